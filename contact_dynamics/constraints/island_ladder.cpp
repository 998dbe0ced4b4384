// The table of strategies for an island, with (5.6) to (5.9), (5.17) and (5.21), docs/physics.md.
#include "viscontact/contact_dynamics/constraints/island_ladder.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace viscontact::particles {
namespace {

struct IslandTuning {
  // Corrections end below this part of what is allowed; the rest is left to the residual.
  static constexpr double kEnd = 0.5;
  // Each correction multiplies the error by about the turn of the bodies in the step [rad].
  // Corrections count as divergent if they grow kPatience times in succession, or if
  // kMostWithoutGain of them do not halve the largest one. (Five factors of 0.87 would halve it.)
  // Then the constraints contradict each other, or the step is too long.
  static constexpr int kPatience = 3, kMostWithoutGain = 5;
  // A correction is fast if it is below this part of the one before.
  static constexpr double kFast = 0.1;
  // An unsolved problem is still corrected if its residual is this small part of the correction.
  static constexpr double kSmallPart = 1e-3;
  // Corrected problems take 10 to 300 iterations, unless constraints contradict each other. They
  // may take kLeastCorrected also if the solution before left fewer.
  static constexpr int kMostCorrected = 1000, kLeastCorrected = 100;
  // Corrections after which unique loads have the tensions that belong to them.
  static constexpr int kWithTheirTensions = 4;
  // Energy and loads of a corrected problem over the first ones that tell that friction locks a
  // body (is_locked()). Planes and arms that move may add energy, too, but without such loads.
  static constexpr double kMostEnergy = 1.01, kMostLoads = 10;
  // Corrections below this part of the mean radius are errors of solutions.
  static constexpr double kErrors = 1e-6;
};

/// Twice the kinetic energy of the `motions`, times the length of the step [M L^2/T].
template <int D>
double energy_of(const ConstraintProblem<D>& problem, std::span<const Motion<D>> motions) {
  double energy = 0;
  for (std::size_t u = 0; u < motions.size(); ++u) {
    const auto impulse = problem.units[u].impulse_of(motions[u]);
    for (std::size_t k = 0; k < impulse.size(); ++k) energy += impulse[k] * motions[u][k];
  }
  return energy;
}

/// The sum of the magnitudes of the normal impulses of all contacts [M L/T].
template <int D>
double sum_of_loads(const ConstraintProblem<D>& problem) {
  double sum = 0;
  for (const auto& block : problem.blocks)
    if (block.is_contact) sum += std::abs(problem.impulses[block.row]);
  return sum;
}

}  // namespace

// Stage; when it is entered; its step. Each takes one step, and the table is read again from the
// top. Each row follows from a case of the tests of contact_dynamics/friction or links.
template <int D>
const std::array<typename IslandLadder<D>::Row, 8> IslandLadder<D>::kTable{{
    // The problem as it stands: first without corrections, then with them.
    {Stage::kCorrections, &IslandLadder::needs_solution, nullptr, &IslandLadder::find_solution,
     nullptr, nullptr},
    // Friction locks a body that turns about the line through two contacts. The correction for this
    // turn demands a motion that the locks prevent. The convex relaxation has a solution, but with
    // loads more than ten times those without corrections and 1 % more energy: anew with the loads
    // without corrections.
    {Stage::kGivenLoads, &IslandLadder::is_locked, nullptr, &IslandLadder::retry_with_first_loads,
     nullptr, nullptr},
    // The corrected problem is not solved, and its gaps are linear: anew with distances, and with
    // as many further iterations as were taken.
    {Stage::kDistances, &IslandLadder::needs_distances, nullptr,
     &IslandLadder::use_distances_with_more_iterations, nullptr, nullptr},
    // It is not solved with distances either: anew with the loads without corrections or, with
    // Coulomb's law, of a solution without friction.
    {Stage::kGivenLoads, &IslandLadder::may_retry, nullptr, &IslandLadder::retry_with_first_loads,
     nullptr, nullptr},
    // The first problem is not solved. With Coulomb's law by the loads of the best iterate, so that
    // gaps, films and links are exact, or, if this fails, those of a solution without friction. The
    // convex relaxation has no solution where friction locks particles that must move: by the loads
    // of a solution without friction.
    {Stage::kGivenLoads, &IslandLadder::may_give_up_here, nullptr, &IslandLadder::give_up_here,
     nullptr, nullptr},
    // The next correction: done if it is small, or if a problem stays unsolved.
    {Stage::kCorrections, &IslandLadder::needs_measurement, nullptr, &IslandLadder::measure,
     nullptr, nullptr},
    // Corrections diverge: anew with distances. (Linear gaps of particles in touch that turn about
    // each other contradict rigid bodies and links.)
    {Stage::kDistances, &IslandLadder::may_use_distances, nullptr, &IslandLadder::use_distances,
     nullptr, nullptr},
    // They diverge also with distances, because friction may turn bodies too far: anew with the
    // loads of a solution without friction.
    {Stage::kGivenLoads, &IslandLadder::may_retry_without_friction, nullptr,
     &IslandLadder::retry_without_friction, nullptr, nullptr},
}};

