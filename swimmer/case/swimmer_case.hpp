// The case of a swimmer: spheres on a line and their strokes (docs/case-file.md).
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/case_file/case_template.hpp"
#include "viscontact/swimmer/optimal_stroke.hpp"
#include "viscontact/swimmer/resistance/resistance_table.hpp"
#include "viscontact/swimmer/stroke.hpp"
#include "viscontact/swimmer/tabulation/collinear_spheres.hpp"

namespace viscontact::swimmer {

/// A case of spheres on a line, connected by arms that change their lengths. Lengths, masses and
/// times are in any consistent units.
struct SwimmerCase {
  std::string title;  ///< a title for pages; may be empty
  Units units{};      ///< units of the numbers, in words for pages; may be empty
  /// The spheres, and the fluid and container for which their resistances are tabulated.
  CollinearSpheres spheres;
  /// The file of the table that the case names; nothing if the table is to be computed.
  std::optional<std::filesystem::path> table_file{};
  /// The table in that file, scaled to `spheres`; without rows if the table is to be computed.
  ResistanceTable table{};
  /// For each arm, in the order of the spheres, the gaps of the table between its two spheres [L],
  /// > 0, rising: from 3 to 200 of them if the table is to be computed.
  std::vector<std::vector<double>> gaps;
  /// The stroke that the swimmer makes; nothing if the file has no section [stroke].
  std::optional<Stroke> stroke;
  /// What the stroke of least energy must achieve; nothing if the file has no section [optimal].
  std::optional<OptimalStrokeRequest> optimal;
  double optimal_period = 1;  ///< period of the optimal stroke [T], > 0
  std::string text;
  std::filesystem::path path;
  std::vector<std::filesystem::path> stroke_files;
};

/// Reads a case file, and the files of a table and a stroke that it names. Throws Error(kBadInput)
/// that names the file, the line, the key, the value and what is allowed.
SwimmerCase read_swimmer_case(const std::filesystem::path& path);

/// Reads a case from the root table of its file. Throws the errors of read_swimmer_case().
void read_root(const case_file::TomlSection& root, SwimmerCase& c);

/// The case file and the files of tables and strokes that it names.
std::vector<std::filesystem::path> files_of(const SwimmerCase& c);

/// The tables in docs/case-file.md with the keys of each section.
std::vector<case_file::KeyTable> tables_of_swimmer_case();

}  // namespace viscontact::swimmer
