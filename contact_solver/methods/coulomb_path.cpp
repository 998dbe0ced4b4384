// Steps along the path of (5.20), docs/physics.md.
#include "viscontact/contact_solver/methods/coulomb_path.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <utility>

namespace viscontact::contact_solver {
namespace {

struct PathTuning {
  // This part [1] of the change of a scaled impulse is added to that of its gap or slip. It bounds
  // the entries of the matrix at 1e10 times the masses.
  static constexpr double kRegularisation = 1e-10;
  // The product of `bound` and `spare` over tau on each path: a larger one smooths the bound of the
  // friction more. The second path is for problems on which the first one fails or is long, the
  // third one for those on which the second one does. On 88 problems of 300 to 1900 contacts the
  // first path took 10900, 9300 and 9900 factorisations with 3, 9 and 20.
  static constexpr std::array<double, CoulombPath<2>::kPaths> kSmoothing = {10, 100, 30};
  // The product (bound, p) o (z, v) on each path over tau. With 1 and 0.6 runs of bench/box2d.cpp
  // took longer.
  static constexpr double kOfFriction = 2;
  // The products stay between kNear and 1/kNear times their values on the path. On the problems
  // above, 0.2 took as many factorisations, and 0.5 a fifth more.
  static constexpr double kNear = 0.3;
  // Lengths are changes of ln(tau). A step may be kGrowth times as long as the one before, and is
  // tried with kLess times its length while it leaves the neighbourhood of the path.
  static constexpr double kLongest = 0.9, kGrowth = 4, kLess = 0.7;
  // If the end of a step cannot be corrected, the step is taken again with kShorter times its
  // length. After kMostTries the same is done with the step before. The last kKept steps are kept.
  // Without steps back, 5 of the problems above were lost.
  static constexpr double kShorter = 0.3;
  static constexpr int kMostTries = 3;
  static constexpr std::size_t kKept = 8;
  // If no length of kShortest or more leads to a point near the path, only the correction is made,
  // and kAfterNone is the next length.
  static constexpr double kShortest = 1e-5, kAfterNone = 1e-3;
  // Only rounding errors are left if the root of tau is below kSmall times its size at the start,
  // and kPatience factorisations do not halve tau.
  static constexpr double kSmall = 1e-6;
  static constexpr int kPatience = 30;
};

template <std::size_t N>
double inner(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < N; ++k) sum += a[k] * b[k];
  return sum;
}

/// a I + b x y^T, row by row.
template <std::size_t N>
std::array<double, N * N> matrix_of(double a, double b, const std::array<double, N>& x,
                                    const std::array<double, N>& y) {
  std::array<double, N * N> matrix{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k) matrix[i * N + k] = (i == k ? a : 0) + b * x[i] * y[k];
  return matrix;
}

template <std::size_t N>
std::array<double, N> times(const std::array<double, N * N>& matrix,
                            const std::array<double, N>& x) {
  std::array<double, N> result{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k) result[i] += matrix[i * N + k] * x[k];
  return result;
}

/// The inverse of a matrix, row by row; infinite or NaN if it is singular.
std::array<double, 1> inverse_of(const std::array<double, 1>& a) { return {1 / a[0]}; }
std::array<double, 4> inverse_of(const std::array<double, 4>& a) {
  const double determinant = a[0] * a[3] - a[1] * a[2];
  return {a[3] / determinant, -a[1] / determinant, -a[2] / determinant, a[0] / determinant};
}

/// The inner product [1] of changes (a_0, a) and (b_0, b) of a point (x_0, x) with |x| < x_0 by the
/// Hessian of -ln(x_0^2 - |x|^2): a measure of relative changes.
template <std::size_t N>
double relative_product(double x_0, const std::array<double, N>& x, double a_0,
                        const std::array<double, N>& a, double b_0,
                        const std::array<double, N>& b) {
  const double determinant = x_0 * x_0 - inner(x, x);
  const double of_a = x_0 * a_0 - inner(x, a), of_b = x_0 * b_0 - inner(x, b);
  return (4 * of_a * of_b / determinant - 2 * (a_0 * b_0 - inner(a, b))) / determinant;
}

/// The positive x with x (x - by) = product > 0.
double positive_root(double by, double product) {
  const double root = std::sqrt(by * by + 4 * product);
  return by > 0 ? (by + root) / 2 : 2 * product / (root - by);
}

}  // namespace

