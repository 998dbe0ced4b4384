// Newton's method for the films, and an augmented Lagrangian for contacts.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/step/contacts.hpp"
#include "viscontact/suspensions/step/films.hpp"
#include "viscontact/suspensions/step/step_parts.hpp"

namespace viscontact::suspensions {
namespace {

using particles::PairTerms;

/// The pairs at half of the step, if the spheres have these motions.
PairSystem::Places predicted(const StepProblem& problem, const std::vector<Motion>& motions) {
  const double half = problem.h / 2;
  const Matrix carry = matrix_of(carried, problem.gradient, half);
  return [&problem, &motions, half, carry](std::size_t p) {
    const auto& pair = problem.pairs[p];
    const auto i = index_of(pair.first), j = index_of(pair.second);
    const auto sizes = sizes_of(problem.radii[i], problem.radii[j]);
    const double sum = sizes.contact_distance, length = norm(pair.apart), start = length - sum;
    const Vector apart =
        times(carry, pair.apart) + half * vector_of(motions[j].along - motions[i].along);
    // The normal of a plane does not turn.
    const double distance = sizes.has_plane ? dot(apart, pair.apart) / length : norm(apart);
    const Vector normal = sizes.has_plane ? (1 / length) * pair.apart : (1 / distance) * apart;
    const double contact = problem.lubrication.roughness * sizes.mean;
    // The prediction may close a gap; a film resists that.
    const double least =
        std::max({contact, start / 4, StepTuning::kLeastGap * problem.mean_radius});
    return PlacedPair{pair.first, pair.second, normal, std::max(distance - sum, least)};
  };
}

}  // namespace

SuspensionStep::SuspensionStep(StepProblem problem)
    : problem_(std::move(problem)),
      strain_(strain_rate_of(problem_.gradient)),
      system_(problem_.lubrication, problem_.radii, problem_.pairs.size(),
              predicted(problem_, problem_.motions), *problem_.pool),
      gradients_(*problem_.pool),
      motions_(std::move(problem_.motions)) {
  system_.leave_out_squeezes();
  add_inertia();
  if (const auto& given = problem_.stress) {
    rate_ = std::make_unique<Rate>();
    rate_->value = given->rate;
    rate_->strain = strain_rate_of(given->gradient);
  }
  films_.resize(problem_.pairs.size());
  for_each_pair([&](std::size_t p) {
    auto& film = films_[p];
    film.start = std::max(norm(problem_.pairs[p].apart) - sizes(p).contact_distance,
                          StepTuning::kLeastGap * problem_.mean_radius) +
                 delta(p);
    film.at = film.start;
  });
  place_films();
  add_contacts();
  std::vector<ContactMemory>().swap(problem_.memories);
}

SuspensionStep::~SuspensionStep() = default;

void SuspensionStep::place_again() {
  std::vector<Lanes> forces;
  for (const auto& contact : frictions_) forces.push_back(force_of(contact));
  preconditioner_.forget_order();
  has_factors_ = false;
  system_.place(predicted(problem_, motions_));
  add_inertia();
  place_films();
  for (auto& contact : contacts_) place_contact(contact);
  for (std::size_t c = 0; c < frictions_.size(); ++c) place_friction(frictions_[c], forces[c]);
}

double SuspensionStep::least_power() const {
  double sum = 0;
  for (std::size_t k = 0; k < problem_.loads.size(); ++k) {
    double drag = 6 * std::numbers::pi * problem_.lubrication.viscosity * problem_.radii[k];
    if (k < inertia_.size()) drag += inertia_[k].move;
    sum += dot(problem_.loads[k].along, problem_.loads[k].along) / drag;
  }
  // The fluid alone would have this power.
  if (const auto& given = problem_.stress)
    sum += given->of_stress * given->of_stress / given->of_fluid;
  return StepTuning::kLeastPower * sum;
}

double SuspensionStep::rounding_power() const {
  const double speed = StepTuning::kGapRounding * problem_.mean_radius / problem_.h;
  return gaps_.stiffness * speed * speed;
}

double SuspensionStep::least_rate() const {
  double least = StepTuning::kRestStrain / problem_.h;
  if (!rate_) return least;
  // A contact may close or open its gap by the tolerance.
  if (!contacts_.empty()) least = StepTuning::kGapTolerance / problem_.h;
  const double shear = std::sqrt(2 * rate_->strain.contracted(rate_->strain));
  return std::max(least, StepTuning::kRestErrors * shear * rate_error());
}

double SuspensionStep::rate_error() const { return std::sqrt(rounding_power() / rate_->resisted); }

ConjugateGradients::Result SuspensionStep::solve_linear(const ConjugateGradients::End& end) {
  if (rate_) return solve_with_rate(end);
  const auto few = StepTuning::kFewChanged * static_cast<double>(films_.size());
  const bool has_new_states =
      problem_.friction > 0 && !is_split_ && unchanged_ % StepTuning::kFactorsWithFriction == 0;
  if (!has_factors_ || has_new_states || static_cast<double>(changed_since_factors_) > few) {
    preconditioner_.set(system_.resistance(), *problem_.pool);
    has_factors_ = true;
    changed_since_factors_ = 0;
  }
  return gradients_.solve(system_.resistance(), preconditioner_, right_, motions_, end,
                          StepTuning::kMostIterations);
}

ConjugateGradients::End SuspensionStep::end_of_linear(int solutions, double allowed) const {
  ConjugateGradients::End end{StepTuning::kSolved * allowed, StepTuning::kReduction};
  if (problem_.friction > 0 && !rate_) end.reduction = StepTuning::kReductionWithFriction;
  if (problem_.friction > 0) return end;
  if (solutions < StepTuning::kRough)
    end.reduction = StepTuning::kReductionBefore;
  else if (!rate_ && solutions <= StepTuning::kMostEarly)
    end.residual = std::max(end.residual, StepTuning::kPartOfChanges * gaps_.power_of_changes);
  return end;
}

StepSolution SuspensionStep::solve() {
  StepSolution solution;
  const int rough = problem_.friction > 0 ? StepTuning::kRoughWithFriction : StepTuning::kRough;
  find_gaps();
  double tightening = problem_.friction > 0 ? StepTuning::kTightWithFriction : 1, allowed = 0;
  double first_allowed = 0, placed_allowed = 0;
  std::vector<Motion> before;
  // Linear problems of the splitting.
  int split_solutions = 0;
  const auto most = [&] {
    return rate_ && contacts_.empty() ? StepTuning::kMostWithRate
                                      : StepTuning::kMostSolutions + split_solutions;
  };
  while (solution.solutions < most()) {
    if (solution.solutions < StepTuning::kMeasured ||
        allowed < StepTuning::kFallen * first_allowed) {
      sum_stresses(solution);
      const double tolerance = problem_.lubrication.pairs == PairTerms::kNone
                                   ? StepTuning::kToleranceWithoutFilm
                                   : StepTuning::kTolerance;
      allowed = tolerance * tolerance * std::max(std::abs(solution.dissipation), least_power());
      if (solution.solutions == 0) first_allowed = allowed;
    }
    const double rounding = rounding_power();
    bool are_loads_given = false;
    if (problem_.friction > 0 && solution.solutions == StepTuning::kFirstSplit) {
      are_loads_given = !split(solution, std::max(tightening * allowed, rounding));
      split_solutions = solution.solutions - StepTuning::kFirstSplit;
    }
    if (problem_.friction > 0 && solution.solutions - split_solutions == StepTuning::kMostWithLoads)
      are_loads_given = true;
    if (are_loads_given) {
      for (auto& contact : frictions_) contact.given_bound = friction_bound(contact);
      if (!problem_.takes_given_bounds) break;
      bounds_ = Bounds::kGiven;
      acceleration_.forget();
    }
    if (solution.solutions == StepTuning::kMostSoft) {
      is_stiff_ = true;
      for (auto& contact : contacts_) place_contact(contact);
    }
    ++unchanged_;
    linearise(solution.solutions == 0);
    const double rate_before = rate_ ? rate_->value : 0;
    if (rate_) linearise_rate();
    const bool is_checked = solution.solutions >= StepTuning::kUnchecked || problem_.friction > 0;
    if (is_checked) before = motions_;
    const auto result =
        solve_linear(end_of_linear(solution.solutions, std::max(tightening * allowed, rounding)));
    ++solution.solutions;
    solution.iterations += result.iterations;
    const bool is_steady = result.start <= std::max(tightening * allowed, rounding) &&
                           solution.solutions > 1 && is_film_exact_;
    const double tolerated = StepTuning::kGapTolerance * problem_.mean_radius;
    if (is_steady && gaps_.error <= tolerated && (!rate_ || rate_->is_right)) {
      const auto error = friction_error();
      solution.is_solved = error.with_bounds <= tolerated;
      solution.converged =
          solution.is_solved && error.with_loads <= tolerated && are_bounds_right();
      if (solution.is_solved && (solution.converged || bounds_ == Bounds::kGiven)) {
        // The last linear problem may have moved a pair too far.
        if (!rate_) find_gaps();
        if (gaps_.error <= tolerated) break;
        solution.is_solved = solution.converged = false;
      }
    }
    // Errors of the linear problem may be what remains.
    if (is_steady && result.iterations <= 1 && tightening > StepTuning::kTightest)
      tightening *= 0.1;
    if (is_checked && (count_changes() > 0 || !is_film_exact_ ||
                       (problem_.friction > 0 && unchanged_ < StepTuning::kUnchanged)))
      shorten(before, rate_before, result.curvature);
    if (rate_) set_rate();
    // The motions may since have fallen to a small part of those by which pairs were placed.
    const bool is_placed_roughly =
        solution.solutions == rough ||
        (solution.solutions > rough && bounds_ == Bounds::kOfLoads && allowed > rounding &&
         allowed < StepTuning::kFallen * placed_allowed);
    if (is_placed_roughly) {
      place_again();
      placed_allowed = allowed;
    }
    find_gaps();
    // Multipliers are those of a problem that is solved, whose contacts are the right ones, or is
    // solved better than the change of multipliers is large.
    const bool is_early = !(problem_.friction > 0) && !rate_ &&
                          solution.solutions <= StepTuning::kMostEarly &&
                          result.start <= gaps_.power_of_changes;
    if (is_placed_roughly || (!is_early && gaps_.changes > 0)) {
      acceleration_.forget();
    } else if (problem_.friction > 0) {
      update_friction(solution.solutions);
    } else {
      update_contacts();
    }
  }
  finish(solution);
  return solution;
}

void SuspensionStep::finish(StepSolution& solution) {
  if (rate_) set_rate();
  balance_momentum();
  // Those of the last motions.
  find_gaps();
  if (rate_) settle_rate(solution);
  solution.least_rate = least_rate();
  sum_stresses(solution);
  solution.changes = changes_of_velocities();
  solution.has_given_loads = bounds_ == Bounds::kGiven && !solution.converged;
  solution.residual = std::max(gaps_.error, friction_error().with_loads) / problem_.mean_radius;
  solution.smallest_gap = gaps_.smallest;
  solution.touching = static_cast<std::size_t>(
      std::ranges::count_if(contacts_, [](const Contact& contact) { return contact.load > 0; }));
  // The memory of the linear problems is of use for what the step leaves.
  preconditioner_ = {};
  gradients_ = ConjugateGradients(*problem_.pool);
  solution.contacts = memories();
  solution.motions = std::move(motions_);
}

}  // namespace viscontact::suspensions
