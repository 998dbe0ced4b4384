// When trajectories first reach a gap: closed forms of the limit case, m = k = 1.
#include "viscontact/reduced_model/gap_time.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/common/temporary_folder.hpp"
#include "tests/reduced_model/cases.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact::reduced_model {
namespace {

const std::vector<double> kGaps = {std::exp(-1.0), 5e-2, std::exp(-4.0) * 1.001, 1e-3, 1.5};

Trajectory run(const char* model) {
  auto motion = limit_motion();
  motion.gaps_to_reach = kGaps;
  return simulate(find_model(model), motion, lubrication::LubricationForce(leading_term_fit(1)));
}

// Without inertia ln q = -2 t until t = 2, then ln q = -8 + 2 t.
TEST(GapTime, IsThatOfTheMotionWithoutInertia) {
  for (const char* model : {"reference", "viscous_contact"}) {
    SCOPED_TRACE(model);
    const auto times = run(model).gap_times;
    ASSERT_EQ(times.size(), kGaps.size());
    // The film of the contact model is exact, and so are its logarithms between two rows. The
    // reference is of first order in its step of 1e-3.
    const double error = std::string(model) == "reference" ? 4e-3 : 1e-11;
    for (std::size_t k = 1; k < 3; ++k) {
      ASSERT_TRUE(times[k].time) << kGaps[k];
      EXPECT_NEAR(*times[k].time, -std::log(kGaps[k]) / 2, error) << kGaps[k];
    }
    EXPECT_FALSE(times[3].time);  // the smallest gap is exp(-4) = 0.018
  }
}

// The contact model lands at t = 1, when the film without inertia is already thinner than exp(-1):
// its film is first that thin when it lands. Away from contact it flies: q = (t - 4)^2.
TEST(GapTime, OfAContactModelBeginsWithItsFilm) {
  const auto times = run("viscous_contact").gap_times;
  ASSERT_TRUE(times[0].time && times[4].time);
  EXPECT_NEAR(*times[0].time, 1, 2e-3);                   // within the step of the landing
  EXPECT_NEAR(*times[4].time, 4 + std::sqrt(1.5), 2e-3);  // first order in the step of 1e-3
}

// With inertia ln q + u = -2 t until t = 2.
TEST(GapTime, IsThatOfTheMotionWithInertia) {
  const auto trajectory = run("inertial");
  const auto& of = trajectory.gap_times[1];
  ASSERT_TRUE(of.time);
  const auto after = std::ranges::lower_bound(trajectory.rows, *of.time, {}, &TrajectoryRow::time);
  const auto before = std::prev(after);
  const double w = (*of.time - before->time) / (after->time - before->time);
  // u is linear between rows with an error of 1e-7 (second derivative about 1, rows 1e-3 apart).
  EXPECT_NEAR(std::log(of.gap) + std::lerp(before->velocity, after->velocity, w), -2 * *of.time,
              1e-6);
}

TEST(GapTime, StandsInTheHeadOfTheFile) {
  Trajectory written;
  written.model = "own";
  written.rows = {{0, 1, -1, {}, {}, {}}};
  written.gap_times = {{1e-5, 0.1 + 0.2}, {1e-7, {}}};
  const TemporaryFolder folder;
  EXPECT_EQ(read_trajectory(folder.file("t.csv", write_trajectory(written))).gap_times,
            written.gap_times);
}

}  // namespace
}  // namespace viscontact::reduced_model
