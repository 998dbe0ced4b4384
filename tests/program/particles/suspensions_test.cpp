// Spheres with pairwise lubrication, from the command line to the files.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/particles/contact/film_law.hpp"
#include "viscontact/reduced_model/trajectory.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// 30 rough spheres of two sizes, which meet within a unit of strain.
const std::string kShear = R"(title = "Shear"
[space]
dimension = 3
[domain]
box = { from = [1.0, 2.0, 3.0], to = [11.0, 12.0, 13.0], periodic = [true, true, true] }
[arrangement]
count = 30
species = [ { radius = 1.0, share = 0.7 }, { radius = 1.3, share = 0.3 } ]
[lubrication]
viscosity = 2.0
pairs = "near_contact"
regularisation = 1e-3
velocity = { shear_rate = 4.0 }
[viscous_contact]
strain_step = 0.02
end_strain = 2.0
roughness = 1e-3
[output]
every = 0.05
average_from = 0.21
)";

class Suspensions : public ParticlesCommand {
 protected:
  Json record(const std::string& folder = "out") const {
    return Json::parse(read_file(out(folder) / "run.json"));
  }
};

TEST_F(Suspensions, HaveEinsteinsViscosityAroundOneSphere) {
  compute(R"(title = "One sphere"
[space]
dimension = 3
[domain]
box = { from = [0.0, 0.0, 0.0], to = [20.0, 10.0, 8.0], periodic = [true, true, true] }
[lubrication]
viscosity = 3.0
velocity = { shear_rate = -2.0 }
[viscous_contact]
end_time = 0
[[particle]]
centre = [1.0, 4.0, 5.0]
radius = 0.5
)");
  const double fraction = 4 * std::numbers::pi / 3 * 0.125 / 1600;
  const auto viscosity = column("rheology.csv", "viscosity");
  ASSERT_EQ(viscosity.size(), 1U);
  // Rounding errors of the solution, whose tolerance is 1e-11.
  EXPECT_NEAR(viscosity[0], 1 + 2.5 * fraction, 1e-12);
  EXPECT_NEAR(column("final_particles.csv", "vx").at(0), -8, 1e-9);
  EXPECT_NEAR(column("final_particles.csv", "angular_velocity_z").at(0), 1, 1e-9);
  EXPECT_FALSE(std::signbit(column("rheology.csv", "pressure").at(0)));
  EXPECT_EQ(record()["mean_viscosity"], viscosity[0]);
  EXPECT_TRUE(record()["mean_viscosity_error"].is_null());
}

TEST_F(Suspensions, HaveNoViscosityAtRest) {
  compute(
      replaced(replaced(replaced(kShear, "velocity = { shear_rate = 4.0 }\n", ""),
                        "strain_step = 0.02\nend_strain = 2.0",
                        "time_step = 0.1\nend_time = 0.3\nrepulsion = { amplitude = 1.0, length "
                        "= 0.1 }"),
               "average_from = 0.21", "average_from = 0.1"));
  const auto rows = matches_in(content(out() / "rheology.csv"), "([^\n]+)\n", 1);
  ASSERT_EQ(rows.size(), 4U);
  // time, strain, seven empty fields, pairs.
  EXPECT_THAT(rows[1], HasSubstr(",0,,,,,,,,"));
  EXPECT_TRUE(record()["mean_viscosity"].is_null());
  EXPECT_TRUE(record()["mean_viscosity_error"].is_null());
}

