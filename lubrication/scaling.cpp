// Scaling of fits to another radius and viscosity.
#include "viscontact/lubrication/scaling.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::lubrication {
namespace {

/// A matrix m: coefficient i of the scaled fit is sum_j m[i][j] * coefficient j of the given fit.
using Mixing = std::vector<std::vector<double>>;

/// `factor` is (mu'/mu) (r'/r)^power, `ratio` is r'/r. Appends a term q^n to `terms` if they
/// contain q^n ln q but not q^n.
Mixing mixing_of(std::vector<FitTerm>& terms, double factor, double ratio) {
  const auto place = [&](const std::string& name) {
    const auto found = std::ranges::find(terms, name, &FitTerm::name);
    if (found != terms.end()) return static_cast<std::size_t>(found - terms.begin());
    terms.push_back({name, 0, 0, false});
    return terms.size() - 1;
  };
  const std::size_t old = terms.size();
  Mixing mixing;
  for (std::size_t j = 0; j < old; ++j) {
    const std::string name = terms[j].name;
    const double scale = factor * scale_of_term(name, ratio);
    const auto power = factor_of_logarithm(name);
    const std::size_t beside = power ? place(*power) : 0;
    mixing.resize(terms.size(), std::vector<double>(old, 0.0));
    mixing[j][j] += scale;
    if (power) mixing[beside][j] -= scale * std::log(ratio);
  }
  return mixing;
}

void scale_gaps(FitDiagnostics& d, double ratio) {
  d.worst_gap *= ratio;
  if (d.leave_one_out_gap) *d.leave_one_out_gap *= ratio;
  for (auto* row : {&d.left_out_inner, &d.left_out_end})
    if (*row) (*row)->gap *= ratio;
  if (d.worst_to_estimate) d.worst_to_estimate->gap *= ratio;
  for (auto& outlier : d.outliers) outlier.gap *= ratio;
}

}  // namespace

double scale_of_term(std::string_view term, double ratio) {
  assert(ratio > 0);
  const auto power = factor_of_logarithm(term);
  const double q = 1 / ratio;  // also the distance to the second wall, which scales as the gap
  return terms_beside_walls()[place_of(power ? std::string_view(*power) : term)].value.at(
      q, std::log(q), q, std::log(q));
}

Fit scaled_to(Fit fit, double viscosity, double radius, int power) {
  assert(viscosity > 0 && radius > 0 && fit.radius > 0 && power >= 1 && power <= 3);
  if (is_exact_plane(fit)) return exact_plane_fit(viscosity, radius);
  const double ratio = radius / fit.radius;
  if (equal_up_to_rounding(radius, fit.radius)) return with_viscosity(std::move(fit), viscosity);
  const double factor = viscosity / fit.viscosity * std::pow(ratio, power);
  const auto old = fit.terms;
  const auto mixing = mixing_of(fit.terms, factor, ratio);
  const auto covariance = std::exchange(fit.covariance, {});
  const std::size_t size = fit.terms.size(), old_size = old.size();
  if (!covariance.empty()) {
    fit.covariance.assign(size, std::vector<double>(size, 0.0));
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j)
        for (std::size_t k = 0; k < old_size; ++k)
          for (std::size_t l = 0; l < old_size; ++l)
            fit.covariance[i][j] += mixing[i][k] * covariance[k][l] * mixing[j][l];
  }
  for (std::size_t i = 0; i < size; ++i) {
    auto& term = fit.terms[i];
    double variance = 0;
    term.coefficient = 0;
    for (std::size_t k = 0; k < old_size; ++k) {
      term.coefficient += mixing[i][k] * old[k].coefficient;
      variance += std::pow(mixing[i][k] * old[k].standard_error, 2);
    }
    if (!covariance.empty()) variance = std::max(0.0, fit.covariance[i][i]);
    term.standard_error = std::sqrt(variance);
  }
  if (fit.leading_coefficient)
    *fit.leading_coefficient *= factor * scale_of_term(kLeadingTerm, ratio);
  for (auto& gap : fit.gap_interval) gap *= ratio;
  if (fit.diagnostics) scale_gaps(*fit.diagnostics, ratio);
  fit.geometry = with_lengths_scaled(fit.geometry, ratio);
  fit.container = with_lengths_scaled(fit.container, ratio);
  fit.viscosity = viscosity;
  fit.radius = radius;
  return fit;
}

std::string with_lengths_scaled(const std::string& words, double factor) {
  assert(factor > 0);
  std::istringstream in(words);
  std::string text, before;
  for (std::string word; in >> word;) {
    const bool ends_part = word.ends_with(',');
    const auto number = parse_number(word.substr(0, word.size() - (ends_part ? 1 : 0)));
    if (number && !before.empty() && !before.ends_with("_ratio"))
      word = format_number(*number * factor) + (ends_part ? "," : "");
    text += (text.empty() ? "" : " ") + word;
    before = word;
  }
  return text;
}

bool same_words(const std::string& one, const std::string& other) {
  std::istringstream first(one), second(other);
  std::string a, b;
  for (;;) {
    const bool more = static_cast<bool>(first >> a);
    if (more != static_cast<bool>(second >> b)) return false;
    if (!more) return true;
    const auto bare = [](const std::string& word) {
      return word.substr(0, word.size() - (word.ends_with(',') ? 1 : 0));
    };
    const auto x = parse_number(bare(a)), y = parse_number(bare(b));
    if (x && y ? !equal_up_to_rounding(*x, *y) : a != b) return false;
  }
}

}  // namespace viscontact::lubrication
