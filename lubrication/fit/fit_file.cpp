// Reads and writes the fit file. Keys, types and ranges are those of docs/fit.schema.json, and a
// change of one must be made in the other. Lengths, masses and times are in the units of the table.
#include <fmt/format.h>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/lubrication/fit/fit.hpp"
#include "viscontact/lubrication/fit/fit_diagnostics.hpp"
#include "viscontact/lubrication/fit/json_object.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::lubrication {
namespace {

/// Throws Error(kBadInput), which names the key, for a missing, unknown or wrong value.
FitDiagnostics read_diagnostics(const JsonObject& json);

/// The JSON object from which read_diagnostics() reads the same diagnostics.
Json write_diagnostics(const FitDiagnostics& diagnostics);

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

std::vector<FitTerm> read_terms(const JsonObject& root) {
  std::vector<FitTerm> terms;
  const Json& array = root.array("terms");
  const bool exact = root.text("basis") == kExactPlane;
  if (array.empty() != exact)
    root.fail("terms", exact ? "is not empty; a fit of the exact drag must have no terms"
                             : "is empty; a fit must have at least one term");
  for (std::size_t i = 0; i < array.size(); ++i) {
    const JsonObject object = root.element("terms", i);
    object.allow_only("name coefficient standard_error held");
    FitTerm term{object.text("name"), object.number("coefficient"),
                 object.number_above("standard_error", 0, true),
                 object.has("held") && object.boolean("held")};
    if (!find_term(term.name))
      object.fail("name", fmt::format("is '{}', which is not a term; the terms are: {}", term.name,
                                      names_of(all_terms())));
    for (const auto& other : terms)
      if (other.name == term.name)
        object.fail("name", fmt::format("is '{}' for the second time; each term may be named once",
                                        term.name));
    terms.push_back(term);
  }
  return terms;
}

std::vector<std::vector<double>> read_covariance(const JsonObject& root, std::size_t size) {
  std::vector<std::vector<double>> covariance;
  const auto refuse = [&] {
    root.fail("covariance", fmt::format("must be a matrix of {0} rows with {0} numbers each, one "
                                        "for each term",
                                        size));
  };
  for (const Json& row : root.array("covariance")) {
    if (!row.is_array() || row.size() != size) refuse();
    covariance.emplace_back();
    for (const Json& value : row) {
      const auto key =
          fmt::format("covariance[{}][{}]", covariance.size() - 1, covariance.back().size());
      covariance.back().push_back(root.finite(key, value));
    }
  }
  if (covariance.size() != size) refuse();
  for (std::size_t i = 0; i < size; ++i)
    if (covariance[i][i] < 0)
      root.fail(fmt::format("covariance[{0}][{0}]", i),
                fmt::format("is {}; it must be >= 0, since it is a variance", covariance[i][i]));
  return covariance;
}

}  // namespace

Fit read_fit(const std::filesystem::path& path) {
  return parse_fit(read_file(path), path.string());
}

Fit parse_fit(const std::string& text, const std::string& file) {
  const auto document = JsonDocument::parse(text, file);
  return read_fit_object(JsonObject(document));
}

Fit read_fit_object(const JsonObject& root, const std::string& further_keys) {
  root.allow_only(
      "basis reference_velocity viscosity radius gap_interval weights terms "
      "largest_relative_residual rms_relative_residual condition_number covariance table_sha256 "
      "versions loss geometry leading_coefficient diagnostics provenance " +
      further_keys);
  Fit fit;
  fit.basis = root.text("basis");
  fit.reference_velocity = root.number("reference_velocity");
  if (fit.reference_velocity == 0)
    root.fail("reference_velocity", "is 0; it must be different from 0");
  fit.viscosity = root.number_above("viscosity", 0, false);
  fit.radius = root.number_above("radius", 0, false);
  const Json& interval = root.array("gap_interval");
  if (interval.size() != 2)
    root.fail("gap_interval", fmt::format("has {} elements; it must be two gaps", interval.size()));
  fit.gap_interval = {root.finite("gap_interval[0]", interval[0]),
                      root.finite("gap_interval[1]", interval[1])};
  if (!(fit.gap_interval[0] > 0 && fit.gap_interval[1] > fit.gap_interval[0]))
    root.fail("gap_interval",
              fmt::format("is {}; it must be two gaps with 0 < first < second", interval.dump()));
  fit.weights = root.word("weights", parse_weights);
  if (root.has("loss")) fit.loss = root.word("loss", parse_loss);
  if (root.has("geometry")) fit.geometry = root.text("geometry");
  if (root.has("leading_coefficient")) fit.leading_coefficient = root.number("leading_coefficient");
  if (root.has("diagnostics")) fit.diagnostics = read_diagnostics(root.object("diagnostics"));
  fit.terms = read_terms(root);
  fit.largest_relative_residual = root.number_above("largest_relative_residual", 0, true);
  fit.rms_relative_residual = root.number_above("rms_relative_residual", 0, true);
  fit.condition_number = root.number_above("condition_number", 1, true);
  fit.covariance = read_covariance(root, fit.terms.size());
  fit.table_sha256 = root.text("table_sha256");
  if (root.has("provenance")) (void)root.object("provenance");  // checks that it is an object
  (void)root.object("versions");
  for (const auto& [program, version] : root.at("versions").items()) {
    if (!version.is_string())
      root.fail("versions." + program,
                fmt::format("is {}; it must be a text in quotes", shown(version)));
    fit.versions[program] = version.get<std::string>();
  }
  return fit;
}

std::string write_fit(const Fit& fit) {
  Json json;
  json["basis"] = fit.basis;
  json["reference_velocity"] = fit.reference_velocity;
  json["viscosity"] = fit.viscosity;
  json["radius"] = fit.radius;
  json["gap_interval"] = fit.gap_interval;
  json["weights"] = to_string(fit.weights);
  json["loss"] = to_string(fit.loss);
  json["terms"] = Json::array();
  for (const auto& term : fit.terms)
    json["terms"].push_back({{"name", term.name},
                             {"coefficient", term.coefficient},
                             {"standard_error", term.standard_error},
                             {"held", term.is_fixed}});
  json["largest_relative_residual"] = fit.largest_relative_residual;
  json["rms_relative_residual"] = fit.rms_relative_residual;
  json["condition_number"] = fit.condition_number;
  json["covariance"] = fit.covariance;
  if (!fit.geometry.empty()) json["geometry"] = fit.geometry;
  if (fit.leading_coefficient) json["leading_coefficient"] = *fit.leading_coefficient;
  if (fit.diagnostics) json["diagnostics"] = write_diagnostics(*fit.diagnostics);
  json["table_sha256"] = fit.table_sha256;
  json["versions"] = fit.versions;
  // The header of a table may contain bytes that are not UTF-8, which dump() would refuse.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace viscontact::lubrication
