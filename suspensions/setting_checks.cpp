// What the reader of cases checks, too, for those who make settings in C++.
#include "viscontact/suspensions/setting_checks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/setting/lubrication_faults.hpp"

namespace viscontact::particles {
namespace {

// Overlap at the start, in mean radii, that counts as rounding errors of a file.
constexpr double kMostStartOverlap = 1e-6;
// Relative difference of rates that counts as rounding errors of one number.
constexpr double kRoundedRate = 1e-12;

void require_none(const std::optional<SettingFault>& fault) {
  if (fault) throw Error(ErrorKind::kBadInput, "{} {}", fault->key, fault->message);
}

}  // namespace

void check_setting(const Setting& setting, double pair_length) {
  const auto& lubrication = *setting.lubrication;
  const auto& domain = setting.domain;
  require_none(fault_of_periods(domain, pair_length));
  double before = 0;
  for (const auto& piece : lubrication.pieces) {
    require_none(fault_of_piece(piece.until - before, setting.time_step));
    before = piece.until;
  }
  require_none(fault_of_inertia(lubrication, domain));
  const auto periods = periods_of(domain);
  if (lubrication.offset != 0 && periods[1] > 0 && !(periods[0] > 0))
    throw Error(ErrorKind::kBadInput, "an offset of images across y needs a period along x");
  require_none(fault_of_flow(lubrication, domain));
  require_none(fault_of_stress(lubrication, !obstacles_of(domain).empty()));
  if (!setting.planes.empty()) require_none(fault_of_planes(lubrication, domain));
}

void check_flow_before(const Setting& setting, const State& state) {
  const auto& lubrication = *setting.lubrication;
  const bool is_new = state.steps == 0;
  if (!lubrication.inertia || is_new) return;
  const auto periods = periods_of(setting.domain);
  const auto flow = lubrication.flow_at(state.time);
  const double factor = lubrication.factor(state.time, state.time);
  const auto& before = state.shear.gradient;
  for (std::size_t j = 0; j < 3; ++j) {
    if (!(periods[j] > 0)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const double now = factor * flow.gradient[i][j];
      if (std::abs(now - before[i][j]) <= kRoundedRate * std::abs(now)) continue;
      throw Error(ErrorKind::kBadInput,
                  "the velocity along {} changes along {} with the rate {:.6g}, and with {:.6g} in "
                  "the run that this one continues; spheres with inertia keep their velocities, "
                  "which would not be those of their images; along a period the flow must go on "
                  "as it was",
                  "xyz"[i], "xyz"[j], now, before[i][j]);
    }
  }
}

void check_spheres(const Setting& setting, const Particles& particles, double smallest_gap) {
  if (!setting.given_motions.empty())
    throw Error(ErrorKind::kBadInput,
                "spheres with lubrication cannot have given motions; give them forces");
  if (smallest_gap < -kMostStartOverlap * mean_radius(particles))
    throw Error(ErrorKind::kBadInput,
                "two spheres, or a sphere and a plane, overlap by {} at the start; they must not",
                -smallest_gap);
  if (setting.lubrication->inertia &&
      (particles.masses.empty() || !(std::ranges::min(particles.masses) > 0)))
    throw Error(ErrorKind::kBadInput, "a sphere has no mass; with inertia each must have one");
}

}  // namespace viscontact::particles
