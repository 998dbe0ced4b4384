// Mehrotra's predictor, whose goal is u.r = 0, and corrector for (5.9) and (5.17), docs/physics.md.
#include "viscontact/contact_solver/methods/interior_points.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace viscontact::contact_solver {
namespace {

struct InteriorTuning {
  // This part [1] of the change of r is added to the change of u. It bounds the entries of the
  // matrix at 1e10 times the masses, so that its factorisation keeps six digits of the masses.
  static constexpr double kRegularisation = 1e-10;
  // A step ends after this part [1] of the way to the boundary of the nearest cone.
  static constexpr double kInside = 0.995;
  // If the error is below kNear times its size at the start, and an iteration does not reduce it to
  // kSlow times the least error so far, only rounding errors are left. If it exceeds the least one
  // by kLost, nothing will be gained.
  static constexpr double kNear = 1e-6, kSlow = 0.5, kLost = 10;
  // The second solution of find_direction() saves iterations only near the end: when the error
  // divided by its size at the start is below kNearEnd and below kNearAccuracy times the accuracy.
  static constexpr double kNearEnd = 1e-3, kNearAccuracy = 1e3;
};

/// The larger of |x_0| and the distance from the axis, which does not depend on the choice of
/// tangents in space; NaN if one is NaN.
double magnitude(const ConePoint& x) { return largest_or_nan(std::abs(x[0]), beside_axis(x)); }

}  // namespace

template <int D>
InteriorPoints<D>::InteriorPoints(const ConstraintProblem<D>& problem, const std::vector<double>& w,
                                  UnitMatrix<D>& matrix)
    : problem_(problem),
      w_(w),
      matrix_(matrix),
      y_(problem.units.size()),
      direction_(problem.units.size()),
      error_(problem.units.size()),
      right_(problem.units.size()),
      impulses_(problem.impulses) {}

template <int D>
void InteriorPoints<D>::set_parts() {
  singles_.clear();
  cones_.clear();
  for (std::size_t b = 0; b < problem_.blocks.size(); ++b) {
    const auto& block = problem_.blocks[b];
    const double unit = 1 / std::sqrt(w_[block.row]);
    Cones cone;
    cone.block = b;
    if (block.is_in_cone()) {
      cone.row = block.row;
      cone.rows = block.rows;
      cone.scale.fill(unit * block.friction);
      cone.scale[0] = unit;
      cones_.push_back(cone);
      continue;
    }
    for (std::size_t k = 0; k < (block.is_contact ? 1 : block.rows); ++k) {
      Single single;
      single.block = b;
      single.row = block.row + k;
      single.is_equation = !block.is_contact;
      single.scale = unit;
      single.base = block.is_contact ? block.lowest : 0;
      single.compliance = block.compliance * unit * unit;
      singles_.push_back(single);
    }
    // Friction is left out if it moves nothing by more than half of what is allowed.
    if (!block.is_contact || block.rows == 1) continue;
    assert(block.friction_bound == FrictionBound::kGiven);
    const double bound = block.bound(0);
    if (!(bound * w_[block.row + 1] > block.allowed_slip / 2)) continue;
    cone.is_bound_given = true;
    cone.row = block.row + 1;
    cone.rows = block.rows - 1;
    cone.first = 1;
    cone.scale.fill(1 / std::sqrt(w_[cone.row]));
    cone.scaled_bound = bound / cone.scale[0];
    cones_.push_back(cone);
  }
}

template <int D>
double InteriorPoints<D>::value(const Single& part, const std::vector<Motion<D>>& y) const {
  return part.scale * problem_.product(part.row, y);
}

template <int D>
ConePoint InteriorPoints<D>::values(const Cones& part, bool with_offset,
                                    const std::vector<Motion<D>>& y) const {
  ConePoint v{};
  for (std::size_t k = 0; k < part.rows; ++k)
    v[part.first + k] =
        part.scale[part.first + k] * (problem_.product(part.row + k, y) +
                                      (with_offset ? problem_.rows[part.row + k].offset : 0));
  return Cone::coordinates(v);
}

template <int D>
ConePoint InteriorPoints<D>::impulse_of(const Cones& part, const ConePoint& r) const {
  ConePoint impulse = Cone::coordinates(r);
  for (std::size_t k = 0; k < 3; ++k) impulse[k] *= part.scale[k];
  return impulse;
}

