// The keys `units` and [sweep], which all kinds of cases have.
#include "viscontact/case_file/case_template.hpp"

namespace viscontact::case_file {
namespace {

/// 1 to 20 bytes, so that the labels of axes stay short, without blanks and characters that HTML
/// pages or gnuplot read as commands.
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
