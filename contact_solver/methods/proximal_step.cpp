// Newton's method for (5.8), docs/physics.md. The symbols are those of proximal_step.hpp.
#include "viscontact/contact_solver/methods/proximal_step.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace viscontact::contact_solver {
namespace {

struct StepTuning {
  // A step of Newton's method with Coulomb's law is halved, at most kMostHalvings times, until the
  // error falls by kPromised times its fall in a linear equation.
  static constexpr double kPromised = 0.1;
  static constexpr int kMostHalvings = 8;
  // In a convex problem the derivative along a step shall fall to kReached times its size at the
  // beginning, in at most kMostTrials lengths.
  static constexpr double kReached = 0.1;
  static constexpr int kMostTrials = 20;
  // Paths of ProximalStep::follow_path(), and the share of the error that one must remove.
  static constexpr int kMostPaths = 3;
  static constexpr double kLeastShare = 0.05;
  // Factors in convex problems of spheres are renewed if a step reduces the error by less than
  // kSlow. For spheres a step of length 1 ends the iteration if the error is at most kExact times
  // the first one.
  static constexpr double kSlow = 0.1, kExact = 1e-10;
  // Rounding errors over the size of the numbers: a safe multiple of the machine epsilon.
  static constexpr double kRounding = 1e4 * std::numeric_limits<double>::epsilon();
};

}  // namespace

template <int D>
ProximalStep<D>::ProximalStep(const ConstraintProblem<D>& problem, const std::vector<double>& w,
                              UnitMatrix<D>& matrix)
    : problem_(problem),
      w_(w),
      rho_(problem.rows.size()),
      values_(problem.rows.size()),
      changes_(problem.rows.size(), 0.0),
      projected_(problem.rows.size()),
      branches_(problem.blocks.size()),
      direction_(problem.units.size(), Motion<D>{}),
      error_(problem.units.size()),
      matrix_(matrix) {}

template <int D>
void ProximalStep<D>::set_epsilon(double of_gaps, double of_slips) {
  assert(of_gaps > 0 && of_slips > 0 && w_.size() == problem_.rows.size());
  for (const auto& block : problem_.blocks)
    for (std::size_t k = 0; k < block.rows; ++k) {
      const std::size_t r = block.row + k;
      rho_[r] = 1 / ((block.is_contact && k > 0 ? of_slips : of_gaps) * w_[r]);
    }
  has_factor_ = false;
}

template <int D>
void ProximalStep<D>::unprojected(std::size_t b, double t, double* q) const {
  const auto& block = problem_.blocks[b];
  for (std::size_t k = 0; k < block.rows; ++k) {
    const auto r = block.row + k;
    q[k] = center_[r] - rho_[r] * (values_[r] + t * changes_[r]);
  }
}

template <int D>
typename ProximalStep<D>::Branch ProximalStep<D>::project(std::size_t b, const double* q,
                                                          double* p) const {
  const auto& block = problem_.blocks[b];
  if (!block.is_contact) {
    // The impulse of a link obeys p = P^k - rho (b + J y + compliance p).
    for (std::size_t k = 0; k < block.rows; ++k)
      p[k] = q[k] / (1 + rho_[block.row + k] * block.compliance);
    return {true, Friction::kSticks};
  }
  if (block.is_in_cone()) return project_on_cone(b, q, p);
  Branch branch{q[0] > block.lowest};
  p[0] = branch.is_closed ? q[0] : block.lowest;
  const double bound = block.bound(p[0]);
  double square = 0;
  for (std::size_t k = 1; k < block.rows; ++k) square += q[k] * q[k];
  const bool slips = square >= bound * bound;
  const double factor = slips && square > 0 ? bound / std::sqrt(square) : 1;
  for (std::size_t k = 1; k < block.rows; ++k) p[k] = factor * q[k];
  if (bound > 0)
    branch.friction = !slips     ? Friction::kSticks
                      : q[1] < 0 ? Friction::kSlipsBack
                                 : Friction::kSlips;
  return branch;
}

template <int D>
typename ProximalStep<D>::Branch ProximalStep<D>::project_on_cone(std::size_t b, const double* q,
                                                                  double* p) const {
  const auto& block = problem_.blocks[b];
  double square = 0;
  for (std::size_t k = 1; k < block.rows; ++k) square += q[k] * q[k];
  const auto cone = FrictionCone::nearest(block.friction, q[0], std::sqrt(square), w_[block.row],
                                          w_[block.row + 1]);
  p[0] = cone.load;
  for (std::size_t k = 1; k < block.rows; ++k) p[k] = cone.tangential * q[k];
  switch (cone.part) {
    case FrictionCone::Part::kApex:
      return {};
    case FrictionCone::Part::kInside:
      return {true, Friction::kSticks};
    case FrictionCone::Part::kSurface:
      return {true, q[1] < 0 ? Friction::kSlipsBack : Friction::kSlips};
  }
  return {};
}