template <int D>
CoulombPath<D>::CoulombPath(const ConstraintProblem<D>& problem, const std::vector<double>& w,
                            UnitMatrix<D>& matrix)
    : problem_(problem), w_(w), matrix_(matrix), impulses_(problem.impulses) {}

template <int D>
void CoulombPath<D>::set_parts() {
  parts_.clear();
  for (std::size_t b = 0; b < problem_.blocks.size(); ++b) {
    const auto& block = problem_.blocks[b];
    for (std::size_t k = 0; k < (block.is_contact ? 1 : block.rows); ++k) {
      Part part;
      part.block = b;
      part.row = block.row + k;
      part.is_equation = !block.is_contact;
      part.scale = 1 / std::sqrt(w_[block.row]);
      part.base = block.is_contact ? block.lowest : 0;
      part.compliance = block.compliance * part.scale * part.scale;
      part.rubs =
          block.is_contact && block.rows > 1 && block.friction > 0 && std::isfinite(block.capacity);
      if (part.rubs) {
        part.of_slip = 1 / std::sqrt(w_[block.row + 1]);
        part.bound_per_impulse = block.friction * part.scale / part.of_slip;
      }
      assert(!part.rubs || block.friction_bound == FrictionBound::kCoulomb);
      parts_.push_back(part);
    }
  }
}

template <int D>
double CoulombPath<D>::value(const Part& part, std::span<const Motion<D>> y) const {
  return part.scale * problem_.product(part.row, y);
}

template <int D>
typename CoulombPath<D>::Tangent CoulombPath<D>::slip(const Part& part,
                                                      std::span<const Motion<D>> y) const {
  Tangent slip;
  for (std::size_t k = 0; k < kTangents; ++k)
    slip[k] = part.of_slip * problem_.product(part.row + 1 + k, y);
  return slip;
}

template <int D>
void CoulombPath<D>::measure() {
  for (std::size_t u = 0; u < error_.size(); ++u) {
    Motion<D> left;
    for (std::size_t k = 0; k < kMotion; ++k) left[k] = problem_.units[u].free[k] - state_.y[u][k];
    error_[u] = problem_.units[u].impulse_of(left);
  }
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    auto& part = parts_[i];
    const auto& point = state_.points[i];
    problem_.add_impulse(part.row, part.base + part.scale * point.r, error_);
    part.error = value(part, state_.y) + part.scale * problem_.rows[part.row].offset -
                 (part.is_equation ? -part.compliance * point.r : point.u);
    if (!part.rubs) continue;
    part.slip_error = slip(part, state_.y);
    for (std::size_t k = 0; k < kTangents; ++k) {
      part.slip_error[k] += part.of_slip * problem_.rows[part.row + 1 + k].offset - point.v[k];
      problem_.add_impulse(part.row + 1 + k, part.of_slip * point.p[k], error_);
    }
  }
}

template <int D>
void CoulombPath<D>::start() {
  std::ranges::fill(impulses_, 0.0);
  for (const auto& part : parts_) impulses_[part.row] = part.base;
  state_.y = motions(problem_, impulses_);
  state_.points.assign(parts_.size(), Point{});
  error_.resize(problem_.units.size());
  measure();
  size_ = degree_ = 0;
  for (const auto& part : parts_) {
    size_ = largest_or_nan(size_, std::abs(part.error));
    if (part.rubs)
      size_ = largest_or_nan(size_, std::sqrt(inner(part.slip_error, part.slip_error)));
    degree_ += part.is_equation ? 0 : part.rubs ? 4 : 1;
  }
  const double tau = state_.tau = size_ * size_;
  if (!(size_ > 0) || degree_ == 0) return;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto& part = parts_[i];
    const auto& block = problem_.blocks[part.block];
    auto& point = state_.points[i];
    if (part.is_equation) continue;
    point.u = point.r = size_;
    if (!part.rubs) continue;
    const double beyond_film = point.r - (block.capacity - block.lowest) / part.scale;
    point.bound = positive_root(part.bound_per_impulse * beyond_film, smoothing_ * tau);
    point.spare = smoothing_ * tau / point.bound;
    point.z = PathTuning::kOfFriction * tau / point.bound;
  }
  measure();
  error_per_tau_ = error_;
  for (auto& error : error_per_tau_)
    for (double& number : error) number /= tau;
  for (auto& part : parts_) {
    part.error_per_tau = part.error / tau;
    for (std::size_t k = 0; k < kTangents; ++k)
      part.slip_error_per_tau[k] = part.slip_error[k] / tau;
  }
}

