// Fits of the lubrication force: names, files, another viscosity.
#include "viscontact/lubrication/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/common/text/json_fields.hpp"
#include "viscontact/lubrication/stokes_drag.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::lubrication {
namespace {

template <class Value>
struct Named {
  std::string_view name;
  Value value;
};
template <class Value>
Named(std::string_view, Value) -> Named<Value>;

constexpr std::array kLosses = {Named{"none", Loss::kSquared}, Named{"huber", Loss::kHuber},
                                Named{"cauchy", Loss::kCauchy}};
constexpr std::array kMisfits = {Named{"basis", Misfit::kBasis}, Named{"data", Misfit::kData},
                                 Named{"unknown", Misfit::kUnknown}};

}  // namespace

std::string_view to_string(Weights weights) {
  return weights == Weights::kRelative ? "relative" : "absolute";
}

Weights parse_weights(std::string_view word) {
  if (word == "relative") return Weights::kRelative;
  if (word == "absolute") return Weights::kAbsolute;
  throw Error(ErrorKind::kBadInput, "the weights are '{}'; they must be relative or absolute",
              word);
}

std::string_view to_string(Loss loss) {
  return std::ranges::find(kLosses, loss, &Named<Loss>::value)->name;
}

Loss parse_loss(std::string_view word) { return require_named(kLosses, word, "loss").value; }

std::string_view to_string(Misfit misfit) {
  return std::ranges::find(kMisfits, misfit, &Named<Misfit>::value)->name;
}

Misfit parse_misfit(std::string_view word) { return require_named(kMisfits, word, "misfit").value; }

Fit exact_plane_fit(double viscosity, double radius) {
  assert(viscosity > 0 && radius > 0);
  Fit fit;
  fit.basis = kExactPlane;
  fit.reference_velocity = -1;
  fit.viscosity = viscosity;
  fit.radius = radius;
  // A fit file must contain an interval; any two numbers > 0 work. LubricationForce::interval()
  // says at which gaps the drag can be computed.
  fit.gap_interval = {1e-300, 1e300};
  fit.geometry = "plane, unbounded";
  fit.leading_coefficient = stokes_resistance(viscosity, radius) * radius;
  return fit;
}

std::optional<SecondWall> second_wall_of(const Fit& fit) {
  const auto wall = second_wall(fit.geometry, fit.container, fit.radius);
  return wall && fit.gap_interval[1] < wall->largest_gap ? wall : std::nullopt;
}

double zero_of_impulse(const Fit& fit) {
  const auto wall = second_wall_of(fit);
  return wall && !(fit.radius < wall->largest_gap) ? wall->largest_gap / 2 : fit.radius;
}

bool is_exact_plane(const Fit& fit) { return fit.basis == kExactPlane; }

Fit with_viscosity(Fit fit, double viscosity) {
  assert(fit.viscosity > 0);
  const double scale = viscosity / fit.viscosity;
  fit.viscosity = viscosity;
  for (auto& term : fit.terms) {
    term.coefficient *= scale;
    term.standard_error *= scale;
  }
  for (auto& row : fit.covariance)
    for (auto& entry : row) entry *= scale * scale;
  if (fit.leading_coefficient) *fit.leading_coefficient *= scale;
  return fit;
}

