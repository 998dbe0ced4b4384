// Declares the links of a case: hinges, springs, arms and membranes that hold particles and rigid
// bodies. Lengths, masses and times are in any consistent units. Nothing is checked or thrown here;
// particles/case checks the values. setting.hpp, case/, constraints/, fluid/, io/ and run/ use this
// file. A change must keep the order of the forces in State::link_forces, which restart files
// contain: all hinges, springs, arms, membranes. It must also keep that rate_at() is the derivative
// of length_at().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

#include "viscontact/particles/membranes/membrane.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// A length that is a linear function of time between points. Without a period it is constant
/// before the first point and after the last one.
struct PiecewiseLinearLength {
  std::vector<std::array<double, 2>>
      points;  ///< (time [T], length [L] > 0), at least one (not checked); times increase
  /// Period [T], larger than the time of the last point (the reader of a case checks it); between
  /// the last point and the first point of the next period the length is linear. 0: not periodic.
  double period = 0;
};

/// The length mean + amplitude sin(angular_frequency t + phase) at the time t [T].
struct SinusoidalLength {
  double mean = 0,               ///< mean length [L], > |amplitude|
      amplitude = 0;             ///< largest difference from the mean [L], of any sign
  double angular_frequency = 0,  ///< [1/T], of any sign; 0: constant
      phase = 0;                 ///< [rad]
};

/// Length of an arm as a function of time.
using ArmLength = std::variant<PiecewiseLinearLength, SinusoidalLength>;

/// Length at time `t` >= 0 [T].
double length_at(const ArmLength& length, double t);

/// Rate at which the length grows at time `t` >= 0 [L/T]. At the time of a point of a piecewise
/// linear length it is the rate of the piece that begins there.
double rate_at(const ArmLength& length, double t);

/// Least length [L] from 0 to `end` >= 0 [T], which is found at one of the decisive_times().
double least_length(const ArmLength& length, double end);

/// Times from 0 to `end` >= 0 [T] at which the reader of a case checks a length: 0, `end`, and in
/// between the times of all points of a piecewise linear length, or, for a sinusoidal one, times an
/// eighth of a period apart that include all extrema. Later periods are omitted after about 10 000
/// times (a free choice, which bounds the duration of the checks). Between two times, the length is
/// linear, or differs from a linear one by at most 8 percent of the amplitude.
std::vector<double> decisive_times(const ArmLength& length, double end);

/// A point that moves with a particle or with its rigid body.
struct LinkedPoint {
  /// Number of a particle, from 0. If it belongs to a rigid body, the point moves with the body.
  std::int32_t particle = 0;
  /// Vector to the point [L]. Of a body it begins at the centre of the body, which has its
  /// orientation at the start; of a particle without a body it begins at the centre of the
  /// particle, whose angle or rotation is 0.
  Vector offset{};
};

/// Holds a point of a particle or body at a fixed place, about which the particle or body can turn.
/// In the plane the hinge may have a torsion spring, and stops that limit the angle.
struct Hinge {
  LinkedPoint point;     ///< the point that is held
  Vector at{};           ///< the place where it is held [L]
  double stiffness = 0;  ///< stiffness of the torsion spring [M L^2/T^2], >= 0; 0: no spring
  /// Angle at which the spring exerts no torque [rad]. The angle of a body is 0 at the start; that
  /// of a particle without a body is Particles::angles.
  double rest_angle = 0;
  std::int32_t body = -1;  ///< number of the body for messages; -1: the hinge holds a particle
  // The angle stays between these two angles [rad]; the first must be less than the second.
  double lowest_angle = -std::numeric_limits<double>::infinity(),  ///< -infinity without a stop
      highest_angle = std::numeric_limits<double>::infinity();     ///< infinity without a stop
};

/// Pulls the centres of two particles together with the force stiffness * (distance - length); a
/// negative force pushes them apart.
struct Spring {
  std::int32_t first = 0,  ///< number of a particle
      second = 0;          ///< number of another particle, not of the same body
  double stiffness = 0;    ///< stiffness [M/T^2], > 0
  double length = 0;       ///< distance at which it exerts no force [L], >= 0
};

/// Keeps the distance of the centres of two particles at a length prescribed in time.
struct Arm {
  std::int32_t first = 0,  ///< number of a particle
      second = 0;          ///< number of another particle, not of the same body
  ArmLength length;        ///< the length as a function of time, > 0 at all times
};

/// The links of a case.
struct Links {
  std::vector<Hinge> hinges;    ///< in the order of the case
  std::vector<Spring> springs;  ///< in the order of the case
  std::vector<Arm> arms;        ///< in the order of the case
  /// Membranes without a fluid, in the order of the case. Membranes in a fluid are in the struct
  /// Fluid.
  std::vector<Membrane> membranes{};

  /// True if there are no links.
  bool empty() const {
    return hinges.empty() && springs.empty() && arms.empty() && membranes.empty();
  }
  /// Number of forces in State::link_forces, in `dimension` dimensions: those of all hinges
  /// (`dimension` components and, in the plane, the torque of the spring and the stops), of all
  /// springs, of all arms and of all membranes.
  std::size_t force_count(int dimension) const {
    return place_of_membrane(membranes.size(), dimension);
  }
  /// Number of forces of one hinge in State::link_forces; `dimension` is 1 to 3.
  static std::size_t forces_of_hinge(int dimension) {
    return static_cast<std::size_t>(dimension) + (dimension == 2 ? 1 : 0);
  }
  // The next functions do not check that the spring, arm or membrane exists.

  /// Place of the force of spring `k` (from 0) in State::link_forces.
  std::size_t place_of_spring(std::size_t k, int dimension) const {
    return hinges.size() * forces_of_hinge(dimension) + k;
  }
  /// Place of the force of arm `k` (from 0) in State::link_forces.
  std::size_t place_of_arm(std::size_t k, int dimension) const {
    return place_of_spring(springs.size(), dimension) + k;
  }
  /// Place of the first force of membrane `m` (from 0) in State::link_forces.
  std::size_t place_of_membrane(std::size_t m, int dimension) const {
    auto place = place_of_arm(arms.size(), dimension);
    for (std::size_t k = 0; k < m; ++k) place += forces_of_membrane(membranes[k]);
    return place;
  }
  /// Number of forces of one membrane in State::link_forces: one for the distance and one for the
  /// turn of each bead, one for the bending spring of each bead if the membrane resists bending,
  /// and one for the area if it is kept.
  static std::size_t forces_of_membrane(const Membrane& membrane) {
    return (membrane.resists_bending() ? 3 : 2) * membrane.beads.size() +
           (membrane.keeps_area ? 1 : 0);
  }
};

}  // namespace viscontact::particles
