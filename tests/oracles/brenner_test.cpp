// The oracle itself, against reference values computed elsewhere to more digits than it has.
#include "tests/oracles/brenner.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/oracles/near_contact_expansion.hpp"
#include "viscontact/common/text/csv.hpp"

namespace viscontact {
namespace {

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
  expect_next_terms_of_cut_expansion(near_contact_expansion("rigid"), brenner_drag_factor);
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
  expect_expansion_at_small_gaps(near_contact_expansion("rigid"), brenner_drag_factor, 1e-13);
}

}  // namespace
}  // namespace viscontact