namespace {

constexpr auto kAllowed = Absence::kAllowed;  // for keys that files written by hand may lack
constexpr Allowed kAtLeast1 = {[](double v) { return v >= 1; }, ">= 1"};
constexpr auto kLeftOutIfEmpty = Absence::kLeftOutIfEmpty;

/// Refuses a term named twice, a fit of the exact drag with terms, and another fit without terms.
void check_terms(const JsonFields& json, const Fit& fit) {
  const bool exact = fit.basis == kExactPlane;
  if (fit.terms.empty() != exact)
    json.fail("terms", exact ? "is not empty; a fit of the exact drag must have no terms"
                             : "is empty; a fit must have at least one term");
  for (std::size_t i = 0; i < fit.terms.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (fit.terms[j].name == fit.terms[i].name)
        json.fail(fmt::format("terms[{}].name", i),
                  "is '{}' for the second time; each term may be named once", fit.terms[i].name);
}

/// Refuses a covariance without a row and a column for each term, and variances < 0.
void check_covariance(const JsonFields& json, const Fit& fit) {
  const std::size_t size = fit.terms.size();
  const auto is_right = [&](const auto& list) { return list.size() == size; };
  if (!is_right(fit.covariance) || !std::ranges::all_of(fit.covariance, is_right))
    json.fail("covariance", "must be a matrix of {0} rows with {0} numbers each, one for each term",
              size);
  for (std::size_t i = 0; i < size; ++i)
    if (fit.covariance[i][i] < 0)
      json.fail(fmt::format("covariance[{0}][{0}]", i),
                "is {}; it must be >= 0, since it is a variance", fit.covariance[i][i]);
}

/// The two keys of a row that was left out of its fit; `which` is "inner" or "end".
void left_out_row(JsonFields& json, const std::string& which, std::optional<LeftOutRow>& row) {
  std::optional<double> residual, gap;
  if (row) std::tie(residual, gap) = std::tuple(row->relative_residual, row->gap);
  json("leave_one_out_" + which + "_largest", residual);
  json("leave_one_out_" + which + "_gap", gap);
  if (residual && gap) row = {*gap, *residual};
}

void worst_to_estimate(JsonFields& json, std::optional<WorstToEstimate>& worst) {
  std::optional<double> ratio, gap, residual;
  if (worst)
    std::tie(ratio, gap, residual) = std::tuple(worst->ratio, worst->gap, worst->relative_residual);
  json("estimate_ratio_largest", ratio);
  json("estimate_ratio_gap", gap);
  json("estimate_ratio_residual", residual);
  if (ratio && gap && residual) worst = {*gap, *residual, *ratio};
}

}  // namespace

void fields_of(JsonFields& json, Outlier& outlier) {
  json("gap", outlier.gap);
  json("reference_velocity", outlier.reference_velocity);
  json("relative_residual", outlier.relative_residual);
}

void fields_of(JsonFields& json, FitDiagnostics& d) {
  json("rows", d.rows);
  json("failed_rows", d.failed_rows, kLeftOutIfEmpty);
  json("free_coefficients", d.free_coefficients);
  json("degrees_of_freedom", d.degrees_of_freedom);
  json("worst_gap", d.worst_gap, kPositive);
  json("worst_relative_residual", d.worst_relative_residual);
  json("largest_error_estimate", d.largest_error_estimate, kNotNegative);
  json("largest_inlier_residual", d.largest_inlier_residual, kNotNegative);
  json("leave_one_out_rms", d.leave_one_out_rms);
  json("leave_one_out_largest", d.leave_one_out_largest);
  json("leave_one_out_gap", d.leave_one_out_gap);
  left_out_row(json, "inner", d.left_out_inner);
  left_out_row(json, "end", d.left_out_end);
  json("rows_beyond_estimate", d.rows_beyond_estimate);
  worst_to_estimate(json, d.worst_to_estimate);
  json("chi_squared", d.chi_squared);
  json.word("misfit", d.misfit, parse_misfit);
  json("information_criterion", d.information_criterion);
  json("outliers", d.outliers);
  json("warnings", d.warnings);
}

void fields_of(JsonFields& json, FitTerm& term) {
  json("name", term.name);
  json("coefficient", term.coefficient);
  json("standard_error", term.standard_error, kNotNegative);
  json("held", term.is_fixed, kAllowed);
  if (json.reads() && !find_term(term.name))
    json.fail("name", "is '{}', which is not a term; the terms are: {}", term.name,
              names_of(terms_beside_walls()));
}

void fields_of(JsonFields& json, Fit& fit) {
  json("basis", fit.basis);
  json("reference_velocity", fit.reference_velocity, kNotZero);
  json("viscosity", fit.viscosity, kPositive);
  json("radius", fit.radius, kPositive);
  json.gap_interval("gap_interval", fit.gap_interval);
  json.word("weights", fit.weights, parse_weights);
  json.word("loss", fit.loss, parse_loss, kAllowed);
  json("terms", fit.terms);
  if (json.reads()) check_terms(json, fit);
  json("largest_relative_residual", fit.largest_relative_residual, kNotNegative);
  json("rms_relative_residual", fit.rms_relative_residual, kNotNegative);
  json("condition_number", fit.condition_number, kAtLeast1);
  json("covariance", fit.covariance);
  if (json.reads()) check_covariance(json, fit);
  json("geometry", fit.geometry, kLeftOutIfEmpty);
  json("container", fit.container, kLeftOutIfEmpty);
  json("leading_coefficient", fit.leading_coefficient, kLeftOutIfEmpty);
  json("diagnostics", fit.diagnostics, kLeftOutIfEmpty);
  json("table_sha256", fit.table_sha256);
  json("versions", fit.versions);
  json.foreign_object("provenance");
}

Fit read_fit(const std::filesystem::path& path) {
  return parse_fit(read_file(path), path.string());
}

Fit parse_fit(const std::string& text, const std::string& file) {
  return JsonFields::read<Fit>(text, file);
}

std::string write_fit(const Fit& fit) { return JsonFields::text_of(fit); }

std::vector<double> spread_gaps(const std::array<double, 2>& interval, int count) {
  assert(count >= 2 && 0 < interval[0] && interval[0] < interval[1]);
  const double low = std::log(interval[0]);
  const double high = std::log(interval[1]);
  std::vector<double> gaps;
  for (int i = 0; i < count; ++i)
    gaps.push_back(std::clamp(std::exp(std::lerp(low, high, static_cast<double>(i) / (count - 1))),
                              interval[0], interval[1]));
  gaps.front() = interval[0];
  gaps.back() = interval[1];
  return gaps;
}

}  // namespace viscontact::lubrication
