// Particles without a fluid that jam, means over time, and the numbers of their regime.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// Three discs of the radius 1/2 on each other, on a plane at rest, and below the body `upper`.
std::string squeezed(const std::string& end_time, const std::string& upper) {
  std::string text = R"(title = "A column"
[space]
dimension = 2
[viscous_contact]
time_step = 0.05
gamma_min = 0.0
end_time = )" + end_time +
                     R"(
[[plane]]
point = [0.0, 0.0]
normal = [0.0, 1.0]
)";
  for (const auto* height : {"0.5", "1.5", "2.5"})
    text += disc(std::string("0.0, ") + height, "0.5", "1.0");
  return text + upper;
}

/// A plane at the height 3.2, which moves as `motion` says.
std::string plane_above(const std::string& motion) {
  return "[[plane]]\npoint = [0.0, 3.2]\nnormal = [0.0, -1.0]\n" + motion;
}

const std::string kDriven = plane_above("velocity = [0.0, -0.1]\n");
const std::string kDrivenDisc =
    disc("0.0, 3.7", "0.5", "1.0", "velocity_given = { value = [0.0, -0.1] }\n");

class Packings : public ParticlesCommand {
 protected:
  Json record() const { return Json::parse(read_file(out() / "run.json")); }
};

TEST_F(Packings, ThatJamAreCountedAndWarnedOf) {
  for (const auto& [upper, name] :
       {std::pair(kDriven, "plane -2"), std::pair(kDrivenDisc, "particle 3")}) {
    // The column has the height 3, so that the body above leaves it room until t = 2.
    const auto jammed = run(put_case(squeezed("2.5", upper)), out());
    EXPECT_EQ(jammed.exit_status, results::exit_code_of(ErrorKind::kNotConverged));
    const auto found = record();
    const double first = found["first_jam"];
    const int steps = found["jammed_steps"];
    EXPECT_GT(first, 2);
    // Counted from an overlap of 0.005 on: at the latest when four of them are lacking, and a step.
    EXPECT_LT(first, 2.2 + 1.5 * 0.05);
    // Each step from then on, to the end.
    EXPECT_EQ(steps, std::lround((2.5 - first) / 0.05) + 1);
    EXPECT_THAT(jammed.errors,
                Names(fmt::format("{} steps", steps), fmt::format("t = {:.6g}", first), name));
  }
}

TEST_F(Packings, ThatHaveRoomOrGiveWayDoNotJam) {
  for (const auto& text :
       {squeezed("1.9", kDriven), squeezed("4.0", plane_above("force = 1.0\nmass = 1.0\n"))}) {
    const auto result = run(put_case(text), out());
    expect_done(result);
    EXPECT_EQ(record()["jammed_steps"], 0);
    EXPECT_TRUE(record()["first_jam"].is_null());
    EXPECT_THAT(result.errors, Not(HasSubstr("jam")));
  }
}

/// A disc at rest on a floor, pushed down by 1 until t = 5 and by 3 after, and another one, which
/// lies on a fixed disc and is pushed by 2; `output` are more keys of [output].
std::string loads(const std::string& output) {
  return R"(title = "Loads"
[space]
dimension = 2
[domain]
box = { from = [-2.0, -1.0], to = [6.0, 4.0] }
[viscous_contact]
time_step = 0.05
end_time = 10.0
gamma_min = 0.0
[output]
every = 0.05
tables = ["walls", "stress", "motion"]
)" + output +
         R"([[plane]]
point = [0.0, 0.0]
normal = [0.0, 1.0]
)" +
         disc("0.0, 0.5", "0.5", "1.0",
              "force = [ { until = 5.0, value = [0.0, -1.0] }, { until = 10.0, value = [0.0, -3.0] "
              "} "
              "]\n") +
         disc("4.0, 1.0", "0.5", "1.0", "fixed = true\n") +
         disc("4.0, 2.0", "0.5", "1.0", "force = [0.0, -2.0]\n");
}

TEST_F(Packings, HaveMeansOverTheTimeThatIsAskedFor) {
  expect_done(run(put_case(loads("average_from = 2.5\n")), out()));
  const auto found = record();
  EXPECT_EQ(found["average_from"], 2.5);
  // The default of solver.impulse_tolerance, 1e-10, of forces of up to 3.
  constexpr double kTolerance = 1e-9;
  const double floor = (1 * 2.5 + 3 * 5) / 7.5;
  // The sides of the box come first.
  const auto walls = found["mean_wall_forces"];
  ASSERT_EQ(walls.size(), 5U);
  double sum = 0;
  for (const auto& force : walls) sum += force[1].get<double>();
  EXPECT_NEAR(sum, -floor, kTolerance);
  EXPECT_NEAR(walls[4][1].get<double>(), -floor, kTolerance);
  const auto load = found["mean_given_loads"];
  ASSERT_EQ(load.size(), 1U);
  EXPECT_EQ(load[0]["id"], 1);
  EXPECT_NEAR(load[0]["contact_force"][0].get<double>(), 0, kTolerance);
  EXPECT_NEAR(load[0]["contact_force"][1].get<double>(), -2, kTolerance);
  EXPECT_NEAR(load[0]["contact_torque"][0].get<double>(), 0, kTolerance);
  // The same means from the rows of the tables, each of which stands for the step before it.
  const auto mean = [&](const std::string& file, const std::string& name) {
    const auto times = column(file, "time"), values = column(file, name);
    double total = 0;
    int rows = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
      if (times[i] > 2.5 + 1e-9) total += values[i], ++rows;
    EXPECT_EQ(rows, 150) << file;
    return total / rows;
  };
  const auto stress = found["mean_stress"];
  const char* const axes[] = {"x", "y"};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_NEAR(stress[i][j].get<double>(),
                  mean("stress.csv", std::string("stress_") + axes[i] + axes[j]), 1e-12);
  // Force times the distance of the centres, or of the centre from the plane, over 8 times 4, the
  // area between the sides of the box and the plane. Pressure is negative.
  EXPECT_NEAR(stress[1][1].get<double>(), -(floor * 0.5 + 2 * 1) / 32, kTolerance);
}

