// The pictures of a swimmer's report. Lengths, masses and times are in the units of the case.
#pragma once

#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/report/report_plot.hpp"
#include "viscontact/report/swimmer/swimmer_results.hpp"

namespace viscontact::report {

/// The loops in the plane of the arms, over the displacement of a small loop there per area
/// (displacement_curl), as an SVG. Only for two arms. Throws as draw_svg does.
std::string draw_loops(const SwimmerResults& results, const StopToken& stop);

/// Position of the middle sphere, arms, power and forces over time, for each stroke that there is,
/// and the convergence of the optimal one.
std::vector<Plot> swimmer_plots(const SwimmerResults& results);

}  // namespace viscontact::report