template <int D>
IslandLadder<D>::IslandLadder(ConstraintSystem<D>& constraints, ContactSystem<D>& system,
                              Island& island, bool is_rough, double roughly_allowed,
                              int max_iterations)
    : constraints_(constraints),
      system_(system),
      island_(island),
      problem_(island.problem),
      is_rough_(is_rough),
      roughly_allowed_(roughly_allowed),
      max_iterations_(max_iterations) {}

template <int D>
SolverResult IslandLadder<D>::solve() {
  restart();
  contact_solver::run_stages(kTable, *this);
  island_.needs_shorter_step = can_be_divided() && !(result_.residual <= 1) && could_give_up();
  take_over();
  return result_;
}

template <int D>
void IslandLadder<D>::restart() {
  constraints_.make_problem(system_, island_, is_rough_, roughly_allowed_);
  if (constraints_.has_motions_without_contacts(island_) &&
      !constraints_.begin_without_contacts(system_, island_))
    constraints_.make_problem(system_, island_, is_rough_, roughly_allowed_);
  last_change_ = gained_change_ = std::numeric_limits<double>::infinity();
  growing_ = gained_at_ = 0;
}

template <int D>
void IslandLadder<D>::find_solution(Stage stage) {
  using Tuning = IslandTuning;
  int most = island_.has_given_up ? kMostOfGivenLoads : max_iterations_ - result_.iterations;
  if (corrections_ > 0) most = std::max(most, Tuning::kLeastCorrected);
  if (corrections_ > 0 && can_use_distances()) most = std::min(most, Tuning::kMostCorrected);
  solution_ = solve_constraints(problem_, std::max(1, most), constraints_.start);
  result_.iterations += solution_.result.iterations;
  result_.stages += solution_.result.stages;
  if (corrections_ > 0) ++result_.stages[stage];
  refinement_.reset();
  if (!is_rough_) refine();
  phase_ = Phase::kSolved;
  if (corrections_ > 0) return;
  const std::vector<double> none(problem_.rows.size());
  first_energy_ = std::max(energy_of<D>(problem_, solution_.motions),
                           energy_of<D>(problem_, contact_solver::motions<D>(problem_, none)));
  first_loads_ = sum_of_loads(problem_);
  if (constraints_.is_convex_) first_impulses_ = problem_.impulses;
}

template <int D>
void IslandLadder<D>::refine() {
  // Refinement of many rows would take more time than accelerated sweeps.
  if (constraints_.start == ConstraintStart::kAcceleratedSweeps &&
      problem_.rows.size() > Refinement<D>::kFew)
    return;
  refinement_.emplace(problem_, solution_);
  if (refinement_->is_done()) ++result_.stages[Stage::kRefinements];
}

template <int D>
bool IslandLadder<D>::is_locked() const {
  using Tuning = IslandTuning;
  return phase_ == Phase::kSolved && corrections_ > 0 && constraints_.is_convex_ &&
         first_loads_ > 0 && sum_of_loads(problem_) > Tuning::kMostLoads * first_loads_ &&
         energy_of<D>(problem_, solution_.motions) > Tuning::kMostEnergy * first_energy_ &&
         may_give_up();
}

