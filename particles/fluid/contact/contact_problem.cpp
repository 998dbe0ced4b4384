// Solves the contact problem of a step in a fluid (contact_problem.hpp): computes w, and chooses
// between the matrix W and products with it. Units are those of the case.
#include "viscontact/particles/fluid/contact/contact_problem.hpp"

#include <algorithm>
#include <cmath>

#include "viscontact/particles/dual_problem/mprgp.hpp"
#include "viscontact/particles/fluid/contact/contact_residuals.hpp"
#include "viscontact/particles/fluid/contact/dense_contact_problem.hpp"
#include "viscontact/particles/fluid/contact/mobility_graph.hpp"

namespace viscontact::particles {
namespace {

using Eigen::Index;

/// Groups of contacts without a common particle: contact c is in group group[c].
std::vector<std::size_t> disjoint_groups(std::span<const FluidContact> contacts,
                                         std::size_t particles) {
  std::vector<std::vector<char>> is_used(particles);  // by particle and group
  std::vector<std::size_t> groups;
  for (const auto& contact : contacts) {
    const auto is_free = [&](std::int32_t k, std::size_t group) {
      if (k < 0) return true;
      const auto& used = is_used[static_cast<std::size_t>(k)];
      return group >= used.size() || used[group] == 0;
    };
    std::size_t group = 0;
    while (!is_free(contact.first, group) || !is_free(contact.second, group)) ++group;
    for (const auto k : {contact.first, contact.second}) {
      if (k < 0) continue;
      auto& used = is_used[static_cast<std::size_t>(k)];
      used.resize(std::max(used.size(), group + 1), 0);
      used[group] = 1;
    }
    groups.push_back(group);
  }
  return groups;
}

/// Estimates w of each contact by one product for each group of contacts without a common particle.
/// Other contacts of the group change the gap as well, but much less. Returns the number of
/// products.
int estimate_w(std::span<FluidContact> contacts, std::size_t motions, const Mobility& mobility,
               const MotionLayout& layout) {
  const auto group = disjoint_groups(contacts, motions / layout.components);
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

}  // namespace

ContactProblem::ContactProblem(std::span<const double> free_velocities, double h,
                               const Mobility& mobility, MotionLayout layout,
                               const SolverSettings& settings, double mean_radius,
                               double mobility_error)
    : free_velocities_(free_velocities),
      h_(h),
      mobility_(mobility),
      layout_(layout),
      settings_(settings),
      mean_radius_(mean_radius),
      mobility_error_(mobility_error),
      velocities_(free_velocities.begin(), free_velocities.end()) {}

double ContactProblem::b(std::size_t c) const {
  return gap_after(contacts_[c], free_velocities_.data(), h_, layout_);
}

std::vector<double> ContactProblem::loads() const {
  std::vector<double> loads(free_velocities_.size());
  for (const auto& contact : contacts_)
    add_contact_force(contact, contact.impulse / h_, loads, layout_);
  return loads;
}

bool ContactProblem::solve(bool is_rough) {
  is_rough_ = false;
  if (contacts_.empty()) return true;
  const bool is_dense = contacts_.size() <= kMostDenseContacts;
  if (is_dense) {
    while (responses_.size() < contacts_.size()) {
      auto& contact = contacts_[responses_.size()];
      std::vector<double> forces(free_velocities_.size());
      add_contact_force(contact, 1, forces, layout_);
      responses_.push_back(mobility_(forces));
      contact.w = opening(contact, responses_.back().data(), layout_);
      ++iterations_;
    }
  } else if (std::ranges::any_of(contacts_, [](const auto& c) { return !(c.w > 0); })) {
    iterations_ += estimate_w(contacts_, free_velocities_.size(), mobility_, layout_);
  }
  // A matrix is solved exactly at once.
  is_rough_ = is_rough && !is_dense;
  auto settings = settings_;
  if (is_rough_) {
    constexpr double kRoughLength = 1e-3, kRoughImpulse = 1e-2;
    settings.tolerance = std::max(settings.tolerance, kRoughLength);
    settings.impulse_tolerance = std::max(settings.impulse_tolerance, kRoughImpulse);
  }
  // The allowed residuals follow from the impulses, which the first solution tells.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    for (auto& contact : contacts_) contact.impulse = std::max(contact.impulse, contact.gamma);
    auto allowed = contact_tolerances(contacts_, free_velocities_, h_, layout_, settings,
                                      mean_radius_, kErrorOfSums)
                       .allowed;
    // Half of it is left for the difference between this problem and the final velocities.
    for (auto& residual : allowed) residual /= 2;
    is_dense ? solve_dense(allowed) : solve_by_products(allowed);
    const bool converged = measure_residuals(contacts_, free_velocities_, velocities_, h_, layout_,
                                             settings, mean_radius_, kErrorOfSums)
                               .converged;
    if (converged) return true;
    if (iterations_ >= settings_.max_iterations) break;
  }
  // Residuals that errors of the mobility explain are no failure.
  return measure_residuals(contacts_, free_velocities_, velocities_, h_, layout_, settings,
                           mean_radius_, std::max(kErrorOfSums, mobility_error_))
      .converged;
}

void ContactProblem::solve_dense(std::span<const double> allowed) {
  const auto n = static_cast<Index>(contacts_.size());
  DenseContactProblem problem{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), Eigen::VectorXd(n),
                              Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Index c = 0; c < n; ++c) {
    const auto k = static_cast<std::size_t>(c);
    for (Index other = 0; other < n; ++other)
      problem.w(other, c) =
          opening(contacts_[static_cast<std::size_t>(other)], responses_[k].data(), layout_);
    problem.b[c] = b(k);
    problem.gamma[c] = contacts_[k].gamma;
    problem.allowed[c] = allowed[k];
    problem.p[c] = contacts_[k].impulse;
  }
  problem.error_of_w = mobility_error_;
  problem.w = (problem.w + problem.w.transpose().eval()) / 2;
  iterations_ += problem.solve(settings_.max_iterations - iterations_);
  std::ranges::copy(free_velocities_, velocities_.begin());
  for (Index c = 0; c < n; ++c) {
    const auto k = static_cast<std::size_t>(c);
    contacts_[k].impulse = problem.p[c];
    for (std::size_t i = 0; i < velocities_.size(); ++i)
      velocities_[i] += responses_[k][i] * (problem.p[c] / h_);
  }
}

void ContactProblem::solve_by_products(std::span<const double> allowed) {
  std::vector<double> gradients;
  for (std::size_t c = 0; c < contacts_.size(); ++c) gradients.push_back(b(c));
  MobilityGraph graph(contacts_, gradients, allowed, free_velocities_.size(), mobility_, layout_);
  Mprgp mprgp(graph, IdentityPreconditioner(graph));
  bool is_fresh = true;
  for (;;) {
    if (mprgp.residual() <= 1 || iterations_ + graph.products() >= settings_.max_iterations) {
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
    velocities_[i] = free_velocities_[i] + y[i] / h_;
  for (std::size_t c = 0; c < contacts_.size(); ++c) contacts_[c].impulse = graph.impulse(c);
  iterations_ += graph.products();
}

}  // namespace viscontact::particles