template <int D>
bool CoulombPath<D>::factorise() {
  matrix_.set_to_masses();
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    auto& part = parts_[i];
    const auto& point = state_.points[i];
    part.weight = 1 / ((part.is_equation ? part.compliance : point.u / point.r) +
                       PathTuning::kRegularisation);
    matrix_.add_product(part.block, part.row, part.row, part.weight * part.scale * part.scale);
    if (!part.rubs) continue;
    // Without the change of z the changes of friction, slip and bound obey, but for constant terms,
    // (z I - p v^T/bound) dp = - (bound I - p p^T/bound) dv - (v - z p/bound) dbound + ...
    const auto cone = matrix_of(point.bound, -1 / point.bound, point.p, point.p);
    auto left = matrix_of(point.z, -1 / point.bound, point.p, point.v);
    for (std::size_t k = 0; k < left.size(); ++k) left[k] += PathTuning::kRegularisation * cone[k];
    part.inverse = inverse_of(left);
    Tangent right;
    for (std::size_t k = 0; k < kTangents; ++k)
      right[k] = point.z * point.p[k] / point.bound - point.v[k];
    part.by_bound = times(part.inverse, right);
    const double of_r = part.bound_per_impulse * point.bound / (point.bound + point.spare);
    for (std::size_t l = 0; l < kTangents; ++l) {
      Tangent column;
      for (std::size_t k = 0; k < kTangents; ++k) column[k] = cone[k * kTangents + l];
      const auto by_slip = times(part.inverse, column);
      for (std::size_t k = 0; k < kTangents; ++k)
        matrix_.add_product(part.block, part.row + 1 + k, part.row + 1 + l,
                            by_slip[k] * part.of_slip * part.of_slip);
      matrix_.add_product(part.block, part.row + 1 + l, part.row,
                          part.by_bound[l] * of_r * part.weight * part.of_slip * part.scale);
    }
  }
  return matrix_.factorise();
}

template <int D>
void CoulombPath<D>::find_changes(double of_errors, double of_tau, const State* tangent,
                                  State& changes) {
  changes.tau = 0;
  changes.y.resize(error_.size());
  changes.points.resize(parts_.size());
  for (std::size_t u = 0; u < error_.size(); ++u)
    for (std::size_t k = 0; k < kMotion; ++k)
      changes.y[u][k] = of_errors * error_[u][k] - of_tau * error_per_tau_[u][k];
  // The first pass computes the changes of r and p if nothing moves, with the errors of the
  // equations in u and v. The second pass adds the motions.
  const auto find = [&](std::size_t i, bool is_moved) {
    const auto& part = parts_[i];
    const auto& at = state_.points[i];
    const Point second = tangent ? tangent->points[i] : Point{};
    Point change;
    change.u = of_errors * part.error - of_tau * part.error_per_tau;
    if (is_moved) change.u += value(part, changes.y);
    if (part.is_equation) {
      change.r = -part.weight * change.u;
      change.u = 0;
      return change;
    }
    change.r =
        part.weight * ((of_tau - of_errors * at.u * at.r - second.u * second.r) / at.r - change.u);
    change.u += PathTuning::kRegularisation * change.r;
    if (!part.rubs) return change;
    const double of_r = part.bound_per_impulse * change.r;
    change.bound = (smoothing_ * of_tau - of_errors * at.bound * at.spare -
                    second.bound * second.spare + at.bound * of_r) /
                   (at.bound + at.spare);
    change.spare = change.bound - of_r;
    if (is_moved) change.v = slip(part, changes.y);
    const double goal = PathTuning::kOfFriction * of_tau -
                        of_errors * (at.bound * at.z + inner(at.p, at.v)) -
                        second.bound * second.z - inner(second.p, second.v);
    for (std::size_t k = 0; k < kTangents; ++k)
      change.v[k] += of_errors * part.slip_error[k] - of_tau * part.slip_error_per_tau[k];
    const double along = inner(at.p, change.v);
    Tangent right;
    for (std::size_t k = 0; k < kTangents; ++k)
      right[k] = -of_errors * (at.bound * at.v[k] + at.z * at.p[k]) - second.bound * second.v[k] -
                 second.z * second.p[k] - at.bound * change.v[k] +
                 at.p[k] * (along - goal) / at.bound;
    change.p = times(part.inverse, right);
    for (std::size_t k = 0; k < kTangents; ++k) {
      change.p[k] += part.by_bound[k] * change.bound;
      change.v[k] += PathTuning::kRegularisation * change.p[k];
    }
    change.z =
        (goal - at.z * change.bound - inner(at.p, change.v) - inner(at.v, change.p)) / at.bound;
    return change;
  };
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto change = find(i, false);
    const auto& part = parts_[i];
    problem_.add_impulse(part.row, part.scale * change.r, changes.y);
    for (std::size_t k = 0; part.rubs && k < kTangents; ++k)
      problem_.add_impulse(part.row + 1 + k, part.of_slip * change.p[k], changes.y);
  }
  matrix_.solve(changes.y);
  for (std::size_t i = 0; i < parts_.size(); ++i) changes.points[i] = find(i, true);
}

