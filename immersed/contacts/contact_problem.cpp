// Newton's method and MPRGP for ContactProblem. The scaled W is W/(w_i w_j)^(1/2) [1] with its
// diagonal w; a contact is free if its impulse is above its lower bound.
#include <Eigen/Core>
#include <array>
#include <cassert>
#include <limits>
#include <set>
#include <utility>

#include "viscontact/constraint_rows/contact_rows.hpp"
#include "viscontact/contact_solver/methods/active_set_newton.hpp"
#include "viscontact/contact_solver/methods/dense_dual_problem.hpp"
#include "viscontact/immersed/contacts/closed_contacts.hpp"
#include "viscontact/immersed/contacts/fluid_contacts.hpp"

namespace viscontact::particles {
namespace {

using Eigen::Index;

/// Free choices of the solution of a ContactProblem.
struct ContactProblemTuning {
  // The other contacts of a group may cancel the change by the contact itself. An estimate of w is
  // therefore at least the median divided by kLargestRatio; w scales unknowns and allowed residuals
  // only.
  static constexpr double kLargestRatio = 10;
  // A tenth of the residual is enough for the size of the change. Where more products are needed,
  // the change would have gone on growing.
  static constexpr double kReduction = 0.1, kUnfinished = 10;
  // A correction by a tenth takes less than a solution.
  static constexpr int kMostProducts = 40;
  // Newton's method takes few steps, or it cycles.
  static constexpr int kNewtonSteps = 50;
  // As long as the load of a heavy particle on a light one is not known, the allowed residuals may
  // be below rounding errors. A first solution may have residuals that are larger by this factor.
  static constexpr double kRough = 1e6;
  // The least tolerances of gaps and impulses in a rough solution, which only finds further
  // contacts.
  static constexpr double kRoughLength = 1e-3, kRoughImpulse = 1e-2;
  // The relative error of velocities that are sums of responses to forces. Residuals that such
  // errors cause are allowed in all rounds.
  static constexpr double kErrorOfSums = 2e-11;
  // The allowed residuals depend on the impulses, which are known only after the first round. If W
  // is not symmetric, each round multiplies the error by about the ratio of the skew part of W to
  // the symmetric part.
  static constexpr int kRounds = 4, kRoundsOfSkewPart = 40;
};

double gap_without_contact(const Contact<2>& contact, const ContactConditions& conditions) {
  return gap_after(contact, conditions.free_velocities.data(), conditions.h, conditions.layout);
}

/// The group of each contact, from 0; contacts of one group have no common particle.
std::vector<std::size_t> disjoint_groups(std::span<const Contact<2>> contacts) {
  std::set<std::pair<std::int32_t, std::size_t>> used;  // particles and their groups
  std::vector<std::size_t> groups;
  for (const auto& contact : contacts) {
    std::size_t group = 0;
    while (used.contains({contact.first, group}) || used.contains({contact.second, group})) ++group;
    for (const auto k : {contact.first, contact.second})
      if (k >= 0) used.emplace(k, group);
    groups.push_back(group);
  }
  return groups;
}

/// Sets w of each contact [T/M] to an estimate, by one call of the mobility for each group of
/// contacts without a common particle; the other contacts of the group change a gap much less.
/// Returns the number of groups. `motions` is the length of arrays of velocities. `ratio` is the
/// largest over the smallest velocity of a single particle by the unit force of a contact [1].
int estimate_w(std::span<Contact<2>> contacts, std::size_t motions, const Mobility& mobility,
               const MotionLayout& layout, double& ratio) {
  assert(!contacts.empty());
  double least = std::numeric_limits<double>::infinity(), largest = 0;
  const auto count_share = [&](double velocity) {
    // A driven particle, which nothing moves, has no share.
    if (!(velocity > 0)) return;
    least = std::min(least, velocity);
    largest = std::max(largest, velocity);
  };
  const auto group = disjoint_groups(contacts);
  const std::size_t groups = 1 + *std::ranges::max_element(group);
  for (std::size_t g = 0; g < groups; ++g) {
    std::vector<double> forces(motions);
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (group[c] == g) add_contact_force(contacts[c], 1, forces, layout);
    const auto velocities = mobility(forces);
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (group[c] == g) {
        auto alone = contacts[c];
        contacts[c].w = opening(alone, velocities.data(), layout);
        if (alone.is_stop()) continue;
        alone.first = -1;
        const double of_second = opening(alone, velocities.data(), layout);
        count_share(of_second);
        if (contacts[c].first >= 0) count_share(contacts[c].w - of_second);
      }
  }
  ratio = largest > 0 ? largest / least : 1;
  std::vector<double> sorted;
  for (const auto& contact : contacts) sorted.push_back(contact.w);
  std::ranges::sort(sorted);
  const double typical = sorted[sorted.size() / 2];
  for (auto& contact : contacts)
    if (!(contact.w > typical / ContactProblemTuning::kLargestRatio))
      contact.w = typical / ContactProblemTuning::kLargestRatio;
  return static_cast<int>(groups);
}

/// The problem in the unknowns z = sqrt(w) p with the impulses p (dual_problem.hpp). A vector y =
/// B z holds the displacements that the impulses cause, and then the impulses on the particles.
/// Their inner product is p^T W p.
class FluidDualProblem : public DualProblem {
 public:
  /// `contacts` have w > 0 and `allowed` > 0.
  FluidDualProblem(std::span<const Contact<2>> contacts, const ContactConditions& conditions,
                   const Mobility& mobility)
      : DualProblem(contacts.size()),
        contacts_(contacts),
        motions_(conditions.free_velocities.size()),
        mobility_(mobility),
        layout_(conditions.layout) {
    for (std::size_t c = 0; c < contacts.size(); ++c)
      set(c, bounds_of(contacts[c]), gap_without_contact(contacts[c], conditions));
  }

