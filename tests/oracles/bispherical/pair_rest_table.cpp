// Prints lubrication/pairs/pair_rest.hpp, computed anew in some seconds:
//     build/release/pair_rest_table > lubrication/pairs/pair_rest.hpp
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "tests/oracles/bispherical/pair_matrix.hpp"
#include "viscontact/lubrication/pairs/pair_near_contact.hpp"

namespace viscontact {
namespace {

using namespace lubrication;  // NOLINT

// Measured at random ratios and gaps from 1e-3 to 5: 12 and 9 polynomials have the largest error
// 1.3e-5 of the mean of the diagonal entries, 12 and 7 1.2e-4, 16 and 11 2e-6.
constexpr int kGaps = 12, kRatios = 9;
constexpr double kLargestRatio = 10;

double node(int i, int count) { return -std::cos(std::numbers::pi * (i + 0.5) / count); }

/// Index of the component of an entry in the matrix of the pair.
Eigen::Index component(std::size_t entry, PairComponent which) {
  if (entry < 10) return which == kMove ? 2 : 6;
  if (entry < 31) return which == kMove ? 0 : which == kTurn ? 4 : 7;
  return entry < 34 ? 9 : 5;
}

double entry_alone(PairComponent which, double radius) {
  constexpr double kPi = std::numbers::pi;
  if (which == kMove) return 6 * kPi * radius;
  return (which == kTurn ? 8 : 20.0 / 3) * kPi * radius * radius * radius;
}

/// What is left of the normalised entries without the terms near contact.
std::vector<double> rest(double b, double gap) {
  const auto matrix = exact_pair_matrix(1, b, gap);
  const auto weights = PairCoordinates(b, gap).contact_weights();
  std::vector<double> rest;
  for (std::size_t e = 0; e < kPairEntries; ++e) {
    const auto& terms = kPairEntryTerms[e];
    double contact = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      double polynomial = 0;
      for (std::size_t p = 7; p-- > 0;) polynomial = polynomial * b + terms.terms[k].numerator[p];
      contact += weights[k] * polynomial / terms.terms[k].denominator;
    }
    const double tensor = std::sqrt(e < 10 ? 1.5 : 0.5);
    for (const auto which : {terms.row, terms.column})
      if (which == kStrain) contact *= tensor;
    const double entry = matrix(component(e, terms.row) + 11 * terms.row_sphere,
                                component(e, terms.column) + 11 * terms.column_sphere);
    rest.push_back((entry - contact) /
                   std::sqrt(entry_alone(terms.row, terms.row_sphere == 0 ? 1 : b) *
                             entry_alone(terms.column, terms.column_sphere == 0 ? 1 : b)));
  }
  return rest;
}

void print_table() {
  std::array<std::array<std::vector<double>, kGaps>, kRatios> at_nodes;
  for (int i = 0; i < kRatios; ++i)
    for (int j = 0; j < kGaps; ++j) {
      const double b = std::pow(kLargestRatio, (node(i, kRatios) + 1) / 2);
      const double to_contact = std::pow((1 - node(j, kGaps)) / 2, 2);
      at_nodes[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          rest(b, 2 * std::sqrt(b) * to_contact / (1 - to_contact));
    }
  std::puts(
      "// What is left of a pair's entries, over those of the spheres alone, without the terms "
      "near\n"
      "// contact. Written by pair_rest_table (tests/oracles/bispherical) from exact solutions.\n"
      "#pragma once\n\n#include <array>\n#include <cstddef>\n\n"
      "#include \"viscontact/lubrication/pairs/pair_near_contact.hpp\"\n\n"
      "namespace viscontact::lubrication {\n\n"
      "/// Numbers of Chebyshev polynomials in the variables of PairCoordinates.");
  std::printf("inline constexpr std::size_t kRatioTerms = %d, kGapTerms = %d;\n\n", kRatios, kGaps);
  std::puts(
      "/// Their coefficients.\n// clang-format off\n"
      "inline constexpr std::array<std::array<std::array<double, kPairEntries>, kGapTerms>, "
      "kRatioTerms> kPairRest = {{");
  for (int p = 0; p < kRatios; ++p) {
    std::puts("{{");
    for (int q = 0; q < kGaps; ++q) {
      std::printf("{{");
      for (std::size_t e = 0; e < kPairEntries; ++e) {
        double sum = 0;
        for (int i = 0; i < kRatios; ++i)
          for (int j = 0; j < kGaps; ++j)
            sum += at_nodes[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)][e] *
                   std::cos(p * std::acos(node(i, kRatios))) *
                   std::cos(q * std::acos(node(j, kGaps)));
        std::printf("%s%.10g",
                    e == 0       ? ""
                    : e % 8 == 0 ? ",\n  "
                                 : ", ",
                    sum * (p == 0 ? 1 : 2) * (q == 0 ? 1 : 2) / (kRatios * kGaps));
      }
      std::puts("}},");
    }
    std::puts("}},");
  }
  std::puts("}};\n// clang-format on\n\n}  // namespace viscontact::lubrication");
}

}  // namespace
}  // namespace viscontact

int main() { viscontact::print_table(); }
