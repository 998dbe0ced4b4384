// The common part of all tables that FreeFEM computes and fits read: a head, and rows with named
// columns; and the motions of a sphere beside another body, its neighbour. Lengths, masses and
// times are in any consistent units. A name that is no motion throws Error(kBadInput); numbers are
// checked where files are read (table_codec.hpp). Used by motion_table.hpp, freefem_axi/ and
// swimmer/. A change must keep the keys of the head and the names of the motions, which published
// tables have.
//
// A kind of table is a struct Row and four functions beside it: columns_of(), prepare(), complete()
// and check() (table_codec.hpp). A new column needs a member of the row and a line in columns_of(),
// from which the readers and writers of all files take it. A new line of the head needs a member of
// TableHead and a line in table.cpp.
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

/// The z axis goes from the neighbour through the centre of the sphere. A sphere approaches or
/// leaves along z, slides along x, rolls (turns about y), or spins (turns about z).
enum class MotionKind { kApproach, kSlide, kRoll, kSpin };

/// A motion and its name.
struct NamedMotion {
  std::string_view name;  ///< in case files and tables; the table of "slide" is slide.csv
  MotionKind kind;        ///< the motion
};

/// All motions, in the order of MotionKind.
std::span<const NamedMotion> all_motions();

/// The name of a motion. Throws nothing.
std::string_view to_string(MotionKind motion);

/// The motion with this name. Throws Error(kBadInput), which lists the names, if there is none.
MotionKind parse_motion(std::string_view name);

/// The names, separated by commas, as in the head of a table: "approach, slide"; or an empty text.
std::string motions_in_words(const std::vector<MotionKind>& motions);
/// The motions of a text that motions_in_words() made; none if it is empty. Throws the errors of
/// parse_motion().
std::vector<MotionKind> parse_motions_in_words(const std::string& words);

/// The fewest and the most spheres on a line in a table of resistance matrices. With ten spheres a
/// row takes 44 s and 3.6 GB (bench/README.md).
inline constexpr std::size_t kFewestSpheres = 2,  ///< the fewest
    kMostSpheres = 10;                            ///< the most

/// What a table says of all its rows: the problem that it was computed for.
struct TableHead {
  /// The motion of the sphere; kApproach in a table of resistance matrices, too.
  MotionKind motion = MotionKind::kApproach;
  double viscosity = 0;       ///< mu [M/(L T)], > 0
  double radius = 0;          ///< r of the sphere [L], > 0; 0 in a table of resistance matrices
  std::vector<double> radii;  ///< of spheres along a line [L], > 0, 2 to 10; else empty
  std::string geometry;       ///< what the sphere approaches, in words; may be empty
  std::string container;      ///< walls around the fluid, in words; may be empty
  /// True if the neighbour moves. The force may then be along the sphere's velocity.
  bool neighbour_moves = false;
  /// Theory's coefficient k [M L/T] > 0 in the resistance R = k/q + ... of the approach at a small
  /// gap q, where R is -force/velocity; nothing if not known. A file with k <= 0 is refused.
  std::optional<double> leading_coefficient;
  /// Theory's coefficient of ln q (sliding, rolling) or q ln q (spinning) in the force factor and
  /// in the torque factor of MotionRow [1 over the unit of the term], of any sign, with q in the
  /// unit of the table; nothing if not known.
  std::optional<double> leading_force_factor,  ///< the coefficient in the force factor
      leading_torque_factor;                   ///< the coefficient in the torque factor
  std::string case_hash;  ///< SHA-256 of the tabulation's inputs; empty if the table has none
  std::map<std::string, std::string> versions;  ///< program name to version
  /// The motions that were asked for together, each of which has a table of its own; empty if this
  /// table is the only one.
  std::vector<MotionKind> tabulated_motions;
  /// Rows that the table lacks because they could not be computed: the row in words with all
  /// digits, such as "gap 0.01, velocity -1", and the reason.
  std::map<std::string, std::string> failed_rows;
};

/// A table. The rows are in the order of computation: all gaps of the first velocity, then those of
/// the next; or all combinations of gaps, of which the last changes fastest.
template <class Row>
struct Table : TableHead {
  std::vector<Row> rows;  ///< at least one in a file
};

/// What a number is if a file lacks it: kRefused, an error; kZero, 0; kComputed, NaN until
/// complete() computes it from others; kAlwaysComputed, the same, and complete() computes it even
/// if the file has it, so that the journal of an unfinished table does not contain it.
enum class IfAbsent { kRefused, kZero, kComputed, kAlwaysComputed };

/// A column of a table, and its number in one row.
struct Column {
  std::string name;                      ///< in the header line of the file
  double* number = nullptr;              ///< address of a member of the row; not null
  IfAbsent if_absent = IfAbsent::kZero;  ///< columns with kRefused stand before the others
  Allowed allowed = kFinite;             ///< what a number in a file may be; others are refused
};

}  // namespace viscontact::lubrication
