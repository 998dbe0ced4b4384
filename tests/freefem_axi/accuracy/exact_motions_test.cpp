// Forces and torques of the motions across the axis and around it, by FreeFEM, beside exact ones.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/common/failure.hpp"
#include "tests/freefem_axi/tabulations.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/freefem_axi/motion_row.hpp"

namespace viscontact::freefem_axi {
namespace {

using lubrication::MotionKind;
using ::testing::ElementsAre;

Tabulation in_unbounded_fluid(const std::string& geometry, std::vector<double> parameters,
                              double accuracy) {
  Tabulation tabulation = unit_tabulation({1}, 1, accuracy);
  tabulation.container.reset();
  tabulation.geometry = geometry;
  tabulation.geometry_parameters = std::move(parameters);
  return tabulation;
}

/// The exact factors above a plane, from data/reference/sphere_plane_modes.csv, whose head says
/// where they are from.
struct ExactFactors {
  double gap, slide_force, slide_torque, roll_force, roll_torque, spin_torque;
};

std::vector<ExactFactors> exact_factors() {
  const std::array<std::string, 6> columns = {"gap_over_r", "F_t", "T_t", "F_r", "T_r", "T_n"};
  std::vector<ExactFactors> rows;
  for (const auto& row :
       read_csv(std::string(VISCONTACT_SOURCE_FOLDER) + "/data/reference/sphere_plane_modes.csv",
                columns, columns.size())
           .rows)
    rows.push_back({*row.fields[0], *row.fields[1], *row.fields[2], *row.fields[3], *row.fields[4],
                    *row.fields[5]});
  return rows;
}

void expect_factor(double factor, double exact, double diagonal, double estimate, double accuracy) {
  EXPECT_LE(std::abs(factor - exact) / diagonal, estimate);
  EXPECT_LE(estimate, accuracy);
}

TEST(MotionsAboveAPlane, AreWithinTheirEstimatesAndTheAccuracyThatWasAsked) {
  constexpr double kAccuracy = 1e-5;
  const auto plane = in_unbounded_fluid("plane", {}, kAccuracy);
  const auto rows = exact_factors();
  ASSERT_EQ(rows.size(), 5U);
  for (const auto& exact : {rows[0], rows[4]}) {
    SCOPED_TRACE(exact.gap);
    const auto across = solve_motions(default_freefem(), plane, MotionGroup::kAcross, exact.gap);
    const auto& slide = across.at(0);
    const auto& roll = across.at(1);
    // T_y = +8 pi mu r^2 U T_t and F_x = +6 pi mu r^2 w F_r.
    expect_factor(slide.force_factor, exact.slide_force, exact.slide_force,
                  slide.relative_error_estimate, kAccuracy);
    expect_factor(slide.torque_factor, -exact.slide_torque, exact.slide_force,
                  slide.torque_error_estimate, kAccuracy);
    expect_factor(roll.force_factor, -exact.roll_force, exact.roll_torque,
                  roll.relative_error_estimate, kAccuracy);
    expect_factor(roll.torque_factor, exact.roll_torque, exact.roll_torque,
                  roll.torque_error_estimate, kAccuracy);
    const auto around = solve_motions(default_freefem(), plane, MotionGroup::kAround, exact.gap);
    const auto& spin = around.at(0);
    EXPECT_EQ(spin.force_factor, 0);
    expect_factor(spin.torque_factor, exact.spin_torque, exact.spin_torque,
                  spin.torque_error_estimate, kAccuracy);
  }
}

TEST(MotionsInACavity, AreThoseOfConcentricSpheres) {
  constexpr double kRadius = 2.5, kAccuracy = 1e-5;
  const auto cavity = in_unbounded_fluid("cavity", {kRadius}, kAccuracy);
  const double gap = kRadius - 1;
  const auto across = solve_motions(default_freefem(), cavity, MotionGroup::kAcross, gap);
  const auto around = solve_motions(default_freefem(), cavity, MotionGroup::kAround, gap);
  // Haberman & Sayre 1958; Happel & Brenner 1983, (4-22.11).
  const double l = 1 / kRadius;
  const double drag = (1 - std::pow(l, 5)) / (1 - 9. / 4 * l + 5. / 2 * std::pow(l, 3) -
                                              9. / 4 * std::pow(l, 5) + std::pow(l, 6));
  const double torque = 1 / (1 - std::pow(l, 3));
  EXPECT_NEAR(across.at(0).force_factor / drag, 1, kAccuracy);
  EXPECT_NEAR(across.at(1).torque_factor / torque, 1, kAccuracy);
  EXPECT_NEAR(around.at(0).torque_factor / torque, 1, kAccuracy);
  EXPECT_NEAR(across.at(0).torque_factor, 0, 1e-6);
}

TEST(MotionsOfAPair, AreThoseBesideAFreeSurfaceIfTheFlowIsSymmetric) {
  constexpr double kAccuracy = 1e-3;
  // The free surface is the plane of symmetry of two spheres, whose gap is twice as large. Mirror
  // images move alike along it, turn against each other about axes in it, and alike about its
  // normal.
  auto surface = in_unbounded_fluid("free_surface", {}, kAccuracy);
  auto mirrored = in_unbounded_fluid("sphere", {1, 1, -1}, kAccuracy);
  auto spinning = in_unbounded_fluid("sphere", {1, 0, 1}, kAccuracy);
  surface.container = Container{4, 5};  // fewer elements than unbounded fluid
  mirrored.container = spinning.container = Container{4, 10};
  const auto one = solve_motions(default_freefem(), surface, MotionGroup::kAcross, 0.2);
  const auto pair = solve_motions(default_freefem(), mirrored, MotionGroup::kAcross, 0.4);
  for (std::size_t motion : {0, 1}) {
    const auto& both = pair.at(motion);
    const auto& alone = one.at(motion);
    EXPECT_NEAR(both.force_factor, alone.force_factor, 2 * kAccuracy);
    EXPECT_NEAR(both.torque_factor, alone.torque_factor, 2 * kAccuracy);
    ASSERT_TRUE(both.neighbour);
    EXPECT_NEAR(both.neighbour->force_factor, both.force_factor, 2 * kAccuracy);
    EXPECT_NEAR(both.neighbour->torque_factor, -both.torque_factor, 2 * kAccuracy);
  }
  EXPECT_NEAR(
      solve_motions(default_freefem(), spinning, MotionGroup::kAround, 0.4).at(0).torque_factor,
      solve_motions(default_freefem(), surface, MotionGroup::kAround, 0.2).at(0).torque_factor,
      2 * kAccuracy);
}

TEST(MotionsOfAPair, AreThoseOfARigidBodyIfItTurnsAsAWhole) {
  // Two spheres that turn about the axis as one body have no flow between them. Each has nearly its
  // torque alone, 1 and 2^3, less what the other one's flow takes off.
  const auto alike = in_unbounded_fluid("sphere", {2, 0, 1}, 1e-4);
  const auto row = solve_motions(default_freefem(), alike, MotionGroup::kAround, 0.01);
  EXPECT_LT(row.at(0).torque_factor, 1);
  EXPECT_LT(row.at(0).neighbour->torque_factor, 8);
  EXPECT_GT(row.at(0).neighbour->torque_factor, 7);
}

TEST(MotionsOfAPair, AddUpFromThoseOfEachSphere) {
  constexpr double kGap = 0.3, kMoves = 0.7, kTurns = -1.3;
  const auto solved = [](double moves, double turns) {
    auto pair = in_unbounded_fluid("sphere", {2, moves, turns}, 1e-2);
    pair.container = Container{4, 10};  // fewer elements than unbounded fluid
    return solve_motions(default_freefem(), pair, MotionGroup::kAcross, kGap);
  };
  const auto alone = solved(0, 0), both = solved(1, 1), any = solved(kMoves, kTurns);
  for (std::size_t motion : {0, 1}) {
    const double ratio = motion == 0 ? kMoves : kTurns;
    const auto expect_sum = [&](auto entry) {
      const double one = entry(alone.at(motion)), sum = entry(both.at(motion));
      // The meshes are the same, so only the round-off of the solves is left.
      EXPECT_NEAR(entry(any.at(motion)), one + ratio * (sum - one), 1e-9 * std::abs(sum));
    };
    expect_sum([](const lubrication::MotionRow& row) { return row.force_factor; });
    expect_sum([](const lubrication::MotionRow& row) { return row.torque_factor; });
    expect_sum([](const lubrication::MotionRow& row) { return row.neighbour->force_factor; });
    expect_sum([](const lubrication::MotionRow& row) { return row.neighbour->torque_factor; });
  }
}

TEST(Motions, OfAGeometry) {
  EXPECT_THAT(
      parse_motions({"all"}, "plane"),
      ElementsAre(MotionKind::kApproach, MotionKind::kSlide, MotionKind::kRoll, MotionKind::kSpin,
                  MotionKind::kAxialStrain, MotionKind::kShearStrain, MotionKind::kTwofoldStrain));
  EXPECT_THAT(parse_motions({"all"}, "rough_plane"),
              ElementsAre(MotionKind::kApproach, MotionKind::kSpin));
  EXPECT_THAT(parse_motions({"spin", "approach"}, "cavity"),
              ElementsAre(MotionKind::kApproach, MotionKind::kSpin));
  EXPECT_THAT(bad_input([] { (void)parse_motions({"slide"}, "rough_plane"); }),
              Names("rough_plane", "approach", "spin"));
  EXPECT_THAT(bad_input([] { (void)parse_motions({"glide"}, "plane"); }),
              Names("approach", "slide", "roll", "spin"));
  EXPECT_THAT(bad_input([] { (void)parse_motions({"roll", "roll"}, "plane"); }), Names("roll"));
}

}  // namespace
}  // namespace viscontact::freefem_axi
