// What all tables have in common that FreeFEM computes and the fits read: a head, and rows with
// named columns of values and error estimates; and the motions of a sphere beside its neighbour
// whose resistances are tabulated. Lengths, masses and times are in any consistent units. A change
// must keep the keys of the head and the names of the motions, which published tables have.
//
// A kind of table is a struct Row and four functions beside it: columns_of(), prepare(), complete()
// and check() (table_codec.hpp). A new column is a member of the row and a line of columns_of();
// files and journals of tabulations learn it from there. A new line of the head is a member of
// TableHead and a line of table.cpp.
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
  std::string_view name;  ///< word in case files and tables, and name of the table's file
  MotionKind kind;        ///< the motion
};

/// All motions, in the order of MotionKind.
std::span<const NamedMotion> all_motions();

/// The name of a motion.
std::string_view to_string(MotionKind motion);

/// The motion with this name. Throws Error(kBadInput), which lists the names, if there is none.
MotionKind parse_motion(std::string_view name);

/// The names, separated by commas, as the head of a table lists the motions of its tabulation:
/// "approach, slide". Empty without motions.
std::string motions_in_words(const std::vector<MotionKind>& motions);
/// The motions of a text that motions_in_words() made. Throws the errors of parse_motion().
std::vector<MotionKind> parse_motions_in_words(const std::string& words);

/// The fewest and the most spheres on a line. Ten spheres take 44 s and 3.6 GB a row
/// (bench/README.md).
inline constexpr std::size_t kFewestSpheres = 2,  ///< the fewest
    kMostSpheres = 10;                            ///< the most

/// What a table says of all its rows: the problem that it was computed for.
struct TableHead {
  /// The motion of the sphere; kApproach in a table of resistance matrices, too.
  MotionKind motion = MotionKind::kApproach;
  double viscosity = 0;       ///< mu [M/(L T)], > 0
  double radius = 0;          ///< r of the sphere [L], > 0; 0 in a table of resistance matrices
  std::vector<double> radii;  ///< of spheres along a line [L], > 0, at least 2; else empty
  std::string geometry;       ///< what the sphere approaches, in words; may be empty
  std::string container;      ///< walls around the fluid, in words; may be empty
  /// True if the neighbour moves. It may then pull the sphere, so a force along u0 is allowed.
  bool neighbour_moves = false;
  /// Theory's coefficient k of the resistance R = -F_lub/u0 = k/q of the approach near contact
  /// [M L/T], > 0, if it is known.
  std::optional<double> leading_coefficient;
  /// Theory's coefficient of ln q (sliding, rolling) or q ln q (spinning) in the force factor and
  /// in the torque factor, with q in the unit of the table; nothing if not known.
  std::optional<double> leading_force_factor,  ///< the coefficient in the force factor
      leading_torque_factor;                   ///< the coefficient in the torque factor
  std::string case_hash;  ///< SHA-256 of the tabulation's inputs; empty if the table has none
  std::map<std::string, std::string> versions;  ///< program name to version
  /// The motions of the tabulation, if there were several: each has a table of its own.
  std::vector<MotionKind> tabulated_motions;
  /// Rows that the table should have and has not, because they could not be computed: the row in
  /// words, "gap 0.01, velocity -1" with all digits, and the reason.
  std::map<std::string, std::string> failed_rows;
};

/// A table. The rows are in the order of computation: all gaps of the first velocity, then those of
/// the next; or all combinations of gaps, of which the last changes fastest.
template <class Row>
struct Table : TableHead {
  std::vector<Row> rows;  ///< at least one in a file
};

/// What a number is if the file lacks it: an error, 0, or not a number until complete() computes
/// it; or complete() computes it in any case, so that journals need not contain it.
enum class IfAbsent { kRefused, kZero, kComputed, kAlwaysComputed };

/// A column of a table, and its number in one row.
struct Column {
  std::string name;                      ///< in the header line of the file
  double* number = nullptr;              ///< a member of the row
  IfAbsent if_absent = IfAbsent::kZero;  ///< columns with kRefused stand before the others
  Allowed allowed = kFinite;             ///< what the number may be
};

}  // namespace viscontact::lubrication