template <int D>
void IslandLadder<D>::retry_with_first_loads(Stage stage) {
  retry_with_given_loads(first_impulses_, stage);
}

template <int D>
bool IslandLadder<D>::is_exhausted() const {
  return result_.iterations >= max_iterations_ + (island_.has_given_up ? kMostOfGivenLoads : 0);
}

template <int D>
bool IslandLadder<D>::is_unsolved() const {
  // A convex problem is given up only if further iterations would not solve it.
  return phase_ == Phase::kSolved && !(solution_.result.residual <= 1) && !is_rough_ &&
         !(constraints_.is_convex_ && is_exhausted());
}

template <int D>
void IslandLadder<D>::use_distances(Stage stage) {
  system_.use_distances(island_.bodies.front());
  ++result_.stages[stage];
  restart();
  corrections_ = 0;
  phase_ = Phase::kNotSolved;
}

template <int D>
void IslandLadder<D>::use_distances_with_more_iterations(Stage stage) {
  max_iterations_ += result_.iterations;
  use_distances(stage);
}

template <int D>
void IslandLadder<D>::give_up_here(Stage stage) {
  // Where friction locks particles that must move, impulses grow without bound, so that loads have
  // no meaning. This happens in every convex problem without a solution.
  if (give_up(constraints_.is_convex_, stage)) refine();
}

template <int D>
void IslandLadder<D>::measure(Stage) {
  using Tuning = IslandTuning;
  result_.residual = solution_.result.residual;
  const bool is_refined = refinement_ && refinement_->is_done();
  island_.loads_may_drift = corrections_ >= Tuning::kWithTheirTensions && !is_refined;
  double change = constraints_.correct(system_, island_, solution_.motions);
  if (refinement_ && refinement_->is_done()) change = std::max(change, change_of_impulses());
  result_.residual += change;
  growing_ = change < last_change_ ? 0 : growing_ + 1;
  const bool is_fast = change < Tuning::kFast * last_change_;
  last_change_ = change;
  if (change < gained_change_ / 2) {
    gained_change_ = change;
    gained_at_ = corrections_;
  }
  const double most = is_exhausted() ? 1 : std::max(1.0, Tuning::kSmallPart * change);
  if (change <= Tuning::kEnd || is_rough_ || !(solution_.result.residual <= most)) {
    is_done_ = true;
  } else if (growing_ == Tuning::kPatience ||
             corrections_ - gained_at_ == Tuning::kMostWithoutGain) {
    is_done_ = !has_large_shifts();
    phase_ = Phase::kDiverged;
  } else {
    prepare_correction(is_fast);
  }
}

template <int D>
void IslandLadder<D>::prepare_correction(bool is_fast) {
  // The loads of a solution bound the friction of the next one. With large friction this may repeat
  // without end, while corrections would follow the loads. The first correction contains most of
  // what turns change. The solution after it therefore begins with the same loads, and all later
  // solutions keep the loads that it finds.
  if (corrections_ == 0 && !problem_.keeps_loads)
    for (std::size_t b = 0; b < island_.contacts.size(); ++b)
      problem_.blocks[b].given_load = constraints_.contact_states_[island_.contacts[b]].first_load;
  if (corrections_ > 0) problem_.keeps_loads = true;
  problem_.is_near =
      corrections_ > 0 && solution_.result.residual <= 1 && (is_fast || !has_large_shifts());
  ++corrections_;
  phase_ = Phase::kNotSolved;
}

template <int D>
bool IslandLadder<D>::can_be_divided() const {
  return constraints_.can_be_divided &&
         std::ranges::all_of(problem_.blocks, &ConstraintBlock::is_contact);
}

template <int D>
bool IslandLadder<D>::could_give_up() const {
  const auto has_own_load = [](const ConstraintBlock& block) {
    return block.is_contact && block.rows > 1 && block.friction_bound != FrictionBound::kGiven;
  };
  return island_.can_give_up && !island_.has_given_up && !problem_.is_rough &&
         std::ranges::any_of(problem_.blocks, has_own_load);
}

