// Newton's method and MPRGP for ContactProblem. The scaled W is W/(w_i w_j)^(1/2) [1] with its
// diagonal w; a contact is free if its impulse is above its lower bound.
#include <Eigen/Core>
#include <cassert>
#include <limits>
#include <set>
#include <utility>

#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/constraint_rows/contact_rows.hpp"
#include "viscontact/contact_solver/active_set_newton.hpp"
#include "viscontact/contact_solver/mprgp.hpp"
#include "viscontact/immersed/closed_contacts.hpp"
#include "viscontact/immersed/fluid_contacts.hpp"

namespace viscontact::particles {
namespace {

using Eigen::Index;

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
  // The other contacts of the group may cancel the change by the contact itself. An estimate is
  // therefore at least the median divided by kLargestRatio; w scales unknowns and allowed residuals
  // only.
  std::vector<double> sorted;
  for (const auto& contact : contacts) sorted.push_back(contact.w);
  std::ranges::sort(sorted);
  const double typical = sorted[sorted.size() / 2];
  constexpr double kLargestRatio = 10;
  for (auto& contact : contacts)
    if (!(contact.w > typical / kLargestRatio)) contact.w = typical / kLargestRatio;
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

/// The same problem for few contacts. A vector y = B z holds the product of scaled_matrix and z,
/// and then z.
class DenseDualProblem : public DualProblem {
 public:
  /// `full_w` is dense_w() of the contacts; the matrix of the problem is its symmetric part. If W
  /// is not symmetric, the product of its skew part and the present impulses is added to the gaps.
  DenseDualProblem(std::span<const Contact<2>> contacts, const ContactConditions& conditions,
                   const Eigen::MatrixXd& full_w)
      : DualProblem(contacts.size()) {
    assert(full_w.rows() == std::ssize(contacts) && full_w.cols() == full_w.rows());
    Eigen::VectorXd further = Eigen::VectorXd::Zero(full_w.rows());
    if (!conditions.is_symmetric)
      for (std::size_t c = 0; c < contacts.size(); ++c) {
        const auto i = static_cast<Index>(c);
        further += contacts[c].impulse / 2 * (full_w.col(i) - full_w.row(i).transpose());
      }
    for (std::size_t c = 0; c < contacts.size(); ++c)
      set(c, bounds_of(contacts[c]),
          gap_without_contact(contacts[c], conditions) + further[static_cast<Index>(c)]);
    const Eigen::Map<const Eigen::VectorXd> scales(scale.data(), std::ssize(scale));
    scaled_matrix = full_w.cwiseQuotient(scales * scales.transpose());
    scaled_matrix = (scaled_matrix + scaled_matrix.transpose().eval()) / 2;
  }

  std::size_t displacement_count() const { return 2 * count(); }
  ThreadPool& pool() const { return pool_; }

  double to_bodies(std::span<const double> values, std::span<double> y) const {
    const auto n = static_cast<Index>(count());
    const Eigen::Map<const Eigen::VectorXd> z_of(values.data(), n);
    Eigen::Map<Eigen::VectorXd> product(y.data(), n);
    product = scaled_matrix * z_of;
    std::ranges::copy(values, y.begin() + n);
    return product.dot(z_of);
  }
  double combine(std::span<const double> y, double factor, std::span<double> into) const {
    double form = 0;
    for (std::size_t i = 0; i < into.size(); ++i) into[i] = y[i] + factor * into[i];
    for (std::size_t c = 0; c < count(); ++c) form += into[c] * into[count() + c];
    return form;
  }
  double to_contact(std::size_t c, const double* y) const { return y[c]; }

  Eigen::MatrixXd scaled_matrix;  ///< [1], symmetric, with the diagonal 1

 private:
  mutable ThreadPool pool_{1};
};

/// For active_set_newton().
class DenseFactor {
 public:
  explicit DenseFactor(double error_of_w) : error_of_w_(error_of_w) { assert(error_of_w >= 0); }

  bool exists() const { return !free_.empty(); }  ///< true after the first factorise()
  /// Of the contacts c with free[c] != 0. Returns true in any case.
  bool factorise(const DenseDualProblem& problem, const std::vector<char>& free) {
    free_ = free;
    chosen_.clear();
    for (std::size_t c = 0; c < free.size(); ++c)
      if (free[c] != 0) chosen_.push_back(static_cast<Index>(c));
    matrix_ = problem.scaled_matrix(chosen_, chosen_);
    // Redundant contacts make W singular, up to its errors. The term, which is as large as these
    // errors, bounds the impulses of redundant contacts. The refinement in solve() removes the
    // error that the term causes in all other impulses.
    Eigen::MatrixXd regular = matrix_;
    regular.diagonal() *= 1 + error_of_w_;
    factor_.compute(regular);
    return true;
  }
  /// Sets `solved` to the inverse of the scaled W between the chosen contacts times `gradient`.
  void solve(std::span<const double> gradient, std::span<double> solved) const {
    const Eigen::VectorXd right =
        Eigen::Map<const Eigen::VectorXd>(gradient.data(), std::ssize(gradient))(chosen_);
    Eigen::VectorXd values = factor_.solve(right);
    constexpr int kRefinements = 2;
    for (int i = 0; i < kRefinements; ++i) values += factor_.solve(right - matrix_ * values);
    std::ranges::fill(solved, 0.0);
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      solved[static_cast<std::size_t>(chosen_[i])] = values[static_cast<Index>(i)];
  }

