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
/// and torque = -8 pi mu r^3 w0 * torque_factor if it turns, and if it feels the rate of strain w0.
/// The stresslet is +(20/3) pi mu r^2 u0 * stresslet_factor, or r^3 w0 in place of r^2 u0, and so
/// is the trace. Error estimates are those of a factor, divided by the sphere's force factor if it
/// moves, by its torque factor if it turns, and by its stresslet factor if it feels a strain.
struct Action {
  double force = 0;          ///< [M L/T^2]
  double torque = 0;         ///< [M L^2/T^2]
  double force_factor = 0;   ///< [1], finite; in theory > 1 in an approach to a body at rest
  double torque_factor = 0;  ///< [1], finite
  double relative_error_estimate = 0;  ///< of the force factor [1], >= 0; 0: not known
  double torque_error_estimate = 0;    ///< of the torque factor [1], >= 0; 0: not known
  /// Batchelor's stresslet S without trace, [M L^2/T^2]: S_zz (approach, axial strain), S_xz
  /// (slide, roll, shear strain), S_xx = -S_yy (twofold strain); 0 in spinning.
  double stresslet = 0, stresslet_factor = 0, stresslet_error_estimate = 0;
  /// Of the moment of the traction about the centre, [M L^2/T^2]; 0 unless the flow is axial.
  double trace = 0, trace_factor = 0, trace_error_estimate = 0;
};

/// The result of one motion at one gap and one velocity; the members of Action are force and torque
/// on the sphere. z is the axis from the neighbour to the sphere, x an axis across it. The force is
/// along z in axial flows and along x in sliding, rolling and the shear strain. The torque is taken
/// about the centre of the body; it is about y in sliding, rolling and the shear strain, about z in
/// spinning, and 0 otherwise. The force on a sphere that moves, or the torque on one that turns, is
/// opposed to its velocity, unless the neighbour moves as well; the stresslet of a sphere in a
/// strain has the sign of the rate.
struct MotionRow : Action {
  static constexpr bool kIsOfLine = false;
  double gap = 0;  ///< q [L], > 0
  /// u0 [L/T] of a sphere that moves, < 0 when it approaches; w0 [1/T] of one that turns; the rate
  /// of a strain [1/T] (MotionKind); not 0.
  double reference_velocity = 0;
  /// The action on the neighbour. Nothing if the neighbour is no sphere, and in an approach that
  /// was tabulated without strains.
  std::optional<Action> neighbour{};
  /// Whether the row has stresslets: it was tabulated with strains.
  bool has_stresslets = false;
  /// Whether it has traces: the flow is axial, and the fluid unbounded, because a container leaves
  /// a constant of the pressure open.
  bool has_traces = false;
  /// With stresslets: the largest error estimate of all loads i by all motions and strains j that
  /// FreeFEM solved with this one, over sqrt(R_ii R_jj) [1]; R_ii is the load i of the motion or
  /// strain i of the same body, less the ambient stress.
  double largest_error_estimate = 0;
  // Readers of files accept any finite values of these three numbers.
  double degrees_of_freedom = 0;  ///< unknowns on the finest mesh, >= 0; 0: not known
  double seconds = 0;             ///< wall time of the row [s], >= 0; 0: not known
  /// The order in the mesh size [1]: 4 in theory, 0 if it was not observed.
  double observed_order = 0;
};

using MotionTable = Table<MotionRow>;

/// The columns of a row; those of the neighbour only if `row` has one.
std::vector<Column> columns_of(const TableHead& head, MotionRow& row);

/// Gives `row` a neighbour, stresslets, and traces if the flow is axial.
void prepare(const TableHead& head, MotionRow& row);

/// Computes a force or torque that is NaN from its factor, and a factor that is NaN from the force
/// or torque. The neighbour is removed from the row if its force and its force factor are both NaN,
/// or its torque and its torque factor; stresslets or traces of both bodies, if a stresslet or
/// trace and its factor are NaN; a table of spinning has stresslets if it has
/// largest_error_estimate. Viscosity and radius of the head must be > 0.
void complete(const TableHead& head, MotionRow& row);

/// Throws Error(kBadInput) if a factor is not finite, or if the neighbour is at rest and the force
/// on a sphere that moves, or the torque on one that turns, is not opposed to its velocity, or if
/// the stresslet of a sphere in a strain has not the sign of the rate.
void check(const TableHead& head, const MotionRow& row, const FilePosition& here);

/// With stresslets row.largest_error_estimate, else the largest error estimate of sphere and
/// neighbour [1]; 0 if none is known.
double largest_estimate(const MotionRow& row);

/// The units of force and torque per velocity v [L/T] of a sphere that approaches or slides, or per
/// angular velocity or rate of strain v [1/T]: force F = -force * v * (force factor), torque T =
/// -torque * v * (torque factor), stresslet S = +stresslet * v * (stresslet factor).
struct ActionUnits {
  double force = 0;   ///< 6 pi mu r [M/T] or 6 pi mu r^2 [M L/T]
  double torque = 0;  ///< 8 pi mu r^2 [M L/T] or 8 pi mu r^3 [M L^2/T]
  double stresslet =
      0;  ///< (20/3) pi mu r^2 [M L/T] or (20/3) pi mu r^3 [M L^2/T]; of the trace, too
};
/// Viscosity [M/(L T)] and radius [L] of the sphere must be > 0.
ActionUnits action_units(MotionKind motion, double viscosity, double radius);

/// True if the path is a regular file whose head says that it is a table of another motion than the
/// approach. False also if it cannot be opened, and for a pipe, which cannot be read a second time.
/// Throws std::filesystem::filesystem_error if the system cannot look up the path.
bool is_motion_table(const std::filesystem::path& path);

/// Reads a table of any motion. A head without a line `# motion` means the approach, unless its
/// line `# viscontact` says "motion table". The columns gap and reference_velocity are required,
/// and the force, torque and stresslet that the motion has, the last one only in a strain. Throws
/// the errors of read_table().
MotionTable read_motion_table(const std::filesystem::path& path);

/// Reads a table of the approach. Throws Error(kBadInput) for a table of another motion, too.
MotionTable read_force_table(const std::filesystem::path& path);

/// The text of the file. The table must have at least one row.
std::string write_motion_table(const MotionTable& table);

}  // namespace viscontact::lubrication
