// Reads the key `units` (units_key.hpp).
#include "viscontact/case_file/units_key.hpp"

#include "viscontact/case_file/keys.hpp"

namespace viscontact::case_file {
namespace {

/// The word for a unit: 1 to 20 bytes, without blanks and characters that pages and gnuplot read as
/// commands.
void read_unit(const TomlSection& section, std::string_view key, std::string& word) {
  word = section.text(key);
  constexpr std::size_t kLongest = 20;
  section.require(!word.empty() && word.size() <= kLongest &&
                      word.find_first_of(" \t\n\r\"'`\\\\{}<>&$@^_~,;:") == std::string::npos,
                  key, "is '{}'; it must be a word of 1 to {} letters, such as \"mm\"", word,
                  kLongest);
}

void unit_keys(Keys& keys, Units& units) {
  keys.required("length", custom("a word", read_unit, units.length), {"such as `\"m\"`"});
  keys.required("time", custom("a word", read_unit, units.time), {"such as `\"s\"`"});
  keys.required("mass", custom("a word", read_unit, units.mass), {"such as `\"kg\"`"});
}

}  // namespace

void read_units(const TomlSection& root, Units& units) {
  if (root.has("units")) read_keys(root.section("units"), unit_keys, units);
}

KeyTable table_of_units() { return describe_keys("units", unit_keys); }

}  // namespace viscontact::case_file
