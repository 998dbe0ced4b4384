// Writes the report: tables, warnings, plots and provenance. gnuplot draws the plots as still
// pictures, and report/page/panels.js draws them so that they can be zoomed. kPlotNames must
// contain the name of every plot, because it decides which files in plots/ may be replaced or
// removed.
#include "viscontact/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <future>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/on_one_line.hpp"
#include "viscontact/report/html/html.hpp"
#include "viscontact/report/html/report_tables.hpp"
#include "viscontact/report/page_texts.hpp"
#include "viscontact/report/pictures/gnuplot.hpp"
#include "viscontact/report/report_plots.hpp"
#include "viscontact/report/report_warnings.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_results.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::report {
namespace {

constexpr auto kPlotNames =
    std::to_array<std::string_view>({"thinnest_film", "gap", "gap_logarithmic", "external_force",
                                     "gamma", "solid_force", "fit", "uncertainty"});

struct Picture {
  Plot plot;
  std::string svg;  ///< empty if it could not be drawn
};

constexpr std::string_view kStillPicture = "<div class=still><svg";

std::vector<Plot> plots_of(const results::RunResults& run) {
  const auto& motion = case_file::required_motion(run.c);
  // Below the fit's interval, the lubrication limit is always used here, because only pictures
  // depend on it, and a trajectory goes below the interval only if the user has allowed a limit
  // there.
  const lubrication::LubricationForce force(run.fit,
                                            {lubrication::BelowInterval::kLubricationLimit});
  std::vector<Plot> plots = {plot_minimal_gaps(run.comparison, run.c.published),
                             plot_gaps(run.trajectories),
                             plot_gaps_logarithmic(run.trajectories, motion, force),
                             plot_external_force(motion.external_force, motion.end_time),
                             plot_gamma(run.trajectories),
                             plot_solid_force(run.trajectories)};
  if (run.table) plots.push_back(plot_fit(*run.table, run.fit));
  if (run.uncertainty && run.uncertainty->misfit > 0)
    plots.push_back(plot_uncertainty(*run.uncertainty));
  std::erase_if(plots, [](const Plot& plot) { return !shows_something(plot); });
  return plots;
}

/// Draws all plots at the same time, each in a process of gnuplot, because most of the time of such
/// a process is its start. If one plot cannot be drawn, all pictures are returned without an SVG,
/// and `failure` is the reason.
std::vector<Picture> draw(std::vector<Plot> plots, std::exception_ptr& failure,
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

/// The pictures with these names as HTML. Each has the data from which panels.js draws a plot that
/// can be zoomed, and a still picture for browsers without scripts and for printing.
std::string figures(const std::vector<Picture>& pictures,
                    std::initializer_list<std::string_view> names) {
  std::string text;
  for (const auto name : names)
    for (const auto& picture : pictures)
      if (picture.plot.name == name)
        text += fmt::format(
            "<figure data-plot=\"{0}\">\n<div class=still>{1}</div>\n"
            "<script type=\"application/json\">{2}</script>\n"
            "{3}</figure>\n",
            name, picture.svg, json_of(picture.plot),
            picture.svg.empty()
                ? ""
                : fmt::format(
                      "<figcaption><a href=\"plots/{0}.svg\">plots/{0}.svg</a></figcaption>",
                      name));
  return text;
}

std::string warnings_box(const results::RunResults& run) {
  const auto warnings = warnings_of(run);
  if (warnings.empty())
    return fmt::format(
        "<p class=fine>No warnings: all gaps are within the fitted interval, residuals are at most "
        "{:g}, the table is as accurate as asked, no sphere goes through the plane, and all files "
        "belong together.</p>\n",
        kPoorFit);
  std::string items;
  for (const auto& warning : warnings)
    items += fmt::format("<li>{} ({}).</li>\n", escaped(warning.text),
                         link_to(run.folder, warning.file));
  return fmt::format("<section class=warnings>\n<h2>Warnings</h2>\n<ul>\n{}</ul></section>\n",
                     items);
}

std::string summary(const results::RunResults& run) {
  const auto& comparison = run.comparison;
  const auto reference = std::ranges::find(comparison.models, comparison.reference_model,
                                           &reduced_model::ModelComparison::model);
  std::string text = fmt::format(
      "<p class=summary>{} model{} of motion of one sphere{}, compared with <code>{}</code>",
      comparison.models.size(), comparison.models.size() == 1 ? "" : "s",
      run.table && !run.table->geometry.empty() ? ", geometry: " + escaped(run.table->geometry)
                                                : "",
      escaped(comparison.reference_model));
  if (reference != comparison.models.end())
    text += fmt::format(
        ", whose smallest gap is <strong>{}</strong> at time {:.5g}",
        link_to(run.folder, "comparison.json", fmt::format("{:.5g}", reference->minimal_gap)),
        reference->minimal_gap_time);
  return text + ".</p>\n";
}

std::string page_of(const results::RunResults& run, const std::vector<Picture>& pictures) {
  // The Content-Security-Policy forbids the browser to load anything from elsewhere.
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n"
      "<meta name=viewport content=\"width=device-width,initial-scale=1\">\n"
      "<meta http-equiv=Content-Security-Policy content=\"default-src 'none'; style-src "
      "'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n"
      "<title>{0}</title>\n<style>\n{1}{2}</style></head>\n<body>\n<h1>{0}</h1>\n",
      escaped(run.c.title), uplot_style(), report_style());
  page += summary(run) + warnings_box(run);
  page +=
      "<p class=hint>Drag in a plot to zoom; double-click or tap twice to see the whole plot "
      "again. "
      "The values at the pointer are shown beside the legend.</p>\n";
  if (std::ranges::any_of(pictures, [](const Picture& picture) { return picture.svg.empty(); }))
    page +=
        "<p class=fine>gnuplot was missing or failed when this page was made. The page therefore "
        "has no still pictures, and prints and browsers without JavaScript show no plots. Install "
        "gnuplot (<code>apt-get install gnuplot-nox</code>) and make the report again.</p>\n";
  page += section("Models", models_table(run) + figures(pictures, {"thinnest_film"}));
  page += section("Trajectories", figures(pictures, {"gap", "gap_logarithmic", "external_force"}));
  page += section("Contact", figures(pictures, {"gamma", "solid_force"}));
  page += section("Impulse and work", budget_table(run));
  page += section("Lubrication force and fit", figures(pictures, {"fit"}) + fit_table(run));
  page += section("How errors of the fit change the motion",
                  uncertainty_words(run) + figures(pictures, {"uncertainty"}));
  page += section("Parameters", parameters_table(run));
  page += section("How it was made", origin_section(run));
  page += fmt::format(
      "<footer>Made by Viscontact {}. Plots on this page by uPlot.</footer>\n"
      "<!-- uPlot:\n{} -->\n<script>\n{}</script>\n<script>\n{}</script>\n</body></html>\n",
      VISCONTACT_VERSION, uplot_licence(), uplot_script(), report_script());
  return page;
}

/// Warns if gnuplot is missing; throws Error(kExternalProgram) if gnuplot failed. Called after a
/// report without still pictures is written.
void warn_or_throw(const std::exception_ptr& failure) {
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

}  // namespace

void check_report_files(const std::filesystem::path& folder) {
  const results::RunFolder run{folder};
  results::refuse_other_kind(run.report(), "id=\"provenance\"", "report");
  for (const auto name : kPlotNames)
    results::refuse_other_kind(run.plot(std::string(name)), "<svg", "picture");
}

bool report_is_current(const std::filesystem::path& folder) {
  const results::RunFolder run{folder};
  try {
    if (!std::filesystem::exists(run.report())) return false;
    const auto page = read_file(run.report());
    if (page.find(kStillPicture) == std::string::npos) return false;
    const auto provenance = results::provenance_in(page, run.report().string());
    if (!provenance) return false;
    // Pipes (without a hash) are skipped, because their content is in the copy of the case.
    for (const auto& input : provenance->inputs)
      if (!input.sha256.empty() && !results::change_of(input, provenance->folder).empty())
        return false;
    return std::ranges::all_of(kPlotNames, [&](std::string_view name) {
      return page.find(fmt::format("\"plots/{}.svg\"", name)) == std::string::npos ||
             std::filesystem::exists(run.plot(std::string(name)));
    });
  } catch (const Error&) {
    return false;
  }
}

void write_report(const std::filesystem::path& folder,
                  const std::vector<std::filesystem::path>& given, const StopToken& stop) {
  check_report_files(folder);
  const auto run = results::read_run(folder);
  const auto files = results::files_of(run);
  const auto provenance = results::provenance_of(given.empty() ? results::Inputs{files, {}}
                                                               : results::Inputs{given, files});
  std::exception_ptr failure;
  auto pictures = draw(plots_of(run), failure, stop);
  const auto page = page_of(run, pictures);
  std::erase_if(pictures, [](const Picture& picture) { return picture.svg.empty(); });
  for (const auto& [plot, svg] : pictures)
    results::write_output(run.folder.plot(plot.name), TextKind::kSvg, svg, provenance);
  results::write_output(run.folder.report(), TextKind::kHtml, page, provenance);
  // Plots of an earlier report that this report does not have are removed.
  for (const auto name : kPlotNames)
    if (std::ranges::find(pictures, name, [](const Picture& p) { return p.plot.name; }) ==
        pictures.end())
      remove_file(run.folder.plot(std::string(name)));
  terminal::say(fmt::format("report: {}", run.folder.report().string()));
  if (failure) warn_or_throw(failure);
}

}  // namespace viscontact::report
