// Reads data/reference/near_contact_expansion.csv for the tests: the drag factor lambda of a sphere
// near a plane as a series in eps = gap/radius. All numbers are dimensionless.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact {

inline const std::filesystem::path kReference =
    std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data" / "reference";

/// A term of lambda = sum_k eps^k (constant + logarithm * ln eps), k = -1, 0, 1, ...
struct ExpansionTerm {
  double constant, logarithm;
  double at(double epsilon, int power) const {
    return std::pow(epsilon, power) * (constant + logarithm * std::log(epsilon));
  }
};

/// The terms for one `kind` of plane, "rigid" or "free" (of shear stress), in the order of k. The
/// file is not read by read_csv, because it contains fractions.
inline std::vector<ExpansionTerm> near_contact_expansion(const std::string& kind) {
  // "-15416/9095625" or "0.97".
  const auto fraction = [](const std::string& text) {
    const auto slash = text.find('/');
    if (slash == std::string::npos) return parse_number(text).value();
    return parse_number(text.substr(0, slash)).value() /
           parse_number(text.substr(slash + 1)).value();
  };
  std::istringstream stream(read_file(kReference / "near_contact_expansion.csv"));
  std::vector<ExpansionTerm> terms;
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(kind + ",")) continue;
    std::istringstream fields(line);
    std::string name, power, constant, logarithm;
    std::getline(fields, name, ',');
    std::getline(fields, power, ',');
    std::getline(fields, constant, ',');
    std::getline(fields, logarithm, ',');
    EXPECT_EQ(std::stoi(power), static_cast<int>(terms.size()) - 1)
        << "the rows are in the order of the powers";
    terms.push_back({fraction(constant), fraction(logarithm)});
  }
  return terms;
}

/// Expects that drag_factor(epsilon) less the first terms of the expansion is about the next term,
/// for each number of first terms.
template <typename Function>
void expect_next_terms_of_cut_expansion(const std::vector<ExpansionTerm>& terms,
                                        Function drag_factor) {
  ASSERT_EQ(terms.size(), 6U);
  for (const double epsilon : {1e-4, 1e-3, 1e-2, 3e-2}) {
    const double exact = drag_factor(epsilon);
    double sum = 0;
    for (std::size_t i = 0; i + 1 < terms.size(); ++i) {
      sum += terms[i].at(epsilon, static_cast<int>(i) - 1);
      const double next = terms[i + 1].at(epsilon, static_cast<int>(i));
      // The term after the next one is smaller by a factor of order epsilon: at most 2.1 epsilon by
      // the coefficients of the file, so that 4 is enough. The difference lambda - sum has the
      // rounding errors of lambda, a few times 5e-16.
      EXPECT_NEAR(exact - sum, next, 4 * epsilon * std::abs(next) + 2e-15 * exact)
          << "cut after eps^" << static_cast<int>(i) - 1 << " at gap/radius " << epsilon;
    }
  }
}

/// Expects that drag_factor is the whole expansion within the relative difference `tolerance`, at
/// gaps at which the expansion is more exact than that.
template <typename Function>
void expect_expansion_at_small_gaps(const std::vector<ExpansionTerm>& terms, Function drag_factor,
                                    double tolerance) {
  for (const double epsilon : {1e-6, 1e-5}) {
    double sum = 0;
    for (std::size_t i = 0; i < terms.size(); ++i)
      sum += terms[i].at(epsilon, static_cast<int>(i) - 1);
    // What the expansion leaves out is below eps^5 ln eps = 1e-24.
    EXPECT_NEAR(drag_factor(epsilon), sum, tolerance * sum) << "at gap/radius " << epsilon;
  }
}

}  // namespace viscontact
