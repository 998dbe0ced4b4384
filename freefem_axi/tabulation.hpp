// What is to be tabulated, and one row of it.
#pragma once

#include <string>
#include <vector>

#include "fitting/force_table.hpp"
#include "freefem_axi/freefem.hpp"

namespace viscontact {

/// F_lub over a grid of gaps and velocities, for a sphere on the axis of a closed cylinder. Lengths
/// in any one unit.
struct Tabulation {
  double viscosity = 0;                      ///< mu [M/(L T)], > 0
  double radius = 0;                         ///< r [L], > 0
  std::vector<double> gaps;                  ///< q [L], > 0
  std::vector<double> reference_velocities;  ///< u0 [L/T], none 0
  double container_radius = 0;               ///< [L], > r
  double container_height = 0;               ///< [L], > q + 2 r for every gap
  double relative_accuracy = 0;              ///< asked of every row, in (0, 1)
  std::string geometry = "plane";            ///< name of a Geometry
};

/// What the sphere approaches. A geometry is added by writing its script and its row in
/// tabulation.cpp.
struct Geometry {
  std::string_view name;    ///< what users type
  std::string_view script;  ///< in this folder
};

/// The geometry of that name. Throws Error(kBadInput) that lists the names there are.
const Geometry& find_geometry(std::string_view name);

/// SHA-256 of all that the force depends on: the table made from equal inputs has an equal hash.
std::string tabulation_hash(const Tabulation& tabulation);

/// Solves one (q, u0) in a FreeFEM process. Throws Error(kExternalProgram) with FreeFEM's last
/// lines if it fails.
ForceTableRow solve_row(const FreeFem& freefem, const Tabulation& tabulation, double gap,
                        double reference_velocity);

}  // namespace viscontact
