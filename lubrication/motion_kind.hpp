// The motions of a sphere beside its neighbour whose resistances are tabulated. A change must keep
// the names, which case files, tables and fits contain.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viscontact::lubrication {

/// The z axis goes from the neighbour through the centre of the sphere. A sphere approaches or
/// leaves along z, slides along x, rolls (turns about its centre and the y axis), or spins (turns
/// about z).
enum class MotionKind { kApproach, kSlide, kRoll, kSpin };

/// A motion and its name.
struct NamedMotion {
  std::string_view name;  ///< word in case files and tables, and name of the table's file
  MotionKind kind;        ///< the motion
};

/// Force and torque of the fluid on a body, over those of the sphere alone but for the sign [1]:
/// force = -6 pi mu r u0 * force if the sphere slides at u0 [L/T], -6 pi mu r^2 w0 * force if it
/// turns at w0 [1/T]; torque = -8 pi mu r^2 u0 * torque, or -8 pi mu r^3 w0 * torque. r is always
/// the radius of the first sphere.
struct ActionFactors {
  double force = 0;   ///< factor of the force [1]
  double torque = 0;  ///< factor of the torque [1]
  /// Error of `force`, over the sphere's force factor if it slides, or torque factor if it turns.
  double force_error_estimate = 0;
  double torque_error_estimate = 0;  ///< error of `torque`, over the same factor
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
/// The motions of a text that motions_in_words() made. Throws Error(kBadInput) as parse_motion()
/// does.
std::vector<MotionKind> parse_motions_in_words(const std::string& words);

}  // namespace viscontact::lubrication
