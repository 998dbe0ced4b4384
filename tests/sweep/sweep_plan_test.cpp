// Plans of sweeps that are refused, and rows that are handed over in order by several threads.
#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <thread>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/sweep/sweep_rows.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/sweep/sphere_study.hpp"

namespace viscontact::sweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::Lt;
using ::testing::Not;

TEST(SweepPlanCheck, FirstAndLastPointMustBeCases) {
  for (const std::string values : {"-1,1", "1,-1"})
    EXPECT_THAT(bad_input([&] {
                  sphere_study(
                      varied(shipped("vanishing_viscosity.toml"), {"fluid.viscosity=" + values}),
                      "");
                }),
                AllOf(IsAt("vanishing_viscosity.toml", "fluid.viscosity"), Names("-1")));
  EXPECT_THAT(bad_input([] {
                sphere_study(varied(shipped("vanishing_viscosity.toml"), {"fluid.viscosty=1,2"}),
                             "");
              }),
              IsAt("vanishing_viscosity.toml", "fluid.viscosty"));
}

TEST(SweepPlanCheck, CaseNeedsAMotion) {
  const TemporaryFolder folder;
  auto text = read_file(data("cases/vanishing_viscosity.toml"));
  text.erase(text.find("[motion]"));
  auto plan = shipped("vanishing_viscosity.toml");
  plan.case_path = folder.file("case.toml", text);
  // The ranges of the sweep are not named, because the case has no motion without them, either.
  EXPECT_THAT(bad_input([&] { sphere_study(plan, ""); }),
              AllOf(IsAt(plan.case_path.string(), "motion"), Not(Names("--vary"))));
}

TEST(SweepPlanCheck, FitIsScaledToTheRadius) {
  // The fit is R = k/q, and k is proportional to mu r^2: twice the radius is four times the
  // viscosity. The film of viscous contact depends on k alone; the roundings are those of 1000
  // sums.
  const auto film = [](const std::string& variation) {
    const auto plan = varied(shipped("vanishing_viscosity.toml"), {variation});
    return number(row_of(with_models(plan, {"viscous_contact"}, "viscous_contact"), 1),
                  "viscous_contact.film_from_gamma");
  };
  const double radius = 0.23032943298089034, viscosity = 1;
  EXPECT_NEAR(film(fmt::format("sphere.radius={},{}", radius, 2 * radius)) /
                  film(fmt::format("fluid.viscosity={},{}", viscosity, 4 * viscosity)),
              1, 1e-12);
  // k = 6 pi mu r^2 = 4, and gamma is -1 at the end of the push, q0 = 1: exp(gamma/k).
  const auto row =
      row_of(varied(shipped("regime_map.toml"), {"sphere.radius=1,2", "sphere.mass=0.1"}), 1);
  EXPECT_NEAR(number(row, "viscous_contact.film_from_gamma") / std::exp(-0.25), 1, 1e-12);
}

TEST(SweepPlanCheck, DensitiesAreVariedWhereTheMotionDependsOnThem) {
  const TemporaryFolder folder;
  auto text = read_file(data("cases/regime_map.toml"));
  text.replace(text.find("mass ="), 6, "density =");
  auto plan = shipped("regime_map.toml");
  plan.case_path = folder.file("case.toml", text);
  const auto refused = [&](const char* key, const char* model) {
    return failure(ErrorKind::kWrongUsage, [&] {
      sphere_study(with_models(varied(plan, {std::string(key) + "=1,2"}), {model}, model), "");
    });
  };
  EXPECT_THAT(refused("fluid.density", "viscous_contact"), Names("fluid.density"));
  EXPECT_THAT(refused("sphere.density", "reference_exact"), Names("sphere.density"));
  const auto film = [](const SpherePlan& p, std::size_t i) {
    return number(row_of(p, i), "reference_exact.minimal_gap");
  };
  // The weight replaces the force: without inertia the density acts through it alone.
  const auto at = text.find("external_force");
  text.replace(at, text.find("\n\n", at) - at, "gravity = -1.0");
  plan.case_path = folder.file("heavy.toml", text);
  plan = with_models(plan, {"reference_exact"}, "reference_exact");
  for (const auto* key : {"sphere.density", "fluid.density"}) {
    const auto changed = varied(plan, {std::string(key) + "=0.01,0.02"});
    EXPECT_NE(film(changed, 0), film(changed, 1)) << key;
  }
}

