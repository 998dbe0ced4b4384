// Draws plots and writes the frame of a page (figures.hpp). report/page/panels.js reads the data of
// the figures.
#include "viscontact/report/html/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/on_one_line.hpp"
#include "viscontact/report/html/html.hpp"
#include "viscontact/report/page_texts.hpp"
#include "viscontact/report/pictures/gnuplot.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::report {

std::vector<Picture> draw_pictures(std::vector<Plot> plots, std::exception_ptr& failure,
                                   const StopToken& stop) {
  std::vector<std::future<std::string>> drawings;
  for (const auto& plot : plots)
    drawings.push_back(
        std::async(std::launch::async, [&plot, &stop] { return svg_of(plot, stop); }));
  std::vector<std::string> drawn;
  try {
    for (auto& drawing : drawings) drawn.push_back(drawing.get());
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kExternalProgram) throw;
    failure = std::current_exception();
    drawn.assign(plots.size(), "");
  }
  for (auto& drawing : drawings)
    if (drawing.valid()) drawing.wait();  // the drawing refers to its plot, which is moved below
  std::vector<Picture> pictures;
  for (std::size_t i = 0; i < plots.size(); ++i)
    pictures.push_back({std::move(plots[i]), std::move(drawn[i])});
  return pictures;
}

std::string figure(const Picture& picture) {
  const auto& name = picture.plot.name;
  const std::string caption =
      picture.svg.empty()
          ? ""
          : fmt::format("<figcaption><a href=\"plots/{0}.svg\">plots/{0}.svg</a></figcaption>",
                        name);
  return fmt::format(
      "<figure data-plot=\"{0}\">\n<div class=still>{1}</div>\n"
      "<script type=\"application/json\">{2}</script>\n"
      "{3}</figure>\n",
      name, picture.svg, json_of(picture.plot), caption);
}

std::string page_head(std::string_view title) {
  // The Content-Security-Policy forbids the browser to load anything from elsewhere.
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n"
      "<meta name=viewport content=\"width=device-width,initial-scale=1\">\n"
      "<meta http-equiv=Content-Security-Policy content=\"default-src 'none'; style-src "
      "'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n"
      "<title>{0}</title>\n<style>\n{1}{2}</style></head>\n<body>\n<h1>{0}</h1>\n",
      escaped(title), uplot_style(), report_style());
}

std::string hints_about(const std::vector<Picture>& pictures) {
  std::string text =
      "<p class=hint>Drag in a plot to zoom; double-click or tap twice to see the whole plot "
      "again. "
      "The values at the pointer are shown beside the legend.</p>\n";
  if (std::ranges::any_of(pictures, [](const Picture& picture) { return picture.svg.empty(); }))
    text +=
        "<p class=fine>gnuplot was missing or failed when this page was made. The page therefore "
        "has no still pictures, and prints and browsers without JavaScript show no plots. Install "
        "gnuplot (<code>apt-get install gnuplot-nox</code>) and make the report again.</p>\n";
  return text;
}

std::string page_foot() {
  return fmt::format(
      "<footer>Made by Viscontact {}. Plots on this page by uPlot.</footer>\n"
      "<!-- uPlot:\n{} -->\n<script>\n{}</script>\n<script>\n{}</script>\n</body></html>\n",
      VISCONTACT_VERSION, uplot_licence(), uplot_script(), report_script());
}

void warn_of_missing_pictures(const std::exception_ptr& failure) {
  constexpr const char* kWritten =
      "the report is written, without still pictures and without the files in plots/";
  try {
    std::rethrow_exception(failure);
  } catch (const GnuplotMissing& missing) {
    terminal::warn(fmt::format("report: warning: {}; {}", on_one_line(missing.what()), kWritten));
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}; {}", on_one_line(error.what()), kWritten));
  }
}

}  // namespace viscontact::report
