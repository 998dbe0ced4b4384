// Means of the rheology of a run and their standard errors, by hand.
#include "viscontact/particle_runs/run/rheology_means.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace viscontact::particles {
namespace {

Rheology viscosity_of(double viscosity) {
  Rheology rheology;
  rheology.shear_rate = 1;
  rheology.viscosity = viscosity;
  return rheology;
}

TEST(RheologyMeans, CountWhatIsAfterTheirBeginning) {
  RheologyMeans means;
  means.add(viscosity_of(100), 0, 1, 1.5, 11.5);  // before
  means.add(viscosity_of(3), 1, 2, 1.5, 11.5);    // half of the step
  means.add(viscosity_of(6), 2, 3, 1.5, 11.5);
  EXPECT_DOUBLE_EQ(means.mean(0).value(), (0.5 * 3 + 6) / 1.5);
  EXPECT_EQ(means.mean(1), 0);  // n1
}

TEST(RheologyMeans, HaveTheStandardErrorOfTheMeansOfBlocks) {
  RheologyMeans means;
  EXPECT_FALSE(means.mean(0).has_value());
  means.add(viscosity_of(2), 0, 0.5, 0, 10);
  means.add(viscosity_of(4), 0.5, 1, 0, 10);  // the first block: 3
  EXPECT_FALSE(means.standard_error(0).has_value());
  means.add(viscosity_of(5), 1, 2, 0, 10);
  means.add(viscosity_of(7), 9, 10, 0, 10);
  EXPECT_EQ(means.filled_blocks(), 3U);
  // The blocks 3, 5 and 7 have the standard deviation 2.
  EXPECT_DOUBLE_EQ(means.standard_error(0).value(), 2 / std::sqrt(3));
  EXPECT_DOUBLE_EQ(means.mean(0).value(), 5);
}

TEST(RheologyMeans, HaveOneInstantAsTheirMean) {
  RheologyMeans means;
  means.add(viscosity_of(2.5), 0, 0, 0, 0);
  EXPECT_EQ(means.mean(0), 2.5);
  EXPECT_FALSE(means.standard_error(0).has_value());
}

TEST(RheologyMeans, LeaveOutAFluidWithoutAViscosity) {
  RheologyMeans means;
  means.add(viscosity_of(std::numeric_limits<double>::quiet_NaN()), 0, 1, 0, 10);
  EXPECT_FALSE(means.mean(0).has_value());
  Rheology at_rest;
  means.add(at_rest, 1, 2, 0, 10);
  EXPECT_EQ(means.filled_blocks(), 0U);
}

}  // namespace
}  // namespace viscontact::particles
