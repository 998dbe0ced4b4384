#include "tests/oracles/bispherical/pair_matrix.hpp"

#include <cmath>
#include <vector>

#include "tests/oracles/bispherical/pair_loads.hpp"

namespace viscontact {
namespace {

/// A component of a sphere in a block of PairLoads.
struct Component {
  Eigen::Index index;   ///< among the 11 components
  double load, source;  ///< factors of the load and of the unit motion or strain
  double mirror;        ///< -1 if it changes sign in the mirror z -> -z
};

void add(const Eigen::MatrixXd& loads, const std::vector<Component>& block, Eigen::MatrixXd& all) {
  const auto count = static_cast<Eigen::Index>(block.size());
  for (Eigen::Index i = 0; i < loads.rows(); ++i)
    for (Eigen::Index j = 0; j < loads.cols(); ++j) {
      const auto &row = block[static_cast<std::size_t>(i % count)],
                 &column = block[static_cast<std::size_t>(j % count)];
      all(row.index + i / count * 11, column.index + j / count * 11) =
          row.mirror * column.mirror * row.load * column.source * loads(i, j);
    }
}

Eigen::MatrixXd in_components(const PairLoads& loads) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(11 * loads.spin.rows(), 11 * loads.spin.cols());
  // In the basis tensor B = t E of each strain a unit source is t E, and the load is B:S, with E:S =
  // S_zz, 2 S_xz or 2 S_xx. Forces and torques are those on the fluid.
  const double axial = std::sqrt(1.5), shear = std::sqrt(2.0);
  add(loads.axial, {{2, -1, 1, -1}, {6, axial, axial, 1}}, all);
  add(loads.transverse, {{0, -1, 1, 1}, {4, -1, 1, -1}, {7, shear, 1 / shear, -1}}, all);
  // Rotated about z, from x to y and from y to -x.
  add(loads.transverse, {{1, -1, 1, 1}, {3, 1, -1, -1}, {8, shear, 1 / shear, -1}}, all);
  add(loads.twofold, {{9, shear, 1 / shear, 1}}, all);
  add(loads.twofold, {{10, shear, 1 / shear, 1}}, all);
  add(loads.spin, {{5, -1, 1, 1}}, all);
  return all;
}

}  // namespace

Eigen::MatrixXd exact_pair_matrix(double radius1, double radius2, double gap) {
  return in_components(exact_pair_loads(radius1, radius2, gap));
}

Eigen::MatrixXd exact_plane_matrix(double radius, double gap) {
  return in_components(exact_loads_above_plane(radius, gap));
}

}  // namespace viscontact
