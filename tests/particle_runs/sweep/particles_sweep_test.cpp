// Points, cases, rows and means of a sweep of particles; what runs them is a function of the test.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <mutex>
#include <set>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/particle_runs/sweep/particles_case.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/particle_runs/case/particles_study.hpp"
#include "viscontact/particle_runs/run/particles_folder.hpp"

namespace viscontact::particles {
namespace {

using ::testing::AllOf;

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

class ParticlesSweepTest : public ::testing::Test {
 protected:
  ParticlesSweepTest() {
    put_text(path("case.toml"), small_particles_case());
    points_.variations = {sweep::parse_variation("arrangement.area_fraction=0.1,0.3"),
                          sweep::parse_variation("viscous_contact.time_step=0.05,0.1")};
    points_.draws = 3;
  }
  std::filesystem::path path(const std::string& name) const { return scratch_.path() / name; }

  /// Results that tell which row they are of. Row 4 fails.
  static sweep::RowResults of_row(std::uint64_t index) {
    if (index == 4) return {{}, {}, "no luck, this time"};
    const auto value = static_cast<double>(index);
    return {{{"steps", value * value}, {"iterations", 7}}, {}, ""};
  }
  /// Writes the rows and returns their lines without the head.
  std::vector<std::string> lines(const ParticlesSweep& sweep) {
    sweep::write_sweep(sweep.study("1",
                                   [this](std::uint64_t index, const StopToken&) {
                                     const std::lock_guard lock(mutex_);
                                     ran_.insert(index);
                                     return of_row(index);
                                   }),
                       path("rows.csv"), 2, "", [](auto, auto) {});
    return lines_of(read_file(path("rows.csv")));
  }
  static std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> found;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
      if (!line.starts_with('#')) found.push_back(line);
    return found;
  }

