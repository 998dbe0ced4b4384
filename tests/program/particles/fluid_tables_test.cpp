// Sums over the rows of the tables of a run in a fluid (FreeFEM): the energy and the impulses that
// the rows give are those of the motion, to the order of the steps, with and without inertia.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "tests/program/particles/particles_command.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

using std::numbers::pi;

class FluidTables : public ParticlesCommand {
 protected:
  /// A case with these lines of [fluid] in a box, a row of each table for each step of length `h`,
  /// and these further sections.
  static std::string text_of(const std::string& fluid, double h, double end,
                             const std::string& sections, const std::string& gravity = "0.0") {
    return fmt::format(R"(title = "Sums over rows"
[space]
dimension = 2
gravity = [0.0, {4}]
[fluid]
viscosity = 0.5
constraint = "rigid"
edges_per_particle = 6
threshold_gap = 0.05
{0}
[domain]
box = {{ from = [-3.0, -2.0], to = [3.0, 2.0] }}
[viscous_contact]
time_step = {1}
end_time = {2}
[output]
every = {1}
tables = ["motion", "contacts", "walls", "stress"]
{3})",
                       fluid, h, end, sections, gravity);
  }
  double sum(const std::string& file, const std::string& name) const {
    const auto values = column(file, name);
    return std::accumulate(values.begin(), values.end(), 0.0);
  }
  double mean_dissipation() const {
    return nlohmann::json::parse(read_file(out() / "run.json")).at("mean_dissipation");
  }
};

constexpr auto kInertia = "density = 1.0\n";

/// Two discs whose distance oscillates, in opposite phase to the start or from its largest length.
std::string oscillating_discs(double phase, double density) {
  return fmt::format(R"([[particle]]
centre = [{0}, 0.0]
radius = 0.5
density = {2}
[[particle]]
centre = [{1}, 0.0]
radius = 0.5
density = {2}
[[arm]]
between = [0, 1]
length = {{ mean = 2.5, amplitude = 0.4, angular_frequency = 3.141592653589793, phase = {3} }}
)",
                     -1.25 - 0.2 * std::sin(phase), 1.25 + 0.2 * std::sin(phase), density, phase);
}

TEST_F(FluidTables, AnArmWorksAgainstDissipationAndInertia) {
  // The second phase begins with a jump of the velocity from rest. Each disc has the mass `mass`.
  constexpr double kEnd = 0.5;
  for (const double phase : {pi / 2, 0.0})
    for (const bool inertial : {true, false}) {
      const double density = 1.5, mass = density * pi / 4;
      std::vector<double> errors;
      for (const double h : {0.1, 0.05}) {
        compute(text_of(inertial ? kInertia : "", h, kEnd, oscillating_discs(phase, density)));
        const auto power = column("arms.csv", "power");
        const auto steps = column("steps.csv", "time").size();
        EXPECT_EQ(power.size(), steps + 1) << "a row at the start and one for each step";
        if (inertial) {
          EXPECT_EQ(power.at(1), 0) << "the second step computes the first one again";
        }
        // A row of steps.csv has the flow at the beginning of its step, in a fluid with inertia.
        const double end = inertial ? kEnd - h : kEnd,
                     rate = 0.4 * pi * std::cos(pi * end + phase) / 2;
        const double kinetic = mass * rate * rate +
                               (inertial ? column("steps.csv", "kinetic_energy_fluid").back() : 0);
        const double dissipated = h * sum("steps.csv", "dissipation");
        const double work = h * sum("arms.csv", "power");
        errors.push_back(work / (dissipated + kinetic) - 1);
        EXPECT_NEAR(mean_dissipation() * end / dissipated, 1, 1e-12);
      }
      SCOPED_TRACE(
          fmt::format("phase {} inertial {}: {} {}", phase, inertial, errors[0], errors[1]));
      // Five steps in half of a period.
      EXPECT_LT(std::abs(errors[0]), 0.07);
      EXPECT_LT(std::abs(errors[1]), 0.6 * std::abs(errors[0]));
    }
}

TEST_F(FluidTables, AFloorTakesTheWeightThatItsFilmAbsorbs) {
  for (const bool inertial : {true, false})
    for (const double h : {0.2, 0.1}) {
      SCOPED_TRACE(fmt::format("inertial {}, h {}", inertial, h));
      const double mass = 2, weight = (mass - (inertial ? pi / 4 : 0)) * 1.5;
      compute(text_of(
          inertial ? kInertia : "", h, 0.4,
          fmt::format("[[particle]]\ncentre = [0.0, -1.45]\nradius = 0.5\nmass = {}\n", mass),
          "-1.5"));
      const double impulse = h * sum("contacts.csv", "normal_force");
      EXPECT_NEAR(impulse, -column("contacts.csv", "gamma").back(), 1e-9);
      EXPECT_NEAR(impulse, weight * (inertial ? 0.4 - h : 0.4), 2e-3);
      // Only the floor has a force. The branch from the floor to the centre is the radius and the
      // gap; the stress is that of the box of area 24.
      EXPECT_NEAR(h * sum("walls.csv", "force_y"), -impulse, 1e-9);
      EXPECT_NEAR(h * sum("stress.csv", "stress_yy"), -impulse * 0.55 / 24, 1e-9);
    }
}