TEST(SweepPlanCheck, NothingIsThereTwiceAndTheReferenceIsOneOfTheModels) {
  const auto plan = shipped("vanishing_viscosity.toml");
  const auto wrong = [](const SpherePlan& p) {
    return failure(ErrorKind::kWrongUsage, [&] { sphere_study(p, ""); });
  };
  EXPECT_THAT(wrong(varied(plan, {"sphere.mass=1,2", "fluid.viscosity=1", "sphere.mass=3"})),
              Names("sphere.mass"));
  EXPECT_THAT(wrong(with_models(plan, {"inertial", "inertial"}, "inertial")), Names("inertial"));
  EXPECT_THAT(wrong(with_models(plan, {"inertial"}, "viscous_contact")),
              Names("viscous_contact", "inertial"));
  EXPECT_THAT(bad_input([&] { sphere_study(with_models(plan, {"inertia"}, "inertia"), ""); }),
              Names("inertia"));
}

class RunSweep : public ::testing::Test {
 protected:
  using Taken = std::vector<std::pair<std::uint64_t, std::string>>;
  /// The first rows take a hundred times as long as the last, which so are done first; more of them
  /// than any thread may run ahead.
  const Study sweep_ = sphere_study(
      varied(shipped("time_step.toml"), {"viscous_contact.time_step=1e-3:1e-1:log:200"}), "");
  std::uint64_t run(std::uint64_t begin, int jobs,
                    const std::function<void(std::uint64_t, const std::string&)>& take,
                    const StopToken& stop = {}) const {
    return run_rows(
        sweep_.size(), begin, jobs,
        [&](std::uint64_t index, const StopToken& s) { return sweep_.row(index, s); }, take, stop);
  }
  Taken run(std::uint64_t begin, int jobs) const {
    Taken taken;
    const auto end = run(begin, jobs, [&](std::uint64_t index, const std::string& row) {
      taken.emplace_back(index, row);
    });
    EXPECT_EQ(end, 200U);
    return taken;
  }
};

TEST_F(RunSweep, HandsTheSameRowsOverInOrderOnAnyNumberOfThreads) {
  const auto one = run(0, 1);
  ASSERT_EQ(one.size(), 200U);
  for (std::uint64_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].first, i);
  for (const std::uint64_t i : {0U, 7U, 199U}) EXPECT_EQ(one[i].second, sweep_.row(i));
  for (const int jobs : {2, 5}) EXPECT_EQ(run(0, jobs), one) << jobs;
}

TEST_F(RunSweep, BeginsWhereItIsTold) {
  const auto taken = run(197, 2);
  ASSERT_EQ(taken.size(), 3U);
  for (std::uint64_t i = 0; i < 3; ++i) {
    EXPECT_EQ(taken[i].first, 197 + i);
    EXPECT_EQ(taken[i].second, sweep_.row(197 + i));
  }
  EXPECT_TRUE(run(200, 2).empty());
}

TEST_F(RunSweep, StopsWhenARowIsNotTaken) {
  for (const int jobs : {1, 2, 5}) {
    std::vector<std::uint64_t> offered;
    const auto take = [&](std::uint64_t index, const std::string&) {
      offered.push_back(index);
      if (index == 5) throw std::domain_error("full");
    };
    EXPECT_THROW(run(0, jobs, take), std::domain_error) << jobs;
    EXPECT_THAT(offered, ElementsAre(0, 1, 2, 3, 4, 5)) << jobs;
  }
}

TEST_F(RunSweep, EndsEarlyWhenAStopIsRequested) {
  std::atomic<bool> flag = false;
  const auto take = [&](std::uint64_t index, const std::string&) {
    if (index == 5) flag = true;
  };
  EXPECT_THAT(run(0, 2, take, StopToken(flag)), AllOf(Ge(6U), Lt(200U)));
  failure(ErrorKind::kInterrupted, [&] { (void)sweep_.row(0, StopToken(flag)); });
}

TEST(RunRows, EndsWhenARowFailsAfterAStopWhileAThreadWaitsForIt) {
  std::atomic<bool> flag = false;
  // One thread computes the first row until the stop, which the other one requests in the last row
  // that it may compute before the first one.
  const auto row = [&](std::uint64_t index, const StopToken& stop) -> std::string {
    if (index == 63) flag = true;
    while (index == 0) {
      stop.throw_if_stop_requested();
      std::this_thread::yield();
    }
    return "row";
  };
  const auto take = [](std::uint64_t, const std::string&) { FAIL() << "the first row is missing"; };
  EXPECT_EQ(run_rows(1000, 0, 2, row, take, StopToken(flag)), 0U);
}

}  // namespace
}  // namespace viscontact::sweep