  TemporaryFolder scratch_;
  sweep::Points points_;
  std::mutex mutex_;
  std::set<std::uint64_t> ran_;
};

TEST_F(ParticlesSweepTest, DrawsOfAPointFollowEachOtherWithSeedsFromThatOfTheCase) {
  const ParticlesSweep sweep(path("case.toml"), points_);
  EXPECT_EQ(sweep.points().count(), 4U);
  EXPECT_EQ(sweep.points().rows(), 12U);
  EXPECT_THAT(sweep.points().numbers(0),
              ElementsAre(Pair("arrangement.area_fraction", 0.1),
                          Pair("viscous_contact.time_step", 0.05), Pair("arrangement.seed", 5)));
  EXPECT_EQ(sweep.points().key_fields(2), "0.1,0.05,7");
  EXPECT_EQ(sweep.points().key_fields(3), "0.1,0.1,5");
  EXPECT_EQ(sweep.points().key_fields(11), "0.3,0.1,7");
}

TEST_F(ParticlesSweepTest, CaseOfARowIsReadAsTheCaseWithItsNumbers) {
  points_.variations[1] =
      sweep::parse_variation("viscous_contact.time_step=0.033333333333333333,0.1");
  const ParticlesSweep sweep(path("case.toml"), points_);
  make_folder(path("elsewhere"));
  put_text(path("elsewhere/row.toml"), sweep.case_text(7));
  const auto row = read_particles_case(path("elsewhere/row.toml"));
  const auto c = sweep.case_of(7);
  EXPECT_EQ(row.particles.positions, c.particles.positions);
  EXPECT_EQ(row.setting.time_step, 1.0 / 30);
  EXPECT_EQ(row.arrangement->seed, 6U);
  EXPECT_EQ(row.particles.count(), 31U);  // 0.3 * 80/(pi/4) = 30.6
}

TEST_F(ParticlesSweepTest, RowOfTheCaseThatATaskGetsHasTheSameIdentity) {
  put_text(path("particles.csv"), "x,y,radius,mass\n1,1,0.5,1\n");
  put_text(path("case.toml"),
           small_particles_case("[particles] # beside the case\nfile = \"particles.csv\"\n"));
  const ParticlesSweep sweep(path("case.toml"), points_);
  make_folder(path("out.slurm"));
  put_text(path("out.slurm/case.toml"), sweep.base_text());
  const ParticlesSweep copied(path("out.slurm/case.toml"), points_);
  std::set<std::string> identities;
  for (std::uint64_t i = 0; i < sweep.points().rows(); ++i) {
    EXPECT_EQ(copied.identity(i, "1"), sweep.identity(i, "1"));
    identities.insert(sweep.identity(i, "1"));
  }
  EXPECT_EQ(identities.size(), sweep.points().rows());
  EXPECT_NE(sweep.identity(0, "2"), sweep.identity(0, "1"));
  const auto before = sweep.identity(0, "1");
  put_text(path("particles.csv"), "x,y,radius,mass\n1,1,0.6,1\n");
  EXPECT_NE(sweep.identity(0, "1"), before);
}

// A run of a sweep has a folder of its own, from which files beside the case must still be found.
TEST_F(ParticlesSweepTest, RowNamesTheFilesOfAFluidSolverWhereTheyAre) {
  put_text(path("my_solver.py"), "");
  put_text(path("case.toml"),
           small_particles_case(
               "[fluid]\nviscosity = 1.0\nsolver = [\"python3\", \"my_solver.py\", \"--fast\"]\n"));
  make_folder(path("elsewhere"));
  put_text(path("elsewhere/row.toml"), ParticlesSweep(path("case.toml"), points_).case_text(0));
  const auto row = read_particles_case(path("elsewhere/row.toml"));
  EXPECT_EQ(row.setting.fluid->solver,
            (std::vector<std::string>{"python3", path("my_solver.py").string(), "--fast"}));
}

TEST_F(ParticlesSweepTest, RowHasKeysResultsAndFailure) {
  const ParticlesSweep sweep(path("case.toml"), points_);
  const auto found = lines(sweep);
  ASSERT_EQ(found.size(), 13U);
  EXPECT_EQ(found[0],
            "arrangement.area_fraction,viscous_contact.time_step,arrangement.seed,particles,"
            "area_fraction,to_time,steps,unconverged_steps,iterations,largest_residual,"
            "largest_impulse_residual,largest_gamma_error,divided_steps,unresolved_contacts,"
            "largest_overlap,final_overlap,contacts,glued,failure");
  EXPECT_EQ(found[4], "0.1,0.1,5,,,,9,,7,,,,,,,,,,");
  EXPECT_EQ(found[5], "0.1,0.1,6,,,,,,,,,,,,,,,,no luck; this time");
  EXPECT_EQ(ran_.size(), 12U);
}

TEST_F(ParticlesSweepTest, MeansAndStandardErrorsAreOverTheDrawsThatSucceeded) {
  const ParticlesSweep sweep(path("case.toml"), points_);
  lines(sweep);
  const auto means = lines_of(table_of_means(sweep, path("rows.csv")));
  ASSERT_EQ(means.size(), 5U);
  EXPECT_THAT(means[0],
              HasSubstr("arrangement.area_fraction,viscous_contact.time_step,draws,failed,"
                        "particles.mean,particles.standard_error,"));
  // Rows 3 and 5 of point 1 succeed: steps 9 and 25, mean 17, standard error 8.
  EXPECT_EQ(means[2], "0.1,0.1,2,1,,,,,,,17,8,,,7,0,,,,,,,,,,,,,,,,,,");
  // 0, 1, 4: mean 5/3, standard deviation sqrt(13/3), standard error sqrt(13)/3.
  EXPECT_THAT(means[1],
              HasSubstr(fmt::format("0.1,0.05,3,0,,,,,,,{},{}", 5.0 / 3, std::sqrt(13.0 / 3 / 3))));
}

TEST_F(ParticlesSweepTest, FileThatIsNotOfTheSweepHasNoMeans) {
  lines(ParticlesSweep(path("case.toml"), points_));
  points_.draws = 4;
  EXPECT_THAT(bad_input([&] {
                table_of_means(ParticlesSweep(path("case.toml"), points_), path("rows.csv"));
              }),
              AllOf(IsAt("rows.csv"), Names("4")));
}

TEST_F(ParticlesSweepTest, WithoutDrawsTheArrangementIsThatOfTheCase) {
  points_.draws = 0;
  const ParticlesSweep sweep(path("case.toml"), points_);
  EXPECT_EQ(sweep.points().rows(), 4U);
  EXPECT_EQ(sweep.points().key_fields(3), "0.3,0.1");
  EXPECT_THAT(sweep.case_text(3), HasSubstr("seed = 5"));
}

TEST_F(ParticlesSweepTest, WholeNumbersStayWholeInTheCase) {
  points_.variations = {sweep::parse_variation("solver.max_iterations=100,200")};
  put_text(path("case.toml"), small_particles_case("[solver]\nmax_iterations = 50\n"));
  EXPECT_THAT(ParticlesSweep(path("case.toml"), points_).case_text(0),
              HasSubstr("max_iterations = 100"));
}

TEST_F(ParticlesSweepTest, WrongPlansAreRefused) {
  const auto refused = [&](const std::string& name) {
    EXPECT_THAT(
        failure(ErrorKind::kWrongUsage, [&] { (void)ParticlesSweep(path("case.toml"), points_); }),
        Names(name));
  };
  const auto good = points_;
  points_.variations.clear();
  points_.draws = 0;
  refused("draws");
  points_ = good;
  points_.variations.push_back(points_.variations[0]);
  refused("arrangement.area_fraction");
  points_ = good;
  points_.variations = {sweep::parse_variation("arrangement.seed=1,2")};
  refused("arrangement.seed");
  points_.variations = {sweep::parse_variation("output.every=1,2")};
  refused("output.every");
  points_ = good;
  points_.draws = 3000000000;
  refused("2147483647");
  points_ = good;
  auto text = small_particles_case("[[particle]]\ncentre = [1.0, 1.0]\nradius = 0.5\nmass = 1\n");
  const auto at = text.find("[arrangement]");
  put_text(path("case.toml"), text.erase(at, text.find("[[particle]]") - at));
  points_.variations = {sweep::parse_variation("particle[0].mass=1,2")};
  refused("[arrangement]");
}

TEST_F(ParticlesSweepTest, PointThatIsNoCaseIsRefusedAtTheEndsOfTheSweep) {
  points_.variations = {sweep::parse_variation("arrangement.area_fraction=0.1,0.95")};
  EXPECT_THAT(bad_input([&] { (void)ParticlesSweep(path("case.toml"), points_); }),
              ::testing::AllOf(IsAt("case.toml", "arrangement.area_fraction"), Names("0.95")));
  points_.variations = {sweep::parse_variation("arrangement.radus=1,2")};
  EXPECT_THAT(bad_input([&] { (void)ParticlesSweep(path("case.toml"), points_); }),
              IsAt("case.toml", "arrangement.radus"));
}

TEST_F(ParticlesSweepTest, SectionOfTheCaseGivesThePlan) {
  put_text(path("case.toml"),
           small_particles_case(
               "[sweep]\nvary = [\"arrangement.area_fraction=0.1:0.3:3\"]\ndraws = 4\n"));
  const auto plan = planned_particles(path("case.toml"));
  EXPECT_EQ(ParticlesSweep(path("case.toml"), plan).points().rows(), 12U);
}

TEST(StepTotals, MeansOverTimeBeginAtTheTimeThatIsAsked) {
  StepTotals all, late;
  double time = 0;
  for (const double viscosity : {8.0, 2.0, 3.0}) {
    StepReport report;
    report.time = time += 0.5;
    report.fluid.apparent_viscosity = viscosity;
    report.fluid.dissipation = -viscosity;
    all.add(report, 0);
    late.add(report, 0.75);  // in the middle of the second step
  }
  EXPECT_DOUBLE_EQ(all.mean_apparent_viscosity, 13.0 / 3);
  EXPECT_DOUBLE_EQ(late.mean_apparent_viscosity, (0.25 * 2 + 0.5 * 3) / 0.75);
  EXPECT_DOUBLE_EQ(late.mean_dissipation, -late.mean_apparent_viscosity);
  EXPECT_DOUBLE_EQ(late.averaged_time, 0.75);
}

TEST(PathOfMeans, IsBesideTheRows) {
  EXPECT_EQ(path_of_means("out/rows.csv"), "out/rows_means.csv");
  EXPECT_EQ(path_of_means("rows"), "rows_means");
}

}  // namespace
}  // namespace viscontact::particles
