// Reads, checks and writes a table of force and torque on a sphere in one of its motions beside a
// neighbour (approaching, sliding, rolling or spinning), for several gaps and velocities. Lengths,
// masses and times are in any consistent units. A wrong value, row or file throws Error(kBadInput)
// with file and line. freefem_axi/ writes such tables; fitting/, motions/ and results/ read them.
// Ranges of members below are checked when a file is read, if the comment does not say otherwise. A
// change must keep the names of the columns, which published tables have.
#pragma once

#include <filesystem>

#include "viscontact/common/error.hpp"
#include "viscontact/lubrication/table.hpp"

namespace viscontact::lubrication {

/// Force and torque of the fluid on a body, the sphere or its neighbour. The factors are force and
/// torque in units of viscosity mu, radius r of the sphere and its velocity u0 [L/T] or angular
/// velocity w0 [1/T]: force = -6 pi mu r u0 * force_factor and torque = -8 pi mu r^2 u0 *
/// torque_factor if the sphere moves, force = -6 pi mu r^2 w0 * force_factor and torque = -8 pi mu
/// r^3 w0 * torque_factor if it turns. Factors must be finite. Error estimates are relative: errors
/// of a factor, divided by the sphere's force factor if it moves, and by its torque factor if it
/// turns.
struct Action {
  double force = 0;                    ///< [M L/T^2], any sign
  double torque = 0;                   ///< [M L^2/T^2], any sign
  double force_factor = 0;             ///< [1]; in theory > 1 in an approach to a body at rest
  double torque_factor = 0;            ///< [1], any sign
  double relative_error_estimate = 0;  ///< of the force factor [1], >= 0; 0: not known
  double torque_error_estimate = 0;    ///< of the torque factor [1], >= 0; 0: not known
};

/// The result of one motion at one gap and one velocity. The members of Action are force and torque
/// on the sphere. z is the axis from the neighbour to the sphere, x an axis across it. The force is
/// along z in the approach and along x in sliding and rolling. The torque is taken about the centre
/// of the sphere; it is about y in sliding and rolling, about z in spinning, and 0 in the approach.
/// The force on a sphere that moves, or the torque on one that turns, is opposed to its velocity,
/// unless the neighbour moves as well.
struct MotionRow : Action {
  static constexpr bool kIsOfLine = false;  ///< the head of the table has one radius, not a list
  double gap = 0;                           ///< q [L], > 0
  /// u0 [L/T] of a sphere that moves, < 0 when it approaches; w0 [1/T] of one that turns; not 0.
  double reference_velocity = 0;
  /// Force and torque on the neighbour. Nothing in the approach, and if the neighbour is no sphere.
  std::optional<Action> neighbour{};
  // The ranges of these three numbers are not checked in files.
  double degrees_of_freedom = 0;  ///< unknowns on the finest mesh, >= 0; 0: not known
  double seconds = 0;             ///< wall time of the row [s], >= 0; 0: not known
  /// Observed order of convergence in the mesh size [1]: 4 in theory, 0 if it was not observed.
  double observed_order = 0;
};

/// A table of one of the motions.
using MotionTable = Table<MotionRow>;

/// The columns of a row: gap and velocity, force and torque on the sphere, how the row was
/// computed, and force and torque on the neighbour if `row` has one. The columns contain addresses
/// of members of `row`, which must outlive them.
std::vector<Column> columns_of(const TableHead& head, MotionRow& row);

/// Gives `row` a neighbour, whose numbers can then be read, unless the motion is the approach.
void prepare(const TableHead& head, MotionRow& row);

/// Computes a force or torque that is NaN from its factor, and a factor that is NaN from the force
/// or torque. The neighbour is removed from the row if its force and its force factor are both NaN,
/// or its torque and its torque factor. Throws nothing.
void complete(const TableHead& head, MotionRow& row);

/// Throws Error(kBadInput) with the position `here` if a factor is not finite, or if the neighbour
/// is at rest and the force on a sphere that moves, or the torque on one that turns, is not opposed
/// to its velocity.
void check(const TableHead& head, const MotionRow& row, const FilePosition& here);

/// The largest of the error estimates of sphere and neighbour in the row [1], >= 0. It is 0 if none
/// is known.
double largest_estimate(const MotionRow& row);

/// The units of force and torque per velocity. With the velocity v [L/T] of a sphere that
/// approaches or slides, or the angular velocity v [1/T] of one that rolls or spins, the force is F
/// = -force * v * (force factor) and the torque T = -torque * v * (torque factor).
struct ActionUnits {
  double force = 0;   ///< 6 pi mu r [M/T] or 6 pi mu r^2 [M L/T]
  double torque = 0;  ///< 8 pi mu r^2 [M L/T] or 8 pi mu r^3 [M L^2/T]
};
/// The units for a sphere of radius `radius` [L] in a fluid of viscosity `viscosity` [M/(L T)].
/// Both must be > 0, which is not checked.
ActionUnits action_units(MotionKind motion, double viscosity, double radius);

/// True if the path is a regular file whose head says that it is a table of another motion than the
/// approach. False also if it cannot be opened, and for a pipe, which is not read because it cannot
/// be read a second time. Throws std::filesystem::filesystem_error if the system cannot look up the
/// path.
bool is_motion_table(const std::filesystem::path& path);

/// Reads a table of any motion. A head without a line `# motion` means the approach, unless its
/// line `# viscontact` says "motion table", which is an error. The lines `# viscosity` and `#
/// radius` are required, and the columns gap, reference_velocity and force, and torque if the
/// motion is not the approach. Other columns may be absent. Throws Error(kBadInput) with file and
/// line for a value that is missing or out of range, for a file without rows or with another number
/// of rows than its line `# rows` says, or that cannot be read; and the errors of check().
MotionTable read_motion_table(const std::filesystem::path& path);

/// Reads a table of the approach. Throws as read_motion_table(), and Error(kBadInput) for a table
/// of another motion.
MotionTable read_force_table(const std::filesystem::path& path);

/// The text of the file of a table, which must have at least one row (not checked). Throws nothing.
std::string write_motion_table(const MotionTable& table);

}  // namespace viscontact::lubrication
