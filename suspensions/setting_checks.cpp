// What the reader of cases checks, too, for those who make settings in C++.
#include "viscontact/suspensions/setting_checks.hpp"

#include <algorithm>
#include <array>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/steps/step_times.hpp"

namespace viscontact::particles {
namespace {

// Overlap at the start, in mean radii, that counts as rounding errors of a file.
constexpr double kMostStartOverlap = 1e-6;

void check_cell(const Setting& setting, double pair_length) {
  const auto& lubrication = *setting.lubrication;
  const auto periods = periods_of(setting.domain);
  for (const double period : periods)
    if (period > 0 && period < 2 * pair_length)
      throw Error(
          ErrorKind::kBadInput,
          "the period {} is too short for the range of lubrication: it must be at least {}, "
          "twice the largest distance of a pair",
          period, 2 * pair_length);
  double before = 0;
  const double least_piece = StepGrid::least_piece(setting.time_step);
  for (const auto& piece : lubrication.pieces) {
    if (!(piece.until - before >= least_piece))
      throw Error(ErrorKind::kBadInput,
                  "a piece of the flow is {:.6g} long; it must be at least {:.6g} long, because "
                  "steps pass by a shorter one",
                  piece.until - before, least_piece);
    before = piece.until;
  }
  if (lubrication.inertia && !accelerates_images_alike(lubrication, setting.domain))
    throw Error(
        ErrorKind::kBadInput,
        "spheres with inertia move otherwise than their images, because the fluid "
        "accelerates otherwise there; along a period the flow must be at rest or a shear of "
        "constant rate");
  if (lubrication.offset != 0 && periods[1] > 0 && !(periods[0] > 0))
    throw Error(ErrorKind::kBadInput, "an offset of images across y needs a period along x");
  if (strains_cell(lubrication, setting.domain)) {
    if (!setting.planes.empty())
      throw Error(ErrorKind::kBadInput, "a cell with planes can only be sheared along x, across y");
    return;
  }
  const auto check_flow = [&](const std::array<Vector, 3>& gradient) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (periods[j] > 0 && gradient[i][j] != 0 && !(i == 0 && j == 1))
          throw Error(ErrorKind::kBadInput,
                      "the flow changes along a periodic axis; only a velocity along x may change, "
                      "along y, unless there are three periods");
    if (periods[1] > 0 && !(periods[0] > 0) && gradient[0][1] != 0)
      throw Error(ErrorKind::kBadInput, "a shear flow with a period along y needs one along x");
  };
  check_flow(lubrication.gradient);
  for (const auto& piece : lubrication.pieces) check_flow(piece.gradient);
}

void check_stress(const Setting& setting) {
  const auto& lubrication = *setting.lubrication;
  if (lubrication.stress && lubrication.inertia)
    throw Error(ErrorKind::kBadInput, "with inertia the rate must be given, and not the stress");
  if (lubrication.stress && !obstacles_of(setting).empty())
    throw Error(ErrorKind::kBadInput,
                "beside walls and planes the rate must be given, and not the stress");
}

}  // namespace

void check_setting(const Setting& setting, double pair_length) {
  check_cell(setting, pair_length);
  check_stress(setting);
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
