#include "viscontact/report/pictures/sweep_axes.hpp"

#include <gtest/gtest.h>

namespace viscontact::report {
namespace {

const Units kSi = {"m", "s", "kg"};

TEST(SweepAxes, HaveNameAndUnit) {
  EXPECT_EQ(axis_label("sphere.radius", kSi), "sphere.radius [m]");
  EXPECT_EQ(axis_label("fluid.viscosity", kSi), "fluid.viscosity [Pa s]");
  EXPECT_EQ(axis_label("motion.external_force[1].until", kSi), "motion.external_force[1].until");
  EXPECT_EQ(axis_label("inertial.minimal_gap/sphere.radius", kSi),
            "inertial.minimal_gap/sphere.radius");
  EXPECT_EQ(axis_label("inertial.minimal_gap_time/sphere.radius", kSi),
            "inertial.minimal_gap_time/sphere.radius [s/m]");
  EXPECT_EQ(axis_label("inertial.time_to_gap_0.001", kSi), "inertial.time_to_gap_0.001 [s]");
  EXPECT_EQ(axis_label("sphere.radius", Units{}), "sphere.radius");
}

TEST(SweepAxes, OfSeveralColumnsHaveWhatTheyShare) {
  EXPECT_EQ(common_axis_label({"inertial.minimal_gap", "reference.minimal_gap"}, kSi),
            "minimal_gap [m]");
  EXPECT_EQ(common_axis_label({"inertial.minimal_gap", "reference.film_from_gamma"}, kSi), "[m]");
  EXPECT_EQ(common_axis_label({"inertial.minimal_gap", "inertial.steps"}, kSi), "");
}

}  // namespace
}  // namespace viscontact::report
