#include "reduced_model/external_force.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/common/failure.hpp"

namespace viscontact {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// All numbers here are dyadic, so what is computed by hand must come out to the bit.
ExternalForce three_pieces() { return ExternalForce({{0.5, -3}, {2, 5}, {3, 0.25}}); }

TEST(ExternalForce, HasTheValueAfterTheJumpAtAJump) {
  const auto force = three_pieces();
  EXPECT_EQ(force.value(0), -3);
  EXPECT_EQ(force.value(std::nextafter(0.5, 0.0)), -3);
  EXPECT_EQ(force.value(0.5), 5);
  EXPECT_EQ(force.value(1), 5);
  EXPECT_EQ(force.value(2), 0.25);
}

TEST(ExternalForce, GoesOnForEverWithItsLastPiece) {
  const auto force = three_pieces();
  EXPECT_EQ(force.value(3), 0.25);
  EXPECT_EQ(force.value(1000), 0.25);
  EXPECT_EQ(force.impulse(7), -1.5 + 7.5 + 0.25 * 5);
}

TEST(ExternalForce, IntegratesExactly) {
  const auto force = three_pieces();
  EXPECT_EQ(force.impulse(0), 0);
  EXPECT_EQ(force.impulse(0.25), -0.75);
  EXPECT_EQ(force.impulse(0.5), -1.5);
  EXPECT_EQ(force.impulse(1), 1);
  EXPECT_EQ(force.impulse(2), 6);
  EXPECT_EQ(force.impulse(3), 6.25);
}

TEST(ExternalForce, MeanOverAnIntervalWithinAPieceIsItsValue) {
  EXPECT_EQ(three_pieces().mean(0.75, 1.5), 5);
  EXPECT_EQ(three_pieces().mean(4, 8), 0.25);
}

TEST(ExternalForce, MeanAcrossJumpsWeighsThePiecesByTime) {
  EXPECT_EQ(three_pieces().mean(0.25, 0.75), 1);
  EXPECT_EQ(three_pieces().mean(0, 4), (-1.5 + 7.5 + 0.5) / 4);
}

TEST(ExternalForce, JumpsOnlyWhereTheValueChanges) {
  EXPECT_THAT(three_pieces().jumps(), ElementsAre(0.5, 2));
  EXPECT_THAT(ExternalForce({{1, -2}, {2, -2}, {3, 4}, {4, 4}}).jumps(), ElementsAre(2));
  EXPECT_THAT(ExternalForce({{4, -2}}).jumps(), IsEmpty());
}

TEST(ExternalForce, RefusesToHaveNoPiece) {
  EXPECT_THAT(bad_input([] { ExternalForce({}); }), HasSubstr("at least one"));
}

TEST(ExternalForce, RefusesPiecesWhoseTimesDoNotIncreaseFromZero) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<ExternalForce::Piece>> wrong = {
      {{0, 1}},          {{-1, 1}},         {{nan, 1}},
      {{2, 1}, {2, -1}}, {{2, 1}, {1, -1}}, {{1, 1}, {2, 1}, {nan, 1}}};
  for (const auto& pieces : wrong)
    EXPECT_THAT(bad_input([&] { ExternalForce{pieces}; }), HasSubstr("until"));
}

}  // namespace
}  // namespace viscontact
