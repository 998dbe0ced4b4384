// Writes the tables of the report and the sentences beside them (report_tables.hpp), in the units
// of the case. Texts of the user must pass through escaped().
#include "viscontact/report/html/report_tables.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/report/html/page.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/versions.hpp"

namespace viscontact::report {
namespace {

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
  // A fit file of an earlier version has one value for inner rows and end rows together.
  if (d.leave_one_out_rms && !d.left_out_inner && !d.left_out_end)
    text += fmt::format(", largest {:.3g} at gap {:.4g}", d.leave_one_out_largest.value(),
                        d.leave_one_out_gap.value());
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

/// The name of a model as a link to its trajectory.
std::string model_link(const results::RunResults& run, const std::string& model) {
  return link_to(run.folder, "trajectories/" + model + ".csv", model);
}

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

}  // namespace

std::string parameters_table(const results::RunResults& run) {
  const case_file::Case& c = run.c;
  const auto& motion = case_file::required_motion(c);
  std::string rows;
  const auto add = [&](std::string_view name, const std::string& value,
                       std::string_view dimension) { rows += table_row(name, value, dimension); };
  const auto number = [](double value) { return fmt::format("{}", value); };
  add("viscosity", number(c.viscosity), "M L<sup>-1</sup> T<sup>-1</sup>");
  add("radius of the sphere", number(c.radius), "L");
  add("mass", number(motion.mass), "M");
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
  return fmt::format(
      "<p>From {}. Any coherent system of units: M mass, L length, T time.</p>\n"
      "<div class=scroll><table><thead><tr><th>parameter</th><th>value</th><th>dimension</th></tr>"
      "</thead><tbody>\n{}</tbody></table></div>\n",
      link_to(run.folder, "case.toml"), rows);
}

std::string models_table(const results::RunResults& run) {
  std::string rows;
  for (const auto& model : run.comparison.models)
    rows += table_row(
        model_link(run, model.model), fmt::format("{:.6g}", model.minimal_gap),
        fmt::format("{:.5g}", model.minimal_gap_time),
        model.recovered_minimal_gap ? fmt::format("{:.6g}", *model.recovered_minimal_gap)
                                    : "&ndash;",
        model.contact_interval ? fmt::format("{:.4g} to {:.4g}", (*model.contact_interval)[0],
                                             (*model.contact_interval)[1])
                               : "&ndash;",
        fmt::format("{:.3g}", model.sup_gap_distance), fmt::format("{:.3g}", model.l1_gap_distance),
        fmt::format("{:.3g}", model.l1_velocity_distance));
  for (const auto& failed : run.comparison.failed_models)
    rows += fmt::format("<tr><td>{}</td><td colspan=7>failed: {}</td></tr>\n",
                        escaped(failed.model), escaped(failed.reason));
  return fmt::format(
      "<div class=scroll><table><thead><tr><th rowspan=2>model</th><th rowspan=2>smallest gap</th>"
      "<th rowspan=2>at time</th><th rowspan=2>film from gamma</th><th rowspan=2>in contact</th>"
      "<th colspan=3 class=group>distance to {}</th></tr>\n"
      "<tr><th>max |q &minus; q<sub>ref</sub>|</th><th>&int; |q &minus; q<sub>ref</sub>| dt</th>"
      "<th>&int; |u &minus; u<sub>ref</sub>| "
      "dt</th></tr></thead><tbody>\n{}</tbody></table></div>\n"
      "<p class=source>From {}; each model's name leads to its trajectory.</p>\n",
      escaped(run.comparison.reference_model), rows, link_to(run.folder, "comparison.json"));
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
  return fmt::format(
      "<div class=scroll><table><thead><tr><th>model</th><th>number</th>"
      "<th>time</th><th>velocity of approach</th><th>impulse of the solids</th>"
      "<th>velocity of "
      "rebound</th><th>coefficient</th></tr></thead><tbody>\n{}</tbody></table></div>\n"
      "<p class=source>From {}. The coefficient is that of the velocities where the sphere meets "
      "and "
      "leaves the film.</p>\n",
      rows, link_to(run.folder, "comparison.json"));
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
  return fmt::format(
      "<div class=scroll><table><thead><tr><th rowspan=2>model</th><th colspan=4 "
      "class=group>impulse on the "
      "sphere</th><th colspan=4 class=group>work done on "
      "it</th></tr>\n<tr>{0}{0}</tr></thead><tbody>\n"
      "{1}</tbody></table></div>\n<p class=source>From {2}.</p>\n",
      "<th>external</th><th>film</th><th>drag</th><th>solid</th>", rows,
      link_to(run.folder, "comparison.json"));
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
             "square {:.3g}, condition number {:.3g}.</p>\n"
             "<div class=scroll><table><thead><tr><th>term</th><th>coefficient</th><th>standard "
             "error</th></tr></thead><tbody>\n{}</tbody></table></div>\n<p class=source>From "
             "{}{}.</p>\n",
             fit.reference_velocity, lubrication::to_string(fit.weights),
             fit.largest_relative_residual, fit.rms_relative_residual, fit.condition_number, rows,
             link_to(run.folder, "fit.json"),
             run.table ? ", the table in " + link_to(run.folder, "table.csv") : "") +
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

}  // namespace viscontact::report
