// What all kinds of cases share for sweeps: the section [sweep], and a case file that is read once
// and from which cases with other numbers are made.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/case_file/keys.hpp"
#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/common/text/units.hpp"

namespace viscontact::case_file {

/// The section [sweep] of a case. Options of `viscontact sweep` replace these values. A member
/// whose key is missing, or which a kind of case does not have, keeps its default.
struct SweepRequest {
  std::vector<std::string> vary;  ///< "KEY=RANGE" each (sweep/variation.hpp); empty: one point
  /// The line of the key `vary`, or that of [sweep] without this key; 0 without [sweep], and in a
  /// case that was made with other numbers.
  int vary_line = 0;
  std::vector<std::string> models;  ///< empty: the default of the command
  std::string reference;            ///< a model; empty: the default of the command
  std::string x;                    ///< key of the horizontal axis of the plot; may be empty
  std::string y;                    ///< key of the vertical axis of a map; empty: lines over x
  std::vector<std::string> plot;    ///< columns to draw; empty: the default of the command
  std::uint64_t samples = 0;        ///< random samples, <= 1e12; 0: the whole grid
  /// Random arrangements of particles at each point, <= 1e12; 0: the key is not given.
  std::uint64_t draws = 0;
};

/// The keys of [sweep] that choose the points and the picture: samples, x, y and plot; whether the
/// keys and columns that they name exist is tested by the sweep. Sets vary_line when it reads.
void points_and_plot_keys(Keys& keys, SweepRequest& sweep);

/// Reads the key `units` of the root table, if it is there. Throws Error(kBadInput) with the line
/// if a word is missing, empty or longer than 20 bytes, or has a character that web pages or
/// gnuplot would read as a command.
void read_units(const TomlSection& root, Units& units);
/// The key `units` in docs/case-file.md.
KeyTable table_of_units();

/// Throws Error(kBadInput) if the title is missing although `needs_title`.
template <class CaseType>
void read_title_and_units(const TomlSection& root, CaseType& c, bool needs_title = false) {
  if (needs_title || root.has("title")) c.title = root.text("title");
  read_units(root, c.units);
}

/// The case whose root table is `root`. `text` is the content of the file at `path`. The function
/// read_root(root, c), which is declared beside CaseType, reads all other members, and throws
/// Error(kBadInput) with the file, the line, the key, its value and what is allowed.
template <class CaseType>
CaseType case_of_root(const TomlSection& root, std::string_view text,
                      const std::filesystem::path& path) {
  CaseType c;
  c.text = text;
  c.path = path;
  read_root(root, c);
  return c;
}

/// Sections whose keys `sweep --vary` may set although the case file leaves the section out,
/// because all of its keys have defaults.
template <class CaseType>
std::vector<std::string_view> sections_with_defaults() {
  return {};
}

/// Throws the errors of case_of_root() and read_toml_file().
template <class CaseType>
CaseType read_case_file(const std::filesystem::path& path) {
  const auto file = read_toml_file(path);
  return case_of_root<CaseType>(file.root, file.text, path);
}

/// A case file that is read once, and from which many cases with other numbers are made. Several
/// threads may make cases at once.
template <class CaseType>
class CaseTemplate {
 public:
  /// Throws Error(kBadInput) if the file cannot be read or is not valid TOML.
  explicit CaseTemplate(const std::filesystem::path& path)
      : path_(path), file_(read_toml_file(path, sections_with_defaults<CaseType>())) {}

  const std::filesystem::path& path() const { return path_; }  ///< as the constructor was given it
  const std::string& text() const { return file_.text; }

  /// The case with these numbers at these keys, such as "fluid.viscosity" or
  /// "motion.external_force[0].value"; of two numbers at one key the later one counts. Throws the
  /// errors of case_of_root(), and Error(kBadInput) for a key that the case cannot have.
  CaseType with(std::span<const std::pair<std::string, double>> numbers) const {
    return case_of_root<CaseType>(root_with(numbers), file_.text, path_);
  }

  /// The root table of this case. Throws Error(kBadInput) for a key whose table is missing or whose
  /// value is not a number.
  TomlSection root_with(std::span<const std::pair<std::string, double>> numbers) const {
    return file_.root.with_numbers(numbers);
  }

 private:
  std::filesystem::path path_;
  TomlFile file_;
};

}  // namespace viscontact::case_file
