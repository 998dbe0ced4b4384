// The keys of the object "diagnostics". Files of earlier versions lack some of them and must stay
// readable. Units are those of fit_diagnostics.hpp.
#include "viscontact/lubrication/fit/fit_diagnostics_json.hpp"

namespace viscontact::lubrication {
namespace {

Json number_or_null(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

std::vector<Outlier> read_outliers(const JsonObject& json) {
  std::vector<Outlier> outliers;
  const Json& array = json.array("outliers");
  for (std::size_t i = 0; i < array.size(); ++i) {
    const auto object = json.element("outliers", i);
    object.allow_only("gap reference_velocity relative_residual");
    outliers.push_back({object.number("gap"), object.number("reference_velocity"),
                        object.number("relative_residual")});
  }
  return outliers;
}

/// The number at `key`, or nothing if it is null or if a file of an earlier version lacks the key.
std::optional<double> optional_number(const JsonObject& json, const std::string& key) {
  return json.has(key) ? json.number_or_null(key) : std::nullopt;
}

/// Reads the left-out row of this kind: `which` is "inner" or "end".
std::optional<LeftOutRow> read_left_out_row(const JsonObject& json, const std::string& which) {
  const auto gap = optional_number(json, "leave_one_out_" + which + "_gap");
  const auto residual = optional_number(json, "leave_one_out_" + which + "_largest");
  if (!gap || !residual) return std::nullopt;
  return LeftOutRow{*gap, *residual};
}

void write_left_out_row(Json& json, const std::string& which,
                        const std::optional<LeftOutRow>& row) {
  json["leave_one_out_" + which + "_largest"] = row ? Json(row->relative_residual) : Json(nullptr);
  json["leave_one_out_" + which + "_gap"] = row ? Json(row->gap) : Json(nullptr);
}

std::optional<WorstToEstimate> read_worst_to_estimate(const JsonObject& json) {
  const auto ratio = optional_number(json, "estimate_ratio_largest");
  const auto gap = optional_number(json, "estimate_ratio_gap");
  const auto residual = optional_number(json, "estimate_ratio_residual");
  if (!ratio || !gap || !residual) return std::nullopt;
  return WorstToEstimate{*gap, *residual, *ratio};
}

}  // namespace

FitDiagnostics read_diagnostics(const JsonObject& json) {
  json.allow_only(
      "rows failed_rows free_coefficients degrees_of_freedom worst_gap worst_relative_residual "
      "largest_error_estimate largest_inlier_residual leave_one_out_rms leave_one_out_largest "
      "leave_one_out_gap leave_one_out_inner_largest leave_one_out_inner_gap "
      "leave_one_out_end_largest leave_one_out_end_gap rows_beyond_estimate "
      "estimate_ratio_largest estimate_ratio_gap estimate_ratio_residual chi_squared misfit "
      "information_criterion outliers warnings");
  FitDiagnostics d;
  d.rows = json.count("rows");
  if (json.has("failed_rows")) d.failed_rows = json.count("failed_rows");
  d.free_coefficients = json.count("free_coefficients");
  d.degrees_of_freedom = json.count("degrees_of_freedom");
  d.worst_gap = json.number_above("worst_gap", 0, false);
  d.worst_relative_residual = json.number("worst_relative_residual");
  d.largest_error_estimate = json.number_above("largest_error_estimate", 0, true);
  d.largest_inlier_residual = json.number_above("largest_inlier_residual", 0, true);
  d.leave_one_out_rms = json.number_or_null("leave_one_out_rms");
  d.leave_one_out_largest = json.number_or_null("leave_one_out_largest");
  d.leave_one_out_gap = json.number_or_null("leave_one_out_gap");
  d.left_out_inner = read_left_out_row(json, "inner");
  d.left_out_end = read_left_out_row(json, "end");
  if (json.has("rows_beyond_estimate")) d.rows_beyond_estimate = json.count("rows_beyond_estimate");
  d.worst_to_estimate = read_worst_to_estimate(json);
  d.chi_squared = json.number_or_null("chi_squared");
  d.misfit = json.word("misfit", parse_misfit);
  d.information_criterion = json.number_or_null("information_criterion");
  d.outliers = read_outliers(json);
  for (const Json& warning : json.array("warnings")) {
    if (!warning.is_string())
      json.fail("warnings",
                fmt::format("contains {}; it must be a list of texts in quotes", shown(warning)));
    d.warnings.push_back(warning.get<std::string>());
  }
  return d;
}

Json write_diagnostics(const FitDiagnostics& d) {
  Json json;
  json["rows"] = d.rows;
  if (d.failed_rows > 0) json["failed_rows"] = d.failed_rows;
  json["free_coefficients"] = d.free_coefficients;
  json["degrees_of_freedom"] = d.degrees_of_freedom;
  json["worst_gap"] = d.worst_gap;
  json["worst_relative_residual"] = d.worst_relative_residual;
  json["largest_error_estimate"] = d.largest_error_estimate;
  json["largest_inlier_residual"] = d.largest_inlier_residual;
  json["leave_one_out_rms"] = number_or_null(d.leave_one_out_rms);
  json["leave_one_out_largest"] = number_or_null(d.leave_one_out_largest);
  json["leave_one_out_gap"] = number_or_null(d.leave_one_out_gap);
  write_left_out_row(json, "inner", d.left_out_inner);
  write_left_out_row(json, "end", d.left_out_end);
  json["rows_beyond_estimate"] = d.rows_beyond_estimate;
  const auto& worst = d.worst_to_estimate;
  json["estimate_ratio_largest"] = worst ? Json(worst->ratio) : Json(nullptr);
  json["estimate_ratio_gap"] = worst ? Json(worst->gap) : Json(nullptr);
  json["estimate_ratio_residual"] = worst ? Json(worst->relative_residual) : Json(nullptr);
  json["chi_squared"] = number_or_null(d.chi_squared);
  json["misfit"] = to_string(d.misfit);
  json["information_criterion"] = number_or_null(d.information_criterion);
  json["outliers"] = Json::array();
  for (const auto& outlier : d.outliers)
    json["outliers"].push_back({{"gap", outlier.gap},
                                {"reference_velocity", outlier.reference_velocity},
                                {"relative_residual", outlier.relative_residual}});
  json["warnings"] = d.warnings;
  return json;
}

}  // namespace viscontact::lubrication
