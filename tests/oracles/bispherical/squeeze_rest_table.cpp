// Prints lubrication/pairs/squeeze_rest.hpp, computed anew in a minute:
//     build/release/squeeze_rest_table > lubrication/pairs/squeeze_rest.hpp
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <vector>

#include "tests/oracles/bispherical/squeeze.hpp"
#include "viscontact/lubrication/pairs/squeeze_terms.hpp"

namespace viscontact {
namespace {

using lubrication::SqueezeTerms;

// Measured at eight ratios from 0.011 to 0.97: 14 and 10 polynomials have the largest error 2e-6 of
// two spheres and 4e-6 in a round wall for gaps up to r_eff, 10 and 8 have 3e-5; 20 and 10 have
// 1e-6. Far away all have 5e-4, because the far sphere is large or small there.
constexpr int kGaps = 14, kRatios = 10;
// Of the resistance, which is integrated.
constexpr int kNodes = 36;
// The oracles' smallest gap and ratios. The resistance less its terms is constant below this gap.
constexpr double kSmallestWidth = 2e-6, kSmallestRatio = 0.006, kTightestWall = -0.9989;

double node(int i, int count) { return -std::cos(std::numbers::pi * (i + 0.5) / count); }

std::vector<double> coefficients(const std::vector<double>& at_nodes) {
  const int count = static_cast<int>(at_nodes.size());
  std::vector<double> all;
  for (int k = 0; k < count; ++k) {
    double sum = 0;
    for (int j = 0; j < count; ++j)
      sum += at_nodes[static_cast<std::size_t>(j)] * std::cos(k * std::acos(node(j, count)));
    all.push_back(sum * (k == 0 ? 1 : 2) / count);
  }
  return all;
}

double sum_at(const std::vector<double>& coefficients, double x) {
  double sum = 0;
  for (std::size_t k = 0; k < coefficients.size(); ++k)
    sum += coefficients[k] * std::cos(static_cast<double>(k) * std::acos(x));
  return sum;
}

/// The mean of the resistance less 1/width and the mean of the terms, at the nodes of the table.
std::vector<double> means_at_nodes(double ratio) {
  const SqueezeTerms film(ratio);
  const double last = film.coordinate(film.largest_width());
  std::vector<double> rest;
  for (int j = 0; j < kNodes; ++j) {
    const double width = std::max(kSmallestWidth, film.width_at(last * (node(j, kNodes) + 1) / 2));
    rest.push_back(exact_squeeze(ratio, width) - 1 / width - film.terms(width));
  }
  const auto polynomial = coefficients(rest);
  std::vector<double> means;
  for (int j = 0; j < kGaps; ++j) {
    const double end = last * (node(j, kGaps) + 1) / 2, width = film.width_at(end);
    // In u with coordinate = end u^2 the integrand is smooth; three Gauss nodes in each part.
    constexpr int kParts = 400;
    double sum = 0;
    for (int part = 0; part < kParts; ++part)
      for (const int side : {-1, 0, 1}) {
        const double u = (part + 0.5 + side * std::sqrt(0.6) / 2) / kParts, at = end * u * u;
        const double here = film.width_at(at);
        const double slope =
            ratio < 0 ? 4 * at / ((1 - at * at) * (1 - at * at)) : std::sinh(2 * at);
        const double value = sum_at(polynomial, 2 * at / last - 1) + film.terms(here);
        sum += (side == 0 ? 8 : 5) / 18.0 / kParts * value * slope * 2 * end * u;
      }
    means.push_back(sum / width - film.mean_of_terms(width));
  }
  return means;
}

void print_table(const char* name, int side) {
  std::vector<std::vector<double>> by_ratio;
  for (int i = 0; i < kRatios; ++i) {
    const double x = (node(i, kRatios) + 1) / 2;
    const double ratio = side > 0 ? std::max(x, kSmallestRatio) : std::max(-x, kTightestWall);
    by_ratio.push_back(coefficients(means_at_nodes(ratio)));
  }
  std::printf("inline constexpr SqueezeTable %s = {{\n", name);
  for (std::size_t j = 0; j < kGaps; ++j) {
    std::vector<double> of_ratio;
    for (const auto& means : by_ratio) of_ratio.push_back(means[j]);
    std::printf("    {{");
    const auto row = coefficients(of_ratio);
    for (std::size_t k = 0; k < row.size(); ++k)
      std::printf("%s%.9g", k == 0 ? "" : k % 5 == 0 ? ",\n      " : ", ", row[k]);
    std::puts("}},");
  }
  std::puts("}};");
}

}  // namespace
}  // namespace viscontact

int main() {
  std::puts(
      "// What is left of the mean resistance to squeezing without the terms near contact. Written "
      "by\n// squeeze_rest_table (tests/oracles/bispherical) from exact solutions.\n#pragma "
      "once\n\n"
      "#include <array>\n#include <cstddef>\n\n#include "
      "\"viscontact/lubrication/pairs/squeeze_terms.hpp\"\n\nnamespace viscontact::lubrication "
      "{\n\n"
      "/// Coefficients of Chebyshev polynomials, in 2 coordinate/largest - 1 (rows) and 2 |ratio| "
      "- "
      "1,\n/// with the coordinate, its largest value and the ratio of SqueezeTerms.");
  std::printf("inline constexpr std::size_t kSqueezeGapTerms = %d, kSqueezeRatioTerms = %d;\n",
              viscontact::kGaps, viscontact::kRatios);
  std::puts(
      "using SqueezeTable = std::array<std::array<double, kSqueezeRatioTerms>, "
      "kSqueezeGapTerms>;\n\n// clang-format off");
  viscontact::print_table("kSqueezeOfPair", 1);
  viscontact::print_table("kSqueezeInWall", -1);
  std::puts("// clang-format on\n\n}  // namespace viscontact::lubrication");
}