 private:
  double error_of_w_;
  std::vector<char> free_;
  std::vector<Index> chosen_;
  Eigen::MatrixXd matrix_;
  Eigen::LDLT<Eigen::MatrixXd> factor_;
};

/// The identity, as the preconditioner of Mprgp: the diagonal of the scaled W is about 1.
template <SolvableDualProblem Problem>
class IdentityPreconditioner {
 public:
  /// Tells Mprgp to use apply() alone.
  static constexpr bool kMaySweep = false;
  explicit IdentityPreconditioner(Problem& problem) : problem_(&problem) {}

  /// Sets `swept` to the gradient of free contacts, 0 for all others, and `y` to B swept. Returns
  /// the inner product of both.
  double apply(std::span<const double> gradient, std::vector<double>& swept,
               std::vector<double>& y) const {
    double product = 0;
    for (std::size_t c = 0; c < gradient.size(); ++c) {
      swept[c] = problem_->is_free(c) ? gradient[c] : 0.0;
      product += swept[c] * gradient[c];
    }
    problem_->to_bodies(swept, y);
    return product;
  }

 private:
  Problem* problem_;
};

/// Improves problem.z by MPRGP until all residuals are allowed, or until `most` products with W are
/// done. Returns their number.
template <SolvableDualProblem Problem>
int solve_by_gradients(Problem& problem, int most) {
  contact_solver::Mprgp mprgp(problem, IdentityPreconditioner<Problem>(problem));
  bool is_fresh = true;
  for (int products = 1;;) {
    if (!(mprgp.residual() > 1) || products >= most) {
      if (is_fresh) return products;
      mprgp.refresh();  // the updated gradient has accumulated rounding errors
      ++products;
      is_fresh = true;
    } else {
      products += mprgp.step();
      is_fresh = false;
    }
  }
}

struct Correction {
  int products = 0;
  double amplification = 1;  ///< largest change of a scaled impulse over the largest residual
};

/// Reduces the scaled residuals of free contacts by conjugate gradients. How much impulses change
/// in relation to the residuals says how large the errors of impulses are.
template <SolvableDualProblem Problem>
Correction correct_by_gradients(Problem& problem, int most) {
  // A tenth of the residual is enough for the size of the change. Where more products are needed,
  // the change would have gone on growing.
  constexpr double kReduction = 0.1, kUnfinished = 10;
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
  while (left > kReduction * before && correction.products < most) {
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
  if (left > kReduction * before) {
    correction.amplification *= kUnfinished;
    return correction;
  }
  for (std::size_t c = 0; c < n; ++c)
    if (problem.is_free(c)) problem.z[c] = std::max(problem.bound[c], problem.z[c] + change[c]);
  return correction;
}

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
    constexpr double kRoughLength = 1e-3, kRoughImpulse = 1e-2;
    auto& settings = conditions.solver;
    settings.tolerance = std::max(settings.tolerance, kRoughLength);
    settings.impulse_tolerance = std::max(settings.impulse_tolerance, kRoughImpulse);
  }
  const auto is_solved = [&] {
    return measure_residuals(contacts_, velocities_, conditions).converged;
  };
  // The relative error of velocities that are sums of responses to forces. Residuals that such
  // errors cause are allowed in all rounds.
  constexpr double kErrorOfSums = 2e-11;
  if (conditions.keeps_solution && is_dense) {
    take_velocities();
    if (is_solved()) return true;
  }
  conditions.velocity_error = kErrorOfSums;
  // The allowed residuals depend on the impulses, which are known only after the first round. If W
  // is not symmetric, each round multiplies the error by about the ratio of the skew part of W to
  // the symmetric part.
  constexpr int kRounds = 4, kRoundsOfSkewPart = 40;
  const int rounds = is_dense && !conditions.is_symmetric ? kRoundsOfSkewPart : kRounds;
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
  conditions.velocity_error = std::max(kErrorOfSums, conditions_.velocity_error);
  return is_solved();
}

void ContactProblem::solve_dense() {
  constexpr int kNewtonSteps = 50;  // Newton's method takes few steps, or it cycles
  const auto w = dense_w(contacts_, responses_, conditions_.layout);
  int iterations = 0;
  const auto most = [&] { return conditions_.solver.max_iterations - iterations_ - iterations; };
  const auto newton = [&](DenseDualProblem& problem) {
    DenseFactor factor(conditions_.velocity_error);
    const auto solved = active_set_newton(problem, factor, std::min(most(), kNewtonSteps));
    iterations += solved.iterations;
    for (std::size_t c = 0; c < contacts_.size(); ++c) contacts_[c].impulse = problem.impulse(c);
    return solved.residual <= 1;
  };
  const auto solve = [&] {
    DenseDualProblem problem(contacts_, conditions_, w);
    return newton(problem);
  };
  bool is_solved = solve();
  if (!is_solved && most() > 0) {
    // As long as the load of a heavy particle on a light one is not known, the allowed residuals
    // may be below rounding errors.
    constexpr double kRough = 1e6;
    for (auto& contact : contacts_) contact.allowed *= kRough;
    if (solve()) {
      set_allowed(contacts_, conditions_);
      for (auto& contact : contacts_) contact.allowed /= 2;
      is_solved = solve();
    } else {
      for (auto& contact : contacts_) contact.allowed /= kRough;
    }
  }
  if (!is_solved) {
    DenseDualProblem problem(contacts_, conditions_, w);
    iterations += solve_by_gradients(problem, most());
    for (std::size_t c = 0; c < contacts_.size(); ++c) contacts_[c].impulse = problem.impulse(c);
  }
  iterations_ += iterations;
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
  iterations_ += 1 + solve_by_gradients(problem, conditions_.solver.max_iterations - iterations_);
  if (!is_rough_) {
    // A correction by a tenth takes less than a solution.
    constexpr int kMostProducts = 40;
    const auto correction = correct_by_gradients(problem, kMostProducts);
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
