// What is to be tabulated, and one row of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/freefem.hpp"
#include "viscontact/freefem_axi/geometry.hpp"
#include "viscontact/lubrication/force_table.hpp"

namespace viscontact {

/// A closed no-slip cylinder on the axis [L].
struct Container {
  double radius = 0, height = 0;
};

/// F_lub over a grid of gaps and velocities, for a sphere and its neighbour on the axis. Lengths in any one unit.
struct Tabulation {
  double viscosity = 0;                      ///< mu [M/(L T)], > 0
  double radius = 0;                         ///< r [L], > 0
  std::vector<double> gaps;                  ///< q [L], > 0
  std::vector<double> reference_velocities;  ///< u0 [L/T], none 0
  std::optional<Container>
      container;  ///< larger than the geometry's RequiredSpace; none: unbounded fluid, or the geometry is its own
  double relative_accuracy = 0;             ///< asked of every row, in (0, 1)
  std::string geometry = "plane";           ///< name of a Geometry
  std::vector<double> geometry_parameters;  ///< in the order of Geometry::parameters
};

/// In words, for a table's header: "closed cylinder, radius 40, height 80", "unbounded", or "none" where the geometry is its own.
std::string container_in_words(const Tabulation& tabulation);

/// In words, for a table's header: "sphere, radius 2, velocity_ratio 0".
std::string geometry_in_words(const Tabulation& tabulation);

/// True if the geometry's parameters say that what the sphere approaches moves itself.
bool neighbour_moves(const Tabulation& tabulation);

/// Theory's coefficient k of R ~ k/q near contact [M L/T]; nothing where it is not known
/// or beyond the range of a double.
std::optional<double> leading_coefficient(const Tabulation& tabulation);

/// SHA-256 of all that the force depends on: the table made from equal inputs has an equal hash.
std::string tabulation_hash(const Tabulation& tabulation);

/// The flags that the geometry's script is given for one (q, u0).
std::vector<std::string> row_arguments(const Tabulation& tabulation, double gap,
                                       double reference_velocity);

/// What the results of a solve are multiplied with. Stokes flow is linear in the viscosity and in
/// the velocity, so that both may be replaced by 1 where FreeFEM's arithmetic would fail.
struct SolveScale {
  double viscosity = 1;  ///< [M/(L T)], > 0
  double speed = 1;      ///< [L/T], > 0
};

/// 1 for an ordinary viscosity and velocity, whose rows are solved as they are; else the viscosity
/// and the absolute velocity themselves. Beyond 1e-12 and 1e20 the solver's penalty, 1e30, would
/// give wrong forces without a word.
SolveScale solve_scale(const Tabulation& tabulation, double reference_velocity);

/// Solves one (q, u0) in a FreeFEM process, which is given `further_arguments` too; all that it wrote goes to `output`, if that is not
/// null: in units of solve_scale. Throws Error(kExternalProgram) with FreeFEM's last lines if it fails
/// or takes longer than its limit, Error(kBadInput) if the force is beyond the range of a double.
ForceTableRow solve_row(const FreeFem& freefem, const Tabulation& tabulation, double gap,
                        double reference_velocity,
                        const std::vector<std::string>& further_arguments = {},
                        std::string* output = nullptr);

}  // namespace viscontact
