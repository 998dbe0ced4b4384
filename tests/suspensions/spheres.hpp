// Suspensions that the tests share.
#pragma once

#include <cstddef>
#include <vector>

#include "tests/common/random.hpp"
#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/state.hpp"
#include "viscontact/suspensions/suspension_simulation.hpp"

namespace viscontact::particles {

/// Spheres at rest that can turn, of density 1.
State spheres_at(const std::vector<Vector>& places, const std::vector<double>& radii);

/// Spheres without overlaps at random places in a cube with this period along each axis, whose
/// image across y is displaced. The least gap is `gap` times the sum of the radii.
State random_spheres(double period, double offset, const std::vector<double>& radii, double gap,
                     Random& random);

/// Radii 1 and 1.4 in turn.
std::vector<double> two_sizes(std::size_t count);

/// A periodic cube, sheared with rate 1, with near-contact terms.
Setting sheared_cube(double period, double offset);

/// Velocity and angular velocity of sphere k less those of the flow.
struct RelativeMotion {
  Vector along{}, turn{};
};
RelativeMotion relative_motion(const SuspensionSimulation& simulation, const Setting& setting,
                               std::size_t k);

/// The largest difference of components over the largest component.
double largest_difference(const std::vector<RelativeMotion>& a,
                          const std::vector<RelativeMotion>& b);

}  // namespace viscontact::particles
