#include "viscontact/reduced_model/external_force/external_force.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact::reduced_model {
namespace {

using ::testing::AllOf;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
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
  bad_input([] { ExternalForce({}); });
}

TEST(ExternalForce, RefusesPiecesWhoseTimesDoNotIncreaseFromZero) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<ExternalForce::Piece>> wrong = {
      {{0, 1}},          {{-1, 1}},         {{nan, 1}},
      {{2, 1}, {2, -1}}, {{2, 1}, {1, -1}}, {{1, 1}, {2, 1}, {nan, 1}}};
  for (const auto& pieces : wrong)
    EXPECT_THAT(bad_input([&] { ExternalForce{pieces}; }), Names("until"));
}

/// 1 + 2 t until 1, then 4 - (t - 1)^2, and 3 sin(2 t + 0.5) on top.
ExternalForce mixed() {
  ExternalForce force({{1, 1, {2}}, {4, 4, {0, -1}}});
  force += ExternalForce::sinusoidal({3, 2, 0.5});
  return force;
}

TEST(ExternalForceSum, HasTheValuesSlopesAndIntegralsOfItsParts) {
  const auto force = mixed();
  // A few roundings of numbers up to 10.
  constexpr double kRoundOff = 1e-14;
  for (const double t : {0.0, 0.3, 0.999, 1.0, 1.7, 3.9}) {
    const double wave = 2 * t + 0.5;
    const double tau = t - 1;
    const bool first = t < 1;
    EXPECT_NEAR(force.value(t), (first ? 1 + 2 * t : 4 - tau * tau) + 3 * std::sin(wave), kRoundOff)
        << t;
    EXPECT_NEAR(force.slope(t), (first ? 2 : -2 * tau) + 6 * std::cos(wave), kRoundOff) << t;
    EXPECT_NEAR(force.impulse(t),
                (first ? t + t * t : 2 + 4 * tau - tau * tau * tau / 3) +
                    1.5 * (std::cos(0.5) - std::cos(wave)),
                kRoundOff)
        << t;
    EXPECT_NEAR(force.impulse_integral(t),
                (first ? t * t / 2 + t * t * t / 3
                       : 5.0 / 6 + 2 * tau + 2 * tau * tau - std::pow(tau, 4) / 12) +
                    1.5 * t * std::cos(0.5) - 0.75 * (std::sin(wave) - std::sin(0.5)),
                kRoundOff)
        << t;
  }
}

TEST(ExternalForceSum, MeansAreImpulsesOverTimeAlsoOverShortIntervals) {
  const auto force = mixed();
  for (const auto& [from, to] :
       {std::pair(0.0, 4.0), std::pair(0.5, 1.5), std::pair(1.0, 1.25), std::pair(2.0, 3.5)})
    EXPECT_NEAR(force.mean(from, to), (force.impulse(to) - force.impulse(from)) / (to - from),
                1e-14);
  // As a quotient of differences of impulses this would keep 6 digits.
  EXPECT_NEAR(force.mean(2, 2 + 1e-10), force.value(2 + 5e-11), 1e-14);
  EXPECT_NEAR(force.mean(0.5, 0.5 + 1e-10), force.value(0.5 + 5e-11), 1e-14);
}

TEST(ExternalForceSum, DoesNotDependOnTheOrderOfItsParts) {
  ExternalForce one({{0.5, -3}, {2, 5, {1, 0.5}}});
  one += ExternalForce({{1.25, 7}, {4, 0, {0, 0, 2}}});
  ExternalForce other({{1.25, 7}, {4, 0, {0, 0, 2}}});
  other += ExternalForce({{0.5, -3}, {2, 5, {1, 0.5}}});
  for (double t = 0; t < 5; t += 0.125) {
    // Dyadic numbers: what is exact in both orders is equal.
    EXPECT_EQ(one.value(t), other.value(t)) << t;
    EXPECT_NEAR(one.impulse(t), other.impulse(t), 1e-13 * (1 + std::abs(one.impulse(t)))) << t;
  }
  EXPECT_THAT(one.jumps(), ElementsAre(0.5, 1.25));
}

