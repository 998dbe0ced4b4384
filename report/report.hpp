// report.html: one page with the results of a run of one sphere, in the units of the case. The
// commands `run` and `report` call it. Inputs that are missing or wrong throw Error(kBadInput); a
// missing gnuplot is only a warning. A change must keep that the page loads nothing from elsewhere,
// and that folders of earlier versions can be read.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/report/page.hpp"

namespace viscontact::report {

/// Writes report.html into the folder of a run from its case, fit, trajectories, comparison and
/// table (if there is one), and its plots into plots/. `given` are the files of the user from which
/// the same command made the files in the folder; it is empty if the user gave the files in the
/// folder. If gnuplot cannot be run, the user is warned, and there are no still pictures and no
/// files in plots/; browsers draw the plots without gnuplot. Throws Error(kBadInput) if an input is
/// missing or wrong or a file cannot be written, the error of the constructor of Report,
/// Error(kWrongUsage) if the variable SOURCE_DATE_EPOCH is no time, Error(kExternalProgram) if
/// gnuplot fails, after the report is written without still pictures, and Error(kInterrupted) if
/// `stop` requests a stop.
void write_report(const std::filesystem::path& folder,
                  const std::vector<std::filesystem::path>& given = {}, const StopToken& stop = {});

/// The names of all plots of the report (Report).
inline constexpr auto kPlotNames = std::to_array<std::string_view>(
    {"thinnest_film", "gap", "gap_logarithmic", "external_force", "lubrication_force", "gamma",
     "solid_force", "fit", "uncertainty"});

}  // namespace viscontact::report
