// The report of a swimmer: a page with pictures and tables.
#pragma once

#include <filesystem>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/report/swimmer/swimmer_results.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::report {

/// Throws Error(kBadInput) if the report would replace a file in `folder` that Viscontact did not
/// write.
void check_swimmer_report(const std::filesystem::path& folder);

/// Writes report.html and plots/NAME.svg into `folder`. If gnuplot is missing, the page has no still
/// pictures, and a warning says so; throws Error(kExternalProgram) if gnuplot fails.
void write_swimmer_report(const SwimmerResults& results, const std::filesystem::path& folder,
                          const results::Provenance& provenance, const StopToken& stop);

}  // namespace viscontact::report
