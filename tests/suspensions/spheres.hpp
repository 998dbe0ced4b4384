// Suspensions that the tests share.
#pragma once

#include <cstddef>
#include <ostream>
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

/// Spheres of radius 1 on a cubic lattice, `side` of them along each edge, displaced along each axis
/// by at most `displacement`.
State disturbed_lattice(int side, double spacing, double displacement, Random& random);

/// Spheres of the same radii at the places place(x), where x are those of `state`.
template <class Place>
State displaced(const State& state, const Place& place) {
  std::vector<Vector> places;
  for (std::size_t k = 0; k < state.particles.count(); ++k)
    places.push_back(place(state.particles.position(k)));
  return spheres_at(places, state.particles.radii);
}
/// The same spheres in this order.
State reordered(const State& state, const std::vector<std::size_t>& order);
/// The numbers below `count` in an order that is always the same.
std::vector<std::size_t> shuffled(std::size_t count);
/// Places and radii times `length`.
State scaled(const State& state, double length);

/// Radii 1 and 1.4 in turn.
std::vector<double> two_sizes(std::size_t count);

/// A periodic cube, sheared with rate 1, with near-contact terms.
Setting sheared_cube(double period, double offset);

/// Pairs and contacts of a step.
struct StepKind {
  PairTerms pairs;
  double regularisation, roughness, friction;
};
void PrintTo(const StepKind& kind, std::ostream* out);
/// The same cube with this kind of pairs, whose films take the place of those that are left out.
Setting sheared_cube(double period, double offset, const StepKind& kind);

/// Expects that a run of `before` and `after` steps has the same bits if it is continued from its
/// state after the first ones.
void expect_continued(const Setting& setting, const State& start, int before, int after);

/// Velocity and angular velocity of sphere k less those of the flow.
struct RelativeMotion {
  Vector along{}, turn{};
};
RelativeMotion relative_motion(const SuspensionSimulation& simulation, const Setting& setting,
                               std::size_t k);

/// Those behind a mirror across z.
std::vector<RelativeMotion> mirrored(std::vector<RelativeMotion> motions);
/// Those in units of a length and a time.
std::vector<RelativeMotion> in_units(std::vector<RelativeMotion> motions, double length,
                                     double time);

/// The largest difference of components over the largest component.
double largest_difference(const std::vector<RelativeMotion>& a,
                          const std::vector<RelativeMotion>& b);

}  // namespace viscontact::particles