  std::size_t displacement_count() const { return 2 * motions_; }
  /// One thread is enough because the solver of the fluid does most of the work.
  ThreadPool& pool() const { return pool_; }

  double to_bodies(std::span<const double> values, std::span<double> y) {
    const auto impulses = y.subspan(motions_);
    std::ranges::fill(impulses, 0.0);
    for (std::size_t c = 0; c < count(); ++c)
      if (values[c] != 0) add_contact_force(contacts_[c], values[c] / scale[c], impulses, layout_);
    // The mobility is linear, so that impulses give displacements as forces give velocities.
    const auto displacements = mobility_(impulses);
    std::ranges::copy(displacements, y.begin());
    double form = 0;
    for (std::size_t i = 0; i < motions_; ++i) form += displacements[i] * impulses[i];
    return form;
  }
  double combine(std::span<const double> y, double factor, std::span<double> into) const {
    for (std::size_t i = 0; i < into.size(); ++i) into[i] = y[i] + factor * into[i];
    double form = 0;
    for (std::size_t i = 0; i < motions_; ++i) form += into[i] * into[motions_ + i];
    return form;
  }
  /// Entry `c` of W z for y = B z: the scaled change of the gap of contact `c`.
  double to_contact(std::size_t c, const double* y) const {
    return opening(contacts_[c], y, layout_) / scale[c];
  }

 private:
  std::span<const Contact<2>> contacts_;
  std::size_t motions_;
  const Mobility& mobility_;
  MotionLayout layout_;
  mutable ThreadPool pool_{1};
};

/// The matrix W of the contacts [T/M]. Its column c has the changes of all gaps by a unit impulse
/// of contact c, and follows from responses[c], the velocities by a unit force of this contact.
Eigen::MatrixXd dense_w(std::span<const Contact<2>> contacts,
                        std::span<const std::vector<double>> responses,
                        const MotionLayout& layout) {
  assert(responses.size() >= contacts.size());
  const auto n = std::ssize(contacts);
  Eigen::MatrixXd matrix(n, n);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (std::size_t other = 0; other < contacts.size(); ++other)
      matrix(static_cast<Index>(other), static_cast<Index>(c)) =
          opening(contacts[other], responses[c].data(), layout);
  return matrix;
}

struct Correction {
  int products = 0;
  double amplification = 1;  ///< largest change of a scaled impulse over the largest residual
};

/// Reduces the scaled residuals of free contacts by conjugate gradients. How much impulses change
/// in relation to the residuals says how large the errors of impulses are.
template <SolvableDualProblem Problem>
Correction correct_by_gradients(Problem& problem, int most) {
  Correction correction;
  const std::size_t n = problem.count();
  std::vector<double> y(problem.displacement_count()), residual(n), change(n);
  problem.to_bodies(problem.z, y);
  ++correction.products;
  const auto largest_of = [](const std::vector<double>& values) {
    double largest = 0;
    for (const double value : values) largest = largest_or_nan(largest, std::abs(value));
    return largest;
  };
  double square = 0;
  for (std::size_t c = 0; c < n; ++c) {
    if (!problem.is_free(c)) continue;
    residual[c] = -problem.linear_term[c] - problem.to_contact(c, y.data());
    square += residual[c] * residual[c];
  }
  const double before = largest_of(residual);
  if (!(before > 0)) return correction;
  auto direction = residual;
  double left = before;
  while (left > ContactProblemTuning::kReduction * before && correction.products < most) {
    const double form = problem.to_bodies(direction, y);
    ++correction.products;
    if (!(form > 0)) break;
    const double length = square / form;
    double next = 0;
    for (std::size_t c = 0; c < n; ++c) {
      if (!problem.is_free(c)) continue;
      change[c] += length * direction[c];
      residual[c] -= length * problem.to_contact(c, y.data());
      next += residual[c] * residual[c];
    }
    for (std::size_t c = 0; c < n; ++c) direction[c] = residual[c] + next / square * direction[c];
    square = next;
    left = largest_of(residual);
  }
  correction.amplification = std::max(1.0, largest_of(change) / before);
  if (left > ContactProblemTuning::kReduction * before) {
    correction.amplification *= ContactProblemTuning::kUnfinished;
    return correction;
  }
  for (std::size_t c = 0; c < n; ++c)
    if (problem.is_free(c)) problem.z[c] = std::max(problem.bound[c], problem.z[c] + change[c]);
  return correction;
}

/// One solution of the problem with a matrix W.
class DenseLadder {
 public:
  DenseLadder(std::span<Contact<2>> contacts, const ContactConditions& conditions,
              const Eigen::MatrixXd& w, int max_iterations)
      : contacts_(contacts), conditions_(conditions), w_(w), most_(max_iterations) {
    for (const auto& contact : contacts) gaps_.push_back(gap_without_contact(contact, conditions));
  }

