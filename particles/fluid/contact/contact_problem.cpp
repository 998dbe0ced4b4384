// Solves the contact problem of a step in a fluid (fluid_contacts.hpp): computes w, and chooses
// between the matrix W and products with it. Units are those of the case.
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <set>
#include <utility>

#include "viscontact/particles/dual_problem/mprgp.hpp"
#include "viscontact/particles/fluid/contact/fluid_contacts.hpp"

namespace viscontact::particles {
namespace {

using Eigen::Index;

/// D - D_c + h G v [L] with the velocities without contact.
double free_gap(const Contact<2>& contact, const ContactConditions& conditions) {
  return gap_after(contact, conditions.free_velocities.data(), conditions.h, conditions.layout);
}

/// Groups of contacts without a common particle: contact c is in group group[c].
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

/// Estimates w of each contact by one product for each group of contacts without a common particle.
/// Other contacts of the group change the gap as well, but much less. Returns the number of
/// products.
int estimate_w(std::span<Contact<2>> contacts, std::size_t motions, const Mobility& mobility,
               const MotionLayout& layout) {
  const auto group = disjoint_groups(contacts);
  const std::size_t groups = 1 + *std::ranges::max_element(group);
  for (std::size_t g = 0; g < groups; ++g) {
    std::vector<double> forces(motions);
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (group[c] == g) add_contact_force(contacts[c], 1, forces, layout);
    const auto velocities = mobility(forces);
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (group[c] == g) contacts[c].w = opening(contacts[c], velocities.data(), layout);
  }
  // Other contacts of the group can hide a contact's own change. A contact whose w would be below a
  // tenth of the median gets a tenth of the median.
  std::vector<double> sorted;
  for (const auto& contact : contacts) sorted.push_back(contact.w);
  std::ranges::sort(sorted);
  const double typical = sorted[sorted.size() / 2];
  constexpr double kLargestRatio = 10;
  for (auto& contact : contacts)
    if (!(contact.w > typical / kLargestRatio)) contact.w = typical / kLargestRatio;
  return static_cast<int>(groups);
}

/// The contact problem in matrix form, for few contacts: gradient b + W p with p >= gamma. A contact
/// may have a residual |min(b + W p, W_cc (p - gamma))| of at most `allowed` [L].
struct DenseContactProblem {
  Eigen::MatrixXd w;        ///< [T/M], symmetric, positive semidefinite, with a positive diagonal
  Eigen::VectorXd b;        ///< [L]
  Eigen::VectorXd gamma;    ///< [M L/T], <= 0
  Eigen::VectorXd allowed;  ///< [L], > 0
  Eigen::VectorXd p;        ///< a guess, then the solution [M L/T]
  double error_of_w = 0;    ///< relative error of W, >= 0

  /// Largest residual over the allowed one; the problem is solved if it is at most 1.
  double excess() const {
    const Eigen::VectorXd gradient = b + w * p;
    double largest = 0;
    for (Index c = 0; c < p.size(); ++c)
      largest = std::max(largest,
                         contact_residual(gradient[c], w(c, c) * (p[c] - gamma[c])) / allowed[c]);
    return largest;
  }

  /// One step of Newton's method on the set of contacts with p > gamma.
  void change_active_set() {
    const Eigen::VectorXd gradient = b + w * p;
    std::vector<Index> free;
    for (Index c = 0; c < p.size(); ++c) {
      if (w(c, c) * (p[c] - gamma[c]) - gradient[c] > 0)
        free.push_back(c);
      else
        p[c] = gamma[c];
    }
    Eigen::MatrixXd part = w(free, free);
    // Redundant contacts make W singular but for its errors. A term as large as these bounds the
    // impulses that such contacts exert on each other. Refinement removes what it changes elsewhere.
    part.diagonal() *= 1 + error_of_w;
    const Eigen::LDLT<Eigen::MatrixXd> factor(part);
    constexpr int kRefinements = 2;
    for (int i = 0; i <= kRefinements; ++i) {
      const Eigen::VectorXd rest = b + w * p;
      p(free) -= factor.solve(rest(free));
    }
  }

  /// One sweep of Gauss-Seidel with projection on the bounds.
  void sweep() {
    for (Index c = 0; c < p.size(); ++c) {
      const double gradient = b[c] + w.row(c).dot(p);
      p[c] = std::max(gamma[c], p[c] - gradient / w(c, c));
    }
  }