TEST_F(Packings, HaveNoMeansIfNoneAreAskedFor) {
  expect_done(run(put_case(loads("")), out()));
  for (const auto* key : {"average_from", "mean_stress", "mean_wall_forces", "mean_given_loads"})
    EXPECT_FALSE(record().contains(key)) << key;
}

TEST_F(Packings, GravityThatPointsUpwardsIsAWarning) {
  const auto with = [&](const std::string& gravity) {
    const auto result = run(put_case(replaced(kCase, "[0.0, -1.0]", gravity)), out());
    expect_done(result);
    return result.errors;
  };
  EXPECT_THAT(with("[0.0, 9.81]"), Names("warning", "space.gravity", "9.81"));
  for (const auto* gravity : {"[0.0, -1.0]", "[1.0, 0.0]"})
    EXPECT_THAT(with(gravity), Not(Names("space.gravity")));
}

/// Three discs that fall on a floor in a fluid whose flow is not computed.
std::string falling(const std::string& film, const std::string& end_time = "4.0") {
  return R"(title = "Falling discs"
[space]
dimension = 2
gravity = [0.0, -1.0]
[viscous_contact]
time_step = 0.05
end_time = )" +
         end_time + "\n" + film +
         R"([output]
every = 0.05
tables = ["motion"]
[[plane]]
point = [0.0, 0.0]
normal = [0.0, 1.0]
)" + disc("0.0, 1.5", "0.5", "1.0", "velocity = [0.3, 0.0]\n") +
         disc("4.0, 2.5", "1.0", "3.0") + disc("8.0, 0.4", "0.25", "2.0");
}

/// The largest numbers of the rows of motion.csv of falling() after time 0.
struct Largest {
  double size_times_speed = 0, stokes = 0, momentum = 0;
};

TEST_F(Packings, HaveTheReynoldsAndStokesNumbersOfTheirMotion) {
  const auto largest = [&](double viscosity) {
    constexpr double kRadii[] = {0.5, 1, 0.25}, kMasses[] = {1, 3, 2};
    const auto times = column("motion.csv", "time"), ids = column("motion.csv", "id"),
               vx = column("motion.csv", "vx"), vy = column("motion.csv", "vy");
    Largest found;
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (!(times[i] > 0)) continue;
      const auto k = static_cast<std::size_t>(ids[i]);
      const double speed = std::hypot(vx[i], vy[i]), r = kRadii[k], m = kMasses[k];
      found.size_times_speed = std::max(found.size_times_speed, 2 * r * speed);
      found.stokes = std::max(found.stokes, m * speed / (6 * std::numbers::pi * viscosity * r * r));
      found.momentum = std::max(found.momentum, m * speed);
    }
    return found;
  };
  // Rounding errors of the quotients, and of the values in the file.
  constexpr double kRounding = 1e-13;
  const auto film = std::string("viscosity = 0.2\nroughness = 0.01\n");
  auto result = run(put_case(falling(film + "fluid_density = 0.7\n")), out());
  expect_done(result);
  auto numbers = largest(0.2);
  ASSERT_GT(numbers.size_times_speed, 3);  // the largest disc falls by 1.5 to its speed 1.7
  auto found = record();
  const double reynolds = 0.7 * numbers.size_times_speed / 0.2;
  EXPECT_NEAR(found["reynolds_number"].get<double>() / reynolds, 1, kRounding);
  EXPECT_NEAR(found["stokes_number"].get<double>() / numbers.stokes, 1, kRounding);
  EXPECT_THAT(result.errors, Names(fmt::format("Stokes number {:.3g}", numbers.stokes),
                                   fmt::format("Reynolds number {:.3g}", reynolds)));
  // (1 + 0.15 Re^0.687), Schiller & Naumann.
  EXPECT_THAT(result.errors, Names(fmt::format("{:.4g}", reynolds)));

  expect_done(run(put_case(falling(film)), out()));
  EXPECT_TRUE(record()["reynolds_number"].is_null());
  EXPECT_NEAR(record()["stokes_number"].get<double>() / numbers.stokes, 1, kRounding);

  // A film that is given by its impulse has no viscosity.
  for (const double lowest : {-2.0, -60.0, -1000.0}) {
    // The disc of mass 3 presses with 3, and its solid touches at 60 after 19.
    result = run(put_case(falling(fmt::format("gamma_min = {:.1f}\n", lowest), "24.0")), out());
    expect_done(result);
    found = record();
    EXPECT_TRUE(found["stokes_number"].is_null());
    const double of_film = largest(1).momentum / -lowest;
    EXPECT_NEAR(found["film_stokes_number"].get<double>() / of_film, 1, kRounding);
    const auto warning = Names("warning", "momentum");
    // At 2 the impact decides when solids touch, at 1000 they do not.
    if (lowest == -60.0)
      EXPECT_THAT(result.errors, warning);
    else
      EXPECT_THAT(result.errors, Not(warning));
  }
}

}  // namespace
}  // namespace viscontact
