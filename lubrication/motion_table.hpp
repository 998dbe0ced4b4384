// The table of force and torque on a sphere in one of its motions (approaching, sliding, rolling,
// spinning), over a grid of gaps and velocities, which the tabulation writes and the fits read.
// Lengths, masses and times are in any consistent units. A change must keep the names of the
// columns, which published tables have.
#pragma once

#include <filesystem>

#include "viscontact/common/error.hpp"
#include "viscontact/lubrication/table.hpp"

namespace viscontact::lubrication {

/// Force and torque of the fluid on a body. The factors are force and torque divided by those of
/// the sphere alone, except for the sign: force = -6 pi mu r u0 * force_factor if the sphere moves
/// at u0 [L/T], -6 pi mu r^2 w0 * force_factor if it turns at w0 [1/T]; torque = -8 pi mu r^2 u0 *
/// torque_factor, or -8 pi mu r^3 w0 * torque_factor. mu is the viscosity, r always the radius of
/// the first sphere. The errors of the factors are relative to the sphere's force factor if it
/// moves, and to its torque factor if it turns.
struct Action {
  double force = 0;                    ///< [M L/T^2]
  double torque = 0;                   ///< [M L^2/T^2]
  double force_factor = 0;             ///< [1]; K of physics.md in a table of the approach
  double torque_factor = 0;            ///< [1]
  double relative_error_estimate = 0;  ///< of the force, >= 0; 0 if the table has none
  double torque_error_estimate = 0;    ///< of the torque, likewise
};

/// The result of one motion at one gap and one velocity. Its own members are the action on the
/// sphere: the force is along z in the approach and along x in sliding and rolling, the torque
/// about y and the centre of the sphere, or about z for spinning. The neighbour is below. In the
/// approach the torque is 0. The force (torque) of a sphere that moves (turns) is opposed to its
/// velocity, unless the neighbour moves and pulls it along.
struct MotionRow : Action {
  static constexpr bool kIsOfLine = false;  ///< its head has one radius
  double gap = 0;                           ///< q [L], > 0
  /// u0 [L/T] of a sphere that moves, < 0 when it approaches; w0 [1/T] of one that turns; not 0.
  double reference_velocity = 0;
  /// Nothing in the approach, and if the neighbour is no sphere.
  std::optional<Action> neighbour{};
  double degrees_of_freedom = 0;  ///< unknowns on the finest mesh
  double seconds = 0;             ///< wall time of the row [s]
  /// Observed order of convergence in the mesh size [1]: 4 in theory, 0 if it was not observed.
  double observed_order = 0;
};

/// A table of one of the motions.
using MotionTable = Table<MotionRow>;

/// The columns of a row: gap and velocity, the action on the sphere, how the row was computed, and
/// the action on the neighbour if it is a sphere.
std::vector<Column> columns_of(const TableHead& head, MotionRow& row);

/// Adds a neighbour if tables of the motion may have one.
void prepare(const TableHead& head, MotionRow& row);

/// Computes forces and torques or factors that are not a number yet from the others. A neighbour
/// without factors is removed.
void complete(const TableHead& head, MotionRow& row);

/// Throws Error(kBadInput) if the force (torque) of a sphere that moves (turns) is not opposed to
/// its velocity while the neighbour is at rest.
void check(const TableHead& head, const MotionRow& row, const FilePosition& here);

/// The largest error estimate of the row [1].
double largest_estimate(const MotionRow& row);

/// The units of force and torque of a motion: F = -force * v * (force factor) and T = -torque * v *
/// (torque factor), with the velocity v [L/T] of a sphere that moves or the angular velocity v
/// [1/T] of one that turns.
struct ActionUnits {
  double force = 0;   ///< 6 pi mu r [M/T] or 6 pi mu r^2 [M L/T]
  double torque = 0;  ///< 8 pi mu r^2 [M L/T] or 8 pi mu r^3 [M L^2/T]
};
/// The units for a sphere of radius `radius` [L] > 0 in a fluid of viscosity `viscosity` [M/(L T)].
ActionUnits action_units(MotionKind motion, double viscosity, double radius);

/// True if the path is a regular file whose head says that it is a table of another motion than the
/// approach. A pipe is not read, because it cannot be read a second time.
bool is_motion_table(const std::filesystem::path& path);

/// Reads a table of any motion; one whose head names no motion is of the approach. The columns gap,
/// reference_velocity and force are required, and torque if the motion is not the approach; the
/// others may be absent in a table that Viscontact did not write. Throws the errors of read_table()
/// (table_codec.hpp) and check().
MotionTable read_motion_table(const std::filesystem::path& path);

/// As read_motion_table(), but throws Error(kBadInput) for another motion than the approach.
MotionTable read_force_table(const std::filesystem::path& path);

/// The text of the file.
std::string write_motion_table(const MotionTable& table);

}  // namespace viscontact::lubrication
