// Runs of `viscontact particles` with rigid bodies and links: their tables and frames, restarts and
// interrupts, and constraints that contradict each other.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A pendulum of two discs on a hinge hits a disc on a rough floor, to which a spring ties
/// another; an arm between two further discs changes its length.
std::string linked_case(const std::string& scheme) {
  return R"(title = "Linked discs"
[space]
dimension = 2
gravity = [0.0, -1.0]
[viscous_contact]
time_step = 0.02
end_time = 8.0
gamma_min = -0.1
scheme = ")" +
         scheme + R"("
[friction]
coefficient = 0.4
[output]
every = 0.5
[[plane]]
point = [0.0, 0.0]
normal = [0.0, 1.0]
)" + disc("0.0, 5.0", "0.5", "1.0") +
         disc("3.0, 5.0", "0.5", "2.0") + disc("0.6, 0.5", "0.5", "1.0") +
         disc("2.5, 0.5", "0.5", "1.0") + disc("10.0, 1.0", "1.0", "1.0") +
         disc("13.0, 1.0", "1.0", "1.0") + R"([[body]]
particles = [0, 1]
[[hinge]]
body = 0
at = [0.0, 4.5]
stiffness = 0.2
[[spring]]
between = [2, 3]
stiffness = 3.0
[[arm]]
between = [4, 5]
length = { pieces = [[0.0, 3.0], [1.0, 2.5]], period = 2.0 }
)";
}

class LinkedParticles : public ParticlesCommand, public ::testing::WithParamInterface<const char*> {
 protected:
  void expect_same(const std::string& one, const std::string& other) const {
    for (const auto* file : {"final_particles.csv", "final_contacts.csv", "restart.bin",
                             "bodies.csv", "hinges.csv", "springs.csv", "arms.csv"})
      EXPECT_EQ(content(out(one) / file), content(out(other) / file)) << file;
  }
};

INSTANTIATE_TEST_SUITE_P(Schemes, LinkedParticles, ::testing::Values("euler", "leapfrog"),
                         [](const auto& test) { return test.param; });

TEST_P(LinkedParticles, HaveTablesOfBodiesAndLinks) {
  expect_done(run(put_case(linked_case(GetParam())), out()));
  EXPECT_THAT(content(out() / "bodies.csv"), HasSubstr("\n0,0,2,5,0,0,0,0\n"));
  EXPECT_THAT(content(out() / "hinges.csv"), HasSubstr("\n0,0,0,0,0,0,0\n"));
  EXPECT_THAT(content(out() / "springs.csv"), HasSubstr("\n0,0,1.9,0\n"));
  EXPECT_THAT(content(out() / "arms.csv"),
              AllOf(HasSubstr("\n0,0,3,0,0\n"), HasSubstr("\n7,0,2.5")));
  for (const auto* table : {"bodies.csv", "hinges.csv", "springs.csv", "arms.csv"}) {
    const auto text = content(out() / table);
    EXPECT_EQ(std::ranges::count(text, '\n'), 18) << table;  // a header and 17 times
  }
  EXPECT_TRUE(fs::exists(out() / "links_00016.vtp"));
  EXPECT_THAT(read_file(out() / "links.pvd"), HasSubstr("links_00016.vtp"));
}

TEST_P(LinkedParticles, ARestartContinuesBitForBit) {
  const auto text = linked_case(GetParam());
  expect_done(run(put_case(text), out("whole")));
  expect_done(
      run(put_case(replaced(text, "end_time = 8.0", "end_time = 3.34"), "half.toml"), out("half")));
  expect_done(run(put_case(text), out("rest"),
                  {"--restart", (out("half") / "restart.bin").string(), "-j", "2"}));
  for (const auto* file : {"final_particles.csv", "final_contacts.csv", "restart.bin"})
    EXPECT_EQ(content(out("whole") / file), content(out("rest") / file)) << file;
}

TEST_P(LinkedParticles, ThatAreInterruptedBecomeTheSameRun) {
  const auto text = replaced(linked_case(GetParam()), "time_step = 0.02", "time_step = 2e-4");
  const auto file = put_case(text);
  expect_done(run(file, out("whole")));
  for (const auto* signal : {"INT", "KILL"}) {
    const auto frame =
        out("parts") / (signal == std::string("INT") ? "links_00004.vtp" : "links_00009.vtp");
    const auto result =
        run_viscontact({"particles", file.string(), "-o", out("parts").string()}, {},
                       "(while [ ! -e '" + frame.string() + "' ]; do sleep 0.01; done; kill -" +
                           signal + " $$) &");
    EXPECT_NE(result.exit_status, 0);
  }
  const auto last = run(file, out("parts"));
  expect_done(last);
  EXPECT_THAT(last.errors, Continues());
  expect_same("whole", "parts");
  for (int frame = 0; frame <= 16; ++frame)
    for (const std::string kind : {"particles_000", "links_000"}) {
      const auto name = kind + (frame < 10 ? "0" : "") + std::to_string(frame) + ".vtp";
      const auto rest = [](const std::string& bytes) {
        return bytes.substr(bytes.find("<VTKFile"));
      };
      EXPECT_TRUE(rest(read_file(out("whole") / name)) == rest(read_file(out("parts") / name)))
          << name;
    }
}

TEST_F(ParticlesCommand, FilesOfLinksThatTheCaseNoLongerHasAreRemoved) {
  expect_done(run(put_case(linked_case("euler")), out()));
  expect_done(run(put_case(kCase), out()));
  for (const auto* file : {"bodies.csv", "arms.csv", "links.pvd", "links_00003.vtp"})
    EXPECT_FALSE(fs::exists(out() / file)) << file;
}

TEST_F(ParticlesCommand, ARestartIntoACaseWithOtherLinksIsRefused) {
  const auto text = linked_case("euler");
  expect_done(run(put_case(replaced(text, "end_time = 8.0", "end_time = 1.0")), out()));
  const auto refused = [&](const std::string& from, const std::string& to,
                           const std::string& said) {
    expect_refusal(run(put_case(replaced(text, from, to), "other.toml"), out("no"),
                       {"--restart", (out() / "restart.bin").string()}),
                   ErrorKind::kBadInput, Names(said));
  };
  refused("[[spring]]\nbetween = [2, 3]\nstiffness = 3.0\n", "", "springs");
  refused("[[body]]\nparticles = [0, 1]\n[[hinge]]\nbody = 0", "[[hinge]]\nparticle = 0", "bodies");
}

TEST_F(ParticlesCommand, LinksThatContradictEachOtherWhileRunningAreNamed) {
  // Both ends of the arm that changes its length are held.
  const auto text = linked_case("euler") + R"([[hinge]]
particle = 4
at = [10.0, 1.0]
[[hinge]]
particle = 5
at = [13.0, 1.0]
)";
  const auto result = run(put_case(text), out());
  expect_refusal(result, ErrorKind::kNotConverged, Names("arm", "hinge", "contradict"));
  EXPECT_TRUE(fs::exists(out() / "final_particles.csv"));
  EXPECT_TRUE(fs::exists(out() / "arms.csv"));
}

}  // namespace
}  // namespace viscontact