  SolverResult solve() {
    contact_solver::run_stages(kTable, *this);
    return result_;
  }
  bool is_done() const { return is_done_; }

 private:
  int left() const { return most_ - result_.iterations; }
  bool is_first() const { return tries_ == 0; }
  bool may_try_roughly() const { return tries_ == 1 && left() > 0; }
  bool always() const { return true; }

  contact_solver::DenseDualProblem problem() const {
    std::vector<ContactBounds> bounds;
    for (const auto& contact : contacts_) bounds.push_back(bounds_of(contact));
    return {bounds, gaps_, w_, conditions_.is_symmetric};
  }
  void take(const contact_solver::DenseDualProblem& problem) {
    for (std::size_t c = 0; c < contacts_.size(); ++c) contacts_[c].impulse = problem.impulse(c);
  }
  void count(Stage stage, int iterations) {
    result_.iterations += iterations;
    result_.stages[stage] += iterations;
  }
  bool newton(Stage stage) {
    auto of = problem();
    contact_solver::DenseFactor factor(conditions_.velocity_error);
    const auto solved = contact_solver::active_set_newton(
        of, factor, std::min(left(), ContactProblemTuning::kNewtonSteps));
    count(stage, solved.iterations);
    take(of);
    return solved.residual <= 1;
  }

  void take_newton(Stage stage) {
    ++tries_;
    is_done_ = newton(stage);
  }
  void take_newton_roughly(Stage stage) {
    ++tries_;
    for (auto& contact : contacts_) contact.allowed *= ContactProblemTuning::kRough;
    if (!newton(stage)) {
      for (auto& contact : contacts_) contact.allowed /= ContactProblemTuning::kRough;
      return;
    }
    set_allowed(contacts_, conditions_);
    for (auto& contact : contacts_) contact.allowed /= 2;
    is_done_ = newton(stage);
  }
  void take_gradients(Stage stage) {
    auto of = problem();
    count(stage, contact_solver::solve_by_gradients(of, left()));
    take(of);
    is_done_ = true;
  }

  using Row = contact_solver::StageRow<DenseLadder>;
  static const std::array<Row, 3> kTable;

