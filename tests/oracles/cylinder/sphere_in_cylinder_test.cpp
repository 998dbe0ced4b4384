// The sphere in a closed cylinder against values computed by another method, and against what must
// hold: symmetry about half the height, and the plane for a large cylinder.
#include "tests/oracles/cylinder/sphere_in_cylinder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <initializer_list>
#include <string>

#include "tests/oracles/bispherical/bispherical.hpp"
#include "tests/oracles/near_contact_expansion.hpp"
#include "viscontact/common/text/csv.hpp"

namespace viscontact {
namespace {

TEST(SphereInCylinder, AgreesWithTheReferenceValues) {
  const auto table =
      read_csv(kReference / "sphere_in_cylinder.csv",
               std::array<std::string, 4>{"R_over_r", "H_over_r", "gap_over_r", "lambda"}, 4);
  ASSERT_GE(table.rows.size(), 12U);
  for (const auto& row : table.rows) {
    const double epsilon = row.fields[2].value(), exact = row.fields[3].value();
    // The file's values have 7 digits.
    EXPECT_NEAR(
        sphere_in_cylinder_drag_factor(epsilon, row.fields[0].value(), row.fields[1].value()),
        exact, 1e-7 * exact)
        << "at gap/radius " << epsilon;
  }
}

TEST(SphereInCylinder, IsSymmetricAboutHalfTheHeight) {
  // Nothing in the method is: one end has its no-slip built in, the other in the least squares. The
  // header promises 1e-6 for the upper one.
  for (const double radius : {3.0, 5.0}) {
    const double middle = radius - 1;
    for (const double shift : {0.25, 0.5, 1.0}) {
      const double below = sphere_in_cylinder_drag_factor(middle - shift, radius, 2 * radius);
      const double above = sphere_in_cylinder_drag_factor(middle + shift, radius, 2 * radius);
      EXPECT_NEAR(above, below, 1e-6 * below) << "R/r " << radius << ", shift " << shift;
    }
  }
}

TEST(SphereInCylinder, TendsToThePlaneAsTheCylinderGrows) {
  // The flow that a force normal to a plane drives falls as r^-3 (Blake 1971), and what the other
  // walls send back falls, by reciprocity, as R^-5. The next order is smaller by (sphere's
  // height)/R, here 2/40.
  for (const double epsilon : {0.1, 1.0}) {
    const auto excess = [epsilon](double radius) {
      return sphere_in_cylinder_drag_factor(epsilon, radius, 2 * radius) -
             bispherical_plane_factor(epsilon);
    };
    EXPECT_GT(excess(80), 0);
    EXPECT_NEAR(excess(40) / excess(80), 32, 32 * 0.06) << "at gap/radius " << epsilon;
  }
  // Small gap, largest cylinder: nothing is left of it but the method's error.
  EXPECT_NEAR(sphere_in_cylinder_drag_factor(1e-3, 80, 160), bispherical_plane_factor(1e-3),
              1e-8 * bispherical_plane_factor(1e-3));
}

}  // namespace
}  // namespace viscontact
