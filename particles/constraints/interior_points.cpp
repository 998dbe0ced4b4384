// Iterations of the interior-point method (interior_points.hpp).
#include "viscontact/particles/constraints/interior_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscontact::particles {
namespace {

/// Share of the change of r that is added to u. It bounds the entries of the matrix at 1e9
/// times the masses.
constexpr double kRegularisation = 1e-9;

}  // namespace

template <int D>
InteriorPoints<D>::InteriorPoints(const ConstraintProblem<D>& problem, const std::vector<double>& w)
    : problem_(problem),
      w_(w),
      matrix_(problem),
      y_(problem.units.size()),
      impulses_(problem.impulses) {}

/// Sets roles and scales of the parts.
template <int D>
void InteriorPoints<D>::set_parts() {
  parts_.clear();
  for (std::size_t b = 0; b < problem_.blocks.size(); ++b) {
    const auto& block = problem_.blocks[b];
    Part part;
    part.block = b;
    part.row = block.row;
    part.rows = block.rows;
    const double unit = 1 / std::sqrt(w_[block.row]);
    part.scale.fill(unit);
    if (!block.is_contact) {
      part.role = Role::kEquation;
      part.compliance = block.compliance * unit * unit;
    } else if (block.is_in_cone()) {
      part.role = Role::kCone;
      for (std::size_t k = 1; k < 3; ++k) part.scale[k] = unit * block.friction;
    } else {
      part.rows = 1;
      part.base = block.lowest;
    }
    parts_.push_back(part);
    // Friction that moves nothing by more than is allowed is left out.
    if (!block.is_contact || block.is_in_cone() || block.rows == 1) continue;
    const double bound = block.bound(0);
    if (!(bound * w_[block.row + 1] > block.allowed_slip / 2)) continue;
    part.role = Role::kGivenBound;
    part.row = block.row + 1;
    part.rows = block.rows - 1;
    part.first = 1;
    part.base = 0;
    part.scale.fill(1 / std::sqrt(w_[part.row]));
    part.scaled_bound = bound / part.scale[0];
    parts_.push_back(part);
  }
}

/// The scaled values of the rows of a part for the motions `y`.
template <int D>
ConePoint InteriorPoints<D>::values(const Part& part, bool with_offset,
                                    const std::vector<Motion<D>>& y) const {
  ConePoint v{};
  for (std::size_t k = 0; k < part.rows; ++k)
    v[part.first + k] =
        part.scale[part.first + k] * (problem_.product(part.row + k, y) +
                                      (with_offset ? problem_.rows[part.row + k].offset : 0));
  return coordinates(part, v);
}

/// The impulses of the rows of a part [M L/T] without its base.
template <int D>
ConePoint InteriorPoints<D>::impulse_of(const Part& part, const ConePoint& r) const {
  ConePoint impulse = coordinates(part, r);
  for (std::size_t k = 0; k < 3; ++k) impulse[k] *= part.scale[k];
  return impulse;
}

template <int D>
void InteriorPoints<D>::add_impulse(const Part& part, const ConePoint& r,
                                    std::vector<Motion<D>>& to) const {
  const auto impulse = impulse_of(part, r);
  for (std::size_t k = 0; k < part.rows; ++k)
    problem_.add_impulse(part.row + k, impulse[part.first + k], to);
}

/// Computes all errors. Returns the largest of them, in the unit of u and r.
template <int D>
double InteriorPoints<D>::measure() {
  double largest = 0, cones = 0;
  gap_ = 0;
  error_.resize(y_.size());
  for (std::size_t u = 0; u < y_.size(); ++u) {
    Motion<D> left;
    for (std::size_t k = 0; k < kMotion; ++k) left[k] = problem_.units[u].free[k] - y_[u][k];
    error_[u] = problem_.units[u].impulse_of(left);
  }
  for (auto& part : parts_) {
    if (part.base != 0) problem_.add_impulse(part.row, part.base, error_);
    add_impulse(part, part.r, error_);
    part.error = values(part, true, y_);
    if (part.role == Role::kEquation) {
      for (std::size_t k = 0; k < part.rows; ++k) part.error[k] += part.compliance * part.r[k];
    } else {
      for (std::size_t k = 0; k < dimension(part); ++k) part.error[k] -= part.u[k];
      if (part.role == Role::kGivenBound) {
        // No row tells z.
        auto components = coordinates(part, part.error);
        components[0] = 0;
        part.error = coordinates(part, components);
      }
      gap_ += inner(part.u, part.r);
      cones += degree(part);
    }
    for (const double e : part.error) largest = std::max(largest, std::abs(e));
  }
  if (cones > 0) gap_ /= cones;
  for (std::size_t u = 0; u < y_.size(); ++u) {
    const auto moved = problem_.units[u].moved_by(error_[u]);
    double square = 0;
    for (std::size_t k = 0; k < kMotion; ++k) square += moved[k] * error_[u][k];
    largest = std::max(largest, std::sqrt(std::max(square, 0.0)));
  }
  return std::max(largest, std::sqrt(std::max(gap_, 0.0)));
}