template <int D>
double CoulombPath<D>::product(const State& a, const State& b) const {
  double sum = degree_ * a.tau * b.tau / (state_.tau * state_.tau);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto& part = parts_[i];
    const auto &at = state_.points[i], &x = a.points[i], &y = b.points[i];
    if (part.is_equation) continue;
    sum += x.u * y.u / (at.u * at.u) + x.r * y.r / (at.r * at.r);
    if (!part.rubs) continue;
    sum += x.bound * y.bound / (at.bound * at.bound) + x.spare * y.spare / (at.spare * at.spare);
    sum += relative_product(at.bound, at.p, x.bound, x.p, y.bound, y.p) +
           relative_product(at.z, at.v, x.z, x.v, y.z, y.v);
  }
  return sum;
}

template <int D>
bool CoulombPath<D>::is_inside(const Step& step, double length) const {
  const double square = length * length;
  const double tau =
      step.at.tau + step.correction.tau + length * step.tangent.tau + square * step.second.tau;
  if (!(tau > 0)) return false;
  const auto is_near = [&](double product, double goal) {
    return product >= PathTuning::kNear * goal && product <= goal / PathTuning::kNear;
  };
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto& part = parts_[i];
    if (part.is_equation) continue;
    const auto& at = step.at.points[i];
    const auto& a = step.correction.points[i];
    const auto& b = step.tangent.points[i];
    const auto& c = step.second.points[i];
    const auto number = [&](double Point::*member) {
      return at.*member + a.*member + length * b.*member + square * c.*member;
    };
    const double u = number(&Point::u), r = number(&Point::r);
    if (!(u > 0 && r > 0 && is_near(u * r, tau))) return false;
    if (!part.rubs) continue;
    const double bound = number(&Point::bound), spare = number(&Point::spare);
    if (!(bound > 0 && spare > 0 && is_near(bound * spare, smoothing_ * tau))) return false;
    const double z = number(&Point::z);
    Tangent p, v, across;
    for (std::size_t k = 0; k < kTangents; ++k) {
      p[k] = at.p[k] + a.p[k] + length * b.p[k] + square * c.p[k];
      v[k] = at.v[k] + a.v[k] + length * b.v[k] + square * c.v[k];
      across[k] = bound * v[k] + z * p[k];
    }
    if (!(bound * bound > inner(p, p) && z > 0 && z * z > inner(v, v))) return false;
    const double along = bound * z + inner(p, v), beside = std::sqrt(inner(across, across));
    if (!is_near(along - beside, PathTuning::kOfFriction * tau) ||
        !is_near(along + beside, PathTuning::kOfFriction * tau))
      return false;
  }
  return true;
}

template <int D>
void CoulombPath<D>::add(double factor, const State& changes, State& to) {
  to.tau += factor * changes.tau;
  for (std::size_t u = 0; u < to.y.size(); ++u)
    for (std::size_t k = 0; k < kMotion; ++k) to.y[u][k] += factor * changes.y[u][k];
  for (std::size_t i = 0; i < to.points.size(); ++i) {
    auto& point = to.points[i];
    const auto& change = changes.points[i];
    for (const auto member : {&Point::u, &Point::r, &Point::bound, &Point::spare, &Point::z})
      point.*member += factor * (change.*member);
    for (std::size_t k = 0; k < kTangents; ++k) {
      point.p[k] += factor * change.p[k];
      point.v[k] += factor * change.v[k];
    }
  }
}

