// Columns, words and pictures of the summaries.
#include "viscontact/report/summaries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "viscontact/report/pictures/colours.hpp"
#include "viscontact/report/pictures/gnuplot.hpp"

namespace viscontact::report {
namespace {

/// The number in a format of the library fmt; a dash if there is none.
std::string number_or_dash(const std::optional<double>& number, const char* format) {
  return number ? fmt::format(fmt::runtime(format), *number) : "-";
}

/// What chi-squared says about the cause of the residuals; empty if it is not known.
std::string misfit_in_words(const lubrication::FitDiagnostics& d) {
  if (!d.chi_squared) return "";
  return fmt::format(
      "; chi-squared {:.3g} for {} degrees of freedom{}", *d.chi_squared, d.degrees_of_freedom,
      d.misfit == lubrication::Misfit::kBasis  ? ": the misfit is the basis's, not the data's"
      : d.misfit != lubrication::Misfit::kData ? ""
      : d.outliers.empty()                     ? ": the data explain the residuals"
                           : ": but for the outliers, the data explain the residuals");
}

/// The residual [1] of the row in the fit of the other rows; a dash if there is no such row.
std::string left_out(const std::optional<lubrication::LeftOutRow>& row, const char* format) {
  return number_or_dash(row ? std::optional(row->relative_residual) : std::nullopt, format);
}

}  // namespace

std::string fit_in_words(const lubrication::Fit& fit) {
  const auto& d = fit.diagnostics.value();
  std::string text = fmt::format(
      "fit: basis {}, largest relative residual {:.2g} at gap {:.4g}, left one out {} between the "
      "rows and {} beyond an end, condition number {:.2g}{}",
      fit.basis, fit.largest_relative_residual, d.worst_gap, left_out(d.left_out_inner, "{:.2g}"),
      left_out(d.left_out_end, "{:.2g}"), fit.condition_number, misfit_in_words(d));
  for (const auto& outlier : d.outliers)
    text += fmt::format(
        "\nfit: outlier at gap {:.6g}, velocity {:.6g}: the fit is {:+.2g} relative from it",
        outlier.gap, outlier.reference_velocity, outlier.relative_residual);
  return text;
}

std::string basis_table(const std::vector<fitting::BasisResult>& results) {
  constexpr const char* kLine = "{:<20} {:>6} {:>11} {:>9} {:>14} {:>9} {:>11} {:>10} {:>8}\n";
  std::string text = fmt::format(fmt::runtime(kLine), "basis", "terms", "largest res.", "rms",
                                 "left out inner", "end", "chi2/dof", "condition", "AICc");
  for (const auto& result : results) {
    if (!result.fit) {
      text += fmt::format("{:<20} {}\n", result.basis, result.failure);
      continue;
    }
    const auto& fit = *result.fit;
    const auto& d = fit.diagnostics.value();
    const auto reduced =
        d.chi_squared && d.degrees_of_freedom > 0
            ? std::optional(*d.chi_squared / static_cast<double>(d.degrees_of_freedom))
            : std::nullopt;
    text +=
        fmt::format(fmt::runtime(kLine), result.basis, fit.terms.size(),
                    fmt::format("{:.2e}", fit.largest_relative_residual),
                    fmt::format("{:.1e}", fit.rms_relative_residual),
                    left_out(d.left_out_inner, "{:.2e}"), left_out(d.left_out_end, "{:.2e}"),
                    number_or_dash(reduced, "{:.2g}"), fmt::format("{:.1e}", fit.condition_number),
                    number_or_dash(d.information_criterion, "{:.1f}"));
  }
  if (const auto* best = fitting::best_basis(results))
    text += fmt::format("least AICc: {}\n", best->basis);
  return text;
}

std::string basis_json(const std::vector<fitting::BasisResult>& results) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& result : results)
    json.push_back(result.fit ? nlohmann::ordered_json::parse(lubrication::write_fit(*result.fit))
                              : nlohmann::ordered_json(
                                    {{"basis", result.basis}, {"failure", result.failure}}));
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string plot_bases(const lubrication::MotionTable& table,
                       const std::vector<fitting::BasisResult>& results,
                       const results::PictureFormat& format, const StopToken& stop) {
  constexpr std::array kColours = {kVermilion, kBlue, kBluishGreen, kReddishPurple, kOrange};
  Panel panel{"Relative residuals of the fits",
              "gap q",
              "|fit / table - 1|",
              true,
              true,
              {"set format y '1e%T'", "set key below Left reverse noopaque"},
              {}};
  // Of a long table only every n-th row is drawn, because a picture cannot show more points than
  // about this number.
  constexpr std::size_t kMostPoints = 2000;
  const std::size_t stride = 1 + table.rows.size() / kMostPoints;
  std::size_t place = 0;
  for (const auto& result : results) {
    const char* colour = kColours.at(place++ % kColours.size());
    if (!result.fit) continue;
    const double u0 = result.fit->reference_velocity;
    const auto wall = lubrication::second_wall_of(*result.fit);
    const double largest_gap = wall ? wall->largest_gap : lubrication::kNoWall;
    Curve curve{
        result.basis,
        fmt::format("linespoints pointtype 7 pointsize 0.45 linewidth 1.5 linecolor rgb '{}'",
                    colour),
        {}};
    for (std::size_t i = 0; i < table.rows.size(); i += stride) {
      const auto& row = table.rows[i];
      double force = 0;
      for (const auto& term : result.fit->terms)
        force += term.coefficient *
                 lubrication::find_term(term.name).value().value(row.gap, largest_gap);
      const double residual = std::abs(force * row.reference_velocity / u0 / row.force - 1);
      // A logarithmic axis has no zero, so a residual of 0 is not drawn.
      curve.points.emplace_back(row.gap, residual > 0 ? residual : std::nan(""));
    }
    panel.curves.push_back(curve);
  }
  Curve estimate{
      "table's own error estimate", "points pointtype 4 pointsize 0.6 linecolor rgb '#000000'", {}};
  for (std::size_t i = 0; i < table.rows.size(); i += stride)
    if (const auto& row = table.rows[i]; row.relative_error_estimate > 0)
      estimate.points.emplace_back(row.gap, row.relative_error_estimate);
  if (!estimate.points.empty()) panel.curves.push_back(estimate);
  return draw_picture(format, {panel}, 860, 520, stop);  // [pixels]
}