TEST_F(Suspensions, HaveNoViscosityWithoutABox) {
  compute(R"(title = "Two spheres"
[space]
dimension = 3
[lubrication]
viscosity = 1.0
velocity = { shear_rate = 2.0 }
[viscous_contact]
end_time = 0.2
time_step = 0.1
[[particle]]
centre = [-0.9, 0.75, 0.0]
radius = 1.0
[[particle]]
centre = [0.9, -0.75, 0.0]
radius = 1.0
)");
  const auto rows = matches_in(content(out() / "rheology.csv"), "([^\n]+)\n", 1);
  ASSERT_EQ(rows.size(), 3U);
  // Seven empty fields between the strain and one pair.
  for (const std::size_t k : {1U, 2U}) EXPECT_THAT(rows[k], HasSubstr(",,,,,,,,1,"));
  EXPECT_EQ(column("rheology.csv", "shear_rate").back(), 2);
  for (const auto* name : {"mean_viscosity", "mean_n1", "mean_pressure", "mean_viscosity_error"})
    EXPECT_TRUE(record()[name].is_null()) << name;
  EXPECT_EQ(record()["rheology_blocks"], 0);
  EXPECT_THAT(read_file(out() / "particles.html"), Not(HasSubstr("<div class=charts>")));
  EXPECT_FALSE(fs::exists(out() / "rheology.svg"));
  const auto again = run(out().parent_path() / "case.toml", out());
  expect_done(again);
  EXPECT_THAT(again.errors, IsUpToDate(out().string()));
}

TEST_F(Suspensions, HaveMeansOfTheirRheology) {
  compute(kShear);
  const auto time = column("rheology.csv", "time");
  ASSERT_EQ(time.size(), 100U);
  EXPECT_NEAR(time.back(), 0.5, 1e-12);
  EXPECT_NEAR(column("rheology.csv", "strain").back(), 2, 1e-12);
  // The means begin at 0.21, within a step of 0.005 in rounded numbers; blocks are 0.029 long.
  const auto n1 = column("rheology.csv", "n1");
  double sum = 0, duration = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double from = std::max(0.21, k == 0 ? 0 : time[k - 1]);
    if (!(time[k] > from)) continue;
    sum += n1[k] * (time[k] - from);
    duration += time[k] - from;
  }
  EXPECT_NEAR(record()["mean_n1"], sum / duration, 1e-9 * std::abs(sum / duration));
  EXPECT_GT(record()["mean_n1_error"], 0);
  EXPECT_EQ(record()["rheology_blocks"], 10);
  EXPECT_THAT(read_file(out() / "particles.html"), HasSubstr("<div class=charts><svg"));
  EXPECT_EQ(column("pair_distribution.csv", "distance").front(), 1.01);
  for (const double x : column("final_particles.csv", "x")) EXPECT_TRUE(x >= 1 && x <= 11) << x;
  const auto again = run(out().parent_path() / "case.toml", out());
  expect_done(again);
  EXPECT_THAT(again.errors, IsUpToDate(out().string()));
}

TEST_F(Suspensions, GoOnAfterAnInterruptAndFromARestartFile) {
  // So long that the interrupt comes before the end, and with friction, which contacts remember.
  const auto with_friction =
      replaced(kShear, "end_strain = 2.0", "end_strain = 6.0") + "[friction]\ncoefficient = 0.5\n";
  expect_done(run(put_case(with_friction), out("whole")));
  const auto shell =
      fmt::format("(while [ ! -e '{}/particles_00003.vtp' ]; do sleep 0.01; done; kill -INT $$) &",
                  path("parts"));
  const auto half =
      run_viscontact({"particles", path("case.toml"), "-o", path("parts")}, {}, shell);
  ASSERT_EQ(half.exit_status, results::exit_code_of(ErrorKind::kInterrupted)) << half.errors;
  const auto rest = run(put_case(with_friction), out("parts"));
  expect_done(rest);
  EXPECT_THAT(rest.errors, Continues());
  expect_same_files(path("whole"), path("parts"));

  const auto first = replaced(with_friction, "end_strain = 6.0", "end_strain = 3.0");
  expect_done(run(put_case(first, "half.toml"), out("half")));
  expect_done(run(put_case(with_friction), out("rest"),
                  {"--restart", (out("half") / "restart.bin").string()}));
  EXPECT_EQ(content(out("whole") / "final_particles.csv"),
            content(out("rest") / "final_particles.csv"));
}

