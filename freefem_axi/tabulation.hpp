// Describes the inputs of a table of the lubrication force F_lub(q, u0) on a sphere at the gap q
// and the velocity u0, and solves one of its rows by FreeFEM (docs/physics.md, section 2). Lengths,
// masses and times are in any consistent units. An unknown geometry throws Error(kBadInput). Ranges
// are not checked here: the scripts of FreeFEM refuse wrong numbers, which throws
// Error(kExternalProgram). motion_row.hpp, row_picture.hpp, case_file/, rolling/, bench/ and the
// command `doctor` use this file. A change must keep the texts of geometry_in_words() and
// container_in_words(), because the heads of tables contain them and their hash decides whether a
// table is up to date.
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
  double radius = 0;  ///< of the cylinder [L], > 0
  double height = 0;  ///< distance of its ends [L], > 0
};

/// The inputs of a table of F_lub over a grid of gaps and velocities. The sphere and its neighbour,
/// the body that it approaches, have a common axis of symmetry.
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

/// The container in words for the head of a table: "closed cylinder, radius 40, height 80",
/// "unbounded", or "none" if the neighbour encloses the fluid. This function and the next four
/// throw Error(kBadInput) if there is no geometry with the name tabulation.geometry. The
/// geometry_parameters must be complete: if some are missing, geometry_in_words() and
/// row_arguments() throw std::out_of_range, and neighbour_ratio() and leading_coefficient() read
/// beyond the array.
std::string container_in_words(const Tabulation& tabulation);

/// The neighbour in words for the head of a table: "sphere, radius 2, velocity_ratio 0".
std::string geometry_in_words(const Tabulation& tabulation);

/// The neighbour's velocity (approach, slide) or angular velocity (roll, spin) over that of the
/// sphere [1], of either sign; 0 if the neighbour is always at rest.
double neighbour_ratio(const Tabulation& tabulation, lubrication::MotionKind motion);

/// The coefficient k [M L/T] > 0 of lubrication theory in the resistance -F_lub/u0 = k/q + ... near
/// contact. Nothing if k is not known or too large for a double, or if the neighbour moves away at
/// least as fast as the sphere follows, so that k <= 0.
std::optional<double> leading_coefficient(const Tabulation& tabulation);

/// The arguments of the FreeFEM script of the geometry for the row at the gap q = `gap` [L] and the
/// velocity u0 = `reference_velocity` [L/T]: "-name" and "value" in turn.
std::vector<std::string> row_arguments(const Tabulation& tabulation, double gap,
                                       double reference_velocity);

/// The units of viscosity and speed in which FreeFEM writes the force. The force is proportional to
/// both, so in the units of the case it is FreeFEM's number times both members.
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
/// printed if FreeFEM fails or exceeds its time limit, Error(kBadInput) if the force is outside the
/// range of a double or the geometry is not known, std::out_of_range if geometry_parameters are
/// missing, and Error(kInterrupted) if freefem.stop requests a stop.
lubrication::MotionRow solve_row(const FreeFem& freefem, const Tabulation& tabulation, double gap,
                                 double reference_velocity,
                                 const std::vector<std::string>& further_arguments = {},
                                 std::string* output = nullptr);

}  // namespace viscontact::freefem_axi