template <int D>
double ProximalStep<D>::error_at(double t, bool is_kept) {
  for (std::size_t u = 0; u < y_.size(); ++u) {
    const auto& unit = problem_.units[u];
    Motion<D> left;
    for (std::size_t k = 0; k < left.size(); ++k)
      left[k] = unit.free[k] - y_[u][k] - t * direction_[u][k];
    error_[u] = unit.impulse_of(left);
  }
  for (std::size_t b = 0; b < problem_.blocks.size(); ++b) {
    const auto& block = problem_.blocks[b];
    std::array<double, kMostRows> q{}, p{};
    unprojected(b, t, q.data());
    const auto branch = project(b, q.data(), p.data());
    if (is_kept) {
      branches_[b] = branch;
      std::copy_n(p.data(), block.rows, &projected_[block.row]);
    }
    for (std::size_t k = 0; k < block.rows; ++k)
      if (p[k] != 0) problem_.add_impulse(block.row + k, p[k], error_);
  }
  double sum = 0;
  for (std::size_t u = 0; u < error_.size(); ++u) {
    const auto moved = problem_.units[u].moved_by(error_[u]);
    for (std::size_t k = 0; k < moved.size(); ++k) sum += moved[k] * error_[u][k];
  }
  return std::sqrt(sum);
}

template <int D>
void ProximalStep<D>::add_block(std::size_t b) {
  const auto& block = problem_.blocks[b];
  const auto* rho = &rho_[block.row];
  const auto branch = branches_[b];
  if (!block.is_contact) {
    for (std::size_t k = 0; k < block.rows; ++k)
      matrix_.add_product(b, block.row + k, block.row + k,
                          rho[k] / (1 + rho[k] * block.compliance));
    return;
  }
  const bool is_on_cone = block.is_in_cone() && (branch.friction == Friction::kSlips ||
                                                 branch.friction == Friction::kSlipsBack);
  if (branch.is_closed && !is_on_cone) matrix_.add_product(b, block.row, block.row, rho[0]);
  if (branch.friction == Friction::kNone) return;
  if (branch.friction == Friction::kSticks) {
    for (std::size_t k = 1; k < block.rows; ++k)
      matrix_.add_product(b, block.row + k, block.row + k, rho[k]);
    return;
  }
  // The contact slips: p_t is the bound times q_t/|q_t|, with the tangential part q_t of q.
  std::array<double, kMostRows> q{};
  unprojected(b, 0, q.data());
  double square = 0;
  for (std::size_t k = 1; k < block.rows; ++k) square += q[k] * q[k];
  const double length = std::sqrt(square);
  if (is_on_cone) {
    // If only the size of q_t changes, p moves along the line (1, mu_s q_t/|q_t|) of the cone.
    std::array<double, kMostRows> generator{1};
    for (std::size_t k = 1; k < block.rows; ++k) generator[k] = block.friction * q[k] / length;
    const double weight = 1 / (1 / rho[0] + block.friction * block.friction / rho[1]);
    for (std::size_t k = 0; k < block.rows; ++k)
      for (std::size_t l = 0; l < block.rows; ++l)
        matrix_.add_product(b, block.row + k, block.row + l, weight * generator[k] * generator[l]);
  } else if (branch.is_closed && block.friction_bound == FrictionBound::kCoulomb) {
    for (std::size_t k = 1; k < block.rows; ++k)
      matrix_.add_product(b, block.row + k, block.row, rho[0] * block.friction * q[k] / length);
  }
  if (block.rows < 3) return;
  const double bound = block.is_in_cone() ? block.friction * projected_[block.row]
                                          : block.bound(projected_[block.row]);
  const double factor = rho[1] * bound / length;
  for (std::size_t k = 1; k < 3; ++k)
    for (std::size_t l = 1; l < 3; ++l)
      matrix_.add_product(b, block.row + k, block.row + l,
                          factor * ((k == l ? 1 : 0) - q[k] * q[l] / square));
}

template <int D>
bool ProximalStep<D>::factorise() {
  matrix_.set_to_masses();
  for (std::size_t b = 0; b < problem_.blocks.size(); ++b) add_block(b);
  factored_ = branches_;
  has_factor_ = matrix_.factorise();
  return has_factor_;
}

template <int D>
void ProximalStep<D>::find_direction() {
  direction_ = matrix_.solution_of(error_);
  for (std::size_t r = 0; r < problem_.rows.size(); ++r)
    changes_[r] = problem_.product(r, direction_);
}

