// The inputs of a table of the lubrication force F_lub(q, u0) on a sphere, and the solution of one
// of its rows by FreeFEM, docs/physics.md (2.1) to (2.3), in any consistent units.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/geometry.hpp"
#include "viscontact/freefem_axi/journal/freefem.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/lubrication/table.hpp"

namespace viscontact::freefem_axi {

/// A closed no-slip cylinder on the axis [L].
struct Container {
  double radius = 0;  ///< > 0
  double height = 0;  ///< distance of its ends, > 0
};

/// The inputs of a table over a grid of gaps and velocities. The sphere and its neighbour, the body
/// that it approaches, have a common axis of symmetry. The scripts of FreeFEM refuse wrong numbers.
struct Tabulation {
  double viscosity = 0;      ///< mu [M/(L T)], > 0
  double radius = 0;         ///< r [L], > 0
  std::vector<double> gaps;  ///< q [L], all > 0, at least one
  /// u0 [L/T] for motions in which the sphere moves, w0 [1/T] for those in which it turns; at least
  /// one, none of them 0.
  std::vector<double> reference_velocities;
  /// The container must be larger than Geometry::required_space for all gaps. Nothing means that
  /// the fluid is unbounded, or that the neighbour encloses it.
  std::optional<Container> container;
  double relative_accuracy = 0;  ///< largest relative error estimate of a row [1], in (0, 1)
  std::string geometry{default_geometry().name};  ///< name of a Geometry
  std::vector<double> geometry_parameters;        ///< in the order of Geometry::parameters
  /// The motions that are tabulated, each once.
  std::vector<lubrication::MotionKind> motions = {lubrication::MotionKind::kApproach};
};

/// In words for the head of a table: "closed cylinder, radius 40, height 80", "unbounded", or
/// "none" if the neighbour encloses the fluid. The hash of a table depends on these words. This
/// function and the next four throw Error(kBadInput) for an unknown geometry. geometry_in_words()
/// and row_arguments() throw std::out_of_range if geometry_parameters are missing.
std::string container_in_words(const Tabulation& tabulation);

/// In words for the head and the hash of a table: "sphere, radius 2, velocity_ratio 0".
std::string geometry_in_words(const Tabulation& tabulation);

/// The neighbour's velocity (approach, slide) or angular velocity (roll, spin) over that of the
/// sphere [1], of either sign; 0 if the neighbour is always at rest.
double neighbour_ratio(const Tabulation& tabulation, lubrication::MotionKind motion);

/// The coefficient k [M L/T] > 0 of lubrication theory in the resistance -F_lub/u0 = k/q + ... near
/// contact. Nothing if k is not known or too large for a double, or if the neighbour moves away at
/// least as fast as the sphere follows, so that k <= 0.
std::optional<double> leading_coefficient(const Tabulation& tabulation);

/// The arguments of the FreeFEM script of the geometry: "-name" and "value" in turn.
std::vector<std::string> row_arguments(const Tabulation& tabulation, double gap,
                                       double reference_velocity);

/// The units of viscosity and speed in which FreeFEM writes the force: in the units of the case the
/// force is FreeFEM's number times both members.
struct SolveScale {
  double viscosity = 1;  ///< [M/(L T)], > 0
  double speed = 1;      ///< [L/T], > 0
};

/// Both units are 1 if viscosity and |velocity| are in [1e-9, 1e9]. Otherwise they are viscosity
/// and |velocity|: FreeFEM computes with 1 for both and cannot leave the range of a double.
SolveScale solve_scale(const Tabulation& tabulation, double reference_velocity);

/// Solves the approach at the gap `gap` [L] > 0 and the velocity `reference_velocity` [L/T], not 0,
/// in a FreeFEM process. Returns the row with the force [M L/T^2] and its relative error estimate
/// [1], which may be above relative_accuracy. `further_arguments` are added to the command line of
/// FreeFEM. If `output` is not null, it is set to everything that FreeFEM printed, in the units of
/// solve_scale(). Throws Error(kExternalProgram) with the error or the last lines that FreeFEM
/// printed if FreeFEM fails, also because its scripts refuse a number, or exceeds its time limit,
/// Error(kBadInput) if the force is outside the range of a double or the geometry is not known,
/// std::out_of_range if geometry_parameters are missing, and Error(kInterrupted) at a stop.
lubrication::MotionRow solve_row(const FreeFem& freefem, const Tabulation& tabulation, double gap,
                                 double reference_velocity,
                                 const std::vector<std::string>& further_arguments = {},
                                 std::string* output = nullptr);

}  // namespace viscontact::freefem_axi
