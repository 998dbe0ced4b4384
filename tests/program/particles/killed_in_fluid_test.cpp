// A run of particles in a fluid that is killed or interrupted at any moment continues by the same
// command, and its files become those of a run that nothing disturbed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

/// A disc with mass and two without meet each other and the floor. `fluid` is added to [fluid].
std::string case_in_fluid(const std::string& fluid, const std::string& time_step) {
  return fmt::format(R"(title = "Three discs in a fluid"
[space]
dimension = 2
[fluid]
viscosity = 1.0
edges_per_particle = 8
threshold_gap = 0.1
{}
[domain]
box = {{ from = [0.0, 0.0], to = [7.0, 6.0] }}
[viscous_contact]
time_step = {}
end_time = 0.6
[output]
every = 0.1
[[particle]]
centre = [1.2, 1.2]
radius = 1.0
mass = 2.0
force = [ {{ until = 0.55, value = [0.0, -100.0] }}, {{ until = 1.0, value = [40.0, 100.0] }} ]
[[particle]]
centre = [3.4, 1.2]
radius = 1.0
mass = 0.0
force = [-100.0, -100.0]
[[particle]]
centre = [5.0, 4.0]
radius = 0.8
mass = 0.0
force = [-20.0, -50.0]
torque = 3.0
)",
                     fluid, time_step);
}

class KilledInFluid : public ParticlesCommand {
 protected:
  /// Runs the command, and sends the signal after that time in seconds, if there is one.
  ProgramResult run_until(const std::string& folder, const std::string& signal = "",
                          double seconds = 0) const {
    const auto shell =
        signal.empty() ? "" : fmt::format("(sleep {:.3f}; kill -{} $$) &", seconds, signal);
    return run_viscontact({"particles", path("case.toml"), "-o", path(folder)}, {}, shell);
  }

  /// Disturbs a run at random moments within `seconds` of each start, then compares.
  void expect_same_if_disturbed(const std::string& text, double seconds) {
    put_case(text);
    expect_done(run_until("whole"));
    EXPECT_GT(read_file(path("whole/final_contacts.csv")).size(), 0U);
    constexpr unsigned kSeed = 20071115;
    std::mt19937 random(kSeed);
    int disturbed = 0;
    for (const std::string signal : {"KILL", "INT", "TERM"}) {
      const double share = static_cast<double>(random()) / std::mt19937::max();
      const auto result = run_until("parts", signal, 0.02 + share * seconds);
      if (result.exit_status == 0) break;
      // A signal ends a program that does not yet handle it: 128 + its number.
      const int number = signal == "KILL" ? 9 : signal == "INT" ? 2 : 15;
      EXPECT_TRUE(result.exit_status == 128 + number ||
                  result.exit_status == results::exit_code_of(ErrorKind::kInterrupted))
          << result.exit_status << result.errors;
      ++disturbed;
    }
    EXPECT_GE(disturbed, 2) << "the run was done before it could be disturbed";
    expect_done(run_until("parts"));
    expect_same_files(path("whole"), path("parts"));
  }
};

TEST_F(KilledInFluid, GoesOnWithASolverOfTheUsersOwn) {
  expect_same_if_disturbed(case_in_fluid("solver = [\"python3\", \"" VISCONTACT_SOURCE_FOLDER
                                         "/examples/stokes_drag.py\"]",
                                         "0.0005"),
                           0.3);
}

// All discs have mass, and the steps are short enough for the mesh to follow them.
TEST_F(KilledInFluid, GoesOnWithInertiaOfTheFluid) {
  auto text = case_in_fluid("density = 1.0\nconstraint = \"rigid\"", "0.02");
  text = replaced(text, "end_time = 0.6", "end_time = 0.2");
  expect_same_if_disturbed(replaced_matches(text, "mass = 0.0", "mass = 2.0"), 0.5);
}

TEST_F(KilledInFluid, GoesOnWithMembranes) {
  expect_same_if_disturbed(R"(title = "A vesicle"
[space]
dimension = 2
[fluid]
viscosity = 1.0
edges_per_particle = 10
velocity = { shear_rate = 1.0 }
[domain]
box = { from = [-4.0, -3.0], to = [4.0, 3.0], periodic = [true, false] }
[viscous_contact]
time_step = 0.1
end_time = 0.9
[output]
every = 0.3
[[membrane]]
centre = [2.6, 0.5]
perimeter = 6.623059
reduced_area = 0.9
bending_rigidity = 1.0
inner_viscosity = 3.0
beads = 16
)",
                           0.5);
}

}  // namespace
}  // namespace viscontact
