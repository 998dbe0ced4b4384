// report.html: one self-contained page with what a run found.
#pragma once

#include <filesystem>
#include <vector>

namespace viscontact {

/// Writes report.html into a run's folder from its case, fit, trajectories and comparison (and
/// table, if there is one), and its plots into plots/. If gnuplot cannot be run, the report is written
/// without its still pictures and without plots/, and a warning says so: the plots that the browser
/// draws need no gnuplot. Throws Error(kBadInput) if an input is missing or wrong, or as
/// check_report_files; Error(kExternalProgram) if gnuplot fails, after the report was written likewise.
/// `given`: the user's files from which the same command made the folder's; empty if the folder's are the user's.
void write_report(const std::filesystem::path& folder,
                  const std::vector<std::filesystem::path>& given = {});

/// Throws Error(kBadInput) if the report or one of its plots would replace or delete a file that
/// Viscontact did not write.
void check_report_files(const std::filesystem::path& folder);

/// True if the folder's report and its plots are there, made from what the report's inputs still are.
/// A report without still pictures is never current: gnuplot may be there now.
bool report_is_current(const std::filesystem::path& folder);

}  // namespace viscontact
