// The fluid around the particles, as a case describes it: sections [fluid] and [domain] of a case
// file. Lengths, masses and times are in the units of the case; in two dimensions masses and forces
// are per unit length of the third dimension. particles/case checks the values; particles/fluid and
// freefem_flow read them. A change must keep the defaults, which cases rely on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/membranes/membrane.hpp"
#include "viscontact/particles/piecewise_constant.hpp"

namespace viscontact::particles {

/// How the fluid solver keeps a body rigid, docs/physics.md (6.1) and (6.2).
enum class RigidConstraint {
  kPenalty,  ///< the body is a very viscous fluid (the lecture's method)
  kRigid,    ///< the rigid motions of the bodies are unknowns
};

/// Whether the mesh of the fluid follows the particles.
enum class FluidMesh {
  kFitted,  ///< curved edges of the mesh follow the surfaces of the particles
  kFixed,   ///< one mesh of the domain, whatever the places of the particles (the lecture's method)
};

/// How contact acts on particles in a fluid, docs/physics.md (6.4).
enum class Coupling {
  kConstrained,  ///< contact impulses are forces in the problem of the fluid
  kSplitting,    ///< the velocities that the fluid gives are projected (the lecture's method)
};

/// How the velocity is carried along in a fluid with inertia, docs/physics.md (6.9).
enum class Advection {
  kSemiImplicit,  ///< by the velocity extrapolated from the steps before, within the linear problem
  kCharacteristics,  ///< the velocities of the steps before are taken where the fluid was
};

/// How a fluid with inertia begins.
enum class FlowStart {
  kRest,    ///< the fluid is at rest
  kStokes,  ///< it has the Stokes flow of the first instant
};

/// Velocity of a wall: constant, or a parabola along the wall that is 0 at both ends, or not given.
/// In a fluid with inertia the velocity may depend on time.
struct WallVelocity {
  /// What is given on the wall.
  enum class Kind {
    kConstant,   ///< `value` everywhere
    kParabolic,  ///< along the inward normal, with the largest speed value[0] in the middle
    kOpen,       ///< no stress acts on this side, and fluid flows through it freely
  };
  Kind kind = Kind::kConstant;  ///< what is given
  /// x and y of a constant velocity; of a parabola value[0] is the largest speed [L/T].
  std::array<double, 2> value{};
  /// Takes the place of `value` if it has pieces.
  PiecewiseConstant pieces{};
  /// If the period [T] is > 0, the velocity is multiplied by 1 + amplitude sin(2 pi time/period).
  double period = 0;
  double amplitude = 0;  ///< without dimension