template <int D>
double ProximalStep<D>::length_of_step(double before) {
  if (problem_.is_convex) return length_to_minimum();
  double length = 1;
  for (int n = 0; n < StepTuning::kMostHalvings; ++n, length /= 2)
    if (error_at(length, false) <= (1 - StepTuning::kPromised * length) * before) return length;
  return 0;
}

template <int D>
double ProximalStep<D>::length_to_minimum() {
  using Tuning = StepTuning;
  const auto derivative = [&](double t) {
    error_at(t, false);
    double sum = 0;
    for (std::size_t u = 0; u < error_.size(); ++u)
      for (std::size_t k = 0; k < error_[u].size(); ++k) sum -= error_[u][k] * direction_[u][k];
    return sum;
  };
  const double first = derivative(0);
  double low = 0, high = 1, at_low = first, at_high = derivative(1);
  if (!(first < 0) || at_high <= -Tuning::kReached * first) return 1;
  double length = 1;
  for (int n = 0; n < Tuning::kMostTrials; ++n) {
    // Secant and bisection alternate, because a kink of the derivative can make the secant slow.
    length = n % 2 == 0 ? low + (high - low) * at_low / (at_low - at_high) : (low + high) / 2;
    const double here = derivative(length);
    if (std::abs(here) <= -Tuning::kReached * first) break;
    (here < 0 ? low : high) = length;
    (here < 0 ? at_low : at_high) = here;
  }
  return length;
}

template <int D>
double ProximalStep<D>::rounding_error() const {
  double square = 0;
  for (std::size_t r = 0; r < projected_.size(); ++r)
    square += w_[r] * projected_[r] * projected_[r];
  for (std::size_t u = 0; u < y_.size(); ++u) {
    const auto impulse = problem_.units[u].impulse_of(y_[u]);
    for (std::size_t k = 0; k < impulse.size(); ++k) square += impulse[k] * y_[u][k];
  }
  return StepTuning::kRounding * std::sqrt(square);
}

template <int D>
int ProximalStep<D>::solve(const std::vector<double>& center, const std::vector<Motion<D>>& start,
                           int max_iterations) {
  using Tuning = StepTuning;
  assert(center.size() == problem_.rows.size() && start.size() == problem_.units.size());
  center_ = center;
  y_ = start;
  for (std::size_t r = 0; r < problem_.rows.size(); ++r)
    values_[r] = problem_.rows[r].offset + problem_.product(r, y_);
  failed_ = false;
  paths_ = path_iterations_ = 0;
  int iterations = 0;
  const double first = error_at(0, true);
  double before = first;
  while (iterations < max_iterations) {
    const bool is_fresh = !has_factor_ || factored_ != branches_;
    if (is_fresh) {
      ++iterations;
      if (!factorise()) failed_ = true;
      if (failed_) break;
    }
    ++iterations;
    find_direction();
    const double length = length_of_step(before);
    const auto last = factored_;
    if (length == 0) {
      if (before <= rounding_error()) break;
      failed_ = D == 3 || paths_ == Tuning::kMostPaths;
      if (failed_) break;
      ++paths_;
      error_at(0, true);
      const int before_path = iterations;
      const double share = follow_path(iterations);
      path_iterations_ += iterations - before_path;
      before = error_at(0, true);
      if (share == 1) break;
      failed_ = share < Tuning::kLeastShare;
      if (failed_) break;
      continue;
    }
    move(length, direction_);
    const double here = error_at(0, true);
    // For discs a step of length 1 without a change of a branch ends at the solution but for
    // rounding errors, because the equation is then linear. For spheres the error must also be at
    // most kExact times the first one, or the step must have failed to halve it. In a convex
    // problem such a failure counts only if the factors are new.
    const bool is_linear = D == 2 || here <= Tuning::kExact * first ||
                           ((is_fresh || !problem_.is_convex) && here > before / 2);
    // For spheres the matrix also changes while contacts slip.
    if (D == 3 && problem_.is_convex && !is_fresh && here > Tuning::kSlow * before)
      has_factor_ = false;
    if (here == 0 || (length == 1 && last == branches_ && is_linear)) break;
    // In convex problems the error may grow on the way to the minimum. While it has the size of
    // rounding errors, iterations go on as long as they halve it, because impulses that must grow
    // between jammed particles need small errors.
    const bool is_rounding = here <= rounding_error();
    if (problem_.is_convex ? is_rounding && has_factor_ && !(here < before / 2)
                           : !(here < before)) {
      failed_ = !is_rounding;
      break;
    }
    before = here;
  }
  return iterations;
}

template class ProximalStep<2>;
template class ProximalStep<3>;

}  // namespace viscontact::contact_solver
