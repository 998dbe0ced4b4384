#include "viscontact/fitting/basis_comparison.hpp"

#include <gmock/gmock.h>

#include <atomic>

#include "tests/common/failure.hpp"
#include "tests/fitting/samples.hpp"
#include "viscontact/fitting/fit_force_table.hpp"

namespace viscontact::fitting {
namespace {

TEST(CompareBases, FitsEveryBasisAndNamesTheOneOfLeastCriterion) {
  const auto results = compare_bases(exact_drag_table(fifty_gaps(), {-1}, 3, 1), {});
  ASSERT_EQ(results.size(), lubrication::all_bases().size());
  for (const auto& result : results) ASSERT_TRUE(result.fit.has_value()) << result.failure;
  EXPECT_EQ(best_basis(results)->basis, "asymptotic_extended");
}

TEST(CompareBases, TakesAUsersOwnTermsAlong) {
  FitSettings settings;
  settings.basis = lubrication::parse_terms("1/q, ln q, 1");
  const auto results = compare_bases(exact_drag_table(fifty_gaps(), {-1}, 3, 1), settings);
  EXPECT_EQ(results.back().basis, lubrication::kOwnTerms);
  EXPECT_EQ(results.back().fit->terms.size(), 3U);
}

TEST(CompareBases, EndsWhenAStopIsRequested) {
  const std::atomic<bool> flag = true;
  failure(ErrorKind::kInterrupted,
          [&] { compare_bases(exact_drag_table(fifty_gaps(), {-1}, 3, 1), {}, StopToken(flag)); });
}

TEST(CompareBases, KeepsTheReasonWhereABasisCannotBeFitted) {
  const auto results = compare_bases(exact_drag_table(log_spaced(1e-3, 1, 6), {-1}, 3, 1), {});
  EXPECT_TRUE(results[0].fit.has_value());
  EXPECT_FALSE(results[2].fit.has_value());
  EXPECT_THAT(results[2].failure, Names("8"));
}

TEST(CompareBases, PrefersTheSmallerBasisWhereTheLargerOneFitsNoise) {
  // k/q + 1 with noise: what the lecture's five terms leave is not the smaller for three more.
  lubrication::MotionTable table = exact_drag_table(fifty_gaps(), {-1}, 3, 1);
  double sign = 1;
  for (auto& row : table.rows) row.force = (50 / row.gap + 1) * (1 + 1e-3 * (sign = -sign));
  FitSettings settings;
  settings.basis = lubrication::parse_terms("1/q, 1");
  EXPECT_EQ(best_basis(compare_bases(table, settings))->basis, lubrication::kOwnTerms);
}

}  // namespace
}  // namespace viscontact::fitting