  /// True if the velocity depends on time.
  bool depends_on_time() const { return !pieces.pieces.empty() || period > 0; }
  /// The velocity, as in `value`, at `time` [T]; if `to` > `from`, pieces are averaged between
  /// both.
  std::array<double, 2> at(double time, double from = 0, double to = 0) const;
};

/// The velocity E x of all walls, with the constant matrix E; where the domain is periodic both
/// ways, the mean velocity gradient. A shear rate s is E = (0, s; 0, 0), u = (s y, 0), and a strain
/// rate s is E = (s, 0; 0, -s), u = (s x, -s y). All zero: walls at rest.
struct LinearFlow {
  std::array<double, 4> gradient{};  ///< du/dx, du/dy, dv/dx, dv/dy [1/T]
};

/// One entry for each side of a box, in the order left, right, bottom, top. The entries of periodic
/// sides are not used.
using SideVelocities = std::array<WallVelocity, 4>;

/// A line across a channel, through which the flow and on which the mean pressure are measured:
/// `[[probe]]` of a case.
struct Probe {
  std::string name;              ///< in files
  std::array<double, 2> from{};  ///< a point on a wall [L]
  std::array<double, 2> to{};    ///< a point on another wall [L]
};

/// The fluid around the particles, and how its flow is computed: `[fluid]` of a case.
struct Fluid {
  double viscosity = 0;  ///< mu [M/(L T)], > 0
  double density = 0;    ///< rho_f [M/L^3], >= 0; 0: Stokes flow
  /// The next three members are used only if the density is > 0.
  Advection advection = Advection::kSemiImplicit;  ///< how velocities are carried along
  FlowStart start = FlowStart::kRest;              ///< the flow at time 0
  /// Uniform pressure gradient that drives the fluid, and acts on particles, too [M/(L^2 T^2)].
  std::array<double, 2> pressure_gradient{};
  /// If the period [T] is > 0, the gradient is multiplied by 1 + amplitude sin(2 pi time/period).
  double gradient_period = 0;
  double gradient_amplitude = 0;  ///< without dimension
  /// How particles are kept rigid; kRigid needs the fitted mesh.
  RigidConstraint constraint = RigidConstraint::kPenalty;
  /// The penalty > 0 of docs/physics.md (6.1), without dimension; used by kPenalty only. Velocities
  /// have an error proportional to it, and rounding errors of about 1e-16/penalty (docs/fluid.md).
  double penalty = 1e-7;
  FluidMesh mesh = FluidMesh::kFitted;  ///< whether it follows the particles
  /// Edges of the mesh on the circumference of the smallest particle, >= 6. With 24, velocities
  /// have relative errors of some 1e-4 at gaps of 0.1 radii and more (docs/fluid.md).
  int edges_per_particle = 24;
  Coupling coupling = Coupling::kConstrained;  ///< how contact acts
  double threshold_gap = 0;  ///< gap at which particles make contact, D_c of physics.md [L], >= 0
  /// Velocities of the walls, or of a cell that is periodic both ways.
  std::variant<LinearFlow, SideVelocities> boundary;
  /// Command of a solver of the user's own; empty: FreeFEM.
  std::vector<std::string> solver;
  /// Semi-axes of each particle in the plane, of which the first one points along the angle of the
  /// particle [L], > 0. Equal ones are those of a disc. Empty: all particles are discs or spheres.
  /// Those of a plate are half of its length and the radius of its round ends.
  std::vector<std::array<double, 2>> semi_axes{};
  /// Which particles are plates with round ends, one number for each: 1 or 0. Empty: none is.
  std::vector<char> plates{};
  /// Where discs of one body overlap, each is cut at the chord through the points where their
  /// circles meet (chords_of(), outline.hpp). This is the area of each disc beyond its chords
  /// [L^2], >= 0. Empty: no members of bodies overlap.
  std::vector<double> cut_areas{};

  /// Membranes in the fluid, in the order of their beads, which are all particles of the case.
  std::vector<Membrane> membranes{};

  /// Where flow and pressure are measured.
  std::vector<Probe> probes{};

  /// The pressure gradient at `time` [T].
  std::array<double, 2> pressure_gradient_at(double time) const;
  /// True if both particles are beads of one membrane, which make no contact.
  bool are_of_one_membrane(std::int32_t first, std::int32_t second) const;
  /// True if the fluid has inertia.
  bool has_inertia() const { return density > 0; }
  /// True if particle k is a plate.
  bool is_plate(std::size_t k) const { return !plates.empty() && plates[k] != 0; }
  /// True if particle k is an ellipse, and neither a disc nor a plate.
  bool is_ellipse(std::size_t k) const {
    return !semi_axes.empty() && semi_axes[k][0] != semi_axes[k][1] && !is_plate(k);
  }
  /// True if particle k is a disc or a sphere.
  bool is_disc(std::size_t k) const { return !is_plate(k) && !is_ellipse(k); }
  /// The radius of the round ends of a plate, or else `radius` [L].
  double end_radius(std::size_t k, double radius) const {
    return is_plate(k) ? semi_axes[k][1] : radius;
  }
  /// Area of particle k [L^2] without what is cut from it, or volume of a sphere on the axis
  /// [L^3], of this radius [L].
  double size_of(int dimension, std::size_t k, double radius) const;
  /// Moment of inertia of particle k in the plane [M L^2] if it is homogeneous and has this mass
  /// [M] and radius [L].
  double homogeneous_inertia_of(std::size_t k, double mass, double radius) const;
};

}  // namespace viscontact::particles