template <int D>
void InteriorPoints<D>::add_impulse(const Cones& part, const ConePoint& r,
                                    std::vector<Motion<D>>& to) const {
  const auto impulse = impulse_of(part, r);
  for (std::size_t k = 0; k < part.rows; ++k)
    problem_.add_impulse(part.row + k, impulse[part.first + k], to);
}

template <int D>
double InteriorPoints<D>::largest_value() const {
  double largest = 0;
  for (const auto& part : singles_)
    largest = largest_or_nan(
        largest, std::abs(value(part, y_) + part.scale * problem_.rows[part.row].offset));
  for (const auto& part : cones_)
    largest = largest_or_nan(largest, magnitude(values(part, true, y_)));
  return largest;
}

template <int D>
double InteriorPoints<D>::measure() {
  double largest = 0, largest_product = 0;
  gap_ = 0;
  const auto add_product = [&](double product) {
    gap_ += product;
    largest_product = largest_or_nan(largest_product, product);
  };
  for (std::size_t u = 0; u < y_.size(); ++u) {
    Motion<D> left;
    for (std::size_t k = 0; k < kMotion; ++k) left[k] = problem_.units[u].free[k] - y_[u][k];
    error_[u] = problem_.units[u].impulse_of(left);
  }
  for (auto& part : singles_) {
    problem_.add_impulse(part.row, part.base + part.scale * part.r, error_);
    part.error = value(part, y_) + part.scale * problem_.rows[part.row].offset;
    if (part.is_equation) {
      part.error += part.compliance * part.r;
    } else {
      part.error -= part.u;
      add_product(part.u * part.r);
    }
    largest = largest_or_nan(largest, std::abs(part.error));
  }
  for (auto& part : cones_) {
    add_impulse(part, part.r.x, error_);
    part.error = values(part, true, y_);
    for (std::size_t k = 0; k < 3; ++k) part.error[k] -= part.u.x[k];
    if (part.is_bound_given) {
      // The component z of u has no row and therefore no error.
      auto components = Cone::coordinates(part.error);
      components[0] = 0;
      part.error = Cone::coordinates(components);
    }
    add_product(part.scaling.product_of_points());
    largest = largest_or_nan(largest, magnitude(part.error));
  }
  if (degree_ > 0) gap_ /= degree_;
  for (std::size_t u = 0; u < y_.size(); ++u) {
    const auto moved = problem_.units[u].moved_by(error_[u]);
    double square = 0;
    for (std::size_t k = 0; k < kMotion; ++k) square += moved[k] * error_[u][k];
    largest = largest_or_nan(largest, std::sqrt(std::max(square, 0.0)));
  }
  return largest_or_nan(largest, std::sqrt(std::max(largest_product, 0.0)));
}

template <int D>
void InteriorPoints<D>::begin_predictor(Single& part) {
  part.goal = -part.u;
  part.weight = 1 / ((part.is_equation ? part.compliance : part.u / part.r) +
                     InteriorTuning::kRegularisation);
}

template <int D>
void InteriorPoints<D>::begin_predictor(Cones& part) {
  part.goal = part.scaling.numbers_of_u();
  for (double& number : part.goal) number = -number;
}

template <int D>
ConePoint InteriorPoints<D>::change_of_r(const Cones& part, const ConePoint& numbers) {
  return part.is_bound_given ? part.scaling.solve_beside(InteriorTuning::kRegularisation, numbers)
                             : part.scaling.solve(InteriorTuning::kRegularisation, numbers);
}

template <int D>
bool InteriorPoints<D>::factorise() {
  matrix_.set_to_masses();
  for (auto& part : singles_) {
    begin_predictor(part);
    matrix_.add_product(part.block, part.row, part.row, part.weight * part.scale * part.scale);
  }
  for (auto& part : cones_) {
    begin_predictor(part);
    for (std::size_t k = 0; k < part.rows; ++k) {
      // The impulses of the rows that remove a displacement of row k.
      ConePoint displacement{};
      displacement[part.first + k] = part.scale[part.first + k];
      const auto impulse = impulse_of(
          part, change_of_r(part, part.scaling.numbers(Cone::coordinates(displacement))));
      for (std::size_t l = 0; l < part.rows; ++l)
        if (const double weight = impulse[part.first + l]; weight != 0)
          matrix_.add_product(part.block, part.row + k, part.row + l, weight);
    }
  }
  return matrix_.factorise();
}

