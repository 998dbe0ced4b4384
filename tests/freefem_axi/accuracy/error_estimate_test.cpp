// That the error estimate of a row is true, against exact drags. bench_estimates does the same with
// many more rows.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tests/freefem_axi/accuracy/exact_rows.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::freefem_axi {
namespace {

// What GoogleTest shows of the parameter.
std::ostream& operator<<(std::ostream& out, const ExactRows& rows) { return out << rows.name; }

class ErrorEstimate : public ::testing::TestWithParam<ExactRows> {};

TEST_P(ErrorEstimate, IsAboveTheErrorAndNotAHundredTimesIt) {
  const double accuracy = std::string(GetParam().name) == "cavity" ? 1e-6 : 1e-5;
  Random random(1);  // always the same row
  const auto solved = solve(default_freefem(), GetParam().draw(random, accuracy));
  SCOPED_TRACE(solved.in_words());
  EXPECT_TRUE(solved.says_reached());
  EXPECT_LE(solved.error(), accuracy);
  // Estimates a hundred times the error would make meshes needlessly fine. (Medians over many rows:
  // bench/README.md.)
  EXPECT_LE(solved.ratio(), 1);
  EXPECT_GT(solved.ratio(), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Of, ErrorEstimate, ::testing::ValuesIn(exact_rows()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace viscontact::freefem_axi
