// The pictures of `viscontact tabulate --plot`: the flow around the sphere for chosen gaps, as SVG
// and VTK files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// The gaps of the case that the numbers `asked` [L] mean, in the same order. A number means the
/// nearest gap of the case, and may differ from it by at most 1e-6 of the gap, because names of
/// files have seven digits. If `asked` is empty, the result is the smallest, the middle and the
/// largest gap, without repetition, increasing. Throws Error(kBadInput), which names the nearest
/// gap, for a number that is not a gap of the case.
std::vector<double> gaps_to_picture(const freefem_axi::Tabulation& tabulation,
                                    const std::vector<double>& asked);

/// The folder for the pictures of a table, beside the table: table.plots for table.csv.
std::filesystem::path picture_folder(const std::filesystem::path& table_path);

/// Throws Error(kBadInput) if a picture of these gaps in `folder` would replace a file that
/// Viscontact did not write, or one of another kind. Must be called before the long tabulation.
void check_pictures(const std::vector<double>& gaps, const std::filesystem::path& folder);

/// Solves the flow again for each of these gaps at the first reference velocity of the tabulation,
/// and writes into `folder` pictures of the mesh, of the flow and of the flow in the gap
/// (gap_GAP_mesh.svg, gap_GAP_flow.svg, gap_GAP_film.svg), and the flow as gap_GAP.vtu. `motion` is
/// the motion of the sphere in the table, such as approach or roll. Throws Error(kExternalProgram)
/// if FreeFEM or gnuplot fails or is missing, Error(kBadInput) if `case_file` cannot be read or a
/// file cannot be written, Error(kWrongUsage) if the environment variable
/// VISCONTACT_FREEFEM_TIME_LIMIT is not a whole number of seconds, and Error(kInterrupted) at a
/// stop. After an error, the files that are complete are kept.
void picture_stage(const freefem_axi::Tabulation& tabulation, lubrication::MotionKind motion,
                   const std::vector<double>& gaps, const std::filesystem::path& folder,
                   const std::filesystem::path& case_file, const StopToken& stop);

}  // namespace viscontact::pipeline
