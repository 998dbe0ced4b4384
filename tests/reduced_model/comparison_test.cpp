#include "viscontact/reduced_model/comparison.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"

namespace viscontact::reduced_model {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using Function = std::function<double(double)>;

/// q and u at these times. All numbers in these tests are dyadic: sup and L1 by hand come out to
/// the bit.
Trajectory sampled(
    const std::string& model, const std::vector<double>& times, const Function& gap,
    const Function& velocity = [](double) { return 0.0; }) {
  Trajectory trajectory;
  trajectory.model = model;
  for (const double t : times) trajectory.rows.push_back({t, gap(t), velocity(t), {}, {}, {}});
  return trajectory;
}

Function constant(double value) {
  return [value](double) { return value; };
}

ModelComparison compared(const Trajectory& trajectory, const Trajectory& reference) {
  return compare_trajectories({reference, trajectory}, reference.model).models.at(1);
}

TEST(Comparison, IsZeroWithItself) {
  const auto a = sampled(
      "a", {0, 1, 3}, [](double t) { return t * t; }, [](double t) { return 2 * t; });
  const auto result = compare_trajectories({a}, "a").models.at(0);
  EXPECT_EQ(result.sup_gap_distance, 0);
  EXPECT_EQ(result.l1_gap_distance, 0);
  EXPECT_EQ(result.l1_velocity_distance, 0);
}

TEST(Comparison, MeasuresLinearFunctionsOnDifferentGrids) {
  const auto a = sampled("a", {0, 0.5, 2}, constant(1), constant(0.25));
  const auto b = sampled(
      "b", {0, 0.25, 1, 2}, [](double t) { return 1 + t; }, constant(1));
  const auto result = compared(a, b);
  EXPECT_EQ(result.sup_gap_distance, 2);
  EXPECT_EQ(result.l1_gap_distance, 2);
  EXPECT_EQ(result.l1_velocity_distance, 1.5);
}

TEST(Comparison, MeasuresFunctionsThatCrossBetweenTheirRows) {
  // |t - (2 - t)| over [0, 2]: two triangles of area 1.
  const auto a = sampled(
      "a", {0, 2}, [](double t) { return t; }, constant(1));
  const auto b = sampled(
      "b", {0, 2}, [](double t) { return 2 - t; }, constant(-1));
  const auto result = compared(a, b);
  EXPECT_EQ(result.sup_gap_distance, 2);
  EXPECT_EQ(result.l1_gap_distance, 2);
  EXPECT_EQ(result.l1_velocity_distance, 4);
}

TEST(Comparison, FindsTheLargestDistanceAtARowOfTheOtherTrajectory) {
  const auto a = sampled("a", {0, 4}, constant(1));
  auto b = sampled("b", {0, 1, 4}, constant(1));
  b.rows[1].gap = 4;
  EXPECT_EQ(compared(a, b).sup_gap_distance, 3);
  EXPECT_EQ(compared(b, a).sup_gap_distance, 3);
  EXPECT_EQ(compared(a, b).l1_gap_distance, 6);
}

TEST(Comparison, SeesAParabolaAsItsChords) {
  // 1 + t^2 by steps H and H/2: at mid-step the chord of H is H^2/4 above, so sup = H^2/4 and L1 =
  // 2 H^2/8 over [0, 2].
  const auto parabola = [](double t) { return 1 + t * t; };
  const auto coarse =
      sampled("coarse", {0, 0.5, 1, 1.5, 2}, parabola, [](double t) { return 2 * t; });
  const auto fine = sampled("fine", {0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2}, parabola,
                            [](double t) { return 2 * t; });
  const auto result = compared(coarse, fine);
  EXPECT_EQ(result.sup_gap_distance, 0.0625);
  EXPECT_EQ(result.l1_gap_distance, 0.0625);
  EXPECT_EQ(result.l1_velocity_distance, 0);
}

TEST(Comparison, LooksOnlyAtTheTimesThatBothCover) {
  const auto a = sampled(
      "a", {0, 2}, [](double t) { return t; }, [](double t) { return t; });
  const auto b = sampled("b", {1, 3}, constant(0), constant(0));
  const auto result = compared(a, b);
  EXPECT_EQ(result.sup_gap_distance, 2);
  EXPECT_EQ(result.l1_gap_distance, 1.5);
  EXPECT_EQ(result.l1_velocity_distance, 1.5);
  EXPECT_EQ(compared(b, a).l1_gap_distance, 1.5);
}

TEST(Comparison, IsOfOneInstantWhereTheTimesTouch) {
  const auto result =
      compared(sampled("a", {0, 1}, constant(3)), sampled("b", {1, 2}, constant(1)));
  EXPECT_EQ(result.sup_gap_distance, 2);
  EXPECT_EQ(result.l1_gap_distance, 0);
}

TEST(Comparison, RefusesTrajectoriesWithoutATimeInCommon) {
  const auto a = sampled("early", {0, 1}, constant(1));
  const auto b = sampled("late", {1.5, 2}, constant(1));
  EXPECT_THAT(bad_input([&] { compared(a, b); }), Names("early", "late"));
}

TEST(Comparison, RefusesTwoTrajectoriesOfOneName) {
  const auto a = sampled("twin", {0, 1}, constant(1));
  EXPECT_THAT(bad_input([&] { compare_trajectories({a, a}, "twin"); }), Names("twin"));
}

TEST(Comparison, RefusesAReferenceThatIsNotThereAndListsWhatIs) {
  const auto a = sampled("one", {0, 1}, constant(1));
  const auto b = sampled("two", {0, 1}, constant(1));
  EXPECT_THAT(bad_input([&] {
                compare_trajectories({a, b}, "three");
              }),
              Names("three", "one", "two"));
  EXPECT_THAT(bad_input([&] { compare_trajectories({}, "three"); }), Names("three"));
}

TEST(Comparison, FindsTheFirstOfTheLowestRows) {
  const auto a =
      sampled("a", {0, 1, 2, 3, 4}, [](double t) { return t == 1 || t == 3 ? 0.25 : 1.0; });
  const auto result = compare_trajectories({a}, "a").models.at(0);
  EXPECT_EQ(result.minimal_gap, 0.25);
  EXPECT_EQ(result.minimal_gap_time, 1);
}

TEST(Comparison, TakesTheContactFromTheFirstToTheLastRowWithGammaBelowZero) {
  auto a = sampled("a", {0, 1, 2, 3, 4, 5}, constant(0));
  const std::vector<double> gamma = {0, -1, 0, -0.0, -2, 0};
  for (std::size_t i = 0; i < gamma.size(); ++i) a.rows[i].gamma = gamma[i];
  const auto interval = compare_trajectories({a}, "a").models.at(0).contact_interval;
  ASSERT_TRUE(interval.has_value());
  EXPECT_THAT(*interval, ::testing::ElementsAre(1, 4));
}

TEST(Comparison, HasNoContactWhereGammaIsAbsentOrZero) {
  auto a = sampled("a", {0, 1}, constant(1));
  EXPECT_FALSE(compare_trajectories({a}, "a").models.at(0).contact_interval);
  for (auto& row : a.rows) row.gamma = 0;
  EXPECT_FALSE(compare_trajectories({a}, "a").models.at(0).contact_interval);
}

TEST(Comparison, KeepsTheOrderAndWhatTheTrajectoriesKnow) {
  auto a = sampled("zebra", {0, 1}, constant(1));
  a.steps = 12;
  a.seconds = 0.5;
  a.film_from_gamma = 3e-3;
  const auto result = compare_trajectories({a, sampled("ant", {0, 1}, constant(1))}, "ant");
  EXPECT_EQ(result.reference_model, "ant");
  EXPECT_EQ(result.models[0].model, "zebra");
  EXPECT_EQ(result.models[0].steps, 12);
  EXPECT_EQ(result.models[0].seconds, 0.5);
  EXPECT_EQ(result.models[0].film_from_gamma, 3e-3);
  EXPECT_EQ(result.models[1].model, "ant");
}

Comparison two_models() {
  ModelComparison zebra;
  zebra.model = "zebra";
  zebra.minimal_gap = 0.1 + 0.2;
  zebra.minimal_gap_time = 2;
  zebra.film_from_gamma = 2.9708466100000004e-3;
  zebra.contact_interval = {0.59, 1.0 / 3};
  zebra.rebounds = {{0.1 + 0.2, -1.0 / 3, 5e-324, 0, 0}, {1, -2, 3, 1e-17, 5e-18}};
  zebra.sup_gap_distance = 5e-324;
  zebra.l1_gap_distance = 1e308;
  zebra.l1_velocity_distance = 1e-17;
  zebra.steps = 4000;
  zebra.seconds = 0.25;
  ModelComparison ant;
  ant.model = "ant";
  return {"ant", {zebra, ant}};
}

TEST(ComparisonFile, ReadsBackToTheBit) {
  const auto written = two_models();
  const TemporaryFolder folder;
  const auto read = read_comparison(folder.file("c.json", write_comparison(written)));
  EXPECT_EQ(read.reference_model, written.reference_model);
  ASSERT_EQ(read.models.size(), written.models.size());
  for (std::size_t i = 0; i < read.models.size(); ++i) {
    const auto& a = read.models[i];
    const auto& b = written.models[i];
    EXPECT_EQ(a.model, b.model);
    EXPECT_EQ(a.minimal_gap, b.minimal_gap);
    EXPECT_EQ(a.minimal_gap_time, b.minimal_gap_time);
    EXPECT_EQ(a.film_from_gamma, b.film_from_gamma);
    EXPECT_EQ(a.contact_interval, b.contact_interval);
    EXPECT_EQ(a.rebounds, b.rebounds);
    EXPECT_EQ(a.sup_gap_distance, b.sup_gap_distance);
    EXPECT_EQ(a.l1_gap_distance, b.l1_gap_distance);
    EXPECT_EQ(a.l1_velocity_distance, b.l1_velocity_distance);
    EXPECT_EQ(a.steps, b.steps);
    EXPECT_EQ(a.seconds, b.seconds);
  }
}

TEST(ComparisonFile, HasNullWhereAModelHasNoContact) {
  EXPECT_THAT(write_comparison(two_models()), AllOf(HasSubstr("\"film_from_gamma\": null"),
                                                    HasSubstr("\"contact_interval\": null")));
}

TEST(ComparisonFile, IsRefusedWhenItIsSomethingElse) {
  const TemporaryFolder folder;
  std::string without_a_key = write_comparison(two_models());
  without_a_key.replace(without_a_key.find("\"steps\""), 7, "\"stops\"");
  std::string cut_off = write_comparison(two_models());
  cut_off.resize(cut_off.size() / 2);
  for (const std::string& text :
       {std::string(), std::string("{}"), std::string("[1, 2]"), std::string("time,gap\n0,1\n"),
        std::string(R"({"reference_model": 3, "models": {}})"),
        std::string(R"({"reference_model": "a", "models": {"a": 1}})"),
        std::string(R"({"reference_model": "a", "models": 5})"), without_a_key, cut_off}) {
    const auto path = folder.file("wrong.json", text);
    // A syntax error has its line, too.
    EXPECT_THAT(bad_input([&] { read_comparison(path); }), IsAt(path.string())) << text;
  }
}

TEST(ComparisonFile, IsRefusedWhenItIsAFolderOrMissing) {
  const TemporaryFolder folder;
  for (const auto& path : {folder.path(), folder.path() / "missing.json"})
    EXPECT_THAT(bad_input([&] { read_comparison(path); }), IsAt(path.string()));
}

}  // namespace
}  // namespace viscontact::reduced_model
