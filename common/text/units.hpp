// The units in which a case is written, as words for pages, axes and tables. Nothing is converted.
// case_file/ reads the words from a case and checks them; particles/, report/, rolling/ and
// swimmer/ show them in pages and files. A power below -9 or above 9 throws std::out_of_range;
// nothing else is checked or thrown here. The layout of a unit in pages may be changed; a change
// must keep the words in files, which users' scripts read.
#pragma once

#include <string>

namespace viscontact {

/// The words for the units of length, time and mass, such as "m", "s" and "kg". If the case does
/// not say its units, all three words are empty; the functions below test only whether the word for
/// the length is empty.
struct Units {
  std::string length,  ///< such as "m"
      time,            ///< such as "s"
      mass;            ///< such as "kg"

  /// True if the case says its units.
  bool are_said() const { return !length.empty(); }
  /// The three words in the form "length m, time s, mass kg"; empty if the case does not say its
  /// units.
  std::string words() const;
  /// The units of a text that words() made; empty words for another text.
  static Units of_words(const std::string& text);
  /// The unit of the quantity with these powers, such as "kg m/s" for (1, 1, -1). Forces, moments,
  /// pressures and viscosities in kg, m and s have the units N, N m, Pa and Pa s. It is empty if
  /// the case does not say its units or if all powers are 0. Powers are from -9 to 9; others throw
  /// std::out_of_range.
  std::string unit_of(int mass_power, int length_power, int time_power) const;
  /// The text of unit_of() in brackets after a blank, for the end of a label, such as " [m/s]";
  /// empty if the case does not say its units, and " []" if it does and all powers are 0. Powers
  /// are from -9 to 9; others throw std::out_of_range.
  std::string in_brackets(int mass_power, int length_power, int time_power) const;
  /// The text of unit_of(). If the case does not say its units, it is the dimension in words, such
  /// as "mass × length/time²". Powers are from -9 to 9; others throw std::out_of_range.
  std::string unit_or_dimension(int mass_power, int length_power, int time_power) const;
  /// The text with units in place of the letters M, L and T of the dimensions in brackets that it
  /// contains, such as "[M L/T]" or "[M/(L T)]". Other brackets are not changed, and the text is
  /// not changed if the case does not say its units. Exponents may be superscripts of HTML. Throws
  /// nothing.
  std::string in_brackets_of(std::string text) const;
  /// The text with units in place of the letters M, L and T of dimensions without brackets, such as
  /// M, L<sup>-1</sup> and T<sup>-2</sup>, each of which stands between blanks. The text is not
  /// changed if the case does not say its units. Throws nothing.
  std::string in_place_of_dimensions(const std::string& html) const;
};

}  // namespace viscontact
