// Spheres with inertia in a step, (9.19) to (9.21).
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/step/step_parts.hpp"

namespace viscontact::suspensions {
namespace {

/// The theta (9.20) of a velocity that dies out with exp(-z) in the step.
double share_of_end(double z) {
  // Below this z the next term of the series, z^3/720, is below rounding errors.
  constexpr double kSmall = 1e-4;
  return z < kSmall ? 0.5 + z / 12 : -1 / std::expm1(-z) - 1 / z;
}

double power(const SphereDrag& inertia, const Motion& a, const Motion& b) {
  return inertia.move * dot(a.along, b.along) + inertia.turn * dot(a.turn, b.turn);
}

}  // namespace

void SuspensionStep::add_inertia() {
  inertia_.clear();
  if (problem_.inertia.empty()) return;
  auto& resistance = system_.resistance();
  // What slows each sphere down.
  std::vector<SphereDrag> slowed(resistance.count());
  const auto& lubrication = problem_.lubrication;
  for (std::size_t k = 0; k < problem_.inertia.size(); ++k) {
    const double a = problem_.radii[k];
    const double drag = lubrication.drag * lubrication.viscosity * std::numbers::pi * a;
    slowed[k] = {6 * drag, 8 * drag * a * a};
  }
  for (const auto& pair : resistance.pairs) {
    auto &first = slowed[index_of(pair.first)], &second = slowed[index_of(pair.second)];
    first.move += pair.squeeze;
    first.turn += pair.turn_first;
    second.move += pair.squeeze;
    second.turn += pair.turn_second;
  }
  // Solids that touch do not give their momentum back.
  const bool may_touch = lubrication.pairs == particles::PairTerms::kNone ||
                         lubrication.roughness > 0 || lubrication.regularisation > 0;
  const double h = problem_.h;
  const auto stops = stopped_spheres();
  for (std::size_t k = 0; k < problem_.inertia.size(); ++k) {
    const auto& [mass, moment, start] = problem_.inertia[k];
    const bool is_last = may_touch || stops[k];
    const double move = is_last ? 1 : share_of_end(h * slowed[k].move / mass);
    const double turn = is_last ? 1 : share_of_end(h * slowed[k].turn / moment);
    inertia_.push_back({mass / (move * h), moment / (turn * h)});
    resistance.spheres[k].move += inertia_[k].move;
    resistance.spheres[k].turn += inertia_[k].turn;
  }
}

std::vector<bool> SuspensionStep::stopped_spheres() const {
  std::vector<bool> stops(problem_.inertia.size(), false);
  const Matrix carry = matrix_of(carried, problem_.gradient, problem_.h);
  const auto start_of = [&](std::size_t k) {
    return k < stops.size() ? vector_of(problem_.inertia[k].start.along) : Vector{};
  };
  for (std::size_t p = 0; p < problem_.pairs.size(); ++p) {
    if (!(system_.resistance().pairs[p].squeeze > 0)) continue;
    const auto& pair = problem_.pairs[p];
    const auto i = index_of(pair.first), j = index_of(pair.second);
    const double length = norm(pair.apart), touching = sizes(p).contact_distance;
    const Vector end = times(carry, pair.apart) + problem_.h * (start_of(j) - start_of(i));
    if (dot(pair.apart, end) / length - touching >= StepTuning::kImpact * (length - touching))
      continue;
    for (const auto k : {i, j})
      if (k < stops.size()) stops[k] = true;
  }
  return stops;
}

void SuspensionStep::add_momentum(std::vector<Motion>& loads) const {
  for (std::size_t k = 0; k < inertia_.size(); ++k) {
    loads[k].along += inertia_[k].move * problem_.inertia[k].start.along;
    loads[k].turn += inertia_[k].turn * problem_.inertia[k].start.turn;
  }
}

std::vector<Motion> SuspensionStep::changes_of_velocities() const {
  std::vector<Motion> changes(inertia_.size());
  for (std::size_t k = 0; k < changes.size(); ++k) {
    const auto& [mass, moment, start] = problem_.inertia[k];
    changes[k].along = (inertia_[k].move * problem_.h / mass) * (motions_[k].along - start.along);
    changes[k].turn = (inertia_[k].turn * problem_.h / moment) * (motions_[k].turn - start.turn);
  }
  return changes;
}

void SuspensionStep::balance_momentum() {
  const auto& resistance = system_.resistance();
  if (inertia_.empty() || resistance.fixed > 0) return;
  // Of pairs only their drags have a sum.
  Lanes force{};
  double most = 0;  // at least what all spheres resist together
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    force += given_loads_[k].along - resistance.spheres[k].move * motions_[k].along;
    most += resistance.spheres[k].move;
  }
  for (const auto& row : resistance.drags) {
    const auto loads = loads_of(row, motions_[index_of(row.first)], motions_[index_of(row.second)]);
    force -= loads.first.along + loads.second.along;
    const auto add = [&](const auto& move) { most += (move[0] + move[1]) * (move[0] + move[1]); };
    add(row.drag.axial);
    for (const auto& mode : row.drag.transverse) add(mode.move);
  }
  for (auto& motion : motions_) motion.along += (1 / most) * force;
}

double SuspensionStep::power_of_inertia() const {
  double sum = 0;
  for (std::size_t k = 0; k < inertia_.size(); ++k)
    sum += power(inertia_[k], motions_[k], motions_[k]);
  return sum;
}

double SuspensionStep::power_of_momentum() const {
  double sum = 0;
  for (std::size_t k = 0; k < inertia_.size(); ++k)
    sum += power(inertia_[k], motions_[k], problem_.inertia[k].start);
  return sum;
}

double SuspensionStep::inertia_of(std::int32_t first, std::int32_t second) const {
  if (inertia_.empty()) return 0;
  const double one = inertia_[index_of(first)].move;
  if (index_of(second) >= inertia_.size()) return one;
  const double two = inertia_[index_of(second)].move;
  return one * two / (one + two);
}

}  // namespace viscontact::suspensions
