// Dissipation of a fluid without particles: linear flows, Couette flow, and where it is not known.
#include "viscontact/freefem_flow/process/dissipation_alone.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;
using particles::Fluid;
using particles::LinearFlow;
using particles::SideVelocities;
using particles::WallVelocity;

Fluid with_viscosity(double mu, decltype(Fluid::boundary) boundary) {
  Fluid fluid;
  fluid.viscosity = mu;
  fluid.boundary = boundary;
  return fluid;
}

// u = (s y, 0) dissipates mu s² on each unit of area, u = (s x, -s y) four times as much.
TEST(DissipationAlone, OfShearAndStrain) {
  const particles::DiscDomain disc{{}, 2};
  const double area = 4 * std::numbers::pi;
  EXPECT_DOUBLE_EQ(dissipation_alone(with_viscosity(3, LinearFlow{{0, 5, 0, 0}}), disc),
                   3 * 25 * area);
  const BoxDomain cell{{-1, -1}, {2, 1}, {true, true}};
  EXPECT_DOUBLE_EQ(dissipation_alone(with_viscosity(3, LinearFlow{{5, 0, 0, -5}}), cell),
                   4 * 3 * 25 * 6);
}

// A rotation dissipates nothing.
TEST(DissipationAlone, OfARotationIsZero) {
  const particles::DiscDomain disc{{}, 2};
  EXPECT_EQ(dissipation_alone(with_viscosity(1, LinearFlow{{0, 1, -1, 0}}), disc), 0);
}

// Walls at 2 and -1 at the distance 6 shear at the rate 1/2, along either axis.
TEST(DissipationAlone, OfCouetteFlow) {
  SideVelocities sides;
  sides[2].value = {-1, 0};
  sides[3].value = {2, 0};
  const BoxDomain box{{0, 0}, {10, 6}, {true, false}};
  EXPECT_DOUBLE_EQ(dissipation_alone(with_viscosity(4, sides), box), 4 * 60 / 4.0);
  SideVelocities upright;
  upright[0].value = {0, -1};
  upright[1].value = {0, 2};
  const BoxDomain turned{{0, 0}, {6, 10}, {false, true}};
  EXPECT_DOUBLE_EQ(dissipation_alone(with_viscosity(4, upright), turned), 4 * 60 / 4.0);
}

TEST(DissipationAlone, IsZeroWhereItIsNotKnownOrWallsAreAtRest) {
  SideVelocities driven;
  driven[3].value = {1, 0};
  const BoxDomain closed{{0, 0}, {1, 1}, {false, false}};
  EXPECT_EQ(dissipation_alone(with_viscosity(1, driven), closed), 0);
  driven[3].kind = WallVelocity::Kind::kOpen;
  const BoxDomain channel{{0, 0}, {1, 1}, {true, false}};
  EXPECT_EQ(dissipation_alone(with_viscosity(1, driven), channel), 0);
  EXPECT_EQ(dissipation_alone(with_viscosity(1, LinearFlow{}), channel), 0);
  driven[3].kind = WallVelocity::Kind::kConstant;
  EXPECT_GT(dissipation_alone(with_viscosity(1, driven), channel), 0);
  auto swinging = driven;
  swinging[3].period = 2;
  swinging[3].amplitude = 0.5;
  EXPECT_EQ(dissipation_alone(with_viscosity(1, swinging), channel), 0);
  auto stopping = driven;
  stopping[2].pieces = {{{1, {1, 0, 0}}, {2, {0, 0, 0}}}};
  EXPECT_EQ(dissipation_alone(with_viscosity(1, stopping), channel), 0);
}

// It drives Poiseuille flow along the channel, and no flow across it.
TEST(DissipationAlone, IsNotKnownIfAPressureGradientDrivesTheFluid) {
  const BoxDomain channel{{0, 0}, {1, 1}, {true, false}};
  SideVelocities sides;
  sides[3].value = {1, 0};
  for (auto fluid : {with_viscosity(1, sides), with_viscosity(1, LinearFlow{{0, 1, 0, 0}})}) {
    fluid.pressure_gradient = {0, -1};
    EXPECT_EQ(dissipation_alone(fluid, channel), 1);
    fluid.pressure_gradient = {-1, 0};
    EXPECT_EQ(dissipation_alone(fluid, channel), 0);
  }
}

TEST(DissipationAlone, IsZeroIfACylinderIsAtRest) {
  EXPECT_EQ(dissipation_alone(with_viscosity(1, LinearFlow{}), particles::CylinderDomain{1, 1}), 0);
}

}  // namespace
}  // namespace viscontact::freefem_flow
