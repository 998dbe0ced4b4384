// The fluid around the particles, as the sections [fluid], [[probe]] and [[membrane]] of a case
// file describe it.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "viscontact/particles/links/membrane.hpp"
#include "viscontact/particles/shapes/shape.hpp"
#include "viscontact/particles/values/piecewise_constant.hpp"

namespace viscontact::particles {

/// How the fluid solver keeps a particle rigid, docs/physics.md (6.1) and (6.2).
enum class RigidConstraint {
  kPenalty,  ///< the particle is a fluid of the viscosity mu (1 + 1/penalty); mu: that around it
  kRigid,    ///< velocity and angular velocity of each particle are unknowns of the flow problem
};

enum class FluidMesh {
  kFitted,  ///< curved edges of the mesh follow the surfaces of the particles
  kFixed,   ///< one mesh of the whole domain, which does not depend on the particles
};

/// How contact acts on particles in a fluid, docs/physics.md (6.4).
enum class Coupling {
  kConstrained,  ///< the fluid moves the particles under forces that include those of the contacts
  /// The velocities without contact forces are computed first. The particles then move with the
  /// nearest velocities that close no gap; masses must be > 0, except with a given motion.
  kSplitting,
};

/// How the term u.grad u of a fluid with inertia is computed, docs/physics.md (6.9).
enum class Advection {
  kSemiImplicit,     ///< the first u of u.grad u is extrapolated in time: a linear problem
  kCharacteristics,  ///< earlier velocities are taken at the places where the fluid was
};

/// How a fluid with inertia begins.
enum class FlowStart {
  kRest,    ///< the fluid begins at rest
  kStokes,  ///< the fluid begins with the Stokes flow around particles that move without inertia
};

/// Velocity of a wall. In a fluid with inertia it may depend on time.
struct WallVelocity {
  enum class Kind {
    kConstant,   ///< the velocity is `value` everywhere on the wall
    kParabolic,  ///< along the inward normal, 0 at both ends; value[0] is the largest speed
    kOpen,       ///< not given: no stress acts on this side, and fluid flows through it freely
  };
  Kind kind = Kind::kConstant;
  /// x and y of a constant velocity [L/T]; of a parabola value[0] is the largest speed [L/T].
  std::array<double, 2> value{};
  /// If this has pieces, their velocities [L/T] take the place of `value`.
  PiecewiseConstant pieces{};
  /// If the period [T] is > 0, the velocity is multiplied by 1 + amplitude sin(2 pi time/period).
  double period = 0;
  double amplitude = 0;  ///< [1], any number; not used without a period

  bool depends_on_time() const { return !pieces.pieces.empty() || period > 0; }
  /// The two numbers [L/T] that take the place of `value` at `time` [T], >= 0. If there are pieces
  /// and `to` > `from` >= 0 [T], the mean of the pieces between both times is exact, so that as
  /// much fluid flows in as the case says.
  std::array<double, 2> at(double time, double from = 0, double to = 0) const;
};

/// The velocity u0 + E x at the points x of all walls, with the constant matrix E. If the domain is
/// periodic along x and y, E is the mean velocity gradient. A shear with the rate s has E = (0, s;
/// 0, 0) and the velocity (s y, 0). A strain with the rate s has E = (s, 0; 0, -s).
struct LinearFlow {
  /// E as du/dx, du/dy, dv/dx, dv/dy [1/T]. If all are 0, the walls are at rest.
  std::array<double, 4> gradient{};
  /// u0 [L/T], which is 0 in a case; not used if the domain is periodic along x and y.
  std::array<double, 2> at_origin{};
};

/// Velocities of the sides of a box: left, right, bottom, top. Entries of periodic sides are not
/// used.
using SideVelocities = std::array<WallVelocity, 4>;

/// A line across a channel, `[[probe]]` of a case, in a box. The flow through the line and the mean
/// pressure on it are measured.
struct Probe {
  std::string name;              ///< its name in the column `name` of the output file probes.csv
  std::array<double, 2> from{};  ///< a point on a wall [L]
  std::array<double, 2> to{};    ///< a point on another wall [L]
};

/// The fluid around the particles, and how its flow is computed: `[fluid]` of a case. In two
/// dimensions masses and forces are per unit length of the third dimension. Particles are given by
/// their numbers, from 0.
struct Fluid {
  double viscosity = 0;  ///< mu [M/(L T)], > 0
  double density = 0;    ///< [M/L^3], >= 0; 0: Stokes flow, without inertia
  // Of the members from here to `gradient_amplitude` Stokes flow has pressure_gradient only.
  Advection advection = Advection::kSemiImplicit;
  FlowStart start = FlowStart::kRest;
  /// Uniform pressure gradient, x and y [M/(L^2 T^2)], which drives the fluid and also acts on
  /// particles.
  std::array<double, 2> pressure_gradient{};
  /// If the period [T] is > 0, the gradient is multiplied by 1 + amplitude sin(2 pi time/period).
  double gradient_period = 0;
  double gradient_amplitude = 0;  ///< [1], any number; not used without a period
  /// How particles are kept rigid; kRigid needs FluidMesh::kFitted.
  RigidConstraint constraint = RigidConstraint::kPenalty;
  /// The penalty of docs/physics.md (6.1) [1], 1e-12 to 1; only kPenalty uses it. Velocities have
  /// an error in proportion to it, and rounding errors of about 1e-16/penalty (docs/fluid.md).
  double penalty = 1e-7;
  FluidMesh mesh = FluidMesh::kFitted;
  /// Edges of the mesh on the circumference of the smallest particle, 6 to 400. With 24, velocities
  /// have relative errors of some 1e-4 at gaps of 0.1 radii and more (docs/fluid.md).
  int edges_per_particle = 24;
  Coupling coupling = Coupling::kConstrained;
  /// Gap at which contact is made [L], > 0: D_c of docs/physics.md. While a case is read, it may be
  /// 0, which stands for a default that is set later.
  double threshold_gap = 0;
  /// Velocities of the walls, or the mean velocity gradient.
  std::variant<LinearFlow, SideVelocities> boundary;
  /// Command of a flow solver of the user's own, with its arguments; empty: FreeFEM is used.
  std::vector<std::string> solver;
  /// For each disc the part of its area [L^2] beyond the chords at which it overlaps other discs of
  /// its rigid body (cut_areas_of(), chords.hpp). Empty: no discs of bodies overlap.
  std::vector<double> cut_areas{};

  std::vector<Membrane> membranes{};

  std::vector<Probe> probes{};

  /// The pressure gradient at `time` >= 0 [T], x and y [M/(L^2 T^2)].
  std::array<double, 2> pressure_gradient_at(double time) const;
  /// True if both particles are beads of one membrane. They make no contact with each other.
  bool are_of_one_membrane(std::int32_t first, std::int32_t second) const;
  bool has_inertia() const { return density > 0; }
  /// Area of particle k of the shape `shape` [L^2], without its cut area, or volume of a sphere
  /// [L^3].
  double size_of(const Shape& shape, std::size_t k) const {
    assert(cut_areas.empty() || k < cut_areas.size());
    return shape.measure() - (cut_areas.empty() ? 0 : cut_areas[k]);
  }
};

}  // namespace viscontact::particles
