// The resistances of a sphere beside another body at rest, its neighbour, to all motions of the
// sphere, as fitted functions of the gap (docs/physics.md (2.12)), and the file of these fits.
// Lengths, masses and times are in the units of the tables from which the fits were made.
// motions/fit/ makes and exports the fits; rolling/ and the Python module read them. A wrong file,
// an unknown basis and an entry that a fit lacks throw Error(kBadInput). Gaps, radii and
// viscosities of arguments are not checked. A change must keep the names of entries, bases and
// keys, which files contain.
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
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::motions {

/// The resistances of a pair. The neighbour is at rest, and z goes from it to the sphere. With the
/// velocities u along x, u_z along z [L/T] and the angular velocities w about y, w_z about z [1/T],
/// the fluid exerts the forces F [M L/T^2] and torques T [M L^2/T^2] on the sphere:
///   F_z = -squeeze u_z,            F_x = -slide u + slide_roll w,
///   T_y = slide_roll u - roll w,   T_z = -spin w_z.
enum class PairEntry { kSqueeze, kSlide, kRoll, kSlideRoll, kSpin };

/// A resistance of a pair, and what its fits may contain.
struct NamedEntry {
  std::string_view name;         ///< such as "slide_roll", in files and in exported code
  std::string_view description;  ///< one line for the comment of exported code
  /// Terms that by lubrication theory this entry does not have near contact; they are not fitted.
  std::vector<std::string_view> absent_terms;
  std::string_view leading_term;  ///< the most singular term near contact, by lubrication theory
  /// What the fitted entry must be; a fit of another shape has a warning.
  lubrication::FittedShape shape;
};

/// All entries, in the order of PairEntry.
std::span<const NamedEntry> pair_entries();

/// Name of the basis that is fitted if the user chooses none.
inline constexpr std::string_view kDefaultPairBasis = "asymptotic_cubic";

/// The names of the bases for the entries of a pair: asymptotic and asymptotic_extended of
/// all_bases() (lubrication/terms.hpp); asymptotic_cubic, which is asymptotic_extended and q^3 ln
/// q; asymptotic_quartic, which is asymptotic_cubic, q^4 ln q and q^4.
std::vector<std::string_view> pair_bases();

/// The basis for an entry: the terms of the basis `name` without entry.absent_terms, and without
/// entry.leading_term if `theory`, its coefficient by lubrication theory, is 0. Throws
/// Error(kBadInput), which lists the names, if no basis has this name.
lubrication::Basis basis_of_entry(const NamedEntry& entry, std::string_view name,
                                  std::optional<double> theory = {});

/// The fit of one entry.
struct EntryFit {
  /// A fit at the reference velocity -1, so that its sum of coefficients times terms is the
  /// resistance itself: [M/T] squeeze and slide, [M L/T] slide_roll, [M L^2/T] roll and spin.
  lubrication::Fit fit;
  /// Lubrication theory's coefficient of NamedEntry::leading_term, of any sign, in the unit of the
  /// entry over that of the term; nothing if it is not known.
  std::optional<double> theory;
};

/// The fits of the resistances of a pair: the content of a fit file of a pair.
struct PairFit {
  double viscosity = 0;                         ///< mu [M/(L T)], > 0
  double radius = 0;                            ///< r [L], > 0
  std::string geometry;                         ///< the neighbour in words; may be empty
  std::array<double, 2> gap_interval = {};      ///< [L], 0 < first < second; common to all tables
  std::map<PairEntry, EntryFit> entries;        ///< at least one: those that the tables determine
  std::map<std::string, std::string> versions;  ///< program name to version
};

/// The value of an entry at a gap [L] > 0, in the dimension that EntryFit gives. The fitted formula
/// is also used outside fit.gap_interval. Throws Error(kBadInput) if the fit lacks the entry. A gap
/// <= 0 is not refused: the value is NaN or infinite.
double entry_value(const PairFit& fit, PairEntry entry, double gap);

/// The fit for another viscosity [M/(L T)] > 0 and radius [L] > 0 of the sphere, beside a neighbour
/// of the same size in radii (lubrication/scaling.hpp). That both are > 0 is not checked.
PairFit scaled_to(PairFit fit, double viscosity, double radius);

/// True if the path is a regular file with a PairFit. False for a pipe, which is not read, because
/// it cannot be read a second time, and if there is no file. Throws Error(kBadInput) if a file
/// cannot be read.
bool is_pair_fit(const std::filesystem::path& path);

/// Reads the file. Throws Error(kBadInput) with the line, the key and what is allowed, also if
/// there is no entry, or if an entry has another viscosity, radius or geometry than the file.
PairFit read_pair_fit(const std::filesystem::path& path);

/// The text of the file (JSON).
std::string write_pair_fit(const PairFit& fit);

}  // namespace viscontact::motions
