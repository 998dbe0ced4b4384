// Writes the report: tables, warnings, plots and provenance. gnuplot draws the plots as still
// pictures, and report/page/panels.js draws them so that they can be zoomed. kPlotNames must
// contain the name of every plot, because it decides which files in plots/ may be replaced or
// removed.
#include "viscontact/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/report/html/page.hpp"
#include "viscontact/report/html/report_tables.hpp"
#include "viscontact/report/report_plots.hpp"
#include "viscontact/report/report_warnings.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_results.hpp"

namespace viscontact::report {
namespace {

constexpr auto kPlotNames =
    std::to_array<std::string_view>({"thinnest_film", "gap", "gap_logarithmic", "external_force",
                                     "gamma", "solid_force", "fit", "uncertainty"});

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

std::string warnings_of_run(const results::RunResults& run) {
  std::vector<std::string> items;
  for (const auto& warning : warnings_of(run))
    items.push_back(
        fmt::format("{} ({}).", escaped(warning.text), link_to(run.folder, warning.file)));
  if (!items.empty()) return warnings_box(items);
  return fmt::format(
      "<p class=fine>No warnings: all gaps are within the fitted interval, residuals are at most "
      "{:g}, the table is as accurate as asked, no sphere goes through the plane, and all files "
      "belong together.</p>\n",
      kPoorFit);
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

std::string sections_of(const results::RunResults& run, const Report& report) {
  return section("Models", models_table(run) + report.figures({"thinnest_film"})) +
         section("Trajectories", report.figures({"gap", "gap_logarithmic", "external_force"})) +
         section("Contact", report.figures({"gamma", "solid_force"})) +
         section("Rebounds", rebounds_table(run)) + section("Impulse and work", budget_table(run)) +
         section("Lubrication force and fit", report.figures({"fit"}) + fit_table(run)) +
         section("How errors of the fit change the motion",
                 uncertainty_words(run) + report.figures({"uncertainty"})) +
         section("Parameters", parameters_table(run)) +
         section("How it was made", origin_section(run));
}

}  // namespace

void check_report_files(const std::filesystem::path& folder) { (void)Report(folder, kPlotNames); }

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
  Report report(folder, kPlotNames);
  const auto run = results::read_run(folder);
  const auto files = results::files_of(run);
  const auto provenance = results::provenance_of(given.empty() ? results::Inputs{files, {}}
                                                               : results::Inputs{given, files});
  report.draw(plots_of(run), stop);
  report.write(run.c.title, summary(run) + warnings_of_run(run), sections_of(run, report),
               provenance);
}

}  // namespace viscontact::report