template <int D>
void InteriorPoints<D>::find_direction(int solutions) {
  assert(solutions == 1 || solutions == 2);
  right_ = error_;
  for (auto& part : singles_) {
    part.change_of_r = part.weight * (part.goal - part.error);
    problem_.add_impulse(part.row, part.scale * part.change_of_r, right_);
    part.change_of_u = part.error;
  }
  for (auto& part : cones_) {
    auto left = part.scaling.numbers(part.error);
    for (std::size_t k = 0; k < 3; ++k) left[k] = part.goal[k] - left[k];
    part.change_of_r = change_of_r(part, left);
    add_impulse(part, part.change_of_r, right_);
    part.change_of_u = part.error;
  }
  for (int n = 0; n < solutions; ++n) {
    matrix_.solve(right_);
    for (auto& part : singles_) {
      const double moved = value(part, right_);
      part.change_of_u += moved;
      part.change_of_r -= part.weight * moved;
    }
    for (auto& part : cones_) {
      const auto moved = values(part, false, right_);
      const auto less = change_of_r(part, part.scaling.numbers(moved));
      for (std::size_t k = 0; k < 3; ++k) {
        part.change_of_u[k] += moved[k];
        part.change_of_r[k] -= less[k];
      }
    }
    if (n == 0) {
      direction_ = right_;
    } else {
      for (std::size_t u = 0; u < y_.size(); ++u)
        for (std::size_t k = 0; k < kMotion; ++k) direction_[u][k] += right_[u][k];
    }
    if (n + 1 == solutions) break;
    for (std::size_t u = 0; u < y_.size(); ++u) {
      const auto impulse = problem_.units[u].impulse_of(direction_[u]);
      for (std::size_t k = 0; k < kMotion; ++k) right_[u][k] = error_[u][k] - impulse[k];
    }
    for (const auto& part : singles_)
      problem_.add_impulse(part.row, part.scale * part.change_of_r, right_);
    for (const auto& part : cones_) add_impulse(part, part.change_of_r, right_);
  }
  for (auto& part : singles_)
    part.change_of_u += InteriorTuning::kRegularisation * part.change_of_r;
  for (auto& part : cones_) {
    for (std::size_t k = 0; k < 3; ++k)
      part.change_of_u[k] += InteriorTuning::kRegularisation * part.change_of_r[k];
    if (!part.is_bound_given) continue;
    // The change of z follows from the second number of W^2 dr + du, which must be that of the
    // goal. The first number is much larger near a solution, so that digits would be lost.
    auto change = Cone::coordinates(part.change_of_u);
    change[0] = 0;
    change[0] = part.scaling.first_change(part.goal, part.change_of_r, Cone::coordinates(change));
    part.change_of_u = Cone::coordinates(change);
  }
}

template <int D>
double InteriorPoints<D>::length_to_boundary() const {
  double length = 1 / InteriorTuning::kInside;
  for (const auto& part : singles_) {
    if (part.is_equation) continue;
    if (part.u + length * part.change_of_u < 0) length = -part.u / part.change_of_u;
    if (part.r + length * part.change_of_r < 0) length = -part.r / part.change_of_r;
  }
  for (const auto& part : cones_)
    length = std::min({length, Cone::length_to_boundary(part.u, part.change_of_u),
                       Cone::length_to_boundary(part.r, part.change_of_r)});
  return length;
}

template <int D>
void InteriorPoints<D>::set_corrector(double gap_before, double length) {
  double after = 0;
  for (const auto& part : singles_)
    if (!part.is_equation)
      after += (part.u + length * part.change_of_u) * (part.r + length * part.change_of_r);
  for (const auto& part : cones_)
    after += part.scaling.product_of_points() +
             length * (inner(part.u.x, part.change_of_r) + inner(part.change_of_u, part.r.x) +
                       length * inner(part.change_of_u, part.change_of_r));
  // The corrector aims at equal products of all u and r, with the products of the changes that the
  // predictor neglects.
  const double ratio = std::clamp(after / (degree_ * gap_before), 0.0, 1.0);
  const double centre = ratio * ratio * ratio * gap_before;
  for (auto& part : singles_)
    if (!part.is_equation)
      part.goal = (centre - part.change_of_u * part.change_of_r) / part.r - part.u;
  for (auto& part : cones_) {
    const auto scaled = part.scaling.scaled();
    const auto square = Cone::product(scaled, scaled);
    const auto second = Cone::product(part.scaling.divide(part.change_of_u),
                                      part.scaling.point(part.scaling.times(part.change_of_r)));
    ConePoint goal = Cone::kUnit;
    for (std::size_t k = 0; k < 3; ++k) goal[k] = centre * goal[k] - square[k] - second[k];
    part.goal = part.scaling.times(Cone::quotient(goal, scaled));
  }
}