/// A line for each model with the times at which it first reaches the gaps of the case; empty if
/// there are none. Names of models are `width` characters wide.
std::string gap_time_table(const reduced_model::Comparison& comparison, std::size_t width) {
  if (comparison.models.empty() || comparison.models.front().gap_times.empty()) return "";
  constexpr std::string_view kCell = " {:>16}";
  std::string text = fmt::format("{:<{}}", "time at which the gap first is", width);
  for (const auto& of : comparison.models.front().gap_times)
    text += fmt::format(kCell, fmt::format("{:.6g}", of.gap));
  text += "\n";
  for (const auto& model : comparison.models) {
    text += fmt::format("{:<{}}", model.model, width);
    for (const auto& of : model.gap_times)
      text += fmt::format(kCell, of.time ? fmt::format("{:.8g}", *of.time) : "never");
    text += "\n";
  }
  return text;
}

std::string regime_in_words(const reduced_model::Comparison& comparison) {
  const auto largest = [&](const auto number) -> std::optional<double> {
    std::optional<double> most;
    for (const auto& model : comparison.models)
      if (const auto& value = model.*number; value && !(most && *most >= *value)) most = value;
    return most;
  };
  const auto stokes = largest(&reduced_model::ModelComparison::stokes_number);
  if (!stokes) return "";
  const auto reynolds = largest(&reduced_model::ModelComparison::reynolds_number);
  return fmt::format(
      "largest Stokes number {:.3g}, Reynolds number {}\n", *stokes,
      reynolds ? fmt::format("{:.3g}", *reynolds) : "not known (it needs `density` in [fluid])");
}