template <int D>
bool IslandLadder<D>::give_up(bool have_diverged, Stage stage) {
  const auto with_own_loads = problem_;
  const auto is_solved = [&](bool without_friction) {
    auto solution =
        contact_solver::solve_with_given_loads(problem_, without_friction, constraints_.start);
    result_.iterations += solution.result.iterations;
    result_.stages += solution.result.stages;
    if (!(solution.result.residual <= 1)) return false;
    solution_ = std::move(solution);
    return true;
  };
  island_.has_given_up = (!have_diverged && is_solved(false)) || is_solved(true);
  auto& states = constraints_.contact_states_;
  if (!island_.has_given_up) {
    island_.can_give_up = false;
    for (const auto c : island_.contacts) states[c].could_not_give_up = true;
    problem_ = with_own_loads;
    return false;
  }
  ++result_.stages[stage];
  for (std::size_t b = 0; b < island_.contacts.size(); ++b) {
    auto& state = states[island_.contacts[b]];
    state.gave_up = true;
    state.given_load = problem_.blocks[b].given_load;
  }
  return true;
}

template <int D>
void IslandLadder<D>::retry_with_given_loads(const std::vector<double>& impulses, Stage stage) {
  auto corrected = problem_;
  const auto tensions = island_.tensions;
  const auto shifts = island_.shifts, shifts_across = island_.shifts_across;
  restart();
  assert(may_give_up());  // as before, or the table would enter the same row without end
  // The rows of tensions, which are the last ones, may have changed.
  std::copy_n(impulses.begin(), std::min(impulses.size(), problem_.impulses.size()),
              problem_.impulses.begin());
  if (give_up(impulses.empty(), stage)) {
    corrections_ = 1;
    phase_ = Phase::kNotSolved;
    return;
  }
  problem_ = std::move(corrected);
  island_.tensions = tensions;
  island_.shifts = shifts;
  island_.shifts_across = shifts_across;
}

template <int D>
bool IslandLadder<D>::can_use_distances() const {
  return system_.may_use_distances() && std::ranges::any_of(island_.contacts, [&](std::size_t c) {
           const auto& contact = system_.contacts[c];
           return contact.first >= 0 && system_.has_finite_turns(contact) &&
                  !system_.uses_distance(contact);
         });
}

template <int D>
bool IslandLadder<D>::has_large_shifts() const {
  const std::size_t contacts = island_.contacts.size();
  const double mean_radius = constraints_.mean_radius_;
  for (std::size_t b = 0; b < island_.shifts.size(); ++b) {
    const bool is_angle =
        b >= contacts && constraints_.links_[island_.links[b - contacts]].is_angle();
    if (std::max(island_.shifts[b], island_.shifts_across[b]) * (is_angle ? mean_radius : 1) >
        IslandTuning::kErrors * mean_radius)
      return true;
  }
  return false;
}

template <int D>
double IslandLadder<D>::change_of_impulses() const {
  if (std::ranges::all_of(island_.shifts, [](double shift) { return shift == 0; })) return 0;
  const auto [allowed, of_values] = constraints_.errors_of_values(island_);
  const auto changes = refinement_->changes_by(island_.shifts);
  const auto unavoidable = refinement_->changes_by(of_values);
  double largest = 0;
  for (std::size_t b = 0; b < allowed.size(); ++b)
    if (changes[b] > 0)
      largest = std::max(largest, changes[b] / std::max(allowed[b], unavoidable[b]));
  return largest;
}

template <int D>
void IslandLadder<D>::take_over() {
  constraints_.take_over(system_, island_, solution_);
  constraints_.take_errors(island_,
                           refinement_ && refinement_->is_done() ? &*refinement_ : nullptr);
  if (island_.contacts.empty() && result_.residual <= 1)
    constraints_.keep_motions_without_contacts(system_, island_, solution_.motions);
  auto& states = constraints_.contact_states_;
  if (is_rough_)
    for (const auto c : island_.contacts) states[c].first_load = states[c].solid_load;
  if (is_rough_ || island_.has_given_up) return;
  for (std::size_t b = 0; b < island_.contacts.size(); ++b)
    states[island_.contacts[b]].last_load = problem_.blocks[b].given_load;
}

template class IslandLadder<2>;
template class IslandLadder<3>;

}  // namespace viscontact::particles
