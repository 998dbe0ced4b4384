// Defines what all tables of FreeFEM's results have in common: a head, and rows with named columns.
// It also names the motions of a sphere beside another body, its neighbour. Lengths, masses and
// times are in any consistent units. A name that is no motion throws Error(kBadInput). The ranges
// below are checked only when files are read (table_codec.hpp). motion_table.hpp, freefem_axi/ and
// swimmer/ use this file. A change must keep the keys of the head and the names of the motions,
// which published tables have.
//
// There are two kinds of tables, that of motion_table.hpp and the resistance matrices of spheres on
// a line (swimmer/resistance/). A kind of table is a struct Row and four functions beside it:
// columns_of(), prepare(), complete() and check() (table_codec.hpp). A new column needs a member of
// the row and a line in columns_of(), from which the readers and writers of all files take it. A
// new line of the head needs a member of TableHead and a line in table.cpp.
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
/// With kSlide it moves along x, with kRoll it turns about y, with kSpin about z.
enum class MotionKind { kApproach, kSlide, kRoll, kSpin };

/// A motion and its name.
struct NamedMotion {
  std::string_view name;  ///< in case files and tables; the table of "slide" is slide.csv
  MotionKind kind;        ///< the motion
};

/// All motions, in the order of MotionKind: approach, slide, roll, spin.
std::span<const NamedMotion> all_motions();

/// The name of a motion. Throws nothing.
std::string_view to_string(MotionKind motion);

/// The motion with this name. Throws Error(kBadInput), which lists the names, if there is none.
MotionKind parse_motion(std::string_view name);

/// The names, separated by commas, as in the head of a table: "approach, slide"; or an empty text.
std::string motions_in_words(const std::vector<MotionKind>& motions);
/// The motions of a text that motions_in_words() made; none if it is empty. Throws Error(kBadInput)
/// if one of the names is not that of a motion.
std::vector<MotionKind> parse_motions_in_words(const std::string& words);

/// The fewest and the most spheres on a line in a table of resistance matrices. The bound of ten is
/// a choice: with ten spheres a row takes 44 s and 3.6 GB (bench/README.md).
inline constexpr std::size_t kFewestSpheres = 2,  ///< the fewest
    kMostSpheres = 10;                            ///< the most

/// What a table says of all its rows: the problem that it was computed for.
struct TableHead {
  /// The motion of the sphere; it is kApproach in a table of resistance matrices.
  MotionKind motion = MotionKind::kApproach;
  double viscosity = 0;       ///< mu [M/(L T)], > 0
  double radius = 0;          ///< r of the sphere [L], > 0; 0 in a table of resistance matrices
  std::vector<double> radii;  ///< of 2 to 10 spheres on a line [L], > 0; empty in other tables
  std::string geometry;       ///< what the sphere approaches, in words; may be empty
  std::string container;      ///< walls around the fluid, in words; may be empty
  /// True if the neighbour moves. The force may then have the direction of the sphere's velocity.
  bool neighbour_moves = false;
  /// Theory's coefficient k [M L/T] > 0 in the resistance R = k/q + ... of the approach at a small
  /// gap q, where R is -force/velocity; nothing if not known. A file with k <= 0 is refused.
  std::optional<double> leading_coefficient;
  /// Theory's coefficient of ln q (sliding, rolling) or q ln q (spinning) in the force factor and
  /// in the torque factor of MotionRow (motion_table.hpp). It has any sign and the unit 1 over that
  /// of the term, with q in the unit of the table; nothing if not known.
  std::optional<double> leading_force_factor,  ///< the coefficient in the force factor
      leading_torque_factor;                   ///< the coefficient in the torque factor
  std::string case_hash;  ///< SHA-256 of the inputs of the computation; may be empty
  std::map<std::string, std::string> versions;  ///< program name to version
  /// The motions that were asked for together, each of which has a table of its own; empty if this
  /// table is the only one.
  std::vector<MotionKind> tabulated_motions;
  /// Rows that the table lacks because they could not be computed. The key is the row in words with
  /// all digits, such as "gap 0.01, velocity -1"; the value is the reason.
  std::map<std::string, std::string> failed_rows;
};

/// A table. The rows are in the order of computation: all gaps of the first velocity, then those of
/// the next; or all combinations of gaps, of which the last changes fastest.
template <class Row>
struct Table : TableHead {
  std::vector<Row> rows;  ///< at least one in a file
};

/// What happens if a file lacks a number. With kRefused the file is refused with Error(kBadInput).
/// With kZero the number is 0. With kComputed it is NaN until complete() computes it from other
/// numbers. With kAlwaysComputed complete() computes it even if the file has it, so that the
/// journal, the file of rows of an unfinished table (freefem_axi/journal/), does not contain it.
enum class IfAbsent { kRefused, kZero, kComputed, kAlwaysComputed };

/// A column of a table, and where its number in one row is stored.
struct Column {
  std::string name;                      ///< in the header line of the file
  double* number = nullptr;              ///< address of a member of the row; not null
  IfAbsent if_absent = IfAbsent::kZero;  ///< columns with kRefused stand before the others
  Allowed allowed = kFinite;             ///< the numbers that a file may contain; others throw
};

}  // namespace viscontact::lubrication
