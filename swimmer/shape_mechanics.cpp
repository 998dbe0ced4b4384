// The balance of forces of a swimmer at one shape.
#include "viscontact/swimmer/shape_mechanics.hpp"

#include <cassert>

#include "viscontact/common/error.hpp"

namespace viscontact::swimmer {
namespace {

using Eigen::Index;

/// The matrix B of ShapeMechanics.
Eigen::MatrixXd relative_positions(Index spheres) {
  const auto middle = static_cast<Index>(middle_sphere(static_cast<std::size_t>(spheres)));
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(spheres, spheres - 1);
  for (Index i = 0; i < spheres; ++i)
    for (Index k = 0; k + 1 < spheres; ++k) b(i, k) = (k < i ? 1 : 0) - (k < middle ? 1 : 0);
  return b;
}

}  // namespace

std::vector<double> Swimmer::gaps_of(const Eigen::VectorXd& arms) const {
  assert(arms.size() == this->arms());
  std::vector<double> gaps;
  for (std::size_t k = 0; k + 1 < radii().size(); ++k)
    gaps.push_back(arms[static_cast<Index>(k)] - radii()[k] - radii()[k + 1]);
  return gaps;
}

std::array<double, 2> Swimmer::arm_interval(Index k) const {
  const auto i = static_cast<std::size_t>(k);
  const auto [from, to] = resistance_.gap_interval(i);
  const double both_radii = radii()[i] + radii()[i + 1];
  return {from + both_radii, to + both_radii};
}

bool Swimmer::contains(const Eigen::VectorXd& arms) const {
  return resistance_.contains(gaps_of(arms));
}

ShapeMechanics Swimmer::at(const Eigen::VectorXd& arms, bool with_slopes) const {
  for (Index k = 0; k < arms.size(); ++k) {
    const auto [from, to] = arm_interval(k);
    // The shape is in the table if its gaps are, which contains() tests. The arms are tested only
    // to find the one at fault, because they have rounding errors: an arm is a gap plus two radii.
    if (!contains(arms) && !(arms[k] >= from && arms[k] <= to))
      throw Error(ErrorKind::kBadInput,
                  "arm x{} is {:.9g}; the table has arms from {:.9g} to {:.9g}", k + 1, arms[k],
                  from, to);
  }
  const auto resistance = resistance_(gaps_of(arms));
  const Eigen::MatrixXd& r = resistance.value;
  const Index spheres = r.rows();
  const Eigen::MatrixXd b = relative_positions(spheres);

  ShapeMechanics mechanics;
  mechanics.resistance = r;
  const Eigen::RowVectorXd row_sum = r.colwise().sum();
  mechanics.towing_resistance = row_sum.sum();
  const Eigen::RowVectorXd a = -row_sum * b / mechanics.towing_resistance;
  mechanics.displacement_form = a;
  mechanics.motion = b + Eigen::VectorXd::Ones(spheres) * a;
  mechanics.metric = mechanics.motion.transpose() * r * mechanics.motion;
  if (!with_slopes) return mechanics;
  for (const auto& slope : resistance.slopes) {
    const Eigen::RowVectorXd row_slope = slope.colwise().sum();
    mechanics.displacement_form_slopes.emplace_back(-(row_slope * b + row_slope.sum() * a) /
                                                    mechanics.towing_resistance);
    // The derivative of `motion` is e dA/dx with the vector e of ones, and e^T R motion = 0,
    // because the total force vanishes.
    mechanics.metric_slopes.emplace_back(mechanics.motion.transpose() * slope * mechanics.motion);
  }
  return mechanics;
}

double displacement_curl(const Swimmer& swimmer, const Eigen::VectorXd& arms) {
  assert(arms.size() == 2);
  const auto slopes = swimmer.at(arms, true).displacement_form_slopes;
  return slopes.at(0)[1] - slopes.at(1)[0];
}

}  // namespace viscontact::swimmer