/// Scales a part at its present point, and sets the predictor's goal.
template <int D>
void InteriorPoints<D>::set_scaling(Part& part) const {
  if (part.role == Role::kEquation) {
    part.inverse = {};
    part.goal = {};
    for (std::size_t k = 0; k < part.rows; ++k)
      part.inverse[k][k] = 1 / (part.compliance + kRegularisation);
    return;
  }
  part.scaling = typename Cone::Scaling(part.u, part.r);
  for (std::size_t k = 0; k < 3; ++k) part.goal[k] = -part.u[k];
  part.inverse =
      part.role == Role::kGivenBound
          ? in_other_coordinates(part, part.scaling.inverse_square_beside(kRegularisation))
          : part.scaling.inverse_square(kRegularisation);
}

/// A matrix of a part in the coordinates of its cone, given in its components, and back.
template <int D>
std::array<ConePoint, 3> InteriorPoints<D>::in_other_coordinates(
    const Part& part, const std::array<ConePoint, 3>& matrix) {
  std::array<ConePoint, 3> half{}, result{};
  for (std::size_t k = 0; k < 3; ++k) half[k] = coordinates(part, matrix[k]);
  for (std::size_t l = 0; l < 3; ++l) {
    const auto column = coordinates(part, {half[0][l], half[1][l], half[2][l]});
    for (std::size_t k = 0; k < 3; ++k) result[k][l] = column[k];
  }
  return result;
}

/// Scales all parts, and factorises.
template <int D>
bool InteriorPoints<D>::factorise() {
  matrix_.set_to_masses();
  for (auto& part : parts_) {
    set_scaling(part);
    const auto weights = in_other_coordinates(part, part.inverse);
    for (std::size_t k = 0; k < part.rows; ++k)
      for (std::size_t l = 0; l < part.rows; ++l) {
        const std::size_t i = part.first + k, j = part.first + l;
        if (weights[i][j] != 0)
          matrix_.add_product(part.block, part.row + k, part.row + l,
                              weights[i][j] * part.scale[i] * part.scale[j]);
      }
  }
  return matrix_.factorise();
}

/// Sets the changes of y, u and r that reach the goals.
template <int D>
void InteriorPoints<D>::find_direction() {
  auto right = error_;
  for (auto& part : parts_) {
    ConePoint left{};
    for (std::size_t k = 0; k < dimension(part); ++k) left[k] = part.goal[k] - part.error[k];
    for (std::size_t k = 0; k < 3; ++k) part.change_of_r[k] = inner(part.inverse[k], left);
    add_impulse(part, part.change_of_r, right);
  }
  direction_.assign(y_.size(), Motion<D>{});
  // Rounding errors of the motions, times the large entries of the matrix, are impulses that are
  // missing. A second solution removes them.
  constexpr int kSolutions = 2;
  for (int n = 0; n < kSolutions; ++n) {
    const auto more = matrix_.solution_of(right);
    right = error_;
    for (std::size_t u = 0; u < y_.size(); ++u) {
      for (std::size_t k = 0; k < kMotion; ++k) direction_[u][k] += more[u][k];
      const auto impulse = problem_.units[u].impulse_of(direction_[u]);
      for (std::size_t k = 0; k < kMotion; ++k) right[u][k] -= impulse[k];
    }
    for (auto& part : parts_) {
      const auto moved = values(part, false, more);
      for (std::size_t k = 0; k < dimension(part); ++k)
        part.change_of_r[k] -= inner(part.inverse[k], moved);
      add_impulse(part, part.change_of_r, right);
    }
  }
  for (auto& part : parts_) {
    const auto moved = values(part, false, direction_);
    for (std::size_t k = 0; k < dimension(part); ++k)
      part.change_of_u[k] = moved[k] + part.error[k] + kRegularisation * part.change_of_r[k];
    if (part.role != Role::kGivenBound) continue;
    // z is what the first row of W^2 dr + du = goal says.
    auto change = coordinates(part, part.change_of_u);
    change[0] = coordinates(part, part.goal)[0] -
                part.scaling.square_along(coordinates(part, part.change_of_r));
    part.change_of_u = coordinates(part, change);
  }
}