  /// Improves p until all residuals are allowed, or for `most` steps. Returns the number of steps.
  ///
  /// The first method is Newton's on the set of contacts with p > gamma (Hintermueller, Ito &
  /// Kunisch 2002, "The primal-dual active set strategy as a semismooth Newton method"). It takes a
  /// few steps from a good guess, but may cycle. Sweeps, which converge if slowly, follow where it
  /// fails.
  int solve(int most) {
    constexpr int kNewtonSteps = 50;
    int steps = 0;
    for (; steps < std::min(most, kNewtonSteps) && excess() > 1; ++steps) change_active_set();
    if (excess() > 1) p = p.cwiseMax(gamma);
    for (; steps < most && excess() > 1; ++steps) sweep();
    p = p.cwiseMax(gamma);
    return steps;
  }
};

/// The dual problem of ContactProblem as the solver of the projection sees it, with one question to
/// the fluid for each product with W, in scaled unknowns z = sqrt(w) p as ContactGraph scales it. A
/// vector y = B z holds the displacements S G^T p that the impulses p cause, S the mobility, and
/// after them the impulses G^T p on the particles. Their product is z^T W z.
class MobilityGraph {
 public:
  /// `contacts` have w > 0 and `allowed` > 0.
  MobilityGraph(std::span<const Contact<2>> contacts, const ContactConditions& conditions,
                const Mobility& mobility)
      : contacts_(contacts),
        motions_(conditions.free_velocities.size()),
        mobility_(mobility),
        layout_(conditions.layout) {
    for (const auto& contact : contacts) {
      const double root = std::sqrt(contact.w);
      scale.push_back(root);
      per_allowed.push_back(root / contact.allowed);
      z.push_back(std::max(contact.impulse, contact.lowest) * root);
      bound.push_back(contact.lowest * root);
      linear_term.push_back(free_gap(contact, conditions) / root);
    }
  }

  /// Number of contacts.
  std::size_t count() const { return contacts_.size(); }
  /// Number of numbers in a vector y = B z: motions of the particles, and impulses on them.
  std::size_t displacement_count() const { return 2 * motions_; }
  /// One thread, because the solver of the fluid does most of the work.
  ThreadPool& pool() const { return pool_; }

  std::vector<double> z,  ///< scaled impulses z = sqrt(w) p; see ContactGraph
      bound,              ///< lower bounds of z
      linear_term,        ///< the gradient at z = 0
      scale,              ///< sqrt(w) of each contact
      per_allowed;        ///< see ContactGraph

  /// Computes y = B z by one product with the mobility. Returns z^T W z.
  double to_bodies(std::span<const double> values, std::span<double> y) {
    const auto impulses = y.subspan(motions_);
    std::ranges::fill(impulses, 0.0);
    for (std::size_t c = 0; c < count(); ++c)
      if (values[c] != 0) add_contact_force(contacts_[c], values[c] / scale[c], impulses, layout_);
    // The mobility is linear, so that impulses give displacements as forces give velocities.
    const auto displacements = mobility_(impulses);
    ++products_;
    std::ranges::copy(displacements, y.begin());
    double form = 0;
    for (std::size_t i = 0; i < motions_; ++i) form += displacements[i] * impulses[i];
    return form;
  }

  /// Replaces `into` by y + factor * into. Returns z^T W z of the sum.
  double combine(std::span<const double> y, double factor, std::span<double> into) const {
    for (std::size_t i = 0; i < into.size(); ++i) into[i] = y[i] + factor * into[i];
    double form = 0;
    for (std::size_t i = 0; i < motions_; ++i) form += into[i] * into[motions_ + i];
    return form;
  }

  /// (W z)_c for y = B z.
  double to_contact(std::size_t c, const double* y) const {
    return opening(contacts_[c], y, layout_) / scale[c];
  }

  /// True if z_c is above its bound.
  bool is_free(std::size_t c) const { return z[c] > bound[c]; }

  /// h lambda of contact c [M L/T].
  double impulse(std::size_t c) const {
    return z[c] == bound[c] ? contacts_[c].lowest : z[c] / scale[c];
  }
  int products() const { return products_; }  ///< number of calls of to_bodies()

 private:
  std::span<const Contact<2>> contacts_;
  std::size_t motions_;
  const Mobility& mobility_;
  MotionLayout layout_;
  int products_ = 0;
  mutable ThreadPool pool_{1};
};

/// Conjugate gradients on the free contacts without a further preconditioner: W has about the
/// diagonal 1 already.
class IdentityPreconditioner {
 public:
  /// Tells Mprgp to use apply() alone.
  static constexpr bool kMaySweep = false;
  /// `graph` must outlive the object.
  explicit IdentityPreconditioner(MobilityGraph& graph) : graph_(&graph) {}

