#include "app/report.hpp"

#include <fmt/format.h>

#include "app/progress.hpp"
#include "app/report_plots.hpp"
#include "app/run_folder.hpp"
#include "app/versions.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "reduced_model/fit_uncertainty.hpp"
#include "reduced_model/models.hpp"

namespace viscontact {
namespace {

constexpr std::string_view kStyle =
    "body{font:16px/1.5 sans-serif;color:#222;max-width:900px;margin:2em auto;padding:0 1em}"
    "h1{font-size:1.5em}h2{font-size:1.15em;margin-top:2em}svg{width:100%;height:auto}"
    "table{border-collapse:collapse;font-size:.9em}td,th{padding:.25em .8em;border-bottom:1px "
    "solid #ddd;text-align:right;white-space:nowrap}"
    "td:first-child,th:first-child{text-align:left}.scroll{overflow-x:auto}footer{color:#666;font-"
    "size:.85em;margin-top:3em}";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string section(const std::string& heading, const std::string& body) {
  return body.empty() ? "" : fmt::format("<h2>{}</h2>\n{}\n", heading, body);
}

std::string parameters(const Case& c, const Fit& fit) {
  const auto& motion = required_motion(c);
  return fmt::format(
      "<p>Sphere of radius {} and mass {} in a fluid of viscosity {}; initial gap {}, initial "
      "velocity {}, until time {}. Drag from "
      "{}.</p>\n",
      c.radius, motion.mass, c.viscosity, motion.initial_gap, motion.initial_velocity,
      motion.end_time,
      fit.terms.empty()          ? "Brenner's exact series"
      : fit.table_sha256.empty() ? "a given fit"
                                 : fmt::format("a fit for gaps from {:.4g} to {:.4g}",
                                               fit.gap_interval[0], fit.gap_interval[1]));
}

std::string coefficients(const Fit& fit) {
  std::string rows;
  for (const auto& term : fit.terms)
    rows += fmt::format("<tr><td>{}</td><td>{:.8g}</td><td>{:.2g}</td></tr>\n", escaped(term.name),
                        term.coefficient, term.standard_error);
  return fmt::format(
      "<p>F(q) at velocity {}, {} weights: largest relative residual {:.3g}, root mean square "
      "{:.3g}, condition number {:.3g}.</p>\n"
      "<div class=scroll><table><tr><th>term</th><th>coefficient</th><th>standard "
      "error</th></tr>\n{}</table></div>\n",
      fit.reference_velocity, to_string(fit.weights), fit.largest_relative_residual,
      fit.rms_relative_residual, fit.condition_number, rows);
}

std::string trust(const FitDiagnostics& d) {
  std::string text = fmt::format(
      "<p>{}", escaped(d.leave_one_out_rms
                           ? fmt::format("Each row predicted from the others: root mean square "
                                         "{:.3g}, largest {:.3g} at gap {:.4g}. ",
                                         *d.leave_one_out_rms, d.leave_one_out_largest.value(),
                                         d.leave_one_out_gap.value())
                           : ""));
  if (d.chi_squared)
    text += fmt::format(
        "Chi-squared against the table's error estimates: {:.3g} for {} degrees of freedom{}",
        *d.chi_squared, d.degrees_of_freedom,
        d.misfit == Misfit::kBasis
            ? ": the misfit is the basis's, and the standard errors take it for noise."
            : ".");
  text += "</p>\n";
  for (const auto& warning : d.warnings) text += "<p>Warning: " + escaped(warning) + ".</p>\n";
  for (const auto& outlier : d.outliers)
    text += fmt::format("<p>Outlier at gap {:.6g}: the fit is {:+.2g} relative from it.</p>\n",
                        outlier.gap, outlier.relative_residual);
  return text;
}

std::string uncertainty_table(const FitUncertainty& uncertainty) {
  const auto& smallest = uncertainty.smallest;
  return fmt::format(
      "<p>Without inertia the smallest gap is {:.6g} at time {:.4g}. 95 % of {} draws of the "
      "coefficients "
      "({} refused) lie in [{:.6g}, {:.6g}]. If the drag were off by {:.2g} everywhere, the "
      "largest residual and error estimate: in [{:.6g}, {:.6g}].</p>\n",
      smallest.gap, smallest.time, uncertainty.draws, uncertainty.refused, smallest.random[0],
      smallest.random[1], uncertainty.misfit, smallest.misfit[0], smallest.misfit[1]);
}

std::string model_table(const Comparison& comparison) {
  std::string rows;
  for (const auto& model : comparison.models)
    rows += fmt::format(
        "<tr><td>{}</td><td>{:.6g}</td><td>{:.6g}</td><td>{}</td><td>{}</td><td>{:.3g}</"
        "td><td>{:.3g}</td><td>{:.3g}</td></tr>\n",
        escaped(model.model), model.minimal_gap, model.minimal_gap_time,
        model.recovered_minimal_gap ? fmt::format("{:.6g}", *model.recovered_minimal_gap) : "",
        model.contact_interval ? fmt::format("[{:.4g}, {:.4g}]", (*model.contact_interval)[0],
                                             (*model.contact_interval)[1])
                               : "",
        model.sup_gap_distance, model.l1_gap_distance, model.l1_velocity_distance);
  return fmt::format(
      "<div class=scroll><table><tr><th>model</th><th>smallest gap</th><th>at "
      "time</th><th>recovered from gamma</th><th>in contact</th>"
      "<th>sup |q - q<sub>ref</sub>|</th><th>&int; |q - q<sub>ref</sub>|</th><th>&int; |u - "
      "u<sub>ref</sub>|</th></tr>\n{}</table></div>\n"
      "<p>Distances are to <code>{}</code>.</p>\n",
      rows, escaped(comparison.reference_model));
}

std::string books_table(const Comparison& comparison) {
  std::string rows;
  for (const auto& model : comparison.models) {
    if (!model.books) continue;
    rows += fmt::format("<tr><td>{}</td>", escaped(model.model));
    for (const auto& entry : kBookEntries)
      rows += fmt::format("<td>{:.5g}</td>", (*model.books).*entry.value);
    rows += "</tr>\n";
  }
  if (rows.empty()) return "";
  return fmt::format(
      "<div class=scroll><table><tr><th>model</th><th colspan=4>impulse on the sphere</th>"
      "<th colspan=4>work done on it</th></tr>\n<tr><th></th>{0}{0}</tr>\n{1}</table></div>\n",
      "<th>external</th><th>film</th><th>drag</th><th>solid</th>", rows);
}

std::string versions(const Fit& fit, const std::optional<ForceTable>& table) {
  auto all = library_versions();
  all.insert(fit.versions.begin(), fit.versions.end());
  if (table) all.insert(table->versions.begin(), table->versions.end());
  std::string text;
  for (const auto& [program, version] : all)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", escaped(program), escaped(version));
  return text;
}

}  // namespace

void write_report(const std::filesystem::path& folder) {
  const RunFolder run{folder};
  const Case c = read_case(run.case_file());
  const Fit fit = read_fit(run.fit());
  // Below the fit's interval only pictures are at stake, and what lies there was computed with the
  // user's consent.
  const LubricationForce force(fit, BelowInterval::kLubricationLimit);
  const Comparison comparison = read_comparison(run.comparison());
  std::vector<Trajectory> trajectories;
  for (const auto& model : comparison.models)
    if (const auto file = run.trajectory(model.model); std::filesystem::exists(file))
      trajectories.push_back(read_trajectory(file));
  if (trajectories.empty())
    throw_bad_input({run.trajectories().string()}, "has none of the comparison's trajectories");
  const auto table = std::filesystem::exists(run.table())
                         ? std::optional(read_force_table(run.table()))
                         : std::nullopt;

  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport "
      "content=\"width=device-width,initial-scale=1\">"
      "<title>{0}</title><style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n",
      escaped(c.title), kStyle);
  page += parameters(c, fit);
  // Each plot is a file of its own too, for talks and papers.
  std::vector<std::pair<std::string, std::string>> plots;
  const auto plot = [&](const std::string& name, const std::string& svg) {
    if (!svg.empty()) plots.emplace_back(name, svg);
    return svg;
  };
  const auto& motion = required_motion(c);
  page +=
      section("Thinnest film", plot("thinnest_film", plot_minimal_gaps(comparison, c.published)));
  page += section("Models", model_table(comparison) + books_table(comparison));
  page += section(
      "Trajectories",
      plot("gap", plot_gaps(trajectories)) +
          plot("gap_logarithmic", plot_gaps_logarithmic(trajectories, motion, force)) +
          plot("external_force", plot_external_force(motion.external_force, motion.end_time)));
  page += section("Contact", plot("gamma", plot_gamma(trajectories)) +
                                 plot("solid_force", plot_solid_force(trajectories)));
  page +=
      section("Lubrication force and fit",
              (table ? plot("fit", plot_fit(*table, fit)) : "") +
                  (fit.terms.empty() ? "<p>The exact drag of a sphere near a plane in a half-space "
                                       "(Brenner 1961): nothing is fitted.</p>\n"
                                     : coefficients(fit)) +
                  (fit.diagnostics ? trust(*fit.diagnostics) : ""));
  if (std::filesystem::exists(run.uncertainty())) {
    const auto uncertainty = read_uncertainty(run.uncertainty());
    page += section(
        "What the fit does to the answer",
        uncertainty_table(uncertainty) +
            (uncertainty.misfit > 0 ? plot("uncertainty", plot_uncertainty(uncertainty)) : ""));
  }
  page += fmt::format("<footer>Made by Viscontact {}. {}.</footer>\n</body></html>\n",
                      VISCONTACT_VERSION, versions(fit, table));
  for (const auto* name : {"thinnest_film", "gap", "gap_logarithmic", "external_force", "gamma",
                           "solid_force", "fit", "uncertainty"})
    std::filesystem::remove(run.plot(name));  // of an earlier report
  for (const auto& [name, svg] : plots) write_file(run.plot(name), svg);
  write_file(run.report(), page);
  say(fmt::format("report: {}", run.report().string()));
}

}  // namespace viscontact
