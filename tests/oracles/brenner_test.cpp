// The oracle itself, against reference values computed elsewhere to more digits than it has.
#include "tests/oracles/brenner.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "common/csv.hpp"
#include "common/file.hpp"
#include "common/number.hpp"

namespace viscontact {
namespace {

const std::filesystem::path kReference =
    std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data" / "reference";

/// lambda = sum_k eps^k (constant + logarithm * ln eps), k = -1, 0, 1, ...
struct ExpansionTerm {
  double constant, logarithm;
  double at(double epsilon, int power) const {
    return std::pow(epsilon, power) * (constant + logarithm * std::log(epsilon));
  }
};

/// "-15416/9095625" or "0".
double fraction(const std::string& text) {
  const auto slash = text.find('/');
  if (slash == std::string::npos) return parse_number(text).value();
  return parse_number(text.substr(0, slash)).value() / parse_number(text.substr(slash + 1)).value();
}

/// The rows of the rigid plane; the file's fractions are not for read_csv.
std::vector<ExpansionTerm> rigid_plane_expansion() {
  std::istringstream stream(read_file(kReference / "near_contact_expansion.csv"));
  std::vector<ExpansionTerm> terms;
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("rigid,")) continue;
    std::istringstream fields(line);
    std::string kind, power, constant, logarithm;
    std::getline(fields, kind, ',');
    std::getline(fields, power, ',');
    std::getline(fields, constant, ',');
    std::getline(fields, logarithm, ',');
    EXPECT_EQ(std::stoi(power), static_cast<int>(terms.size()) - 1)
        << "the rows are in the order of the powers";
    terms.push_back({parse_number(constant).value(), fraction(logarithm)});
  }
  return terms;
}

TEST(Brenner, AgreesWithTheReferenceValues) {
  const auto table = read_csv(kReference / "sphere_plane.csv",
                              std::array<std::string, 2>{"gap_over_r", "lambda"}, 2);
  ASSERT_GE(table.rows.size(), 8U);
  for (const auto& row : table.rows) {
    const double epsilon = row.fields[0].value();
    const double exact = row.fields[1].value();
    // The reference has 22 digits, the sum is done in long double, and what remains is the rounding
    // of both to double; an argument's own rounding counts once, because lambda varies like
    // 1/epsilon at most. 1e-12 leaves room.
    EXPECT_NEAR(brenner_drag_factor(epsilon), exact, 1e-12 * exact) << "at gap/radius " << epsilon;
  }
}

TEST(Brenner, DiffersFromACutExpansionByTheNextTerms) {
  const auto terms = rigid_plane_expansion();
  ASSERT_EQ(terms.size(), 6U);
  for (const double epsilon : {1e-4, 1e-3, 1e-2, 3e-2}) {
    const double exact = brenner_drag_factor(epsilon);
    double sum = 0;
    for (std::size_t i = 0; i + 1 < terms.size(); ++i) {
      sum += terms[i].at(epsilon, static_cast<int>(i) - 1);
      const double next = terms[i + 1].at(epsilon, static_cast<int>(i));
      // After the next term comes one smaller by a factor of order epsilon (coefficients fall too,
      // so twice it is room), and lambda - sum cannot be known better than lambda's own last digits
      // (5e-16 each, a few of them).
      EXPECT_NEAR(exact - sum, next, 2 * epsilon * std::abs(next) + 2e-15 * exact)
          << "cut after eps^" << static_cast<int>(i) - 1 << " at gap/radius " << epsilon;
    }
  }
}

TEST(Brenner, TendsToStokesDragFarFromThePlane) {
  // Lorentz 1907: lambda = 1 + (9/8) r/h + (9/8)^2 (r/h)^2 + O((r/h)^3), h = r + q.
  for (const double epsilon : {1e2, 1e3}) {
    const double x = 9.0 / 8 / (1 + epsilon);
    EXPECT_NEAR(brenner_drag_factor(epsilon), 1 + x + x * x, 2 * x * x * x)
        << "at gap/radius " << epsilon;
  }
}

TEST(Brenner, HoldsItsDigitsAtTheSmallestGapsItPromises) {
  const auto terms = rigid_plane_expansion();
  for (const double epsilon : {1e-6, 1e-5}) {
    double sum = 0;
    for (std::size_t i = 0; i < terms.size(); ++i)
      sum += terms[i].at(epsilon, static_cast<int>(i) - 1);
    // What the expansion leaves out is below eps^5 ln eps = 1e-24: both are exact to the promised
    // 1e-13.
    EXPECT_NEAR(brenner_drag_factor(epsilon), sum, 1e-13 * sum) << "at gap/radius " << epsilon;
  }
}

}  // namespace
}  // namespace viscontact
