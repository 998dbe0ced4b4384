// Gauss-Legendre quadrature with any number of points, for integrals along a stroke.
#pragma once

#include <Eigen/Core>

namespace viscontact::swimmer {

/// Points and weights on [0, 1].
struct GaussRule {
  Eigen::VectorXd points,  ///< in (0, 1)
      weights;             ///< > 0, with the sum 1
};

/// The rule with `count` > 0 points, exact for polynomials of degree 2 count - 1.
GaussRule gauss_rule(int count);

}  // namespace viscontact::swimmer