std::string comparison_table(const reduced_model::Comparison& comparison) {
  // The first column is as wide as the longest name, and at least 30 characters wide, which few
  // names exceed.
  std::size_t width = 30;
  for (const auto& model : comparison.models) width = std::max(width, model.model.size());
  for (const auto& model : comparison.failed_models) width = std::max(width, model.model.size());
  constexpr std::string_view kLine = "{:<{}} {:>12} {:>9} {:>15} {:>16} {:>10}";
  const bool solids = std::ranges::any_of(
      comparison.models, [](const auto& model) { return model.solid_contact_from.has_value(); });
  const auto solid_columns = [&](const std::string& time, const std::string& velocity) {
    return solids ? fmt::format(" {:>15} {:>12}\n", time, velocity) : std::string("\n");
  };
  std::string text = fmt::format(kLine, "model", width, "smallest gap", "at time",
                                 "film from gamma", "in contact", "sup |dq|") +
                     solid_columns("solids touch at", "velocity");
  for (const auto& model : comparison.models) {
    text += fmt::format(kLine, model.model, width, fmt::format("{:.6g}", model.minimal_gap),
                        fmt::format("{:.6g}", model.minimal_gap_time),
                        model.film_from_gamma ? fmt::format("{:.6g}", *model.film_from_gamma) : "-",
                        model.contact_interval
                            ? fmt::format("[{:.4g}, {:.4g}]", (*model.contact_interval)[0],
                                          (*model.contact_interval)[1])
                            : "-",
                        fmt::format("{:.3g}", model.sup_gap_distance));
    const auto& touch = model.solid_contact_from;
    text += solid_columns(touch ? fmt::format("{:.6g}", touch->time) : "-",
                          touch ? fmt::format("{:.4g}", touch->velocity) : "-");
  }
  text += gap_time_table(comparison, width);
  for (const auto& failed : comparison.failed_models)
    text += fmt::format("{:<{}} failed: {}\n", failed.model, width, failed.reason);
  text += regime_in_words(comparison);
  if (!comparison.units.empty()) text += fmt::format("units: {}\n", comparison.units);
  return text;
}

std::string plot_wall_shift(const fitting::WallShift& shift, const std::string& wall,
                            const results::PictureFormat& format, const StopToken& stop) {
  Curve own{
      "shift of the row alone", "points pointtype 7 pointsize 0.7 linecolor rgb '#0072B2'", {}};
  Curve common{fmt::format("common shift {:.4g}", shift.shift),
               "lines linewidth 2 linecolor rgb '#D55E00'",
               {}};
  Curve residual{"|smooth wall at gap + common shift / rough wall - 1|",
                 "linespoints pointtype 7 pointsize 0.5 linecolor rgb '#0072B2'",
                 {}};
  Curve estimate{"the table's own error estimate",
                 "points pointtype 4 pointsize 0.6 linecolor rgb '#000000'",
                 {}};
  for (const auto& row : shift.rows) {
    own.points.emplace_back(row.gap, row.shift);
    common.points.emplace_back(row.gap, shift.shift);
    // A logarithmic axis has no zero, so a residual or an error estimate of 0 is not drawn.
    if (row.relative_residual != 0)
      residual.points.emplace_back(row.gap, std::abs(row.relative_residual));
    if (row.relative_error_estimate > 0)
      estimate.points.emplace_back(row.gap, row.relative_error_estimate);
  }
  const Panel shifts{fmt::format("Smooth wall with the same drag as the rough one ({})", wall),
                     "gap from the crests q",
                     "shift below the crests",
                     true,
                     false,
                     {"set yrange [0:*]", "set key bottom right", "set format x '1e%T'"},
                     {own, common}};
  Panel residuals{"Residuals with the common shift",
                  shifts.x_label,
                  "relative difference of drag",
                  true,
                  true,
                  {"set yrange [*:*]", kLegendBelow, "set format x '1e%T'", "set format y '1e%T'"},
                  {}};
  for (const auto& curve : {residual, estimate})
    if (!curve.points.empty()) residuals.curves.push_back(curve);
  constexpr int kWidth = 860, kPanelHeight = 360;  // [pixels]
  if (residuals.curves.empty()) return draw_picture(format, {shifts}, kWidth, kPanelHeight, stop);
  return draw_picture(format, {shifts, residuals}, kWidth, 2 * kPanelHeight, stop);
}

}  // namespace viscontact::report
