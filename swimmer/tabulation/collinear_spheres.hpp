// Spheres on a line in a viscous fluid: the inputs of a table of their resistance matrices, and its
// computation by FreeFEM (docs/physics.md, section 7).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal/table_plan.hpp"
#include "viscontact/swimmer/resistance/resistance_table.hpp"

namespace viscontact::swimmer {

/// A cylinder without slip whose axis is the line of the spheres.
struct Tube {
  double radius = 0;  ///< [L], larger than the radii of all spheres
  /// Distance between the closed ends of the tube [L], larger than the length of the longest line
  /// of spheres, which is in the middle. Nothing: the tube is so long that its ends do not matter.
  std::optional<double> height{};
};

struct CollinearSpheres {
  double viscosity = 0;        ///< mu [M/(L T)], > 0
  std::vector<double> radii;   ///< radii along the line [L], 2 to 10 of them, > 0
  std::optional<Tube> tube{};  ///< nothing: unbounded fluid
  /// Meshes are refined until the estimated relative error of each entry of R is at most this [1],
  /// in (0, 1).
  double relative_accuracy = 0;
};

/// What surrounds the spheres, in words: "unbounded", "tube of radius 3", or "closed cylinder,
/// radius 3, height 40". lubrication/scaling.hpp finds the lengths in these words.
std::string surroundings_in_words(const CollinearSpheres& spheres);

/// Computes the row of the table at these gaps [L] between neighbours. Throws
/// Error(kExternalProgram) with the last lines of FreeFEM's output if FreeFEM fails, also because
/// an argument is out of range, or exceeds its time limit (freefem.row_limit); Error(kInterrupted)
/// if freefem.stop requests a stop.
ResistanceRow solve_resistance(const freefem_axi::FreeFem& freefem, const CollinearSpheres& spheres,
                               const std::vector<double>& gaps);

/// The plan of the table of all combinations of gaps. grid[k] has the rising gaps between spheres k
/// and k + 1 [L]. The point of a row (TablePlan) is the list of its gaps. If the radii and `grid`
/// are the same in reverse order, only one of each two mirrored rows of the table is computed, and
/// the other one is its reflection. TablePlan::solve throws the errors of solve_resistance().
freefem_axi::TablePlan resistance_table_plan(const CollinearSpheres& spheres,
                                             const std::vector<std::vector<double>>& grid);

}  // namespace viscontact::swimmer
