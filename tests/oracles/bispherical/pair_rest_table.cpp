// Prints lubrication/pairs/pair_rest.hpp, computed anew in some seconds:
//     build/release/pair_rest_table > lubrication/pairs/pair_rest.hpp
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "tests/oracles/bispherical/pair_matrix.hpp"
#include "viscontact/lubrication/pairs/pair_near_contact.hpp"

namespace viscontact {
namespace {

using namespace lubrication;  // NOLINT

// Measured at random ratios and gaps from 1e-3 to 5: 18 polynomials in the gap and 10 in ln b have
// the largest error 1.5e-6 of the mean of the diagonal entries for b <= 10. Products whose
// coefficients are below kLeast are left out, which are a third of them. 12 and 9 have 1.3e-5, 12 and
// 7 1.2e-4, 16 and 11 2e-6.
constexpr int kGaps = 18, kRatios = 10;
constexpr double kLeast = 3e-7;
// For 10 < b <= 100, where an exact solution takes seconds.
constexpr int kFarGaps = 16, kFarRatios = 8;
constexpr double kFarLeast = 1e-6;
// Below this gap the rest for b > 10 is linear in the gap, to 1e-5; exact solutions there take
// gigabytes.
constexpr double kLinear = 1.5e-3;
// The ratio that stands for the plane.
constexpr double kPlane = 1e9;

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

bool is_of_sphere1(const PairEntryTerms& terms) {
  return terms.row_sphere == 0 && terms.column_sphere == 0;
}

/// What is left of the normalised entries without the terms near contact; at a plane of the entries
/// of sphere 1, and 0 of the others.
std::vector<double> rest(double b, double gap) {
  const bool plane = b == kPlane;
  if (b > PairCoordinates::kNearRatio && !plane && gap < kLinear) {
    const auto here = rest(b, kLinear), there = rest(b, 2 * kLinear);
    std::vector<double> extrapolated;
    for (std::size_t e = 0; e < here.size(); ++e)
      extrapolated.push_back(here[e] + (here[e] - there[e]) * (1 - gap / kLinear));
    return extrapolated;
  }
  const auto matrix = plane ? exact_plane_matrix(1, gap) : exact_pair_matrix(1, b, gap);
  const auto weights = PairCoordinates(b, gap).contact_weights();
  std::vector<double> rest;
  for (std::size_t e = 0; e < kPairEntries; ++e) {
    const auto& terms = kPairEntryTerms[e];
    if (plane && !is_of_sphere1(terms)) {
      rest.push_back(0);
      continue;
    }
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

/// A table of the radii 1 and b in [lowest, highest], with one polynomial if these are equal.
void print_table(const char* name, double lowest, double highest, int ratios, int gaps,
                 double least) {
  std::vector<std::vector<double>> at_nodes;
  for (int i = 0; i < ratios; ++i)
    for (int j = 0; j < gaps; ++j) {
      const double b =
          ratios == 1 ? lowest : lowest * std::pow(highest / lowest, (node(i, ratios) + 1) / 2);
      at_nodes.push_back(rest(b, PairCoordinates::gap_at(b, node(j, gaps))));
    }
  std::vector<std::string> products;
  for (int p = 0; p < ratios; ++p)
    for (int q = 0; q < gaps; ++q) {
      std::array<double, kPairEntries> sums{};
      double largest = 0;
      for (std::size_t e = 0; e < kPairEntries; ++e) {
        for (int i = 0; i < ratios; ++i)
          for (int j = 0; j < gaps; ++j)
            sums[e] += at_nodes[static_cast<std::size_t>(i * gaps + j)][e] *
                       std::cos(p * std::acos(node(i, ratios))) *
                       std::cos(q * std::acos(node(j, gaps)));
        sums[e] *= (p == 0 ? 1.0 : 2) * (q == 0 ? 1 : 2) / (ratios * gaps);
        largest = std::max(largest, std::abs(sums[e]));
      }
      if (largest < least) continue;
      std::string text = fmt::format("    {{{}, {}, {{{{", p, q);
      for (std::size_t e = 0; e < kPairEntries; ++e)
        text += fmt::format("{}{:.9g}",
                            e == 0       ? ""
                            : e % 9 == 0 ? ",\n      "
                                         : ", ",
                            std::abs(sums[e]) < 1e-9 ? 0 : sums[e]);
      products.push_back(text + "}}},\n");
    }
  fmt::print("inline constexpr std::array<PairProduct, {}> {} = {{{{\n", products.size(), name);
  for (const auto& product : products) fmt::print("{}", product);
  fmt::print("}}}};\n\n");
}

}  // namespace
}  // namespace viscontact

int main() {
  using namespace viscontact;  // NOLINT
  std::puts(
      "// What is left of a pair's entries, over those of the spheres alone, without the terms "
      "near\n"
      "// contact. Written by pair_rest_table (tests/oracles/bispherical) from exact solutions.\n"
      "#pragma once\n\n#include <array>\n#include <cstddef>\n\n"
      "#include \"viscontact/lubrication/pairs/pair_near_contact.hpp\"\n\n"
      "namespace viscontact::lubrication {\n\n"
      "/// A product of two Chebyshev polynomials, of these orders, in the variables of\n"
      "/// PairCoordinates, and its coefficients in the sums of all entries.\n"
      "struct PairProduct {\n  std::size_t ratio_order, gap_order;\n"
      "  std::array<double, kPairEntries> coefficients;\n};\n\n"
      "/// Numbers of polynomials.");
  fmt::print("inline constexpr std::size_t kRatioTerms = {}, kGapTerms = {};\n\n", kRatios, kGaps);
  std::puts("// clang-format off\n/// For b <= PairCoordinates::kNearRatio.");
  print_table("kPairRest", 1, PairCoordinates::kNearRatio, kRatios, kGaps, kLeast);
  std::puts("/// Up to kFarRatio.");
  print_table("kFarPairRest", PairCoordinates::kNearRatio * (1 + 1e-15), PairCoordinates::kFarRatio,
              kFarRatios, kFarGaps, kFarLeast);
  std::puts("/// Of a plane; 0 for what is not of sphere 1.");
  print_table("kPlaneRest", kPlane, kPlane, 1, kGaps, kLeast);
  std::puts("// clang-format on\n\n}  // namespace viscontact::lubrication");
}
