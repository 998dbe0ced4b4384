// The motions of a sphere beside its neighbour whose resistances are tabulated. A change must keep
// the names, which case files, tables and fits contain.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

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

}  // namespace viscontact::lubrication
