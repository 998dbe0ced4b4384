// The units in which a case is written, as words for pages, axes and tables. Nothing is converted.
// case_file/ fills them in; particles/, report/, rolling/ and swimmer/ show them in pages and
// files. A power beyond -9 to 9 throws std::out_of_range. Words are not checked here, but when
// case_file/ reads them. A change must keep the words of files, which users' scripts read.
#pragma once

#include <string>

namespace viscontact {

/// The words for the units of length, time and mass, such as "m", "s" and "kg"; all three empty if
/// the case does not say them (only the length is looked at). Only wrong powers are thrown for.
struct Units {
  std::string length,  ///< such as "m"
      time,            ///< such as "s"
      mass;            ///< such as "kg"

  /// True if the case says its units.
  bool are_said() const { return !length.empty(); }
  /// "length m, time s, mass kg"; empty without units.
  std::string words() const;
  /// The unit of the quantity with these powers, such as "kg m/s²" for (1, 1, -2); empty without
  /// units, and if all powers are 0. Powers are from -9 to 9; others throw std::out_of_range.
  std::string unit_of(int mass_power, int length_power, int time_power) const;
  /// The same in brackets for the end of a label, such as " [m/s]"; empty without units. Throws as
  /// unit_of(), and so does the next function.
  std::string in_brackets(int mass_power, int length_power, int time_power) const;
  /// The unit, or without units its dimension in words, such as "mass × length/time²".
  std::string unit_or_dimension(int mass_power, int length_power, int time_power) const;
  /// A text with dimensions in brackets, such as "[M L/T]" or "[M/(L T)]", in which the letters are
  /// replaced by the units; unchanged without units. Exponents may be superscripts of HTML.
  std::string in_brackets_of(std::string text) const;
  /// A text with dimensions as `M`, `L<sup>-1</sup>` and `T<sup>-2</sup>` between blanks, in which
  /// the letters are replaced by the units; unchanged without units.
  std::string in_place_of_dimensions(const std::string& html) const;
};

}  // namespace viscontact