TEST_F(FluidTables, AHingeAndASpringHoldADiscThatIsPulled) {
  // The disc at the hinge does not move. The spring takes the force of the other one, which rests.
  for (const bool inertial : {true, false})
    for (const double h : {0.2, 0.1}) {
      SCOPED_TRACE(fmt::format("inertial {}, h {}", inertial, h));
      compute(text_of(inertial ? kInertia : "", h, 0.4, R"([[particle]]
centre = [-1.25, 0.0]
radius = 0.5
mass = 1.0
[[particle]]
centre = [1.25, 0.0]
radius = 0.5
mass = 1.0
force = [3.0, 0.0]
[[hinge]]
particle = 0
at = [-1.25, 0.0]
[[spring]]
between = [0, 1]
length = 2.4
stiffness = 30.0
)"));
      const double duration = inertial ? 0.4 - h : 0.4;
      EXPECT_NEAR(h * sum("hinges.csv", "force_x"), -3 * duration, 1e-3);
      EXPECT_NEAR(h * sum("springs.csv", "force"), -3 * duration, 1e-3);
      EXPECT_NEAR(h * sum("hinges.csv", "force_y"), 0, 1e-3);
      EXPECT_NEAR(column("springs.csv", "length").back(), 2.5, 1e-6);
    }
}

TEST_F(FluidTables, ADrivenDiscGivesItsWorkToTheFluid) {
  // From rest, evenly faster; a row has the force at the beginning of its step.
  std::vector<double> errors;
  for (const double h : {0.1, 0.05}) {
    std::string pieces;
    for (int n = 0; n < 40; ++n)
      pieces += fmt::format("{}{{ until = {}, value = [{}, 0.0] }}", n > 0 ? ", " : "",
                            0.0125 * (n + 1), 0.0125 * (n + 0.5));
    compute(text_of(kInertia, h, 0.5,
                    "[[particle]]\ncentre = [-1.0, 0.0]\nradius = 0.5\ndensity = 1.0\n"
                    "velocity_given = { value = [" +
                        pieces + "] }\n"));
    const auto force = column("steps.csv", "given_force_x"), time = column("steps.csv", "time");
    EXPECT_EQ(force.front(), 0);
    double work = 0;
    for (std::size_t n = 0; n < force.size(); ++n) work -= h * force[n] * (time[n] - h);
    const double given =
        h * sum("steps.csv", "dissipation") + column("steps.csv", "kinetic_energy_fluid").back();
    errors.push_back(work / given - 1);
  }
  // Five steps; their error is of first order.
  EXPECT_LT(std::abs(errors[0]), 0.1) << errors[0];
  EXPECT_LT(std::abs(errors[1]), 0.6 * std::abs(errors[0])) << errors[1];
}

TEST_F(FluidTables, HaveTheSameRowsInTwoParts) {
  // After the first step, whose forces the second one computes, and later.
  const std::string sections =
      oscillating_discs(0, 1.5) + "[[particle]]\ncentre = [0.0, -1.45]\nradius = 0.5\nmass = 2.0\n";
  const auto text = [&](double end) { return text_of(kInertia, 0.05, end, sections, "-1.5"); };
  const auto tables = {"arms.csv",  "contacts.csv", "motion.csv",
                       "steps.csv", "walls.csv",    "stress.csv"};
  // The rows of each table, without the wall time of the step and the row at the start of a part.
  const auto rows = [&](bool is_later) {
    std::map<std::string, std::vector<std::string>> all;
    const auto first = column("steps.csv", "time").front();
    const auto files = without_costs(out().string());
    for (const std::string table : tables) {
      const auto lines =
          matches_in(replaced_matches(files.at(table), "#[^\n]*\n", ""), "([^\n]+)\n", 1);
      const auto names = matches_in(lines.front() + ",", "([^,]*),", 1);
      const auto time = static_cast<std::size_t>(std::ranges::find(names, "time") - names.begin());
      for (std::size_t i = 1; i < lines.size(); ++i)
        if (!is_later ||
            std::stod(matches_in(lines[i] + ",", "([^,]*),", 1).at(time)) > first - 1e-9)
          all[table].push_back(lines[i]);
    }
    return all;
  };
  compute(text(0.25));
  const auto whole = rows(false);
  for (const double middle : {0.05, 0.1}) {
    compute(text(middle));
    auto parts = rows(false);
    continue_last_run(text(0.25));
    for (const auto& [table, later] : rows(true))
      parts[table].insert(parts[table].end(), later.begin(), later.end());
    for (const auto& [table, lines] : whole) EXPECT_EQ(parts.at(table), lines) << table << middle;
  }
}

}  // namespace
}  // namespace viscontact
