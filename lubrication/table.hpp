// What all tables of FreeFEM's results have in common: a head, rows with named columns, and the
// motions of a sphere beside another body, its neighbour (docs/file-formats.md).
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/allowed.hpp"

namespace viscontact::lubrication {

/// The motion of a sphere. The z axis goes from the neighbour through the centre of the sphere, the
/// axes x and y are at right angles to it. With kApproach the sphere approaches or leaves along z.
/// With kSlide it moves along x, with kRoll it turns about y, with kSpin about z. With a strain
/// sphere and neighbour are at rest, and the sphere alone feels an undisturbed flow E.(x - centre):
/// its surface has the opposite velocity. The rate of strain e [1/T] is E_zz = e, E_xx = E_yy =
/// -e/2 (kAxialStrain), E_xz = E_zx = e (kShearStrain), or E_xx = -E_yy = e (kTwofoldStrain).
enum class MotionKind {
  kApproach,
  kSlide,
  kRoll,
  kSpin,
  kAxialStrain,
  kShearStrain,
  kTwofoldStrain
};

bool is_strain(MotionKind motion);
/// Whether the flow is symmetric about the axis and has no swirl: the approach and the axial
/// strain.
bool is_axial(MotionKind motion);

struct NamedMotion {
  std::string_view name;  ///< in case files and tables; the table of "slide" is slide.csv
  MotionKind kind;
};

/// The motions in the order of MotionKind.
std::span<const NamedMotion> all_motions();

std::string_view to_string(MotionKind motion);

/// The motion with this name. Throws Error(kBadInput), which lists the names, if there is none.
MotionKind parse_motion(std::string_view name);

/// The names, separated by commas, as in the head of a table: "approach, slide".
std::string motions_in_words(const std::vector<MotionKind>& motions);
/// The inverse of motions_in_words(). Throws Error(kBadInput) for an unknown name.
std::vector<MotionKind> parse_motions_in_words(const std::string& words);

/// The numbers of spheres on a line in a table of resistance matrices. With ten spheres a row takes
/// 44 s and 3.6 GB (bench/README.md).
inline constexpr std::size_t kFewestSpheres = 2, kMostSpheres = 10;

/// What a table says of all its rows: the problem that was solved, in any consistent units.
struct TableHead {
  /// It is kApproach in a table of resistance matrices.
  MotionKind motion = MotionKind::kApproach;
  double viscosity = 0;       ///< mu [M/(L T)], > 0
  double radius = 0;          ///< r of the sphere [L], > 0; 0 in a table of resistance matrices
  std::vector<double> radii;  ///< of 2 to 10 spheres on a line [L], > 0; empty in other tables
  std::string geometry;       ///< what the sphere approaches, in words; may be empty
  std::string container;      ///< walls around the fluid, in words; may be empty
  /// The force may then have the direction of the sphere's velocity.
  bool neighbour_moves = false;
  /// Theory's coefficient k [M L/T] > 0 in the resistance -force/velocity = k/q + ... of the
  /// approach at a small gap q; nothing if not known.
  std::optional<double> leading_coefficient;
  /// Theory's coefficient of 1/q (axial strain), ln q (sliding, rolling, shear strain) or q ln q
  /// (spinning) in the force factor and in the torque factor of MotionRow (motion_table.hpp), with
  /// q in the unit of the table.
  std::optional<double> leading_force_factor, leading_torque_factor;
  /// The same of the term 1/q (approach, axial strain), ln q (slide, roll, shear strain) or q ln q
  /// (spin, twofold strain) in the stresslet factor, and in the factors of the neighbour.
  std::optional<double> leading_stresslet_factor, neighbour_leading_force_factor,
      neighbour_leading_torque_factor, neighbour_leading_stresslet_factor;
  std::string case_hash;  ///< SHA-256 of the inputs of the computation; may be empty
  std::map<std::string, std::string> versions;  ///< program name to version
  /// The motions that were asked for together, each of which has a table of its own; empty if this
  /// table is the only one.
  std::vector<MotionKind> tabulated_motions;
  /// Rows that could not be computed. The key is the row in words with all digits, such as "gap
  /// 0.01, velocity -1"; the value is the reason.
  std::map<std::string, std::string> failed_rows;
};

/// A kind of table is a struct Row and four functions beside it (table_codec.hpp). The rows are in
/// the order of computation: all gaps of the first velocity, then those of the next; or all
/// combinations of gaps, of which the last changes fastest.
template <class Row>
struct Table : TableHead {
  std::vector<Row> rows;  ///< at least one in a file
};

/// What happens if a file lacks a number. With kRefused Error(kBadInput) is thrown. With kZero the
/// number is 0. With kComputed it is NaN until complete() computes it from other numbers. With
/// kAlwaysComputed complete() computes it even if the file has it, so that the journal of an
/// unfinished table (freefem_axi/journal/) does not contain it.
enum class IfAbsent { kRefused, kZero, kComputed, kAlwaysComputed };

/// A column of a table, and a place for its number in one row.
struct Column {
  std::string name;          ///< in the header line of the file
  double* number = nullptr;  ///< a member of the row, which must outlive the column; not null
  IfAbsent if_absent = IfAbsent::kZero;  ///< columns with kRefused stand before the others
  Allowed allowed = kFinite;             ///< other numbers in a file throw
};

}  // namespace viscontact::lubrication
