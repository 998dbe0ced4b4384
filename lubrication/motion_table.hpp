// The table of force and torque on a sphere in one of its motions beside a neighbour (approaching,
// sliding, rolling, spinning), for several gaps and velocities. Lengths, masses and times are in
// any consistent units. A wrong value, row or file throws Error(kBadInput) with file and line. Used
// by freefem_axi/ (writes), fitting/ and motions/ (read), and results/. A change must keep the
// names of the columns, which published tables have.
#pragma once

#include <filesystem>

#include "viscontact/common/error.hpp"
#include "viscontact/lubrication/table.hpp"

namespace viscontact::lubrication {

/// Force and torque of the fluid on a body, the sphere or its neighbour. The factors are force and
/// torque in units of viscosity mu, radius r of the sphere and its velocity u0 [L/T] or angular
/// velocity w0 [1/T]: force = -6 pi mu r u0 * force_factor and torque = -8 pi mu r^2 u0 *
/// torque_factor if the sphere moves, force = -6 pi mu r^2 w0 * force_factor and torque =
/// -8 pi mu r^3 w0 * torque_factor if it turns. The error estimates are in units of the sphere's
/// force factor if it moves, and of its torque factor if it turns.
struct Action {
  double force = 0;                    ///< [M L/T^2]
  double torque = 0;                   ///< [M L^2/T^2]
  double force_factor = 0;             ///< [1]; > 1 for the approach to a body at rest
  double torque_factor = 0;            ///< [1]
  double relative_error_estimate = 0;  ///< of the force factor [1], >= 0; 0: not known
  double torque_error_estimate = 0;    ///< of the torque factor [1], >= 0; 0: not known
};

/// The result of one motion at one gap and one velocity. The members of Action are force and torque
/// on the sphere. z is the axis from the neighbour to the sphere, x an axis across it. The force is
/// along z in the approach and along x in sliding and rolling; the torque is about y and the centre
/// of the sphere, in spinning about z, and 0 in the approach. The force on a sphere that moves, or
/// the torque on one that turns, is opposed to its velocity, unless the neighbour moves as well.
struct MotionRow : Action {
  static constexpr bool kIsOfLine = false;  ///< the head of the table has one radius, not a list
  double gap = 0;                           ///< q [L], > 0
  /// u0 [L/T] of a sphere that moves, < 0 when it approaches; w0 [1/T] of one that turns; not 0.
  double reference_velocity = 0;
  /// Force and torque on the neighbour. Nothing in the approach, and if the neighbour is no sphere.
  std::optional<Action> neighbour{};
  double degrees_of_freedom = 0;  ///< unknowns on the finest mesh, >= 0; 0: not known
  double seconds = 0;             ///< wall time of the row [s], >= 0; 0: not known
  /// Observed order of convergence in the mesh size [1]: 4 in theory, 0 if it was not observed.
  double observed_order = 0;
};

/// A table of one of the motions.
using MotionTable = Table<MotionRow>;

/// The columns of a row: gap and velocity, force and torque on the sphere, how the row was
/// computed, and force and torque on the neighbour if `row` has one. They point into `row`.
std::vector<Column> columns_of(const TableHead& head, MotionRow& row);

/// Adds a neighbour unless the motion is the approach.
void prepare(const TableHead& head, MotionRow& row);

/// Computes a force or torque that is NaN from its factor, and a factor that is NaN from the force
/// or torque. If factors of the neighbour are still NaN, the neighbour is removed. Throws nothing.
void complete(const TableHead& head, MotionRow& row);

/// Throws Error(kBadInput) with the position `here` if a factor is not finite, or if the neighbour
/// is at rest and the force (torque, if the sphere turns) is not opposed to the velocity.
void check(const TableHead& head, const MotionRow& row, const FilePosition& here);

/// The largest error estimate of sphere and neighbour in the row [1], >= 0; 0: none is known.
double largest_estimate(const MotionRow& row);

/// Force and torque F and T over factors and velocity v [L/T] (approach, slide) or angular velocity
/// v [1/T] (roll, spin): F = -force * v * (force factor), T = -torque * v * (torque factor).
struct ActionUnits {
  double force = 0;   ///< 6 pi mu r [M/T] or 6 pi mu r^2 [M L/T]
  double torque = 0;  ///< 8 pi mu r^2 [M L/T] or 8 pi mu r^3 [M L^2/T]
};
/// These numbers for a sphere of radius `radius` [L] > 0 and a fluid of viscosity `viscosity`
/// [M/(L T)] > 0 (not checked).
ActionUnits action_units(MotionKind motion, double viscosity, double radius);

/// True if the path is a regular file whose head says that it is a table of another motion than the
/// approach; false also if it cannot be opened. A pipe is not read, because it cannot be read a
/// second time.
bool is_motion_table(const std::filesystem::path& path);

/// Reads a table of any motion; a head that names no motion means the approach. The columns gap,
/// reference_velocity and force are required, and torque if the motion is not the approach; the
/// others may be absent in a table that Viscontact did not write. Throws Error(kBadInput) with file
/// and line for a value that is missing or out of range, for a file without rows or with another
/// number of rows than its head says, or that cannot be read; and the errors of check().
MotionTable read_motion_table(const std::filesystem::path& path);

/// As read_motion_table(), but throws Error(kBadInput) for another motion than the approach.
MotionTable read_force_table(const std::filesystem::path& path);

/// The text of the file. `table` has at least one row (not checked).
std::string write_motion_table(const MotionTable& table);

}  // namespace viscontact::lubrication