template <int D>
typename CoulombPath<D>::State CoulombPath<D>::end_of(const Step& step, double length) {
  State end = step.at;
  add(1, step.correction, end);
  add(length, step.tangent, end);
  add(length * length, step.second, end);
  return end;
}

template <int D>
bool CoulombPath<D>::find_direction(Step& step) {
  measure();
  if (!factorise()) return false;
  // tau falls along the path where the determinant is positive, as it is at the start.
  const double sign = matrix_.sign_of_determinant() > 0 ? -1 : 1;
  find_changes(0, sign * state_.tau, nullptr, step.tangent);
  step.tangent.tau = sign * state_.tau;
  find_changes(1, state_.tau, nullptr, step.correction);
  add(-product(step.correction, step.tangent) / product(step.tangent, step.tangent), step.tangent,
      step.correction);
  step.second.tau = 0;
  step.second.points.assign(parts_.size(), Point{});
  step.at = state_;
  return is_inside(step, 0);
}

template <int D>
void CoulombPath<D>::find_second(Step& step) {
  find_changes(0, 0, &step.tangent, step.second);
  add(-product(step.second, step.tangent) / product(step.tangent, step.tangent), step.tangent,
      step.second);
}

template <int D>
int CoulombPath<D>::follow(int number, double accuracy, int max_iterations) {
  using Tuning = PathTuning;
  assert(number >= 0 && number < kPaths && accuracy > 0 && accuracy < 1);
  assert(w_.size() == problem_.rows.size());
  smoothing_ = Tuning::kSmoothing[static_cast<std::size_t>(number)];
  set_parts();
  start();
  best_ = state_;
  std::deque<Step> kept;
  Step step;
  double length = Tuning::kLongest, halved = state_.tau;
  int iterations = 0, halved_at = 0, tries = 0;
  while (size_ > 0 && degree_ > 0 && iterations < max_iterations) {
    ++iterations;
    if (!find_direction(step)) {
      ++tries;
      while (!kept.empty() && (tries > Tuning::kMostTries ||
                               Tuning::kShorter * kept.back().length < Tuning::kShortest)) {
        kept.pop_back();
        tries = 1;
      }
      if (kept.empty()) break;
      length = kept.back().length *= Tuning::kShorter;
      state_ = end_of(kept.back(), length);
      continue;
    }
    tries = 0;
    if (state_.tau < best_.tau) best_ = state_;
    if (best_.tau < halved / 2) {
      halved = best_.tau;
      halved_at = iterations;
    }
    if (std::sqrt(best_.tau) < Tuning::kSmall * size_ && iterations - halved_at > Tuning::kPatience)
      break;
    find_second(step);
    length = std::min(Tuning::kLongest, Tuning::kGrowth * length);
    while (length >= Tuning::kShortest && !is_inside(step, length)) length *= Tuning::kLess;
    if (length < Tuning::kShortest) length = 0;
    state_ = end_of(step, length);
    step.length = length;
    kept.push_back(std::move(step));
    step = {};
    if (kept.size() > Tuning::kKept) kept.pop_front();
    if (length == 0) length = Tuning::kAfterNone;
    if (std::sqrt(state_.tau) > accuracy * size_) continue;
    best_ = state_;
    break;
  }
  take_impulses();
  return iterations;
}

template <int D>
void CoulombPath<D>::take_impulses() {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto& part = parts_[i];
    const auto& point = best_.points[i];
    // Contacts that open get their lowest impulse exactly: no film absorbs a small rest.
    const bool is_open = !part.is_equation && point.u > point.r;
    impulses_[part.row] = part.base + (is_open ? 0 : part.scale * point.r);
    if (!part.rubs) continue;
    // In a collision solids may carry a part of the lowest impulse.
    const double friction = part.of_slip * std::sqrt(inner(point.p, point.p));
    const double bound = problem_.blocks[part.block].bound(impulses_[part.row]);
    const double share = friction > bound ? bound / friction : 1;
    for (std::size_t k = 0; k < kTangents; ++k)
      impulses_[part.row + 1 + k] = share * part.of_slip * point.p[k];
  }
}

template class CoulombPath<2>;
template class CoulombPath<3>;

}  // namespace viscontact::contact_solver
