// The rate of the flow as one more unknown of a step, (9.22) and (9.23).
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/step/contacts.hpp"
#include "viscontact/suspensions/step/films.hpp"
#include "viscontact/suspensions/step/step_parts.hpp"

namespace viscontact::suspensions {
namespace {

double power(const std::vector<Motion>& loads, const std::vector<Motion>& motions) {
  double sum = 0;
  for (std::size_t k = 0; k < loads.size(); ++k)
    sum += dot(loads[k].along, motions[k].along) + dot(loads[k].turn, motions[k].turn);
  return sum;
}

/// a + factor b.
std::vector<Motion> sum(const std::vector<Motion>& a, double factor, const std::vector<Motion>& b) {
  auto result = a;
  for (std::size_t k = 0; k < b.size(); ++k) {
    result[k].along += factor * b[k].along;
    result[k].turn += factor * b[k].turn;
  }
  return result;
}

}  // namespace

void SuspensionStep::set_rate() {
  problem_.gradient = problem_.stress->gradient;
  for (auto& row : problem_.gradient) row = rate_->value * row;
  strain_ = strain_rate_of(problem_.gradient);
  set_flow();
}

void SuspensionStep::place_rate() {
  auto& rate = *rate_;
  const std::vector<Motion> at_rest(motions_.size());
  rate.loads_by_strain = at_rest;
  system_.subtract_strain_loads(rate.strain, rate.loads_by_strain);
  for (auto& load : rate.loads_by_strain) load = {-load.along, -load.turn};
  rate.of_strain = system_.stresslets(at_rest, rate.strain).contracted(rate.strain);
}

void SuspensionStep::linearise_rate() {
  auto& rate = *rate_;
  const auto& rows = system_.resistance().pairs;
  rate.loads = rate.loads_by_strain;
  rate.resistance = rate.of_strain + problem_.stress->of_fluid;
  // What the motions do to the strain is what the strain does to them.
  const double of_motions = power(rate.loads, motions_);
  rate.power = of_motions + rate.resistance * rate.value + problem_.stress->of_repulsion;
  rate.magnitude = std::abs(of_motions) + std::abs(rate.resistance * rate.value) +
                   std::abs(problem_.stress->of_repulsion);
  rate.opening.resize(rows.size());
  for (std::size_t p = 0; p < rows.size(); ++p) add_to_rate(p);
}

void SuspensionStep::add_to_rate(std::size_t p) {
  auto& rate = *rate_;
  const auto& row = system_.resistance().pairs[p];
  const auto& film = films_[p];
  const Vector n = vector_of(row.normal), apart = problem_.pairs[p].apart;
  const double strained = dot(n, rate.strain.times(n)), h = problem_.h;
  const double opened = dot(n, times(problem_.stress->gradient, apart));
  rate.opening[p] = opened;
  const auto add_power = [&](double of_part) {
    rate.power += of_part;
    rate.magnitude += std::abs(of_part);
  };
  // Change of the force along the normal with the rate. It differs by some percent from the change
  // of the power with the opening, because normals are those of half of the step. The mean makes
  // the linear problem symmetric; with one of both the iteration may diverge.
  double load = 0;
  if (film.alpha > 0) {
    const auto [arm, excess, stress_axial] = film_strain(p);
    const double stiffness = film.alpha / film.at;
    const double force = film.force(h) + stiffness * (film.width - film.at) / h;
    load = (stiffness * (opened + arm * strained) + excess * strained) / 2;
    // Of a square, so that the linear problem has a minimum.
    rate.resistance += load * load / stiffness + stress_axial * strained * strained;
    add_power(arm * strained * force);
    add_power(stress_axial * strained * strained * rate.value);
  }
  Lanes turn1{}, turn2{};
  if (film.contact >= 0) {
    const auto& contact = contacts_[index_of(film.contact)];
    const Vector change =
        vector_of(motions_[index_of(row.second)].along - motions_[index_of(row.first)].along);
    const Vector lever = mean_path(problem_.gradient, h, apart, change);
    const double pushed = contact.pushes ? contact.trial_load(film.width, h) : contact.least_load;
    const double opened_by_lever = dot(n, times(problem_.stress->gradient, lever));
    add_power(-pushed * opened_by_lever);
    if (contact.pushes) {
      const double mean = (opened + opened_by_lever) / 2;
      load += contact.stiffness * mean;
      rate.resistance += contact.stiffness * mean * mean;
    }
    if (problem_.friction > 0) {
      const auto& across = frictions_[index_of(film.contact)];
      const Lanes slipped = slip_by_strain(across, rate.strain);
      const Lanes friction = change_of_friction(across, slipped);
      add_power(dot(across.at_friction, slipped));
      rate.resistance += dot(friction, slipped);
      turn1 = across.arm_first * friction;
      turn2 = across.arm_second * friction;
    }
  }
  const Lanes along =
      load * lanes_of(row.normal) + row.inverse_arm * cross(row.normal, turn1 + turn2);
  auto &first = rate.loads[index_of(row.first)], &second = rate.loads[index_of(row.second)];
  first.along -= along;
  first.turn += turn1;
  second.along += along;
  second.turn += turn2;
}

ConjugateGradients::Result SuspensionStep::solve_with_rate(const ConjugateGradients::End& end) {
  auto& rate = *rate_;
  auto& resistance = system_.resistance();
  assert(resistance.fixed == 0 && inertia_.empty());
  std::vector<Motion> product(motions_.size());
  resistance.multiply(motions_, product);
  // The unknowns are the rate and the motions less `share` of the present ones times the rate,
  // which are nearly the response to it, so that the rate hardly changes what is left.
  const double of_motions = power(product, motions_), mixed = power(rate.loads, motions_);
  double share = of_motions > 0 ? -mixed / of_motions : 0;
  if (std::abs(share * rate.value - 1) <= StepTuning::kProportional) share = 1 / rate.value;
  const std::vector<Motion> response = sum(std::vector<Motion>(motions_.size()), share, motions_);
  const double resisted = share * share * of_motions + 2 * share * mixed + rate.resistance;
  rate.resisted = resisted;
  // What the power differs from that of the stress, also by the residuals of the motions: it has an
  // error of their square.
  const double missing =
      problem_.stress->of_stress - rate.power + power(sum(right_, -1, product), response);
  rate.is_right = std::abs(missing) <=
                  std::max({StepTuning::kStressTolerance * std::abs(problem_.stress->of_stress),
                            StepTuning::kStressRounding * rate.magnitude, resisted * rate_error()});

  resistance.rate.loads = sum(rate.loads, share, product);
  auto unknowns = sum(motions_, -rate.value, response);
  auto loads = sum(right_, rate.value, rate.loads);
  const double of_rate = missing + power(resistance.rate.loads, unknowns) + resisted * rate.value;
  unknowns.push_back({Lanes{}, Lanes{rate.value, 0, 0, 0}});
  loads.push_back({Lanes{}, Lanes{of_rate, 0, 0, 0}});
  // The drag keeps the block of the entry regular.
  resistance.spheres.push_back({6 * std::numbers::pi * problem_.lubrication.viscosity *
                                    problem_.lubrication.drag * problem_.mean_radius,
                                resisted});
  preconditioner_.set(resistance, *problem_.pool);
  const auto result = gradients_.solve(resistance, preconditioner_, loads, unknowns, end,
                                       StepTuning::kMostIterations);
  resistance.spheres.pop_back();
  rate.value = unknowns.back().turn[0];
  unknowns.pop_back();
  // The row of the rate exactly, because its residual is small against others that count.
  rate.value = (of_rate - power(resistance.rate.loads, unknowns)) / resisted;
  resistance.rate.loads.clear();
  motions_ = sum(unknowns, rate.value, response);
  return result;
}

void SuspensionStep::settle_rate(StepSolution& solution) {
  set_rate();
  find_gaps();
  settle_contacts();
  const auto& given = *problem_.stress;
  double slope = rate_->resisted, missing_before = 0, change = 0;
  for (int k = 0; rate_->value != 0; ++k) {
    sum_stresses(solution);
    const auto& sums = solution.stresses;
    const double powers = sums.film.power + sums.contact.power + sums.friction.power;
    const double missing = given.of_stress - given.of_repulsion - given.of_fluid * rate_->value -
                           powers / rate_->value;
    if (k == StepTuning::kMostCorrections ||
        std::abs(missing) <= StepTuning::kStressTolerance / 10 * std::abs(given.of_stress))
      break;
    // At given loads of contacts the stress changes less with the rate.
    if (k > 0 && missing != missing_before) slope = (missing_before - missing) / change;
    change = missing / slope;
    if (!(std::abs(change) <= StepTuning::kMostCorrected * std::abs(rate_->value))) break;
    missing_before = missing;
    motions_ = sum(motions_, change / rate_->value, motions_);
    rate_->value += change;
    set_rate();
    find_gaps();
  }
  solution.rate = rate_->value;
}

}  // namespace viscontact::suspensions