template <int D>
void InteriorPoints<D>::move(double length) {
  for (std::size_t u = 0; u < y_.size(); ++u)
    for (std::size_t k = 0; k < kMotion; ++k) y_[u][k] += length * direction_[u][k];
  for (auto& part : singles_) {
    if (!part.is_equation) part.u += length * part.change_of_u;
    part.r += length * part.change_of_r;
  }
  for (auto& part : cones_) {
    Cone::move(part.u, length, part.change_of_u);
    Cone::move(part.r, length, part.change_of_r);
    part.scaling = typename Cone::Scaling(part.u, part.r);
  }
}

template <int D>
void InteriorPoints<D>::take_impulses() {
  std::ranges::fill(impulses_, 0.0);
  for (const auto& part : singles_) {
    // Contacts that seem to open get their lowest impulse exactly, so that no film absorbs a small
    // rest.
    const bool is_open = !part.is_equation && part.u > part.r;
    impulses_[part.row] = part.base + (is_open ? 0 : part.scale * part.r);
  }
  for (const auto& part : cones_) {
    const auto r = part.is_bound_given ? part.r.x : Cone::without_open_part(part.u.x, part.r.x);
    const auto impulse = impulse_of(part, r);
    for (std::size_t k = 0; k < part.rows; ++k) impulses_[part.row + k] = impulse[part.first + k];
  }
}

template <int D>
void InteriorPoints<D>::start(double size) {
  degree_ = 0;
  for (auto& part : singles_) {
    part.u = part.is_equation ? 0 : size;
    part.r = part.is_equation ? 0 : size;
    degree_ += part.is_equation ? 0 : 1;
  }
  for (auto& part : cones_) {
    const auto unit = Cone::kUnit;
    degree_ += inner(unit, unit);
    double share = 1;
    if (part.is_bound_given) share = part.scaled_bound / (Cone::coordinates(unit)[0] * size);
    for (std::size_t k = 0; k < 3; ++k) {
      part.r.x[k] = size * unit[k] * share;
      part.u.x[k] = size * unit[k] / share;
    }
    part.r.inside = size * share;
    part.u.inside = size / share;
    part.scaling = typename Cone::Scaling(part.u, part.r);
  }
}

template <int D>
int InteriorPoints<D>::solve(double accuracy, int max_iterations) {
  using Tuning = InteriorTuning;
  assert(accuracy > 0 && accuracy < 1 && w_.size() == problem_.rows.size());
  set_parts();
  // The impulses get their least allowed values, and y_ the motions with these impulses.
  std::ranges::fill(impulses_, 0.0);
  for (const auto& part : singles_) impulses_[part.row] = part.base;
  y_ = motions(problem_, impulses_);
  const double size = largest_value();
  const double twice_below = std::min(Tuning::kNearEnd, Tuning::kNearAccuracy * accuracy) * size;
  start(size);
  int iterations = 0;
  double least = std::numeric_limits<double>::infinity();
  for (; size > 0; ++iterations) {
    const double left = measure();
    if (!(left < Tuning::kLost * least)) break;
    const bool is_at_end = left < Tuning::kNear * size && left > Tuning::kSlow * least;
    if (left < least) {
      least = left;
      take_impulses();
    }
    if (left <= accuracy * size || is_at_end || iterations == max_iterations || !factorise()) break;
    find_direction(1);
    set_corrector(gap_, std::min(1.0, length_to_boundary()));
    find_direction(left > twice_below ? 1 : 2);
    move(Tuning::kInside * length_to_boundary());
  }
  return iterations;
}

template class InteriorPoints<2>;
template class InteriorPoints<3>;

}  // namespace viscontact::contact_solver
