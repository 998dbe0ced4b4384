// Scales of colours for pressures.
#include "viscontact/report/pictures/colours.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace viscontact::report {
namespace {

TEST(PressureColours, HaveNumbersAlsoWherePressuresDifferByRoundingErrorsOnly) {
  // With ends that differ by one unit in the last place the search for round numbers never ended.
  for (const double pressure : {1.0, -1.0, 3e-200, -7e200}) {
    const double next = std::nextafter(pressure, std::numeric_limits<double>::infinity());
    for (const auto& colours : {proportional_colours({pressure, next}),
                                proportional_colours({pressure}), proportional_colours({})}) {
      EXPECT_LT(colours.low, colours.high);
      EXPECT_GE(colours.ticks().size(), 3U);
      EXPECT_LE(colours.ticks().size(), 12U);
    }
  }
}

}  // namespace
}  // namespace viscontact::report
