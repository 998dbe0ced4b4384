// Gauss-Legendre quadrature with any number of points, for integrals along a stroke (swim.hpp,
// polynomial_loop.hpp). Numbers have no dimension, and nothing is thrown. A change must keep the
// points to round-off. Used by polynomial_loop.cpp and swim.cpp.
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