TEST_F(Suspensions, GoOnFromARestartFileAcrossAReversal) {
  const auto reversed = replaced(
      replaced(kShear, "shear_rate = 4.0",
               "shear_rate = [ { until = 0.2, value = 4.0 }, { until = 1.0, value = -4.0 } ]"),
      "end_strain = 2.0", "end_strain = 1.2");
  compute(reversed);
  EXPECT_NEAR(column("rheology.csv", "strain").back(), 1.2, 1e-12);
  EXPECT_NEAR(column("rheology.csv", "net_strain").back(), 0.8 - 0.4, 1e-12);
  const auto half = replaced(replaced(reversed, "end_strain = 1.2", "end_strain = 0.78"),
                             "average_from = 0.21", "average_from = 0.1");
  expect_done(run(put_case(half, "half.toml"), out("half")));
  expect_done(
      run(put_case(reversed), out("rest"), {"--restart", (out("half") / "restart.bin").string()}));
  EXPECT_EQ(content(out() / "final_particles.csv"), content(out("rest") / "final_particles.csv"));
}

TEST_F(Suspensions, HaveTheStressThatIsGiven) {
  const auto given =
      replaced(replaced(kShear, "shear_rate = 4.0", "stress = -40.0"),
               "strain_step = 0.02\nend_strain = 2.0", "time_step = 0.005\nend_time = 0.3");
  compute(given);
  const auto viscosity = column("rheology.csv", "viscosity"),
             rate = column("rheology.csv", "shear_rate");
  ASSERT_EQ(viscosity.size(), 60U);
  // Files have nine digits or more.
  for (std::size_t k = 0; k < rate.size(); ++k)
    EXPECT_NEAR(2.0 * viscosity[k] * rate[k], -40, 1e-6);
  EXPECT_LT(column("rheology.csv", "net_strain").back(), -0.5);
}

TEST_F(Suspensions, AreComparedWithContactAlone) {
  const auto text = replaced(replaced(kShear, "regularisation", "compare = true\nregularisation"),
                             "end_strain = 2.0", "end_strain = 1.0");
  expect_done(run(put_case(text), out()));
  expect_done(run(
      put_case(replaced(replaced(replaced(kShear, "pairs = \"near_contact\"", "pairs = \"none\""),
                                 "regularisation = 1e-3\n", ""),
                        "end_strain = 2.0", "end_strain = 1.0"),
               "none.toml"),
      out("none")));
  EXPECT_EQ(content(out() / "viscous_contact" / "rheology.csv"),
            content(out("none") / "rheology.csv"));
  EXPECT_NE(content(out() / "rheology.csv"), content(out("none") / "rheology.csv"));
  EXPECT_THAT(read_file(out() / "rheology.svg"), HasSubstr("viscous contact alone"));
  EXPECT_THAT(read_file(out("none") / "rheology.svg"), Not(HasSubstr("viscous contact alone")));
}

TEST_F(Suspensions, OfContactAloneTouchWhenTheFilmHasTakenAllThatItCan) {
  const auto none = replaced(replaced(kShear, "pairs = \"near_contact\"", "pairs = \"none\""),
                             "regularisation = 1e-3\n", "");
  // A dense cell and a long strain, in which contacts last.
  compute(replaced(replaced(replaced(none, "[11.0, 12.0, 13.0]", "[8.8, 9.8, 10.8]"),
                            "end_strain = 2.0", "end_strain = 5.0"),
                   "roughness = 1e-3", "roughness = 1e-2\n[friction]\ncoefficient = 0.5"));
  // The largest film is that of two large spheres.
  particles::FilmLaw film;
  film.viscosity = 2;
  film.roughness = 1e-2 * (21 * 1.0 + 9 * 1.3) / 30 / 2;
  const auto gammas = column("final_contacts.csv", "gamma");
  const std::array lowest{film.lowest_gamma(1, 1), film.lowest_gamma(1, 1.3),
                          film.lowest_gamma(1.3, 1.3)};
  std::size_t touching = 0;
  for (const double gamma : gammas) {
    EXPECT_GE(gamma, lowest[2] * (1 + 1e-6));
    // Files have nine digits or more.
    for (const double least : lowest) touching += std::abs(gamma - least) < -1e-6 * least ? 1 : 0;
  }
  EXPECT_GT(touching, 0U);
  // The solids carry what the film does not.
  const auto solid = column("final_contacts.csv", "solid_force");
  EXPECT_GT(std::ranges::max(solid), 0);
}