/// Longest step, at most 1, with which all points stay in their cones.
template <int D>
double InteriorPoints<D>::length_to_boundary() const {
  double length = 1;
  for (const auto& part : parts_)
    if (part.role != Role::kEquation)
      length =
          std::min({length, Cone::length_to_boundary(part.u, part.change_of_u, dimension(part)),
                    Cone::length_to_boundary(part.r, part.change_of_r, dimension(part))});
  return length;
}

/// Sets the goals of the corrector, after a predictor whose longest step has this length.
template <int D>
void InteriorPoints<D>::set_corrector(double gap_before, double length) {
  double after = 0, cones = 0;
  for (const auto& part : parts_) {
    if (part.role == Role::kEquation) continue;
    cones += degree(part);
    for (std::size_t k = 0; k < part.rows; ++k)
      after +=
          (part.u[k] + length * part.change_of_u[k]) * (part.r[k] + length * part.change_of_r[k]);
  }
  const double ratio = std::clamp(after / (cones * gap_before), 0.0, 1.0);
  const double centre = ratio * ratio * ratio * gap_before;
  for (auto& part : parts_) {
    if (part.role == Role::kEquation) continue;
    const auto scaled = part.scaling.times(part.r);
    const auto square = Cone::product(scaled, scaled);
    const auto second =
        Cone::product(part.scaling.divide(part.change_of_u), part.scaling.times(part.change_of_r));
    ConePoint goal = Cone::unit(dimension(part));
    for (std::size_t k = 0; k < 3; ++k) goal[k] = centre * goal[k] - square[k] - second[k];
    part.goal = part.scaling.times(Cone::quotient(goal, scaled));
  }
}

template <int D>
void InteriorPoints<D>::move(double length) {
  for (std::size_t u = 0; u < y_.size(); ++u)
    for (std::size_t k = 0; k < kMotion; ++k) y_[u][k] += length * direction_[u][k];
  for (auto& part : parts_)
    for (std::size_t k = 0; k < dimension(part); ++k) {
      part.u[k] += length * part.change_of_u[k];
      part.r[k] += length * part.change_of_r[k];
    }
}

template <int D>
void InteriorPoints<D>::take_impulses() {
  std::ranges::fill(impulses_, 0.0);
  for (const auto& part : parts_) {
    const auto impulse = impulse_of(part, part.r);
    for (std::size_t k = 0; k < part.rows; ++k) impulses_[part.row + k] = impulse[part.first + k];
    impulses_[part.row] += part.base;
  }
}

/// Sets all points inside their cones, with equal products u o r.
template <int D>
void InteriorPoints<D>::start(double size) {
  for (auto& part : parts_) {
    if (part.role == Role::kEquation) continue;
    for (std::size_t k = 0; k < 3; ++k)
      part.u[k] = part.r[k] = size * Cone::unit(dimension(part))[k];
    if (part.role != Role::kGivenBound) continue;
    const double of_unit = coordinates(part, Cone::unit(dimension(part)))[0];
    const double share = part.scaled_bound / (of_unit * size);
    for (std::size_t k = 0; k < 3; ++k) {
      part.r[k] *= share;
      part.u[k] /= share;
    }
  }
}

template <int D>
int InteriorPoints<D>::solve(double accuracy, int max_iterations) {
  // A step ends a little before the first boundary.
  constexpr double kInside = 0.995;
  set_parts();
  impulses_ = problem_.impulses;
  for (std::size_t u = 0; u < y_.size(); ++u) y_[u] = problem_.units[u].free;
  double size = 0;
  for (const auto& part : parts_)
    for (const double v : values(part, true, y_)) size = std::max(size, std::abs(v));
  start(size);
  int iterations = 0;
  double least = std::numeric_limits<double>::infinity();
  for (; size > 0; ++iterations) {
    const double left = measure();
    if (!(left < 10 * least)) break;
    if (left < least) {
      least = left;
      take_impulses();
    }
    if (left <= accuracy * size || iterations == max_iterations || !factorise()) break;
    find_direction();
    set_corrector(gap_, length_to_boundary());
    find_direction();
    const double length = length_to_boundary();
    move(length < 1 ? kInside * length : 1);
  }
  return iterations;
}

template class InteriorPoints<2>;
template class InteriorPoints<3>;

}  // namespace viscontact::particles
