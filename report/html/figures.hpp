// The frame of a report's page, and its figures: plots that can be zoomed, with still pictures for
// browsers without scripts and for printing.
#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/report/report_plot.hpp"

namespace viscontact::report {

struct Picture {
  Plot plot;
  std::string svg;  ///< empty if it could not be drawn
};

/// Draws all plots at the same time, each in a process of gnuplot, because most of the time of such
/// a process is its start. If one plot cannot be drawn, all pictures are returned without an SVG,
/// and `failure` is the reason.
std::vector<Picture> draw_pictures(std::vector<Plot> plots, std::exception_ptr& failure,
                                   const StopToken& stop);

/// A picture as HTML: the data from which panels.js draws a plot that can be zoomed, and the still
/// picture with a link to plots/NAME.svg.
std::string figure(const Picture& picture);

/// The beginning of a page, up to its heading. The page loads nothing from elsewhere.
std::string page_head(std::string_view title);

/// How the plots can be used, and why they are missing if they are.
std::string hints_about(const std::vector<Picture>& pictures);

/// The scripts and the end of a page.
std::string page_foot();

/// Warns if gnuplot is missing; throws Error(kExternalProgram) if gnuplot failed. Called after a
/// report without still pictures is written.
void warn_of_missing_pictures(const std::exception_ptr& failure);

}  // namespace viscontact::report