TEST_F(Suspensions, MeetAsTwoFreeSpheresDo) {
  // From the offset 1.5 far away they pass at the gap 0.09635228111 (data/reference/
  // two_free_spheres_in_shear.csv); the error of the path is of second order in the step.
  const auto least_gap = [&](const std::string& step) {
    compute(R"(title = "Two spheres"
[space]
dimension = 3
[lubrication]
viscosity = 1.0
range = 20.0
velocity = { shear_rate = 1.0 }
[viscous_contact]
end_strain = 20.0
strain_step = )" +
            step + R"(
[[particle]]
centre = [-10.0, 0.75, 0.0]
radius = 1.0
[[particle]]
centre = [10.0, -0.75, 0.0]
radius = 1.0
)");
    return std::ranges::min(column("rheology.csv", "smallest_gap"));
  };
  // What is left is from the start at a distance of 20 radii, and as much from steps, because the
  // least gap at the end of a step is above the least one.
  for (const auto* step : {"0.04", "0.02"}) EXPECT_NEAR(least_gap(step), 0.09635228111, 2e-4);
}

TEST_F(Suspensions, StrainTheirCellAndGoOnFromARestartFile) {
  const auto text = replaced(replaced(kShear, "shear_rate = 4.0", "strain_rate = 2.0"),
                             "end_strain = 2.0", "end_strain = 4.0");
  expect_done(run(put_case(text), out("whole")));
  const auto whole = record("whole");
  EXPECT_LE(whole["largest_overlap"], 1e-7);
  // By all images of the cell that the frames and tables have.
  EXPECT_LE(whole["final_overlap"], 1e-7);
  // In a planar extension the stress is along x and y, and half of n1.
  EXPECT_NEAR(whole["mean_n1"], 2 * whole["mean_viscosity"].get<double>(), 1e-6);
  expect_done(run(put_case(replaced(text, "end_strain = 4.0", "end_strain = 2.0"), "half.toml"),
                  out("half")));
  expect_done(
      run(put_case(text), out("rest"), {"--restart", (out("half") / "restart.bin").string()}));
  EXPECT_EQ(content(out("whole") / "final_particles.csv"),
            content(out("rest") / "final_particles.csv"));
}

TEST_F(Suspensions, ThatGoOnWithAnotherRateHaveFramesWithTheirOffset) {
  const auto first =
      replaced(replaced(kShear, "shear_rate = 4.0", "shear_rate = 1.0"),
               "strain_step = 0.02\nend_strain = 2.0", "time_step = 0.02\nend_time = 0.3");
  const auto second = replaced(replaced(first, "shear_rate = 1.0", "shear_rate = 2.0"),
                               "end_time = 0.3", "end_time = 0.7");
  expect_done(run(put_case(first, "first.toml"), out("first")));
  expect_done(run(put_case(second), out(),
                  {"--restart", (out("first") / "restart.bin").string(), "--xyz"}));
  const auto text = content(out() / "particles.xyz");
  const auto offsets = matches_in(text, "Lattice=\"10 0 0 ([^ ]+) 10 0 0 0 10\"", 1);
  const auto times = matches_in(text, " Time=([^ \n]+)", 1);
  ASSERT_EQ(offsets.size(), times.size());
  ASSERT_GE(times.size(), 8U);
  for (std::size_t k = 0; k < times.size(); ++k) {
    // The net strain, 0.3 of the rate 1 and then that of the rate 2, times the edge.
    const double time = std::stod(times[k]), offset = 10 * (0.3 + 2 * (time - 0.3));
    const double difference = std::stod(offsets[k]) - offset;
    // Whole periods; times and strains have rounding errors.
    EXPECT_NEAR(difference - 10 * std::round(difference / 10), 0, 1e-9) << time;
    EXPECT_LE(std::abs(std::stod(offsets[k])), 5 + 1e-9);
  }
  EXPECT_NEAR(column("rheology.csv", "net_strain").back(), 1.1, 1e-12);
}

