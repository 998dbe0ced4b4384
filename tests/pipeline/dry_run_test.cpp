#include "viscontact/pipeline/dry_run.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace viscontact::pipeline {
namespace {

using ::testing::EndsWith;

/// A table with ten rows left, and one with a single row left.
const std::vector<DryRun> kRuns = {{"a.csv", 12, 2, 1, 1.5, "its finished rows"},
                                   {"b.csv", 1, 0, 0, 100, "the shipped tables' rows"}};

TEST(DryRun, SaysTheRowsOfEachOutputAndTheTimeOfAll) {
  EXPECT_EQ(dry_run_text(kRuns, 2, false),
            "a.csv: 12 rows, 2 of them finished, 1 failed; 1.5 s a row (from its finished rows)\n"
            "b.csv: 1 rows, 0 of them finished; 1e+02 s a row (from the shipped tables' rows)\n"
            "about 108 s with 2 at once\n");  // 10 * 1.5 / 2 + 100 / 1 = 107.5
}

TEST(DryRun, SaysTheSameAsJson) {
  const auto json = nlohmann::json::parse(dry_run_text(kRuns, 2, true));
  EXPECT_EQ(json.at("jobs"), 2);
  EXPECT_EQ(json.at("seconds"), 107.5);
  ASSERT_EQ(json.at("outputs").size(), 2U);
  EXPECT_EQ(json.at("outputs")[0].at("rows"), 12);
  EXPECT_EQ(json.at("outputs")[0].at("failed"), 1);
  EXPECT_EQ(json.at("outputs")[1].at("failed"), 0);
  EXPECT_EQ(json.at("outputs")[0].at("estimated_from"), "its finished rows");
}

TEST(DryRun, SaysTimesInTheUnitThatFits) {
  const auto time = [](double seconds) {
    return dry_run_text({{"a.csv", 1, 0, 0, seconds, "x"}}, 1, false);
  };
  EXPECT_THAT(time(0.01), EndsWith("\nless than 0.1 s with 1 at once\n"));
  EXPECT_THAT(time(1.25), EndsWith("\nabout 1.2 s with 1 at once\n"));
  EXPECT_THAT(time(600), EndsWith("\nabout 10 min with 1 at once\n"));
  EXPECT_THAT(time(36000), EndsWith("\nabout 10 h with 1 at once\n"));
  EXPECT_THAT(time(864000), EndsWith("\nabout 10 days with 1 at once\n"));
}

}  // namespace
}  // namespace viscontact::pipeline
