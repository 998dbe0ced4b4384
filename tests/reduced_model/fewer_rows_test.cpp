#include <gmock/gmock.h>

#include <algorithm>

#include "tests/reduced_model/cases.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {
namespace {

using ::testing::ElementsAre;

std::vector<TrajectoryRow> rows_at(const std::vector<double>& times) {
  std::vector<TrajectoryRow> rows;
  for (const double t : times) rows.push_back({t, 1, 0});
  return rows;
}

std::vector<double> times_of(const std::vector<TrajectoryRow>& rows) {
  std::vector<double> times;
  for (const auto& row : rows) times.push_back(row.time);
  return times;
}

TEST(FewerRows, AreAtEqualDistancesOfTime) {
  EXPECT_THAT(times_of(fewer_rows(rows_at({0, 1, 2, 3, 4, 5, 6, 7, 8}), 5)),
              ElementsAre(0, 2, 4, 6, 8));
  EXPECT_THAT(times_of(fewer_rows(rows_at({0, 0.1, 0.2, 0.3, 7, 8}), 3)), ElementsAre(0, 7, 8));
}

TEST(FewerRows, AreAllWhereThereAreNoMore) {
  EXPECT_THAT(times_of(fewer_rows(rows_at({0, 0.1, 5}), 3)), ElementsAre(0, 0.1, 5));
}

TEST(FewerRows, KeepTheExtremesAndBothSidesOfEachChangeOfContact) {
  auto rows = rows_at({0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  rows[1].gap = 3;
  for (const std::size_t i : {3U, 4U, 5U, 6U}) rows[i].gap = 0, rows[i].gamma = -1;
  rows[4].gamma = -2;
  rows[5].solid_force = 1;
  // Largest gap at 1; contact from 3 to 6, solid contact at 5; lowest gamma at 4.
  EXPECT_THAT(times_of(fewer_rows(rows, 5)), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 9));
  // More than 2 changes: only the first and the last.
  EXPECT_THAT(times_of(fewer_rows(rows, 2)), ElementsAre(0, 1, 2, 3, 4, 6, 7, 9));
}

TEST(FewerRows, ChangeNothingThatAComparisonSaysOfOneModel) {
  Motion motion = lecture_motion();
  motion.roughness = {2e-3, 3e-3};
  const lubrication::LubricationForce force = lubrication::LubricationForce::exact_plane(3, 1);
  for (const auto& model : all_models()) {
    const auto whole = simulate(find_model(model.name), motion, force);
    auto fewer = whole;
    fewer.rows = fewer_rows(whole.rows, 50);
    EXPECT_LT(fewer.rows.size(), std::min<std::size_t>(70, whole.rows.size())) << model.name;
    const auto of = [](const Trajectory& trajectory) {
      return compare_trajectories({trajectory}, trajectory.model).models.front();
    };
    const auto a = of(whole), b = of(fewer);
    EXPECT_EQ(a.minimal_gap, b.minimal_gap) << model.name;
    EXPECT_EQ(a.minimal_gap_time, b.minimal_gap_time) << model.name;
    EXPECT_EQ(a.film_from_gamma, b.film_from_gamma) << model.name;
    EXPECT_EQ(a.contact_interval, b.contact_interval) << model.name;
    // Without what the model says itself, as in a file of a user's own.
    auto own_whole = whole, own_fewer = fewer;
    own_whole.contact_interval.reset();
    own_fewer.contact_interval.reset();
    EXPECT_EQ(of(own_whole).contact_interval, of(own_fewer).contact_interval) << model.name;
  }
}

TEST(Progress, IsToldByEveryModelInTimesThatDoNotDecrease) {
  Motion motion = lecture_motion();
  motion.set(kContactTimeStep, 1e-4);
  motion.set(kReferenceTimeStep, 1e-4);
  for (const auto& model : all_models()) {
    std::vector<double> told;
    motion.progress = [&](double time) { told.push_back(time); };
    (void)simulate(find_model(model.name), motion,
                   lubrication::LubricationForce::exact_plane(3, 1));
    EXPECT_TRUE(std::ranges::is_sorted(told)) << model.name;
    ASSERT_FALSE(told.empty()) << model.name;
    if (model.name != "explicit_euler") {  // goes through the plane, and ends there
      EXPECT_GT(told.back(), 1) << model.name;
    }
    EXPECT_LE(told.back(), motion.end_time) << model.name;
  }
}

TEST(Progress, MayEndAModel) {
  Motion motion = lecture_motion();
  motion.progress = [](double) { throw Error(ErrorKind::kInterrupted, "enough"); };
  for (const auto& model : all_models())
    EXPECT_THROW((void)simulate(find_model(model.name), motion,
                                lubrication::LubricationForce::exact_plane(3, 1)),
                 Error)
        << model.name;
}

}  // namespace
}  // namespace viscontact::reduced_model