TEST(ExternalForceSum, JumpsWhereItsSlopeDoes) {
  EXPECT_THAT(ExternalForce({{1, 0, {1}}, {2, 1, {-1}}, {3, 0, {-1}}, {4, -2}}).jumps(),
              ElementsAre(1, 3));
}

TEST(ExternalForceSum, ChangesItsSignByJumpsAndThroughZero) {
  const double pi = std::acos(-1.0);
  const auto sine = ExternalForce::sinusoidal({2, 1, 0});
  const auto changes = sine.sign_changes(10);
  ASSERT_EQ(changes.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(changes[i], pi * static_cast<double>(i + 1), 4e-15);
  EXPECT_THAT(ExternalForce({{1, -1, {2}}, {2, -1}, {3, 0}, {4, -2}, {5, 3}}).sign_changes(5),
              ElementsAre(DoubleEq(0.5), 1, 4));
  EXPECT_THAT(ExternalForce({{1, -1}, {2, 0}, {3, -1}}).sign_changes(3), IsEmpty());
  // 0 at the beginning of a piece, and at an extremum inside one
  EXPECT_THAT(ExternalForce({{1, 1, {-1}}, {2, 0, {-1}}}).sign_changes(2), ElementsAre(1));
  EXPECT_THAT(ExternalForce({{1, 0, {1, -1}}, {2, 0, {-1}}}).sign_changes(2), ElementsAre(1));
  EXPECT_THAT(ExternalForce({{2, 1, {-2, 1}}}).sign_changes(2), IsEmpty());
}

TEST(ExternalForceSum, IsDrawnOutInTime) {
  const auto force = mixed();
  const auto slow = force.stretched(3);
  for (const double t : {0.0, 0.4, 1.0, 2.5}) {
    EXPECT_NEAR(slow.value(3 * t), force.value(t), 1e-14);
    EXPECT_NEAR(slow.impulse(3 * t), 3 * force.impulse(t), 1e-13);
  }
}

TEST(ExternalForceSum, RefusesASinusoidWithoutFrequency) {
  EXPECT_THAT(bad_input([] { ExternalForce::sinusoidal({1, 0, 0}); }), Names("angular_frequency"));
}

class ForceFile : public ::testing::Test {
 protected:
  ExternalForce read(const std::string& text, double end) {
    write_file(path_, text);
    return read_external_force(path_, end);
  }
  Error refusal(const std::string& text, double end = 1) {
    return bad_input([&] { read(text, end); });
  }
  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "force.csv";
};

TEST_F(ForceFile, IsLinearBetweenItsRowsAndJumpsWhereATimeIsTwice) {
  const auto force = read("# from a rig\ntime,force\n0,1\n1,3\n1,-2\n3,-4\n", 2.5);
  EXPECT_EQ(force.value(0.5), 2);
  EXPECT_EQ(force.value(1), -2);
  EXPECT_EQ(force.value(2), -3);
  EXPECT_EQ(force.impulse(3), 2 - 6);
  EXPECT_THAT(force.jumps(), ElementsAre(1));
}

TEST_F(ForceFile, IsRefusedWithItsLine) {
  EXPECT_THAT(refusal("time,force\n0.5,1\n2,1\n"), AllOf(IsAt("force.csv:2"), Names("0.5")));
  EXPECT_THAT(refusal("time,force\n0,1\n2,1\n1,1\n"),
              AllOf(IsAt("force.csv:4", "time"), Names("2")));
  EXPECT_THAT(refusal("time,force\n0,1\n1,1\n1,2\n1,3\n"), IsAt("force.csv:5"));
  EXPECT_THAT(refusal("time,force\n0,1\n1,nan\n"), IsAt("force.csv:3", "force"));
  EXPECT_THAT(refusal("time,push\n0,1\n"), IsAt("force.csv", "force"));
  EXPECT_THAT(refusal("time,force\n0,1\n0.5,1\n"), AllOf(IsAt("force.csv"), Names("0.5")));
  EXPECT_THAT(refusal("time,force\n"), IsAt("force.csv"));
}

}  // namespace
}  // namespace viscontact::reduced_model