  std::span<Contact<2>> contacts_;
  const ContactConditions& conditions_;
  Eigen::MatrixXd w_;
  int most_;
  std::vector<double> gaps_;
  SolverResult result_;
  int tries_ = 0;  // of Newton's method
  bool is_done_ = false;
};

// Stage; when it is entered; its step. Each takes one step.
const std::array<DenseLadder::Row, 3> DenseLadder::kTable{{
    // At first.
    {Stage::kNewton, &DenseLadder::is_first, nullptr, &DenseLadder::take_newton, nullptr, nullptr},
    // If it has cycled: again, to wider tolerances, and from there to those asked for.
    {Stage::kNewton, &DenseLadder::may_try_roughly, nullptr, &DenseLadder::take_newton_roughly,
     nullptr, nullptr},
    // If it cycles then, too.
    {Stage::kGradients, &DenseLadder::always, nullptr, &DenseLadder::take_gradients, nullptr,
     nullptr},
}};

}  // namespace

std::vector<double> ContactProblem::loads() const {
  std::vector<double> loads(velocities_.size());
  for (const auto& contact : contacts_)
    add_contact_force(contact, contact.impulse / conditions_.h, loads, conditions_.layout);
  return loads;
}

bool ContactProblem::solve(bool is_rough) {
  is_rough_ = false;
  if (contacts_.empty()) return true;
  const auto& layout = conditions_.layout;
  const auto has_unknown_w = [&] {
    return std::ranges::any_of(contacts_, [](const auto& c) { return !(c.w > 0); });
  };
  is_dense_ = contacts_.size() <= kMostDenseContacts || !conditions_.is_symmetric;
  if (!is_dense_ && has_unknown_w()) {
    double ratio = 1;
    iterations_ += estimate_w(contacts_, velocities_.size(), mobility_, layout, ratio);
    are_different_ = are_different_ || ratio > kDifferentMobilities;
  }
  is_dense_ = is_dense_ || (are_different_ && contacts_.size() <= kMostDifferentContacts);
  const bool is_dense = is_dense_;
  if (is_dense) {
    while (responses_.size() < contacts_.size()) {
      auto& contact = contacts_[responses_.size()];
      std::vector<double> forces(velocities_.size());
      add_contact_force(contact, 1, forces, layout);
      responses_.push_back(mobility_(forces));
      contact.w = opening(contact, responses_.back().data(), layout);
      ++iterations_;
    }
  }
  is_rough_ = is_rough && !is_dense;  // with a dense W an accurate solution is as fast
  auto conditions = conditions_;
  if (is_rough_) {
    auto& settings = conditions.solver;
    settings.tolerance = std::max(settings.tolerance, ContactProblemTuning::kRoughLength);
    settings.impulse_tolerance =
        std::max(settings.impulse_tolerance, ContactProblemTuning::kRoughImpulse);
  }
  const auto is_solved = [&] {
    return measure_residuals(contacts_, velocities_, conditions).converged;
  };
  if (conditions.keeps_solution && is_dense) {
    take_velocities();
    if (is_solved()) return true;
  }
  conditions.velocity_error = ContactProblemTuning::kErrorOfSums;
  const int rounds = is_dense && !conditions.is_symmetric ? ContactProblemTuning::kRoundsOfSkewPart
                                                          : ContactProblemTuning::kRounds;
  for (int round = 0; round < rounds; ++round) {
    for (auto& contact : contacts_) contact.impulse = std::max(contact.impulse, contact.lowest);
    set_allowed(contacts_, conditions);
    // Half of each allowed residual is left for errors of the velocities that the fluid solver
    // computes from the final forces.
    for (auto& contact : contacts_) contact.allowed /= 2;
    is_dense ? solve_dense() : solve_by_products();
    if (is_solved()) {
      if (is_dense) correct();
      return true;
    }
    if (iterations_ >= conditions_.solver.max_iterations) break;
  }
  // Larger residuals are no failure if errors of the mobility explain them.
  conditions.velocity_error =
      std::max(ContactProblemTuning::kErrorOfSums, conditions_.velocity_error);
  return is_solved();
}

void ContactProblem::solve_dense() {
  DenseLadder ladder(contacts_, conditions_, dense_w(contacts_, responses_, conditions_.layout),
                     conditions_.solver.max_iterations - iterations_);
  const auto solved = ladder.solve();
  iterations_ += solved.iterations;
  stages_ += solved.stages;
  take_velocities();
}

void ContactProblem::correct() {
  StepContacts step;
  step.contacts = contacts_;
  step.of_gaps = responses_;
  step.velocities = velocities_;
  step.loads.resize(velocities_.size());
  correct_impulses(step, 0, mobility_, conditions_);
  iterations_ += step.iterations;
  contacts_ = std::move(step.contacts);
  velocities_ = std::move(step.velocities);
}

void ContactProblem::take_velocities() {
  std::ranges::copy(conditions_.free_velocities, velocities_.begin());
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    for (std::size_t i = 0; i < velocities_.size(); ++i)
      velocities_[i] += responses_[c][i] * (contacts_[c].impulse / conditions_.h);
}

void ContactProblem::solve_by_products() {
  FluidDualProblem problem(contacts_, conditions_, mobility_);
  const int products =
      contact_solver::solve_by_gradients(problem, conditions_.solver.max_iterations - iterations_);
  iterations_ += 1 + products;
  stages_[Stage::kGradients] += products;
  if (!is_rough_) {
    const auto correction = correct_by_gradients(problem, ContactProblemTuning::kMostProducts);
    iterations_ += correction.products;
    amplification_ = correction.amplification;
  }
  std::vector<double> y(problem.displacement_count());
  problem.to_bodies(problem.z, y);
  for (std::size_t i = 0; i < velocities_.size(); ++i)
    velocities_[i] = conditions_.free_velocities[i] + y[i] / conditions_.h;
  for (std::size_t c = 0; c < contacts_.size(); ++c) contacts_[c].impulse = problem.impulse(c);
}

}  // namespace viscontact::particles
