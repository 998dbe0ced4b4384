// report.html, one page with the results of a run of one sphere.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/report/page.hpp"

namespace viscontact::report {

/// Writes report.html, which loads nothing from elsewhere, and the pictures in plots/ into the
/// folder of a run. Its inputs are the files in the folder: case.toml,
/// fit.json, comparison.json, trajectories/*.csv (at least one) and, if they exist, table.csv and
/// uncertainty.json. `given` are the files of the user from which the same command made these
/// files; it is empty if the user gave the files in the folder. If gnuplot cannot be run, the user
/// is warned, and there are no still pictures and no files in plots/; browsers draw the plots
/// without gnuplot. Throws Error(kBadInput) if an input is missing or wrong, if a file cannot be
/// written, or if report.html or a picture would replace a file that Viscontact did not write.
/// Throws Error(kWrongUsage) if the environment variable SOURCE_DATE_EPOCH is not a time,
/// Error(kInterrupted) if `stop` requests a stop, and Error(kExternalProgram) if gnuplot fails; the
/// report is then written without still pictures.
void write_report(const std::filesystem::path& folder,
                  const std::vector<std::filesystem::path>& given = {}, const StopToken& stop = {});

/// The names of all plots that the report can have; only these files plots/NAME.svg are replaced or
/// removed.
inline constexpr auto kPlotNames = std::to_array<std::string_view>(
    {"thinnest_film", "gap", "gap_logarithmic", "external_force", "lubrication_force", "gamma",
     "solid_force", "fit", "uncertainty"});

}  // namespace viscontact::report
