// Fluid solvers that die, are silent, or answer what the protocol does not allow, played by shell
// scripts.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/common/failure.hpp"
#include "viscontact/freefem_flow/process/flow_process.hpp"

namespace viscontact::freefem_flow {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;

/// One disc in a round container and a shell script as the solver of its fluid.
class OneDisc {
 public:
  explicit OneDisc(const std::string& script, std::chrono::milliseconds limit = 10min)
      : solver_(fluid(), particles::DiscDomain{{}, 8}, std::array{particles::Shape::disc(1)}, 2,
                {{"sh", "-c", script}},
                [](const particles::FluidParticles&, double) { return MeshBoundary{}; },
                {limit, {}}) {
    disc_.positions = {0, 0};
    disc_.radii = {1};
  }

  void place() { solver_.place({&disc_, angles_, {}, {}}); }
  void solve() { solver_.velocities(std::vector{1.0, 0.0, 0.0}, true); }
  FlowProcess& solver() { return solver_; }

 private:
  static particles::Fluid fluid() {
    particles::Fluid fluid;
    fluid.viscosity = 1;
    return fluid;
  }

  particles::Particles disc_;
  std::vector<double> angles_ = {0};
  FlowProcess solver_;
};

// Shell text: waits for the line that begins with a word.
std::string await(const std::string& word) {
  return "while read first rest; do [ \"$first\" = " + word + " ] && break; done; ";
}

// Shell text of a solver that is placed and then gets the request `word`.
std::string placed_and_asked(const std::string& word) {
  return "echo ready places; " + await("inertia") + "echo placed 0; " + await(word);
}

struct Failure {
  std::string name;
  std::string script;              ///< what the solver does when it is asked to solve
  std::vector<std::string> names;  ///< numbers and words that the error must name
};

// What GoogleTest shows of the parameter.
std::ostream& operator<<(std::ostream& out, const Failure& failure) { return out << failure.name; }

class FailingSolver : public ::testing::TestWithParam<Failure> {};

TEST_P(FailingSolver, IsNamedWithItsLastLines) {
  OneDisc one(placed_and_asked("solve") + GetParam().script);
  one.place();
  const auto said = failure(ErrorKind::kExternalProgram, [&] { one.solve(); });
  EXPECT_THAT(said, Names("solve", "3"));
  EXPECT_THAT(said, NamesAll(GetParam().names));
  failure(ErrorKind::kExternalProgram, [&] { one.solve(); });
}

INSTANTIATE_TEST_SUITE_P(
    Ways, FailingSolver,
    ::testing::Values(
        Failure{"Dies", "echo singular matrix >&2; exit 7", {"status 7", "singular matrix"}},
        Failure{"IsKilled", "kill -KILL $$", {"signal 9"}},
        Failure{"DiesWithinItsAnswer", "printf 'velocities 1 2'; exit 0", {"status 0"}},
        Failure{"AnswersTooFewNumbers", "echo velocities 1 2", {"status 0"}},
        Failure{"AnswersNan", "echo velocities 1 nan 0; read end", {"'nan'", "nan 0"}},
        Failure{"AnswersInfinity", "echo velocities 1 -inf 0; read end", {"'-inf'"}},
        Failure{"LeavesTheRangeOfADouble", "echo velocities 1e400 0 0; read end", {"'1e400'"}},
        Failure{"AnswersAWord", "echo velocities 1 2.5x 0; read end", {"'2.5x'"}},
        Failure{"AnswersSomethingElse",
                "echo '  Error line number 3'; echo sorry >&2; exit 1",
                {"'Error'", "'velocities'", "sorry", "Error line number 3", "status 1"}},
        Failure{"StaysAfterAWrongAnswer", "echo no; exec sleep 3600", {"'no'"}},
        Failure{"SaysItsError",
                "echo 'error the mesh has no triangles'; exit 1",
                {"the mesh has no triangles", "status 1"}},
        Failure{"SaysItsErrorWithinAnAnswer",
                "echo velocities 1; echo error at node 7",
                {"at node 7", "status 0"}},
        Failure{"SaysItsErrorWithoutALineEnd", "printf 'error no memory'; exit 1", {"no memory"}},
        Failure{"SaysAnEmptyError", "echo error; exit 1", {}},
        Failure{"WritesAWordWithoutEnd", "exec cat /dev/zero", {"4096"}},
        Failure{"WritesWithoutEnd", "exec yes and on", {"'and'", "and on"}},
        Failure{"WritesMegabytesOfMessages",
                "seq 1000000 >&2; echo velocities none; exit 3",
                {"'none'", "status 3", "999983 | 999984", "1000000"}}),
    [](const auto& test) { return test.param.name; });

TEST(FailingSolver, ThatIsSilentIsStoppedAtTheLimit) {
  OneDisc one(placed_and_asked("solve") + "echo slow >&2; exec sleep 3600", 2s);
  one.place();
  EXPECT_THAT(failure(ErrorKind::kExternalProgram, [&] { one.solve(); }), Names("2", "slow"));
}

TEST(FailingSolver, ThatIsNoSolverIsWaitedForAsLongAsOneThatIsNotReady) {
  // cat repeats what it is asked, and waits for more. A flow may take 10 minutes.
  SolverLimits limits;
  limits.answer = 10min;
  EXPECT_EQ(limits.ready, 1min);
  limits.ready = 1s;
  particles::Fluid fluid;
  fluid.viscosity = 1;
  const auto said = failure(ErrorKind::kExternalProgram, [&] {
    FlowProcess(
        fluid, particles::DiscDomain{{}, 8}, std::array{particles::Shape::disc(1)}, 2, {{"cat"}},
        [](const particles::FluidParticles&, double) { return MeshBoundary{}; }, limits);
  });
  EXPECT_THAT(said, Names("ready", "1"));
}

TEST(FailingSolver, ThatNeverCompletesItsAnswerIsStoppedAtTheLimit) {
  // Each number comes in time, the answer does not.
  OneDisc one(placed_and_asked("solve") + "echo velocities 1; sleep 1.5; echo 2; exec sleep 3600",
              2s);
  one.place();
  EXPECT_THAT(failure(ErrorKind::kExternalProgram, [&] { one.solve(); }), Names("2 s"));
}

TEST(FailingSolver, ThatAnswersMoreIsFoundAtTheNextRequest) {
  OneDisc one(placed_and_asked("solve") + "echo velocities 1 2 3 4; read next");
  one.place();
  one.solve();
  EXPECT_THAT(failure(ErrorKind::kExternalProgram, [&] { one.solver().quantities(); }),
              Names("solve", "4"));
}

TEST(FailingSolver, ThatIsNotReadySaysWhy) {
  const auto start = [](const std::string& script) {
    return failure(ErrorKind::kExternalProgram, [&] { const OneDisc one(script); });
  };
  EXPECT_THAT(start("echo init; echo compile error; exit 1"),
              Names("viscontact-fluid", "1", "init | compile error"));
  EXPECT_THAT(start("echo ready nothing; read end"), Names("nothing", "boundary", "places"));
  EXPECT_THAT(start("echo error wrong version"), Names("wrong version"));
  EXPECT_THAT(start("exec yes and on"), Names("ready", "1000"));
}

TEST(FailingSolver, ThatIsMissingIsNamedWithTheRemedy) {
  const auto start = [] {
    FlowProcess(particles::Fluid{}, particles::DiscDomain{{}, 8}, {}, 2,
                {{"viscontact-no-such-solver"}, {}, {}, "install it"}, {});
  };
  EXPECT_THAT(failure(ErrorKind::kExternalProgram, start),
              Names("viscontact-no-such-solver", "install it"));
}

TEST(FailingSolver, MayNotCountUnknownsInFractions) {
  for (const std::string count : {"-1", "1.5", "1e3", "99999999999999999999"}) {
    OneDisc one("echo ready places; " + await("inertia") + "echo placed " + count + "; read end");
    EXPECT_THAT(failure(ErrorKind::kExternalProgram, [&] { one.place(); }),
                Names("'" + count + "'"));
  }
}

TEST(FailingSolver, MayNotEstimateANegativeError) {
  OneDisc one(placed_and_asked("vary") + "echo varied 1 -1 0; read end");
  one.place();
  EXPECT_THAT(failure(ErrorKind::kExternalProgram, [&] { one.solver().vary_mesh(); }),
              Names("'-1'", "0"));
}

Error said_of_flow(const std::string& answer) {
  OneDisc one(placed_and_asked("flow") + "echo flow " + answer + "; read end");
  one.place();
  return failure(ErrorKind::kExternalProgram, [&] { one.solver().flow(); });
}

TEST(FailingSolver, MayNotNameNodesThatAreNotThere) {
  EXPECT_THAT(said_of_flow("1 1  0 0 0 0 0  0 0 0 0 0 1"), Names("'1'", "0"));
  EXPECT_THAT(said_of_flow("0 1  0 0 0 0 0 0"), Names("'1'"));
  EXPECT_THAT(said_of_flow("1 0  0 0 nan 0 0"), Names("nan"));
}

TEST(FailingSolver, TakesNoMemoryForAWrongCount) {
  // Two thousand million nodes would be 80 GB.
  EXPECT_THAT(said_of_flow("2000000000 0  0 0 stop"), Names("stop"));
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1'000'000);  // kB; a sanitizer's own memory is below this
}

}  // namespace
}  // namespace viscontact::freefem_flow