  /// Sets swept to the gradient of the free contacts, and y = B swept. Returns swept.gradient.
  double apply(std::span<const double> gradient, std::vector<double>& swept,
               std::vector<double>& y) const {
    double product = 0;
    for (std::size_t c = 0; c < gradient.size(); ++c) {
      swept[c] = graph_->is_free(c) ? gradient[c] : 0.0;
      product += swept[c] * gradient[c];
    }
    graph_->to_bodies(swept, y);
    return product;
  }

 private:
  MobilityGraph* graph_;
};

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
  const bool is_dense = contacts_.size() <= kMostDenseContacts;
  if (is_dense) {
    while (responses_.size() < contacts_.size()) {
      auto& contact = contacts_[responses_.size()];
      std::vector<double> forces(velocities_.size());
      add_contact_force(contact, 1, forces, layout);
      responses_.push_back(mobility_(forces));
      contact.w = opening(contact, responses_.back().data(), layout);
      ++iterations_;
    }
  } else if (std::ranges::any_of(contacts_, [](const auto& c) { return !(c.w > 0); })) {
    iterations_ += estimate_w(contacts_, velocities_.size(), mobility_, layout);
  }
  // A matrix is solved exactly at once.
  is_rough_ = is_rough && !is_dense;
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
  // The relative error of velocities that are sums of responses to forces.
  constexpr double kErrorOfSums = 2e-11;
  conditions.velocity_error = kErrorOfSums;
  // The allowed residuals follow from the impulses, which the first solution tells.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    for (auto& contact : contacts_) contact.impulse = std::max(contact.impulse, contact.lowest);
    set_allowed(contacts_, conditions);
    // Half of it is left for the difference between this problem and the final velocities.
    for (auto& contact : contacts_) contact.allowed /= 2;
    is_dense ? solve_dense() : solve_by_products();
    if (is_solved()) return true;
    if (iterations_ >= conditions_.solver.max_iterations) break;
  }
  // Residuals that errors of the mobility explain are no failure.
  conditions.velocity_error = std::max(kErrorOfSums, conditions_.velocity_error);
  return is_solved();
}

void ContactProblem::solve_dense() {
  const auto n = static_cast<Index>(contacts_.size());
  DenseContactProblem problem{Eigen::MatrixXd(n, n), Eigen::VectorXd(n),
                              Eigen::VectorXd(n),    Eigen::VectorXd(n),
                              Eigen::VectorXd(n),    conditions_.velocity_error};
  for (Index c = 0; c < n; ++c) {
    const auto k = static_cast<std::size_t>(c);
    for (Index other = 0; other < n; ++other)
      problem.w(other, c) = opening(contacts_[static_cast<std::size_t>(other)],
                                    responses_[k].data(), conditions_.layout);
    problem.b[c] = free_gap(contacts_[k], conditions_);
    problem.gamma[c] = contacts_[k].lowest;
    problem.allowed[c] = contacts_[k].allowed;
    problem.p[c] = contacts_[k].impulse;
  }
  problem.w = (problem.w + problem.w.transpose().eval()) / 2;
  iterations_ += problem.solve(conditions_.solver.max_iterations - iterations_);
  std::ranges::copy(conditions_.free_velocities, velocities_.begin());
  for (Index c = 0; c < n; ++c) {
    const auto k = static_cast<std::size_t>(c);
    contacts_[k].impulse = problem.p[c];
    for (std::size_t i = 0; i < velocities_.size(); ++i)
      velocities_[i] += responses_[k][i] * (problem.p[c] / conditions_.h);
  }
}

void ContactProblem::solve_by_products() {
  MobilityGraph graph(contacts_, conditions_, mobility_);
  Mprgp mprgp(graph, IdentityPreconditioner(graph));
  bool is_fresh = true;
  for (;;) {
    if (mprgp.residual() <= 1 ||
        iterations_ + graph.products() >= conditions_.solver.max_iterations) {
      if (is_fresh) break;
      mprgp.refresh();  // the updated gradient has accumulated rounding errors
      is_fresh = true;
    } else {
      mprgp.step();
      is_fresh = false;
    }
  }
  std::vector<double> y(graph.displacement_count());
  graph.to_bodies(graph.z, y);
  for (std::size_t i = 0; i < velocities_.size(); ++i)
    velocities_[i] = conditions_.free_velocities[i] + y[i] / conditions_.h;
  for (std::size_t c = 0; c < contacts_.size(); ++c) contacts_[c].impulse = graph.impulse(c);
  iterations_ += graph.products();
}

}  // namespace viscontact::particles
