// One row of the motions across the axis or around it, solved by FreeFEM (physics.md, section 2),
// for motion_table_plan.hpp and row_picture.hpp. Lengths, masses and times are in the units of the
// case. A change must agree with scripts/row.idp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/tabulation.hpp"
#include "viscontact/lubrication/motion_kind.hpp"

namespace viscontact::freefem_axi {

/// The motions that are solved together, because they share a matrix: sliding and rolling, which is
/// azimuthal mode 1, or spinning, which is swirl.
enum class MotionGroup { kAcross = 1, kAround = 2 };

/// The motions of the group, in the order of the solutions of scripts/row.idp.
std::vector<lubrication::MotionKind> motions_of(MotionGroup group);

/// Factors of force and torque of one motion at one gap [1], which do not depend on viscosity and
/// velocity.
struct MotionResult {
  /// On the sphere.
  lubrication::ActionFactors sphere;
  std::optional<lubrication::ActionFactors> neighbour;  ///< if the neighbour is a sphere
  /// Observed order of convergence in the mesh size [1].
  double observed_order = 0;
};

/// The results of a group of motions at one gap.
struct MotionRow {
  std::vector<MotionResult> results;  ///< in the order of motions_of()
  double degrees_of_freedom = 0;      ///< number of unknowns on the finest mesh
  double seconds = 0;                 ///< wall time of the row [s]
};

/// True if the neighbour is a sphere, on which there are force and torque, too.
bool neighbour_is_sphere(const Tabulation& tabulation);

/// Solves the motions of a group at one gap in a FreeFEM process. Throws Error(kExternalProgram)
/// with the last lines of FreeFEM if it fails or exceeds its time limit, or if the torque of
/// sliding and the force of rolling differ by more than their error estimates allow: the resistance
/// matrix is symmetric (Lorentz 1896), also if the neighbour moves in proportion to the sphere.
/// `further_arguments` are added to the command line of FreeFEM. If `output` is not null, it is set
/// to everything that FreeFEM printed.
MotionRow solve_motions(const FreeFem& freefem, const Tabulation& tabulation, MotionGroup group,
                        double gap, const std::vector<std::string>& further_arguments = {},
                        std::string* output = nullptr);

}  // namespace viscontact::freefem_axi
