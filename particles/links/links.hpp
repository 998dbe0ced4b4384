// The links of a case: hinges, springs, arms and membranes that hold particles and rigid bodies.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

#include "viscontact/particles/links/membrane.hpp"
#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

/// A length that is linear in time between points. Without a period it is constant before the first
/// point and after the last one.
struct PiecewiseLinearLength {
  std::vector<std::array<double, 2>>
      points;  ///< (time [T], length [L] > 0), at least one; times increase
  /// Period [T], larger than the time of the last point, after which the length is linear until the
  /// first point of the next period. 0: not periodic.
  double period = 0;
};

/// The length mean + amplitude sin(angular_frequency t + phase).
struct SinusoidalLength {
  double mean = 0,               ///< [L], > |amplitude|
      amplitude = 0;             ///< [L], of any sign
  double angular_frequency = 0,  ///< [1/T], of any sign; 0: constant
      phase = 0;                 ///< [rad]
};

using ArmLength = std::variant<PiecewiseLinearLength, SinusoidalLength>;

double length_at(const ArmLength& length, double t);

/// The derivative [L/T]; at the time of a point the rate of the piece that begins there.
double rate_at(const ArmLength& length, double t);

/// The least length [L] from 0 to `end` >= 0 [T].
double least_length(const ArmLength& length, double end);

/// Times from 0 to `end` >= 0 [T] at which a length is checked: 0, `end`, and in between those of
/// all points, or an eighth of a period apart with all extrema, so that a sinusoidal length differs
/// from a linear one by at most 8 percent of the amplitude. Later periods are omitted after about
/// 10 000 times, which bounds the duration of the checks.
std::vector<double> decisive_times(const ArmLength& length, double end);

/// A point that moves with a particle or with its rigid body.
struct LinkedPoint {
  /// If the particle belongs to a rigid body, the point moves with the body.
  std::int32_t particle = 0;
  /// Vector to the point [L]: from the centre of the body with its orientation at the start, or
  /// from the centre of a particle without a body whose angle or rotation is 0.
  Vector offset{};
};

/// Holds a point at a fixed place, about which its particle or body can turn. In the plane the
/// hinge may have a torsion spring, and stops that limit the angle.
struct Hinge {
  LinkedPoint point;
  Vector at{};           ///< the place where it is held [L]
  double stiffness = 0;  ///< of the torsion spring [M L^2/T^2]; 0: no spring
  /// Angle without torque [rad]. The angle of a body is 0 at the start; that of a particle without
  /// a body is Particles::angles.
  double rest_angle = 0;
  std::int32_t body = -1;  ///< number of the body for messages; -1: the hinge holds a particle
  // The angle stays between these two [rad]; the first must be less than the second.
  double lowest_angle = -std::numeric_limits<double>::infinity(),  ///< -infinity without a stop
      highest_angle = std::numeric_limits<double>::infinity();     ///< infinity without a stop
};

/// Pulls two centres together with the force stiffness * (distance - length).
struct Spring {
  std::int32_t first = 0,
               second = 0;  ///< not of the same body
  double stiffness = 0;     ///< [M/T^2], > 0
  double length = 0;        ///< distance without a force [L], >= 0
};

struct Arm {
  std::int32_t first = 0,
               second = 0;  ///< not of the same body
  ArmLength length;         ///< > 0 at all times
};

struct Links {
  std::vector<Hinge> hinges;
  std::vector<Spring> springs;
  std::vector<Arm> arms;
  /// Without a fluid; those in a fluid are in the struct Fluid.
  std::vector<Membrane> membranes{};

  bool empty() const {
    return hinges.empty() && springs.empty() && arms.empty() && membranes.empty();
  }
  /// Number of forces in State::link_forces: those of all hinges (`dimension` components and, in
  /// the plane, the torque of the spring and the stops), springs, arms and membranes, in this
  /// order.
  std::size_t force_count(int dimension) const {
    return place_of_membrane(membranes.size(), dimension);
  }
  static std::size_t forces_of_hinge(int dimension) {
    return static_cast<std::size_t>(dimension) + (dimension == 2 ? 1 : 0);
  }

  /// Place of the force of spring `k` in State::link_forces.
  std::size_t place_of_spring(std::size_t k, int dimension) const {
    assert(k <= springs.size());
    return hinges.size() * forces_of_hinge(dimension) + k;
  }
  std::size_t place_of_arm(std::size_t k, int dimension) const {
    assert(k <= arms.size());
    return place_of_spring(springs.size(), dimension) + k;
  }
  /// Place of the first force of membrane `m`.
  std::size_t place_of_membrane(std::size_t m, int dimension) const {
    assert(m <= membranes.size());
    auto place = place_of_arm(arms.size(), dimension);
    for (std::size_t k = 0; k < m; ++k) place += forces_of_membrane(membranes[k]);
    return place;
  }
  /// For each bead one for the distance, one for the turn and, if the membrane resists bending, one
  /// for the bending spring, and one for the area if it is kept.
  static std::size_t forces_of_membrane(const Membrane& membrane) {
    return (membrane.resists_bending() ? 3 : 2) * membrane.beads.size() +
           (membrane.keeps_area ? 1 : 0);
  }
};

}  // namespace viscontact::particles
