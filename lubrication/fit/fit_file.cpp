// Reads and writes the fit file. Keys, types and ranges are those of docs/fit.schema.json, and a
// change of one must be made in the other. Lengths, masses and times are in the units of the table.
#include <fmt/format.h>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/lubrication/fit/fit.hpp"
#include "viscontact/lubrication/fit/fit_diagnostics_json.hpp"
#include "viscontact/lubrication/fit/json_object.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::lubrication {
namespace {

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
