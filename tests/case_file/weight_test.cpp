// Densities and gravity of one sphere: mass, weight less buoyancy, and what may not be given
// together.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "tests/case_file/edited_case.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact::case_file {
namespace {

constexpr LectureKey kMass = {"sphere.mass", "20.0"};
constexpr LectureKey kViscosity = {"fluid.viscosity", "3.0"};
const std::string kForce =
    "external_force = [ { until = 2.0, value = -200.0 }, { until = 4.0, value = 200.0 } ]";
constexpr double kVolume = 4 * std::numbers::pi / 3;  // of the lecture's sphere, r = 1

/// The lecture's case with these lines in [sphere] in place of its mass, and these in [motion] in
/// place of its force.
std::string text_of(const std::string& sphere, const std::string& fluid,
                    const std::string& motion) {
  auto text = with_text(kForce, motion).text;
  const auto put = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  put("mass = 20.0 ", sphere + " ");
  put("viscosity = 3.0 ", "viscosity = 3.0\n" + fluid + " ");
  return text;
}

TEST(WeightOfOneSphere, IsThatOfTheDensityLessTheBuoyancy) {
  const Case c = read_text(text_of("density = 5.0", "density = 2.0", "gravity = -10.0"));
  const auto& motion = required_motion(c);
  EXPECT_DOUBLE_EQ(motion.mass, 5 * kVolume);
  EXPECT_DOUBLE_EQ(motion.external_force.value(0), -30 * kVolume);
  EXPECT_DOUBLE_EQ(motion.external_force.value(4), -30 * kVolume);
  EXPECT_TRUE(motion.external_force.jumps().empty());
}

TEST(WeightOfOneSphere, IsThatOfAMassToo) {
  const Case c = read_text(text_of("mass = 20.0", "density = 2.0", "gravity = -10.0"));
  EXPECT_DOUBLE_EQ(required_motion(c).external_force.value(1), -10 * (20 - 2 * kVolume));
}

TEST(WeightOfOneSphere, IsAddedToTheExternalForce) {
  const Case c = read_text(text_of("mass = 20.0", "", "gravity = -10.0\n" + kForce));
  EXPECT_EQ(required_motion(c).external_force.value(1), -400);
  EXPECT_EQ(required_motion(c).external_force.value(3), 0);
}

TEST(WeightOfOneSphere, IsExactlyZeroAtEqualDensities) {
  const Case c = read_text(text_of("density = 1.3", "density = 1.3", "gravity = -9.81"));
  EXPECT_EQ(required_motion(c).external_force.value(1), 0);
}

TEST(WeightOfOneSphere, StaysWhereTimesAreStretched) {
  const Case c = read_text(text_of("mass = 20.0", "", "gravity = -10.0\ntime_scale = 2.5"));
  EXPECT_EQ(required_motion(c).external_force.value(9), -200);
}

TEST(WeightOfOneSphere, DensityWithoutGravityGivesTheMassAlone) {
  const Case c = read_text(text_of("density = 5.0", "density = 2.0", kForce));
  EXPECT_DOUBLE_EQ(required_motion(c).mass, 5 * kVolume);
  EXPECT_EQ(required_motion(c).external_force.value(1), -200);
}

TEST(WeightOfOneSphere, NamesBothLinesIfMassAndDensityAreGiven) {
  auto edited = with_value(kMass, "20.0\ndensity = 5.0");
  expect_refused(edited, kMass.path, "line " + std::to_string(edited.line + 1));
}

TEST(WeightOfOneSphere, RefusesWhatMakesNoWeight) {
  constexpr LectureKey kForceKey = {"motion.external_force",
                                    "[ { until = 2.0, value = -200.0 }, { until = 4.0, value = "
                                    "200.0 } ]"};
  expect_refused(without_key(kForceKey), kForceKey.path);
  expect_refused(without_key(kMass), kMass.path);
  const auto below = [](EditedCase edited) {
    ++edited.line;  // the added key is below the edited one
    return edited;
  };
  expect_refused(below(with_value(kViscosity, "3.0\ndensity = -1.0")), "fluid.density");
  auto heavy = with_value(kMass, "20.0");
  heavy.text.replace(heavy.text.find("mass = 20.0"), 11, "density = 1e308");
  expect_refused(heavy, "sphere.density");
  expect_refused(below(with_value({"motion.initial_velocity", "0.0"}, "0.0\ngravity = 1e308")),
                 "motion.gravity");
}

/// A glass sphere of 0.5 mm that falls in silicone oil, in units of which one metre, kilogram and
/// second are `metre`, `kilogram` and `second`.
Case glass_in(double metre, double kilogram, double second) {
  const double density = kilogram / (metre * metre * metre);
  const std::string text = fmt::format(
      "title = \"glass\"\n[fluid]\nviscosity = {}\ndensity = {}\n[sphere]\nradius = {}\n"
      "density = {}\n[fit]\nexact = \"plane\"\n[motion]\ninitial_gap = {}\ninitial_velocity = 0\n"
      "end_time = {}\ngravity = {}\n[viscous_contact]\nroughness = [{}, {}]\n",
      0.1 * kilogram / (metre * second), 970 * density, 0.5e-3 * metre, 2500 * density,
      1e-3 * metre, second, -9.81 * metre / (second * second), 5e-7 * metre, 5e-7 * metre);
  return read_text(text);
}

TEST(WeightOfOneSphere, MakesTheSameMotionInUnitsOverTenDecades) {
  // One rounding of each number of the case, multiplied by 4000 steps. The models with inertia
  // choose their steps: within their tolerance of 1e-9.
  constexpr double kRounding = 1e-10, kTolerance = 5e-9;
  std::mt19937_64 generator(36);
  std::uniform_real_distribution<double> decades(-5, 5);
  const auto ends = [](const Case& c, const char* model) {
    const auto force = lubrication::LubricationForce::exact_plane(c.viscosity, c.radius);
    return reduced_model::simulate(reduced_model::find_model(model), required_motion(c), force);
  };
  const Case si = glass_in(1, 1, 1);
  for (int i = 0; i < 20; ++i) {
    const double metre = std::pow(10, decades(generator));
    const double kilogram = std::pow(10, decades(generator));
    const double second = std::pow(10, decades(generator));
    SCOPED_TRACE(fmt::format("metre {}, kilogram {}, second {}", metre, kilogram, second));
    const Case c = glass_in(metre, kilogram, second);
    for (const auto* model : {"reference_exact", "inertial", "inertial_rough"}) {
      const auto old_one = ends(si, model), other = ends(c, model);
      EXPECT_NEAR(other.rows.back().gap / metre / old_one.rows.back().gap, 1,
                  old_one.steps == other.steps ? kRounding : kTolerance)
          << model;
    }
    const auto old_one = ends(si, "viscous_contact_threshold");
    const auto other = ends(c, "viscous_contact_threshold");
    EXPECT_NEAR(other.contact_interval.value()[0] / second / old_one.contact_interval.value()[0], 1,
                kRounding);
    EXPECT_NEAR(*other.film_from_gamma / metre / 1e-6, 1, kRounding);
  }
}

}  // namespace
}  // namespace viscontact::case_file