TEST_F(Suspensions, OfTheShippedExtensionHasNoOverlap) {
  const auto text = read_file(VISCONTACT_SOURCE_FOLDER "/data/cases/suspensions/extension.toml");
  compute(replaced(replaced(text, "end_strain = 4.0", "end_strain = 0.5"), "average_from = 1.0",
                   "average_from = 0.2"));
  EXPECT_LE(record()["largest_overlap"], 1e-7);
  EXPECT_EQ(record()["unconverged_steps"], 0);
  EXPECT_GT(record()["mean_viscosity"], 3);
}

TEST_F(Suspensions, InABoxThatIsNotTurnedEndWithTheStrainReached) {
  const auto text =
      replaced(replaced(kShear, "shear_rate = 4.0 }", "strain_rate = 2.0 }\nturned = false"),
               "end_strain = 2.0", "end_strain = 3.0");
  const auto stopped = run(put_case(text), out());
  EXPECT_EQ(stopped.exit_status, results::exit_code_of(ErrorKind::kNotConverged)) << stopped.errors;
  // The edge 10 falls to 2 (2 + 0.5) 1.3 = 6.5, and the strain is twice the logarithm.
  EXPECT_NEAR(column("rheology.csv", "strain").back(), 2 * std::log(10 / 6.5), 0.0201);
  EXPECT_TRUE(fs::exists(out() / "particles.html"));
}

TEST_F(Suspensions, OfOneSphereAndAPlaneAreTheLecturesCase) {
  const fs::path data = VISCONTACT_SOURCE_FOLDER "/data";
  const auto done = run(data / "cases/suspensions/lecture.toml", out());
  expect_done(done);
  // docs/theory.md, section 3; a step ends up to 1e-4 above the least gap.
  EXPECT_NEAR(std::ranges::min(column("rheology.csv", "smallest_gap")) / 2.9673e-3, 1, 2e-4);
  expect_done(run_viscontact({"simulate", (data / "cases/lecture.toml").string(), "--fit",
                              (data / "fits/lecture.json").string(), "-o", path("one"), "--models",
                              "inertial"}));
  std::map<double, double> gaps;
  for (const auto& row : reduced_model::read_trajectory(path("one/trajectories/inertial.csv")).rows)
    gaps[row.time] = row.gap;
  const auto times = column("motion.csv", "time"), heights = column("motion.csv", "z");
  std::size_t compared = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto after = gaps.lower_bound(times[k] - 1e-9);
    if (after == gaps.end() || after->first > times[k] + 1e-9) continue;
    // Steps of 1e-3 leave 1e-6 of the gap.
    EXPECT_NEAR((heights[k] - 1) / after->second, 1, 3e-6) << times[k];
    ++compared;
  }
  EXPECT_GT(compared, 190U);
  // Without a box there is no volume, and so no viscosity of the suspension.
  EXPECT_THAT(done.errors, Not(HasSubstr("viscosity")));
}

TEST_F(Suspensions, AreSweptWithTheirMeans) {
  const auto file = put_case(replaced(kShear, "end_strain = 2.0", "end_strain = 1.0"));
  expect_done(run_viscontact({"sweep", file.string(), "--draws", "2", "-o", path("rows.csv")}));
  const auto rows = content(out("rows.csv"));
  EXPECT_THAT(rows, HasSubstr("mean_viscosity,mean_viscosity_error,mean_n1"));
  EXPECT_EQ(matches_in(rows, "\n", 0).size(), 3U);
}

TEST_F(Suspensions, RefuseABadKeyWithItsLine) {
  expect_refusal(run(put_case(replaced(kShear, "viscosity = 2.0", "viscosity = -2.0")), out()),
                 ErrorKind::kBadInput, Names("case.toml:10", "lubrication.viscosity"));
  EXPECT_FALSE(fs::exists(out() / "run.json"));
}

}  // namespace
}  // namespace viscontact
