// Points and weights by the eigenvalues of the Jacobi matrix (gauss_rule.hpp; Golub & Welsch 1969,
// Math. Comp. 23, 221). Numbers have no dimension, and nothing is thrown. Sums along a stroke
// depend on the points to the last digit.
#include "viscontact/swimmer/gauss_rule.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace viscontact::swimmer {

GaussRule gauss_rule(int count) {
  Eigen::VectorXd off_diagonal(count - 1);
  for (Eigen::Index k = 1; k < count; ++k) {
    const auto number = static_cast<double>(k);
    off_diagonal[k - 1] = number / std::sqrt(4 * number * number - 1);
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
  eigen.computeFromTridiagonal(Eigen::VectorXd::Zero(count), off_diagonal);
  return {(eigen.eigenvalues().array() + 1) / 2,
          eigen.eigenvectors().row(0).transpose().array().square()};
}

}  // namespace viscontact::swimmer
