// Tables of force and torque on a sphere in one motion beside a neighbour (docs/file-formats.md).
#pragma once

#include <filesystem>

#include "viscontact/common/error.hpp"
#include "viscontact/lubrication/table.hpp"

namespace viscontact::lubrication {

/// Force and torque of the fluid on a body, the sphere or its neighbour, in any consistent units.
/// The factors are force and torque in units of viscosity mu, radius r of the sphere and its
/// velocity u0 [L/T] or angular velocity w0 [1/T]: force = -6 pi mu r u0 * force_factor and torque
/// = -8 pi mu r^2 u0 * torque_factor if the sphere moves, force = -6 pi mu r^2 w0 * force_factor
/// and torque = -8 pi mu r^3 w0 * torque_factor if it turns. Error estimates are those of a factor,
/// divided by the sphere's force factor if it moves, and by its torque factor if it turns.
struct Action {
  double force = 0;          ///< [M L/T^2]
  double torque = 0;         ///< [M L^2/T^2]
  double force_factor = 0;   ///< [1], finite; in theory > 1 in an approach to a body at rest
  double torque_factor = 0;  ///< [1], finite
  double relative_error_estimate = 0;  ///< of the force factor [1], >= 0; 0: not known
  double torque_error_estimate = 0;    ///< of the torque factor [1], >= 0; 0: not known
};

/// The result of one motion at one gap and one velocity; the members of Action are force and torque
/// on the sphere. z is the axis from the neighbour to the sphere, x an axis across it. The force is
/// along z in the approach and along x in sliding and rolling. The torque is taken about the centre
/// of the sphere; it is about y in sliding and rolling, about z in spinning, and 0 in the approach.
/// The force on a sphere that moves, or the torque on one that turns, is opposed to its velocity,
/// unless the neighbour moves as well.
struct MotionRow : Action {
  static constexpr bool kIsOfLine = false;
  double gap = 0;  ///< q [L], > 0
  /// u0 [L/T] of a sphere that moves, < 0 when it approaches; w0 [1/T] of one that turns; not 0.
  double reference_velocity = 0;
  /// The action on the neighbour. Nothing in the approach, and if the neighbour is no sphere.
  std::optional<Action> neighbour{};
  // Readers of files accept any finite values of these three numbers.
  double degrees_of_freedom = 0;  ///< unknowns on the finest mesh, >= 0; 0: not known
  double seconds = 0;             ///< wall time of the row [s], >= 0; 0: not known
  /// The order in the mesh size [1]: 4 in theory, 0 if it was not observed.
  double observed_order = 0;
};

using MotionTable = Table<MotionRow>;

/// The columns of a row; those of the neighbour only if `row` has one.
std::vector<Column> columns_of(const TableHead& head, MotionRow& row);

/// Gives `row` a neighbour, unless the motion is the approach.
void prepare(const TableHead& head, MotionRow& row);

/// Computes a force or torque that is NaN from its factor, and a factor that is NaN from the force
/// or torque. The neighbour is removed from the row if its force and its force factor are both NaN,
/// or its torque and its torque factor. Viscosity and radius of the head must be > 0.
void complete(const TableHead& head, MotionRow& row);

/// Throws Error(kBadInput) if a factor is not finite, or if the neighbour is at rest and the force
/// on a sphere that moves, or the torque on one that turns, is not opposed to its velocity.
void check(const TableHead& head, const MotionRow& row, const FilePosition& here);

/// The largest error estimate of sphere and neighbour [1]; 0 if none is known.
double largest_estimate(const MotionRow& row);

/// The units of force and torque per velocity v [L/T] of a sphere that approaches or slides, or per
/// angular velocity v [1/T] of one that rolls or spins: force F = -force * v * (force factor),
/// torque T = -torque * v * (torque factor).
struct ActionUnits {
  double force = 0;   ///< 6 pi mu r [M/T] or 6 pi mu r^2 [M L/T]
  double torque = 0;  ///< 8 pi mu r^2 [M L/T] or 8 pi mu r^3 [M L^2/T]
};
/// Viscosity [M/(L T)] and radius [L] of the sphere must be > 0.
ActionUnits action_units(MotionKind motion, double viscosity, double radius);

/// True if the path is a regular file whose head says that it is a table of another motion than the
/// approach. False also if it cannot be opened, and for a pipe, which cannot be read a second time.
/// Throws std::filesystem::filesystem_error if the system cannot look up the path.
bool is_motion_table(const std::filesystem::path& path);

/// Reads a table of any motion. A head without a line `# motion` means the approach, unless its
/// line `# viscontact` says "motion table". The columns gap, reference_velocity and force are
/// required, and torque if the motion is not the approach. Throws the errors of read_table().
MotionTable read_motion_table(const std::filesystem::path& path);

/// Reads a table of the approach. Throws Error(kBadInput) for a table of another motion, too.
MotionTable read_force_table(const std::filesystem::path& path);

/// The text of the file. The table must have at least one row.
std::string write_motion_table(const MotionTable& table);

}  // namespace viscontact::lubrication
