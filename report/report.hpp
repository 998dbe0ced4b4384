// report.html: one self-contained page with the results of a run of one sphere, in the units of the
// case. `run` and `report` call it. A change must keep that the page loads nothing from elsewhere.
#pragma once

#include <filesystem>
#include <vector>

#include "viscontact/common/stop_token.hpp"

namespace viscontact::report {

/// Writes report.html into a run's folder from its case, fit, trajectories, comparison and table
/// (if there is one), and its plots into plots/. If gnuplot cannot be run, a warning says so, and
/// the report is written without still pictures and without plots/. The plots that the browser
/// draws do not need gnuplot. Throws Error(kBadInput) if an input is missing or wrong, and the
/// error of check_report_files(). If gnuplot fails, throws Error(kExternalProgram) after the report
/// is written without still pictures. `given` are the files of the user from which the same command
/// made the files in the folder; it is empty if the user gave the files in the folder. Throws
/// Error(kInterrupted) if `stop` requests a stop.
void write_report(const std::filesystem::path& folder,
                  const std::vector<std::filesystem::path>& given = {}, const StopToken& stop = {});

/// Throws Error(kBadInput) if the report or one of its plots would replace or delete a file that
/// Viscontact did not write.
void check_report_files(const std::filesystem::path& folder);

/// True if the report and its plots exist and the inputs of the report have not changed since. A
/// report without still pictures is never current, because gnuplot may have been installed since.
bool report_is_current(const std::filesystem::path& folder);

}  // namespace viscontact::report
