// Single steps of viscous contact, by hand. All numbers are dyadic: what is computed by hand comes
// out to the bit.
#include "viscontact/reduced_model/models/contact/contact_step.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace viscontact::reduced_model {
namespace {

constexpr double kSmooth = -std::numeric_limits<double>::infinity();
constexpr double kMass = 4;
constexpr double kStep = 0.5;

/// One step without drag, from the velocity that it would have without contact.
ContactState contact_step(const ContactState& state, double free_velocity, double mass,
                          double gamma_min, double step) {
  return reduced_model::contact_step(state, mass * (free_velocity - state.velocity),
                                     ContactSetting(mass, gamma_min, step), NoDrag())
      .state;
}

void expect_state(const ContactState& state, double gap, double velocity, double gamma) {
  EXPECT_EQ(state.gap, gap);
  EXPECT_EQ(state.velocity, velocity);
  EXPECT_EQ(state.gamma, gamma);
}

TEST(ContactStep, LeavesADistantSphereFree) {
  expect_state(contact_step({2, -1, 0}, -1.5, kMass, kSmooth, kStep), 1.25, -1.5, 0);
}

TEST(ContactStep, StopsASphereAtThePlaneAndRemembersTheImpulse) {
  // It may go 1 down in 0.5: u = -2; the film takes m (u - free) = 4 (-2 + 5) = 12.
  expect_state(contact_step({1, -5, 0}, -5, kMass, kSmooth, kStep), 0, -2, -12);
}

TEST(ContactStep, TouchesWithoutForceWhenItArrivesExactly) {
  expect_state(contact_step({1, 0, 0}, -2, kMass, kSmooth, kStep), 0, -2, 0);
}

TEST(ContactStep, ComesToRestInTheStepAfterItsArrival) {
  // Carried on at -2 without contact: the film takes that momentum, 8, too.
  expect_state(contact_step({0, -2, -12}, -2, kMass, kSmooth, kStep), 0, 0, -20);
}

TEST(ContactStep, RemembersThePushOnASphereAtRest) {
  expect_state(contact_step({0, 0, -3}, -0.25, kMass, kSmooth, kStep), 0, 0, -4);
}

TEST(ContactStep, HoldsAPulledSphereUntilThePushIsGivenBack) {
  expect_state(contact_step({0, 0, -3}, 0.25, kMass, kSmooth, kStep), 0, 0, -2);
}

TEST(ContactStep, ReleasesASphereWithWhatIsLeftOfThePull) {
  // The pull gives 4 * 2 = 8, the film asks for 3: 5 are left, u = 5/4.
  expect_state(contact_step({0, 0, -3}, 2, kMass, kSmooth, kStep), 0.625, 1.25, 0);
}

TEST(ContactStep, EndsAtThePlaneWhenThePullJustGivesThePushBack) {
  expect_state(contact_step({0, 0, -4}, 1, kMass, kSmooth, kStep), 0, 0, 0);
}

TEST(ContactStep, LetsASphereWithNothingToRememberGo) {
  expect_state(contact_step({0, 0, 0}, 0.5, kMass, kSmooth, kStep), 0.25, 0.5, 0);
}

TEST(ContactStep, LeavesTheRestOfThePushToTheSolid) {
  expect_state(contact_step({1, -5, 0}, -5, kMass, -10, kStep), 0, -2, -10);
  expect_state(contact_step({0, 0, -10}, -3, kMass, -10, kStep), 0, 0, -10);
}

TEST(ContactStep, RisesFromTheSolidAsSoonAsItIsPulled) {
  expect_state(contact_step({0, 0, -10}, 0.25, kMass, -10, kStep), 0, 0, -9);
}

TEST(ContactStep, IsPlainContactWhereTheFilmRemembersNothing) {
  expect_state(contact_step({1, -5, 0}, -5, kMass, 0, kStep), 0, -2, 0);
  expect_state(contact_step({0, -2, 0}, 0.5, kMass, 0, kStep), 0.25, 0.5, 0);
}

}  // namespace
}  // namespace viscontact::reduced_model
