// The fit file: docs/fit.schema.json in words of C++.
#include <fmt/format.h>

#include <algorithm>

#include "common/error.hpp"
#include "common/file.hpp"
#include "fitting/fit.hpp"
#include "fitting/fit_diagnostics_json.hpp"
#include "fitting/json_object.hpp"
#include "fitting/terms.hpp"

namespace viscontact {
namespace {

Json parse(const std::string& file, const std::string& text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto line =
        1 +
        std::count(text.begin(),
                   text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size())),
                   '\n');
    throw_bad_input({file, static_cast<int>(line)},
                    "is not valid JSON; write one with 'viscontact fit'");
  } catch (const Json::exception& error) {
    // "[json.exception.out_of_range.406] number overflow parsing '1e400'": what is for users comes behind the bracket.
    const std::string what = error.what();
    throw_bad_input({file}, what.substr(std::min(what.size(), what.find("] ") + 2), 80));
  }
}

std::vector<FitTerm> read_terms(const JsonObject& root) {
  std::vector<FitTerm> terms;
  const Json& array = root.array("terms");
  const bool exact = root.text("basis") == kExactPlane;
  if (array.empty() != exact)
    root.fail("terms", exact ? "is not empty; the exact drag has no terms" : "is empty");
  for (std::size_t i = 0; i < array.size(); ++i) {
    const JsonObject object = root.element("terms", i);
    object.allow_only({"name", "coefficient", "standard_error", "held"});
    FitTerm term{object.text("name"), object.number("coefficient"),
                 object.number_above("standard_error", 0, true),
                 object.has("held") && object.truth("held")};
    if (!find_term(term.name))
      object.fail("name", fmt::format("is '{}', which is no term", term.name));
    for (const auto& other : terms)
      if (other.name == term.name)
        object.fail("name", fmt::format("is '{}', a second time", term.name));
    terms.push_back(term);
  }
  return terms;
}

std::vector<std::vector<double>> read_covariance(const JsonObject& root, std::size_t size) {
  std::vector<std::vector<double>> covariance;
  for (const Json& row : root.array("covariance")) {
    if (!row.is_array() || row.size() != size)
      root.fail("covariance", fmt::format("must be {} x {}", size, size));
    covariance.emplace_back();
    for (const Json& value : row) covariance.back().push_back(root.finite("covariance", value));
  }
  if (covariance.size() != size)
    root.fail("covariance", fmt::format("must be {} x {}", size, size));
  for (std::size_t i = 0; i < size; ++i)
    if (covariance[i][i] < 0)
      root.fail("covariance", fmt::format("has the variance {}; must be >= 0", covariance[i][i]));
  return covariance;
}

}  // namespace

Fit read_fit(const std::filesystem::path& path) {
  const std::string file = path.string();
  const Json json = parse(file, read_file(path));
  const JsonObject root(json, file, "");
  root.allow_only({"basis", "reference_velocity", "viscosity", "radius", "gap_interval", "weights",
                   "terms", "largest_relative_residual", "rms_relative_residual",
                   "condition_number", "covariance", "table_sha256", "versions", "loss", "geometry",
                   "leading_coefficient", "diagnostics", "provenance"});
  Fit fit;
  fit.basis = root.text("basis");
  fit.reference_velocity = root.number("reference_velocity");
  if (fit.reference_velocity == 0) root.fail("reference_velocity", "is 0; must not be");
  fit.viscosity = root.number_above("viscosity", 0, false);
  fit.radius = root.number_above("radius", 0, false);
  const Json& interval = root.array("gap_interval");
  if (interval.size() != 2) root.fail("gap_interval", "must be two gaps");
  fit.gap_interval = {root.finite("gap_interval[0]", interval[0]),
                      root.finite("gap_interval[1]", interval[1])};
  if (!(fit.gap_interval[0] > 0 && fit.gap_interval[1] > fit.gap_interval[0]))
    root.fail("gap_interval", fmt::format("is {}; must be 0 < first < second", interval.dump()));
  fit.weights = root.word("weights", parse_weights);
  if (root.has("loss")) fit.loss = root.word("loss", parse_loss);
  if (root.has("geometry")) fit.geometry = root.text("geometry");
  if (root.has("leading_coefficient")) fit.leading_coefficient = root.number("leading_coefficient");
  if (root.has("diagnostics"))
    fit.diagnostics = read_diagnostics({root.at("diagnostics"), file, "diagnostics"});
  fit.terms = read_terms(root);
  fit.largest_relative_residual = root.number_above("largest_relative_residual", 0, true);
  fit.rms_relative_residual = root.number_above("rms_relative_residual", 0, true);
  fit.condition_number = root.number_above("condition_number", 1, true);
  fit.covariance = read_covariance(root, fit.terms.size());
  fit.table_sha256 = root.text("table_sha256");
  if (root.has("provenance") && !root.at("provenance").is_object())
    root.fail("provenance", "must be an object");
  if (!root.at("versions").is_object()) root.fail("versions", "must be an object");
  for (const auto& [program, version] : root.at("versions").items()) {
    if (!version.is_string()) root.fail("versions." + program, "must be text");
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
                             {"held", term.held}});
  json["largest_relative_residual"] = fit.largest_relative_residual;
  json["rms_relative_residual"] = fit.rms_relative_residual;
  json["condition_number"] = fit.condition_number;
  json["covariance"] = fit.covariance;
  if (!fit.geometry.empty()) json["geometry"] = fit.geometry;
  if (fit.leading_coefficient) json["leading_coefficient"] = *fit.leading_coefficient;
  if (fit.diagnostics) json["diagnostics"] = write_diagnostics(*fit.diagnostics);
  json["table_sha256"] = fit.table_sha256;
  json["versions"] = fit.versions;
  // A table's header may hold bytes that are no UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace viscontact
