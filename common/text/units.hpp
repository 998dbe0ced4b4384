// The units in which a case is written, as words for pages, axes and tables. Nothing is converted.
#pragma once

#include <string>

namespace viscontact {

/// If the case does not say its units, all three words are empty; only that for the length is
/// tested. Powers of mass, length and time are from -9 to 9; others throw std::out_of_range.
struct Units {
  std::string length,  ///< such as "m"
      time,            ///< such as "s"
      mass;            ///< such as "kg"

  bool are_said() const { return !length.empty(); }
  /// The words in the form "length m, time s, mass kg"; empty if the case does not say its units.
  std::string words() const;
  /// The units of a text of words(); empty words for another text.
  static Units of_words(const std::string& text);
  /// The unit of the quantity with these powers, such as "kg m/s" for (1, 1, -1). Forces, moments,
  /// pressures and viscosities in kg, m and s have the units N, N m, Pa and Pa s. It is empty if
  /// the case does not say its units or if all powers are 0.
  std::string unit_of(int mass_power, int length_power, int time_power) const;
  /// The text of unit_of() in brackets after a blank, for the end of a label, such as " [m/s]";
  /// empty if the case does not say its units, and " []" if it does and all powers are 0.
  std::string in_brackets(int mass_power, int length_power, int time_power) const;
  /// The text of unit_of(); without units the dimension in words, such as "mass × length/time²".
  std::string unit_or_dimension(int mass_power, int length_power, int time_power) const;
  /// The text with units in place of the letters M, L and T of the dimensions in brackets that it
  /// contains, such as "[M L/T]" or "[M/(L T)]"; exponents may be superscripts of HTML. Other
  /// brackets, and texts of a case that does not say its units, are not changed.
  std::string in_brackets_of(std::string text) const;
  /// The same for dimensions without brackets, such as M, L<sup>-1</sup> and T<sup>-2</sup>, each
  /// of which stands between blanks. Several blanks become one.
  std::string in_place_of_dimensions(const std::string& html) const;
};

}  // namespace viscontact
