// The fits of a pair, which is a sphere beside a body at rest, its neighbour (docs/physics.md
// (2.12)), and their file.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/table.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::motions {

/// The resistances of a pair, called entries. The neighbour is at rest, and the axis z goes from
/// the neighbour to the sphere. With the velocities u along x and u_z along z [L/T] of the sphere,
/// and its angular velocities w about y and w_z about z [1/T], the fluid exerts these forces F
/// [M L/T^2] and torques T [M L^2/T^2] on the sphere:
///   F_z = -squeeze u_z,            F_x = -slide u + slide_roll w,
///   T_y = slide_roll u - roll w,   T_z = -spin w_z.
/// The other entries come from tables with stresslets (lubrication/motion_table.hpp): the
/// stresslets and traces of the sphere, and all loads on its neighbour, by motions and strains of
/// the sphere. The reciprocal theorem gives the other loads (docs/pairs.md).
enum class PairEntry {
  kSqueeze,
  kSlide,
  kRoll,
  kSlideRoll,
  kSpin,
  kSqueezeStress,
  kSlideStress,
  kRollStress,
  kAxialStrain,
  kShearStrain,
  kTwofoldStrain,
  kSqueezeTrace,
  kAxialTrace,
  kNeighbourSqueeze,
  kNeighbourSlide,
  kNeighbourSlideTorque,
  kNeighbourRollForce,
  kNeighbourRoll,
  kNeighbourSpin,
  kNeighbourSqueezeStress,
  kNeighbourSlideStress,
  kNeighbourRollStress,
  kNeighbourAxialForce,
  kNeighbourShearForce,
  kNeighbourShearTorque,
  kNeighbourAxialStrain,
  kNeighbourShearStrain,
  kNeighbourTwofoldStrain,
  kNeighbourSqueezeTrace,
  kNeighbourAxialTrace
};

/// A load in a table of a motion or strain.
enum class PairLoad { kForce, kTorque, kStresslet, kTrace };

/// A scalar function of Jeffrey & Onishi 1984 and Jeffrey 1992, in which the sphere is sphere 1 and
/// its neighbour sphere 2, and the unit vector of all goes from 1 to 2: it is numerator/denominator
/// times the entry, over pi mu s^power. s is 2 r for the indices 11, and the sum of both radii for
/// 12 and 21.
struct JeffreyFunction {
  std::string_view name;  ///< such as "X^A_11"; empty for a trace
  int numerator = 1, denominator = 1, power = 1;
};

/// What the fits of a resistance may contain.
struct NamedEntry {
  std::string_view name;         ///< such as "slide_roll", in files and in exported code
  std::string_view description;  ///< one line for the comment of exported code
  /// Terms that by lubrication theory this entry does not have near contact; they are not fitted.
  std::vector<std::string_view> absent_terms;
  std::string_view leading_term;  ///< the most singular term near contact, by lubrication theory
  /// The shape that the fitted entry must have; another one gives a warning.
  lubrication::FittedShape shape;
  /// The entry is -force/v, -torque/v, +stresslet/v or +trace/v in the table of `motion` with the
  /// velocity or rate v, of the neighbour if `of_neighbour`. slide_roll also has -1 times this.
  lubrication::MotionKind motion;
  PairLoad load;
  bool of_neighbour;
  /// The power of the length in its unit M L^(power - 1)/T: 1 to 3.
  int power;
  JeffreyFunction function;
};

/// All entries, in the order of PairEntry.
std::span<const NamedEntry> pair_entries();

/// Such as "X^G_11 = 3 squeeze_stress/(2 pi mu s^2)"; empty for a trace.
std::string function_in_words(const NamedEntry& entry);

/// The basis that is fitted if the user chooses none. Another one would change the fits of all
/// users who choose none.
inline constexpr std::string_view kDefaultPairBasis = "asymptotic_cubic";

/// The names of the bases for the entries of a pair. `asymptotic` has the terms 1/q, ln q, 1, q ln
/// q and q of the gap q; `asymptotic_extended` also q^2 ln q, q^2 and q^3; `asymptotic_cubic` also
/// q^3 ln q; and `asymptotic_quartic` also q^4 ln q and q^4.
std::vector<std::string_view> pair_bases();

/// The basis for an entry. It has the terms of the basis `name` but those of entry.absent_terms.
/// `theory` is the coefficient of entry.leading_term by lubrication theory; if it is 0, this term
/// is left out, too. Throws Error(kBadInput), which lists the names, if no basis has this name.
lubrication::Basis basis_of_entry(const NamedEntry& entry, std::string_view name,
                                  std::optional<double> theory = {});

struct EntryFit {
  /// A fit at the reference velocity -1, so that its sum of coefficients times terms is the
  /// resistance itself, in the unit that NamedEntry::power says.
  lubrication::Fit fit;
  /// The coefficient of NamedEntry::leading_term by lubrication theory, in the unit of the entry
  /// over that of the term; nothing if it is not known.
  std::optional<double> theory;
};

/// The fits of the resistances of a pair, in the units of the tables from which they were made.
struct PairFit {
  double viscosity = 0;                         ///< mu [M/(L T)], > 0
  double radius = 0;                            ///< r [L], > 0
  std::string geometry;                         ///< the neighbour in words; may be empty
  std::array<double, 2> gap_interval = {};      ///< [L], 0 < first < second; all tables contain it
  std::map<PairEntry, EntryFit> entries;        ///< at least one: those that the tables determine
  std::map<std::string, std::string> versions;  ///< program name to version
};

/// The value of an entry at a gap [L], in the dimension that EntryFit gives. The fitted formula is
/// also used outside fit.gap_interval; at a gap <= 0 it is NaN or infinite. Throws Error(kBadInput)
/// if the fit lacks the entry.
double entry_value(const PairFit& fit, PairEntry entry, double gap);

/// The fit for another viscosity [M/(L T)] and another radius [L] of the sphere, beside a neighbour
/// whose size in sphere radii stays the same (lubrication/scaling.hpp).
PairFit scaled_to(PairFit fit, double viscosity, double radius);

/// True if the path is a regular file that contains the key of a fit of a pair, `"kind": "pair
/// fit"`. False if there is no file, and for a pipe, which is not read because it cannot be read a
/// second time. Throws Error(kBadInput) if a file cannot be read, and
/// std::filesystem::filesystem_error if the system cannot look up the path.
bool is_pair_fit(const std::filesystem::path& path);

/// Reads the file of a pair. Throws Error(kBadInput) with the line, the key and what is allowed if
/// a key is missing, unknown or has a wrong value, if there is no entry, if an entry has another
/// viscosity, radius or geometry than the file or another reference velocity than -1, or if the
/// file cannot be read.
PairFit read_pair_fit(const std::filesystem::path& path);

/// The text of the file of a pair (JSON), which read_pair_fit() reads.
std::string write_pair_fit(const PairFit& fit);

}  // namespace viscontact::motions
