// `viscontact tabulate --plot`: pictures of chosen rows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"

namespace viscontact {

/// The case's gaps that `asked` names, in its order: numbers separated by commas, each within 1e-6 of a gap, relatively; nothing: the smallest, the
/// middle and the largest. Throws Error(kWrongUsage) for what is no number, Error(kBadInput) with the nearest gap for a gap that is not there.
std::vector<double> gaps_to_picture(const Tabulation& tabulation, const std::string& asked);

/// The folder of a table's pictures, beside it: table.csv has table.plots/.
std::filesystem::path picture_folder(const std::filesystem::path& table_path);

/// Throws Error(kBadInput) if a picture of those gaps would replace a file that Viscontact did not
/// write. To be called before the tabulation.
void check_pictures(const std::vector<double>& gaps, const std::filesystem::path& folder);

/// Solves those rows again, at the first velocity, and writes of each gap_GAP_mesh.svg, gap_GAP_flow.svg, gap_GAP_film.svg and gap_GAP.vtu. `case_file` is where the tabulation stands.
void picture_stage(const Tabulation& tabulation, const std::vector<double>& gaps,
                   const std::filesystem::path& folder, const std::filesystem::path& case_file);

}  // namespace viscontact
