// The ids of a particles' file name its particles: in forces, in messages and in every output.
#include <gmock/gmock.h>

#include <ostream>

#include "tests/common/regular_expressions.hpp"
#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/particle_runs/io/particle_file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Three discs on a floor in a file, the first two in touch, and one in the case; one force by id.
const std::string kCaseWithIds = discs_on_a_floor("0.05", "2.0", R"([[particle]]
centre = [40.0, 1.0]
radius = 1.0
mass = 1.0
[[force]]
particles = [3]
value = [1.0, 0.0]
)");
const std::string kDiscsWithIds = "id,x,y,radius,mass\n41,0,1,1,1\n7,2,1,1,1\n3,10,1,1,1\n";

class ParticleIds : public ParticlesCommand {
 protected:
  ParticleIds() { folder_.file("discs.csv", kDiscsWithIds); }
  ProgramResult run(const std::string& text, const std::string& folder,
                    const std::vector<std::string>& more = {}) const {
    return ParticlesCommand::run(put_case(text), out(folder), more);
  }
};

TEST_F(ParticleIds, NameTheParticlesOfAForceAndOfEveryOutput) {
  expect_done(run(kCaseWithIds, "out"));
  const auto end = particles::read_particles(path("out/final_particles.csv"), 2).particles;
  EXPECT_THAT(end.ids, ElementsAre(41, 7, 3, 42));  // those of tables go on after the largest
  // The disc with the id 3 is the third one, and the only one that is pushed: by 1 for 2 units of
  // time.
  const double at_rest = 1e-12, pushed = 2;  // the velocity is exact: the force is constant
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(end.velocity(k)[0], k == 2 ? pushed : 0, at_rest);
  const auto contacts = content(path("out/final_contacts.csv"));
  for (const auto* line : {"\n41,7,", "\n41,-1,", "\n7,-1,", "\n3,-1,", "\n42,-1,"})
    EXPECT_THAT(contacts, HasSubstr(line));
  const std::string command =
      "/usr/bin/python3 " VISCONTACT_SOURCE_FOLDER "/tests/program/particles/read_vtk.py ";
  ASSERT_EQ(
      std::system((command + path("out/particles_00000.vtp") + " > " + path("vtk.txt")).c_str()),
      0);
  EXPECT_THAT(read_file(path("vtk.txt")), ::testing::ContainsRegex("id 41[.0]* 7[.0]* 3[.0]* 42"));
}

TEST_F(ParticleIds, DoNotChangeTheMotion) {
  expect_done(run(kCaseWithIds, "named"));
  // The same without ids: the disc that is pushed is number 2.
  put_text(path("discs.csv"), replaced_matches(kDiscsWithIds, "(id|41|7|3),(.*)", "$2"));
  expect_done(run(replaced(kCaseWithIds, "particles = [3]", "particles = [2]"), "numbered"));
  const auto without_ids = [&](const std::string& folder) {
    return replaced_matches(content(path(folder + "/final_particles.csv")), "\n[0-9]+,", "\n");
  };
  EXPECT_EQ(without_ids("named"), without_ids("numbered"));
}

TEST_F(ParticleIds, SurviveARestartAndAreReadFromTheFinalParticles) {
  expect_done(run(kCaseWithIds, "whole"));
  expect_done(run(replaced(kCaseWithIds, "end_time = 2.0", "end_time = 1.0"), "half"));
  expect_done(run(kCaseWithIds, "rest", {"--restart", path("half/restart.bin")}));
  for (const std::string name : {"final_particles.csv", "final_contacts.csv"})
    EXPECT_EQ(content(path("rest/" + name)), content(path("whole/" + name)));
  // The result as the input of another case: its force finds the disc by the same id.
  const auto next =
      replaced_matches(replaced(kCaseWithIds, "discs.csv", "whole/final_particles.csv"),
                       "\\[\\[particle\\]\\][^\\[]*\\[40[^\\[]*", "");
  expect_done(run(next, "next"));
  const auto end = particles::read_particles(path("next/final_particles.csv"), 2).particles;
  EXPECT_THAT(end.ids, ElementsAre(41, 7, 3, 42));
  EXPECT_NEAR(end.velocity(2)[0], 4, 1e-12);  // pushed twice as long
}

struct BadId {
  std::string name, from, to, said;
};
std::ostream& operator<<(std::ostream& out, const BadId& bad) { return out << bad.name; }

class BadIds : public ParticleIds, public ::testing::WithParamInterface<BadId> {};

TEST_P(BadIds, AreRefusedWithTheirLine) {
  const auto& bad = GetParam();
  const bool in_file = kDiscsWithIds.find(bad.from) != std::string::npos;
  if (in_file) put_text(path("discs.csv"), replaced(kDiscsWithIds, bad.from, bad.to));
  expect_refusal(run(in_file ? kCaseWithIds : replaced(kCaseWithIds, bad.from, bad.to), "out"),
                 ErrorKind::kBadInput, Names(bad.said));
  EXPECT_FALSE(fs::exists(path("out")));
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadIds,
    ::testing::ValuesIn(std::vector<BadId>{
        {"Twice", "7,2,1", "41,2,1", "discs.csv:3: id"},
        {"Missing", "7,2,1", ",2,1", "discs.csv:3: id"},
        {"Negative", "7,2,1", "-7,2,1", "discs.csv:3: id"},
        {"Fraction", "7,2,1", "7.5,2,1", "discs.csv:3: id"},
        {"TooLarge", "7,2,1", "2147483648,2,1", "discs.csv:3: id"},
        {"NoneLeftForTheTable", "7,2,1", "2147483647,2,1", "2147483647"},
        {"ForceOnNoId", "particles = [3]", "particles = [2]", "case.toml:19: force[0].particles"},
        {"ForceTwice", "particles = [3]", "particles = [3, 3]", "force[0].particles"},
        {"OverlapIsNamedByIds", "7,2,1", "7,1,1", "particle 41 (line 2"},
    }),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace viscontact
