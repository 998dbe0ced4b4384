// The sections of the report of a run of one sphere, as pieces of HTML.
#include "viscontact/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/report/run_plots.hpp"
#include "viscontact/report/run_warnings.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_results.hpp"

namespace viscontact::report {
namespace {

/// How well the fit predicts rows of the table that it did not use, as HTML. Empty if this is not
/// known.
std::string trust(const lubrication::FitDiagnostics& d) {
  std::string text;
  if (d.leave_one_out_rms)
    text += fmt::format("Each row predicted from the others: root mean square {:.3g}",
                        *d.leave_one_out_rms);
  if (d.left_out_inner)
    text += fmt::format(", between the rows at worst {:.3g} at gap {:.4g}",
                        d.left_out_inner->relative_residual, d.left_out_inner->gap);
  if (d.left_out_end)
    text += fmt::format(", beyond an end (an extrapolation) {:.3g} at gap {:.4g}",
                        d.left_out_end->relative_residual, d.left_out_end->gap);
  if (d.leave_one_out_rms) text += ". ";
  if (d.chi_squared)
    text += fmt::format(
        "Chi-squared against the table's error estimates: {:.3g} for {} degrees of freedom{}.",
        *d.chi_squared, d.degrees_of_freedom,
        d.misfit == lubrication::Misfit::kBasis
            ? ": the basis causes the misfit, but the standard errors treat it as noise"
            : "");
  if (!text.empty()) text = "<p>" + text + "</p>\n";
  for (const auto& outlier : d.outliers)
    text += fmt::format(
        "<p>Outlier at gap {:.6g}: the relative difference of the fit is {:+.2g}.</p>\n",
        outlier.gap, outlier.relative_residual);
  return text;
}

std::string model_link(const results::RunResults& run, const std::string& model) {
  return link_to(run.folder, trajectory_name(model), model);
}

/// Where the drag comes from, and the gaps [L] for which it is known, in words.
std::string drag_in_words(const results::RunResults& run) {
  const lubrication::Fit& fit = run.fit;
  if (fit.terms.empty()) return "Brenner's exact series; nothing is fitted";
  return fmt::format("{}, gaps from {:.4g} to {:.4g}",
                     fit.table_sha256.empty() ? "a given fit" : "a fit", fit.gap_interval[0],
                     fit.gap_interval[1]);
}

/// The command as a user would type it in a shell.
std::string command_line(const std::vector<std::string>& words) {
  std::string line;
  for (const auto& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

/// The record of how the file was made; nothing if it is missing or damaged.
std::optional<results::Provenance> provenance_or_none(const std::filesystem::path& path) {
  try {
    return results::read_provenance(path);
  } catch (const Error&) {
    return {};
  }
}

std::string hash_cell(const std::string& sha256) {
  return "<code class=hash>" + escaped(sha256) + "</code>";
}

std::string parameters_table(const results::RunResults& run) {
  const case_file::Case& c = run.c;
  const auto& motion = case_file::required_motion(c);
  std::string rows;
  const auto add = [&](std::string_view name, const std::string& value,
                       std::string_view dimension) {
    rows += table_row(name, value, c.units.in_place_of_dimensions(std::string(dimension)));
  };
  const auto number = [](double value) { return fmt::format("{}", value); };
  add("viscosity", number(c.viscosity), "M L<sup>-1</sup> T<sup>-1</sup>");
  add("radius of the sphere", number(c.radius), "L");
  if (c.density > 0) add("density of the sphere", number(c.density), "M L<sup>-3</sup>");
  add("mass", number(motion.mass), "M");
  if (c.fluid_density > 0) add("density of the fluid", number(c.fluid_density), "M L<sup>-3</sup>");
  if (c.gravity) add("gravity along the normal", number(*c.gravity), "L T<sup>-2</sup>");
  add("initial gap", number(motion.initial_gap), "L");
  add("initial velocity", number(motion.initial_velocity), "L T<sup>-1</sup>");
  add("end time", number(motion.end_time), "T");
  add("roughness of sphere and plane",
      fmt::format("{}, {}", motion.roughness[0], motion.roughness[1]), "L");
  for (const auto& parameter : reduced_model::model_parameters())
    add(parameter.description, number(motion.parameter(parameter)), parameter.dimension);
  add("external force", link_to(run.folder, "plots/external_force.svg", "over time"),
      "M L T<sup>-2</sup>");
  if (run.table) {
    add("geometry", escaped(run.table->geometry), "L");
    add("container", escaped(run.table->container), "L");
  }
  add("lubrication force", link_to(run.folder, "fit.json", drag_in_words(run)), "");
  if (c.tabulation && run.table)
    add("accuracy asked of the table",
        link_to(run.folder, "table.csv", fmt::format("{:g}", c.tabulation->relative_accuracy)),
        "1");
  const bool has_units = c.units.are_said();
  return fmt::format("<p>From {}. {}.</p>\n", link_to(run.folder, "case.toml"),
                     has_units ? "Units are those of the case; nothing is converted"
                               : "Any coherent system of units: M mass, L length, T time") +
         table_of(rows, headings({"parameter", "value", has_units ? "unit" : "dimension"}));
}

/// The unit, such as " [m/s]", of a quantity with these powers of mass, length and time, for a
/// heading. Empty if the case says no units.
std::string in_brackets(const results::RunResults& run, int mass, int length, int time) {
  return escaped(run.c.units.in_brackets(mass, length, time));
}

std::string models_table(const results::RunResults& run) {
  std::string rows;
  for (const auto& model : run.comparison.models)
    rows += table_row(
        model_link(run, model.model), fmt::format("{:.6g}", model.minimal_gap),
        fmt::format("{:.5g}", model.minimal_gap_time),
        model.film_from_gamma ? fmt::format("{:.6g}", *model.film_from_gamma) : "&ndash;",
        model.contact_interval ? fmt::format("{:.4g} to {:.4g}", (*model.contact_interval)[0],
                                             (*model.contact_interval)[1])
                               : "&ndash;",
        model.solid_contact_from ? fmt::format("{:.6g} at {:.4g}", model.solid_contact_from->time,
                                               model.solid_contact_from->velocity)
                                 : "&ndash;",
        fmt::format("{:.3g}", model.sup_gap_distance), fmt::format("{:.3g}", model.l1_gap_distance),
        fmt::format("{:.3g}", model.l1_velocity_distance),
        model.reynolds_number ? fmt::format("{:.3g}", *model.reynolds_number) : "&ndash;",
        model.stokes_number ? fmt::format("{:.3g}", *model.stokes_number) : "&ndash;");
  for (const auto& failed : run.comparison.failed_models)
    rows += fmt::format("<tr><td>{}</td><td colspan=10>failed: {}</td></tr>\n",
                        escaped(failed.model), escaped(failed.reason));
  const auto head = fmt::format(
      "<tr><th rowspan=2>model</th><th rowspan=2>smallest gap{1}</th><th rowspan=2>at time{2}</th>"
      "<th rowspan=2>film from gamma{1}</th><th rowspan=2>in contact{2}</th>"
      "<th rowspan=2>solids touch{2}, at the velocity{3}</th>"
      "<th colspan=3 class=group>distance to {0}</th><th rowspan=2>largest Reynolds number</th>"
      "<th rowspan=2>largest Stokes number</th></tr>\n{4}",
      escaped(run.comparison.reference_model), in_brackets(run, 0, 1, 0), in_brackets(run, 0, 0, 1),
      in_brackets(run, 0, 1, -1),
      headings({"max |q &minus; q<sub>ref</sub>|", "&int; |q &minus; q<sub>ref</sub>| dt",
                "&int; |u &minus; u<sub>ref</sub>| dt"}));
  return table_of(rows, head) + source(link_to(run.folder, "comparison.json") +
                                       "; each model's name leads to its trajectory");
}

std::string gap_times_table(const results::RunResults& run) {
  std::string rows;
  for (const auto& model : run.comparison.models)
    for (const auto& of : model.gap_times)
      rows += table_row(model_link(run, model.model), fmt::format("{:.6g}", of.gap),
                        of.time ? fmt::format("{:.8g}", *of.time) : "never");
  if (rows.empty()) return "";
  return table_of(rows, headings({"model", "gap" + in_brackets(run, 0, 1, 0),
                                  "first reached at time" + in_brackets(run, 0, 0, 1)})) +
         source(link_to(run.folder, "comparison.json") +
                ". In contact, the gap of a contact model is the film from gamma");
}

std::string rebounds_table(const results::RunResults& run) {
  std::string rows;
  for (const auto& model : run.comparison.models)
    for (std::size_t n = 0; n < model.rebounds.size(); ++n) {
      const auto& of = model.rebounds[n];
      rows += table_row(model_link(run, model.model), fmt::format("{}", n + 1),
                        fmt::format("{:.6g}", of.time), fmt::format("{:.5g}", of.approach_velocity),
                        fmt::format("{:.5g}", of.solid_impulse), fmt::format("{:.5g}", of.velocity),
                        fmt::format("{:.5g}", of.coefficient));
    }
  if (rows.empty()) return "";
  const auto velocity = in_brackets(run, 0, 1, -1);
  return table_of(rows, headings({"model", "number", "time" + in_brackets(run, 0, 0, 1),
                                  "velocity of approach" + velocity,
                                  "impulse of the solids" + in_brackets(run, 1, 1, -1),
                                  "velocity of rebound" + velocity, "coefficient"})) +
         source(link_to(run.folder, "comparison.json") +
                ". The coefficient is that of the velocities where the sphere meets and leaves the "
                "film");
}

std::string budget_table(const results::RunResults& run) {
  std::string rows;
  for (const auto& model : run.comparison.models) {
    if (!model.budget) continue;
    rows += "<tr><td>" + model_link(run, model.model) + "</td>";
    for (const auto& entry : reduced_model::kBudgetEntries)
      rows += fmt::format("<td>{:.5g}</td>", (*model.budget).*entry.value);
    rows += "</tr>\n";
  }
  if (rows.empty()) return "";
  return table_of(rows, fmt::format(
                            "<tr><th rowspan=2>model</th><th colspan=4 class=group>impulse on the "
                            "sphere{}</th><th colspan=4 class=group>work done on it{}</th></tr>\n",
                            in_brackets(run, 1, 1, -1), in_brackets(run, 1, 2, -2)) +
                            headings({"external", "film", "drag", "solid", "external", "film",
                                      "drag", "solid"})) +
         source(link_to(run.folder, "comparison.json"));
}

std::string fit_table(const results::RunResults& run) {
  const lubrication::Fit& fit = run.fit;
  if (fit.terms.empty())
    return "<p>The exact drag of a sphere near a plane in a half-space (Brenner 1961): nothing is "
           "fitted.</p>\n";
  std::string rows;
  for (const auto& term : fit.terms)
    rows += table_row(escaped(term.name), fmt::format("{:.8g}", term.coefficient),
                      term.is_fixed ? "fixed" : fmt::format("{:.2g}", term.standard_error));
  return fmt::format(
             "<p>F(q) at velocity {}, {} weights: largest relative residual {:.3g}, root mean "
             "square {:.3g}, condition number {:.3g}.</p>\n",
             fit.reference_velocity, lubrication::to_string(fit.weights),
             fit.largest_relative_residual, fit.rms_relative_residual, fit.condition_number) +
         table_of(rows, headings({"term", "coefficient", "standard error"})) +
         source(link_to(run.folder, "fit.json") +
                (run.fit_is_scaled ? ", scaled to the radius and the viscosity of the case" : "") +
                (run.table ? ", the table in " + link_to(run.folder, "table.csv") : "")) +
         (fit.diagnostics ? trust(*fit.diagnostics) : "");
}

std::string uncertainty_words(const results::RunResults& run) {
  if (!run.uncertainty) return "";
  const auto& smallest = run.uncertainty->smallest;
  return fmt::format(
      "<p>Without inertia the smallest gap is {:.6g} at time {:.4g}. Of {} random draws of the "
      "coefficients ({} of them refused), 95 % give a smallest gap in [{:.6g}, {:.6g}]. If the "
      "drag were wrong at every gap by {:.2g} (from the largest residual and the largest error "
      "estimate), the smallest gap would be in [{:.6g}, {:.6g}].</p>\n"
      "<p class=source>From {}.</p>\n",
      smallest.gap, smallest.time, run.uncertainty->draws, run.uncertainty->refused,
      smallest.random[0], smallest.random[1], run.uncertainty->misfit, smallest.misfit[0],
      smallest.misfit[1], link_to(run.folder, "uncertainty.json"));
}

/// Made from the record in each file. If it is missing or damaged, the table says so.
std::string origin_section(const results::RunResults& run) {
  std::string made, inputs;
  auto versions = results::library_versions();
  versions.insert(run.fit.versions.begin(), run.fit.versions.end());
  if (run.table) versions.insert(run.table->versions.begin(), run.table->versions.end());
  std::vector<std::string> files;
  if (run.table) files.emplace_back("table.csv");
  files.emplace_back("fit.json");
  if (!run.trajectories.empty())
    files.push_back("trajectories/" + run.trajectories.front().model + ".csv");
  files.emplace_back("comparison.json");
  for (const auto& file : files) {
    const auto path = run.folder.path / file;
    if (!std::filesystem::exists(path)) continue;
    const auto provenance = provenance_or_none(path);
    made += table_row(
        link_to(run.folder, file),
        provenance ? escaped(provenance->made) : "not recorded, or damaged",
        provenance ? "<code>" + escaped(command_line(provenance->command)) + "</code>" : "",
        hash_cell(sha256(read_file(path))));
    if (!provenance) continue;
    versions.insert(provenance->versions.begin(), provenance->versions.end());
    for (const auto& input : provenance->inputs)
      inputs += table_row(link_to(run.folder, file), escaped(input.file), hash_cell(input.sha256));
  }
  std::string programs;
  for (const auto& [program, version] : versions)
    programs += fmt::format("{}{}&nbsp;{}", programs.empty() ? "" : ", ", escaped(program),
                            escaped(version));
  std::string text = fmt::format(
      "<div class=scroll><table class=words><thead><tr><th>file</th><th>made (UTC)</th><th>by</th>"
      "<th>SHA-256</th></tr></thead><tbody>\n{}</tbody></table></div>\n",
      made);
  if (!inputs.empty())
    text += fmt::format(
        "<div class=scroll><table class=words><thead><tr><th>file</th><th>made from</th>"
        "<th>SHA-256</th></tr></thead><tbody>\n{}</tbody></table></div>\n",
        inputs);
  return text + fmt::format("<p>Programs and libraries: {}.</p>\n", programs);
}

/// Adds the unit to the label of an axis, as in run_plots.cpp, if kDimensions has it and the case
/// says its units.
void add_unit(std::string& label, const Units& units) {
  struct Dimension {
    std::string_view label;
    int mass, length, time;  // powers of the units
  };
  constexpr auto kDimensions = std::to_array<Dimension>({{"time t", 0, 0, 1},
                                                         {"gap q", 0, 1, 0},
                                                         {"gamma", 1, 1, -1},
                                                         {"f", 1, 1, -2},
                                                         {"lubrication force", 1, 1, -2},
                                                         {"force of the solids", 1, 1, -2}});
  const auto* found = std::ranges::find(kDimensions, label, &Dimension::label);
  if (found == kDimensions.end()) return;
  label += units.in_brackets(found->mass, found->length, found->time);
}

/// The plots of the run, without those that have no curves. Throws Error(kBadInput) if the fit or
/// the motion is refused.
std::vector<Plot> plots_of(const results::RunResults& run) {
  const auto& motion = case_file::required_motion(run.c);
  // Below the smallest fitted gap, the drag is continued as k/q + constant with the gap q and the
  // fitted coefficient k. If the case does not allow this, no trajectory reaches such gaps, and
  // only pictures depend on the continued drag.
  const lubrication::LubricationForce force(run.fit,
                                            {lubrication::BelowInterval::kLubricationLimit});
  std::vector<Plot> plots = {plot_minimal_gaps(run.comparison, run.c.published),
                             plot_gaps(run.trajectories),
                             plot_gaps_logarithmic(run.trajectories, motion, force),
                             plot_external_force(motion.external_force, motion.end_time),
                             plot_lubrication_force(run.trajectories),
                             plot_gamma(run.trajectories),
                             plot_solid_force(run.trajectories)};
  if (run.table) plots.push_back(plot_fit(*run.table, run.fit));
  if (run.uncertainty && run.uncertainty->misfit > 0)
    plots.push_back(plot_uncertainty(*run.uncertainty));
  for (auto& plot : plots)
    for (auto& panel : plot.panels)
      for (auto* axis : {&panel.x, &panel.y}) add_unit(axis->label, run.c.units);
  std::erase_if(plots, [](const Plot& plot) {
    return std::ranges::all_of(plot.panels,
                               [](const PlotPanel& panel) { return panel.curves.empty(); });
  });
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
  if (run.c.units.are_said()) text += fmt::format("; units: {}", escaped(run.c.units.words()));
  return text + ".</p>\n";
}

std::string sections_of(const results::RunResults& run, const Report& report) {
  return section("Models",
                 models_table(run) + gap_times_table(run) + report.figures({"thinnest_film"})) +
         section("Trajectories", report.figures({"gap", "gap_logarithmic", "lubrication_force",
                                                 "external_force"})) +
         section("Contact", report.figures({"gamma", "solid_force"})) +
         section("Rebounds", rebounds_table(run)) + section("Impulse and work", budget_table(run)) +
         section("Lubrication force and fit", report.figures({"fit"}) + fit_table(run)) +
         section("How errors of the fit change the motion",
                 uncertainty_words(run) + report.figures({"uncertainty"})) +
         section("Parameters", parameters_table(run)) +
         section("How it was made", origin_section(run));
}

}  // namespace

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
