// How FreeFEM and the solvers of users are started, with a shell script in FreeFEM's place.
#include "viscontact/freefem_flow/freefem_solver.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cstdlib>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact::freefem_flow {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::EndsWith;

/// Sets a variable of the environment as long as the object lives.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    ::setenv(name, value.c_str(), 1);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { ::unsetenv(name_); }

 private:
  const char* name_;
};

particles::Fluid fluid_of_solver(std::vector<std::string> solver) {
  particles::Fluid fluid;
  fluid.viscosity = 1;
  fluid.solver = std::move(solver);
  return fluid;
}

TEST(SolverCommand, OfAUserIsTakenAsItIs) {
  const auto command = solver_command(fluid_of_solver({"python3", "my solver.py"}), 2);
  EXPECT_THAT(command.arguments, ::testing::ElementsAre("python3", "my solver.py"));
  EXPECT_TRUE(command.environment.empty());
  EXPECT_TRUE(command.folder.empty());
}

TEST(SolverLimits, AreThoseOfTheEnvironment) {
  EXPECT_EQ(solver_limits().answer, 30min);
  EXPECT_EQ(solver_limits().ready, 1min);
  {
    const Variable limit("VISCONTACT_FREEFEM_TIME_LIMIT", "5");
    EXPECT_EQ(solver_limits().answer, 5s);
    EXPECT_EQ(solver_limits().ready, 5s);
  }
  const Variable wrong("VISCONTACT_FREEFEM_TIME_LIMIT", "5 s");
  EXPECT_THAT(failure(ErrorKind::kWrongUsage, [] { solver_limits(); }),
              Names("VISCONTACT_FREEFEM_TIME_LIMIT", "'5 s'"));
}

TEST(StartFluidSolver, RefusesAParticleTooSmallForTheDomain) {
  // The least radius in a square of 4 with 24 edges is that of the message.
  const particles::BoxDomain box = {{0, 0}, {4, 4}, {}};
  const auto fluid = fluid_of_solver({});
  const auto said = failure(ErrorKind::kBadInput, [&] {
    start_fluid_solver(fluid, box,
                       std::array{particles::Shape::disc(1), particles::Shape::disc(1e-6)}, 2);
  });
  EXPECT_THAT(said, Names("1e-06", "24"));
  // In other units the same.
  const particles::BoxDomain small = {{0, 0}, {4e-9, 4e-9}, {}};
  EXPECT_THAT(
      failure(
          ErrorKind::kBadInput,
          [&] { start_fluid_solver(fluid, small, std::array{particles::Shape::disc(1e-15)}, 2); }),
      Names("1e-15", "24"));
}

TEST(StartFluidSolver, StartsTheSolverOfAUser) {
  const auto fluid =
      fluid_of_solver({"python3", VISCONTACT_SOURCE_FOLDER "/examples/stokes_drag.py"});
  const auto solver = start_fluid_solver(fluid, particles::CylinderDomain{5, 10},
                                         std::array{particles::Shape::sphere(1)}, 1);
  particles::Particles sphere;
  sphere.dimension = 1;
  sphere.positions = {5};
  sphere.radii = {1};
  solver->place({&sphere, {}, {}, {}});
  EXPECT_NEAR(solver->velocities(std::vector{-1.0}, true).at(0), -0.0530516476972984451, 1e-16);
}

struct ExpectedScript {
  int dimension;
  particles::FluidMesh mesh;
  std::string script;
  particles::Domain domain;
};

TEST(StartFluidSolver, RunsFreeFemWithTheScriptOfTheDimensionAndMesh) {
  using enum particles::FluidMesh;
  const particles::DiscDomain disc = {{}, 8};
  const particles::CylinderDomain cylinder = {5, 10};
  for (const auto& [dimension, mesh, script, domain] :
       {ExpectedScript{2, kFitted, "discs.edp", disc},
        ExpectedScript{2, kFixed, "discs_on_fixed_mesh.edp", disc},
        ExpectedScript{1, kFitted, "spheres.edp", cylinder},
        ExpectedScript{1, kFixed, "spheres_on_fixed_mesh.edp", cylinder}}) {
    const TemporaryFolder folder;
    const auto fake =
        folder.file("fake", "#!/bin/sh\nprintf '%s|' \"$@\" \"$OMP_NUM_THREADS\" > " +
                                (folder.path() / "asked").string() +
                                "\nbasename \"$FF_INCLUDEPATH\"\necho ready places\n");
    make_executable(fake);
    const Variable freefem("VISCONTACT_FREEFEM", fake.string());
    auto fluid = fluid_of_solver({});
    fluid.mesh = mesh;
    start_fluid_solver(fluid, domain, {}, dimension, {});
    const auto asked = read_file(folder.path() / "asked");
    EXPECT_EQ(asked.substr(0, asked.find('/')), "-nw|-v|0|");
    EXPECT_THAT(asked, EndsWith("/share/viscontact/freefem_flow/" + script + "|1|"));
  }
}

TEST(StartFluidSolver, SaysHowToInstallFreeFem) {
  const Variable freefem("VISCONTACT_FREEFEM", "no-such-freefem");
  EXPECT_THAT(
      failure(ErrorKind::kExternalProgram,
              [] {
                start_fluid_solver(fluid_of_solver({}), particles::DiscDomain{{}, 1}, {}, 2, {});
              }),
      Names("no-such-freefem", "apt-get install", "VISCONTACT_FREEFEM"));
}

TEST(StartFluidSolver, SaysWhatToDoWithoutAProgram) {
  const auto fluid = fluid_of_solver({"viscontact-no-such-solver"});
  EXPECT_THAT(failure(ErrorKind::kExternalProgram,
                      [&] {
                        start_fluid_solver(fluid, particles::DiscDomain{{}, 1}, {}, 2, {});
                      }),
              AllOf(Names("viscontact-no-such-solver"), Names("solver")));
}

}  // namespace
}  // namespace viscontact::freefem_flow
