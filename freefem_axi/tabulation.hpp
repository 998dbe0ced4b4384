// The tabulation of the lubrication force F_lub(q, u0) (physics.md, section 2): its inputs, and the
// solution of one row, at the gap q and the velocity u0 of the sphere. Case files,
// motion_table_plan.hpp, row_picture.hpp and `doctor` use it. Lengths, masses and times are in any
// consistent units.
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

/// The inputs of a table of F_lub over a grid of gaps and velocities, for a sphere and its
/// neighbour on the axis.
struct Tabulation {
  double viscosity = 0;                      ///< mu [M/(L T)], > 0
  double radius = 0;                         ///< r [L], > 0
  std::vector<double> gaps;                  ///< q [L], all > 0
  std::vector<double> reference_velocities;  ///< u0 [L/T], none of them 0
  /// Larger than the RequiredSpace of the geometry. Nothing: the fluid is unbounded, or the
  /// geometry takes no container.
  std::optional<Container> container;
  double relative_accuracy = 0;                   ///< error estimate asked of a row [1], in (0, 1)
  std::string geometry{default_geometry().name};  ///< name of a Geometry
  std::vector<double> geometry_parameters;        ///< in the order of Geometry::parameters
  /// The motions that are tabulated, each once.
  std::vector<lubrication::MotionKind> motions = {lubrication::MotionKind::kApproach};
};

/// The container in words for the header of a table: "closed cylinder, radius 40, height 80",
/// "unbounded", or "none" if the geometry takes no container.
std::string container_in_words(const Tabulation& tabulation);

/// The geometry in words for the header of a table: "sphere, radius 2, velocity_ratio 0".
std::string geometry_in_words(const Tabulation& tabulation);

/// The neighbour's velocity (approach, slide) or angular velocity (roll, spin) over that of the
/// sphere [1], from the parameters of the geometry.
double neighbour_ratio(const Tabulation& tabulation, lubrication::MotionKind motion);

/// Theory's coefficient k [M L/T] of the resistance -F_lub/u0 = k/q near contact. Nothing if it is
/// not known or too large for a double.
std::optional<double> leading_coefficient(const Tabulation& tabulation);

/// The arguments of the geometry's script for one row (q, u0).
std::vector<std::string> row_arguments(const Tabulation& tabulation, double gap,
                                       double reference_velocity);

/// The units of viscosity and speed in which FreeFEM writes the force. Because Stokes flow is
/// linear in both, the force is that in these units times both units.
struct SolveScale {
  double viscosity = 1;  ///< [M/(L T)], > 0
  double speed = 1;      ///< [L/T], > 0
};

/// Returns 1 for both if viscosity and velocity are within 1e-9..1e9; otherwise the viscosity and
/// the absolute velocity, so that no product of theirs is outside the range of a double.
SolveScale solve_scale(const Tabulation& tabulation, double reference_velocity);

/// Solves one row (q, u0) in a FreeFEM process. `further_arguments` are added to its command line.
/// If `output` is not null, it is set to everything that FreeFEM printed, in the units of
/// solve_scale(). Throws Error(kExternalProgram) with the last lines of FreeFEM if it fails or
/// exceeds its time limit, and Error(kBadInput) if the force is outside the range of a double.
lubrication::MotionRow solve_row(const FreeFem& freefem, const Tabulation& tabulation, double gap,
                                 double reference_velocity,
                                 const std::vector<std::string>& further_arguments = {},
                                 std::string* output = nullptr);

}  // namespace viscontact::freefem_axi
