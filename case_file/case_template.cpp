// The keys that all kinds of cases have: `units`, and those of [sweep] that choose points and
// picture. The readers of cases in case_file/, particles/, rolling/ and swimmer/ use them. Words of
// units have 1 to 20 bytes; `samples` is a whole number from 1 to 1e12 without a unit; the other
// keys are texts. Whether the keys and columns that [sweep] names exist is not checked here. A
// wrong value is an Error(kBadInput) with file and line. A change must keep accepting users' cases.
// After a change of a declaration the tables of docs/case-file.md must be made again (the test
// CaseFilePage makes them and says where).
#include "viscontact/case_file/case_template.hpp"

namespace viscontact::case_file {
namespace {

/// Reads the word for a unit: 1 to 20 bytes, without blanks and characters that HTML pages or
/// gnuplot read as commands. Any limit that keeps the labels of axes short works. Throws
/// Error(kBadInput) for another word.
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

/// Reads the section `units` into `units`, which stays as it is if the case does not have this
/// section. Throws Error(kBadInput) for a missing or wrong word.
void read_units(const TomlSection& root, Units& units) {
  if (root.has("units")) read_keys(root.section("units"), unit_keys, units);
}

/// Declares the keys of [sweep] that choose points and picture: the number of random samples, the
/// keys of the axes x and y, and the columns to draw. When it reads, it also notes the line of the
/// key `vary` (that of [sweep] if there is no such key), for messages.
void points_and_plot_keys(Keys& keys, SweepRequest& sweep) {
  if (keys.reads()) sweep.vary_line = keys.section().line("vary");
  keys.optional("samples", number(sweep.samples, kWholeNumber),
                {"number of random points", "the whole grid"});
  keys.optional("x", text(sweep.x),
                {"key of the horizontal axis of the plot", "the first varied key"});
  keys.optional("y", text(sweep.y), {"key of the vertical axis of a map", "lines over `x`"});
  keys.optional("plot", texts(sweep.plot), {"columns to draw", "that of the command"});
}

KeyTable table_of_units() { return describe_keys("units", unit_keys); }

}  // namespace viscontact::case_file
