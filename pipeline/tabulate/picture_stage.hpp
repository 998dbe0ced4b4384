// `viscontact tabulate --plot`: pictures (SVG) and VTK files of the flow around the sphere for
// chosen gaps. Gaps [L] and velocities [L/T] are in the units of the case. A number that is not a
// gap of the case throws Error(kBadInput), a failure of FreeFEM or gnuplot Error(kExternalProgram).
// A change must keep the names of the files, which contain the gap. Used by app/.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// The gaps of the case that the numbers `asked` [L] mean, in the same order. A number means the
/// nearest gap, from which it may differ by at most 1e-6 of that gap, because names of files have
/// seven digits. If `asked` is empty, the result is the smallest, the middle and the largest gap,
/// without repetition. The tabulation must have at least one gap (not checked). Throws
/// Error(kBadInput), which names the nearest gap, for a number that is not a gap of the case.
std::vector<double> gaps_to_picture(const freefem_axi::Tabulation& tabulation,
                                    const std::vector<double>& asked);

/// The folder for the pictures of a table, beside the table: table.plots for table.csv.
std::filesystem::path picture_folder(const std::filesystem::path& table_path);

/// Throws Error(kBadInput) if a picture of these gaps in `folder` would replace a file that
/// Viscontact did not write, or one of another kind. Must be called before the long tabulation.
void check_pictures(const std::vector<double>& gaps, const std::filesystem::path& folder);

/// Solves the flow again for each of these gaps (> 0) at the first reference velocity of the
/// tabulation, and writes into `folder` pictures of the mesh, of the flow and of the flow in the
/// gap (gap_GAP_mesh.svg, gap_GAP_flow.svg, gap_GAP_film.svg), and the flow as gap_GAP.vtu.
/// `motion` is that of the sphere in the table, and `case_file` contains the tabulation. Throws
/// Error(kExternalProgram) if FreeFEM or gnuplot fails or is missing, Error(kBadInput) if
/// `case_file` cannot be read or a file cannot be written, Error(kInterrupted) if `stop` requests a
/// stop. Files of earlier gaps are then kept, and the .vtu of the gap if only gnuplot failed.
void picture_stage(const freefem_axi::Tabulation& tabulation, lubrication::MotionKind motion,
                   const std::vector<double>& gaps, const std::filesystem::path& folder,
                   const std::filesystem::path& case_file, const StopToken& stop);

}  // namespace viscontact::pipeline
