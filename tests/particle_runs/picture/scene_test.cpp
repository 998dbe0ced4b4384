// The scene of a motion: its flows on one grid, motions on an axis, and the colours of the speed.
#include "viscontact/particle_runs/picture/scene.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/particle_runs/picture/playbacks.hpp"
#include "tests/report/flow/flows.hpp"
#include "viscontact/particle_runs/picture/particles_picture.hpp"

namespace viscontact::particles {
namespace {

/// The flows of all frames of a motion with two frames.
FlowFrames flows_of(const Playback& playback) {
  return scene_of(playback, {0, 1}, {0, 1}, 2000).flows;
}

TEST(Scene, HasTheExtentOfTheFirstFlowOrOfTheCell) {
  const TemporaryFolder folder;
  auto playback = disc_in_flow(folder, 2, report::turning);
  playback.frames[0].flow.clear();
  EXPECT_EQ(flows_of(playback).grid.window.left, 0);
  EXPECT_EQ(flows_of(playback).grid.window.right, 4);
  playback.cell = {{-1, 0}, {4, 0}};
  EXPECT_EQ(flows_of(playback).grid.window.left, -1);
  EXPECT_EQ(flows_of(playback).grid.window.right, 3);
  EXPECT_EQ(flows_of(playback).grid.window.top, 2);
  EXPECT_FALSE(scene_of(one_particle(), {0}, {0}, 100).is_in_fluid);
  // A solver without a mesh gives a flow without triangles.
  playback.frames[1].flow = folder.file("none.vtu", write_flow({}));
  EXPECT_FALSE(scene_of(playback, {0, 1}, {1}, 100).is_in_fluid);
}

TEST(Scene, OnAnAxisIsMirrored) {
  const TemporaryFolder folder;
  auto playback = disc_in_flow(folder, 1, report::turning);
  playback.dimension = 1;
  playback.frames[0].positions = {1};
  const auto scene = scene_of(playback, {0}, {0}, 100);
  EXPECT_LE(scene.box.low[0], -4);
  EXPECT_EQ(scene.flows.grid.window.left, 0);
  EXPECT_EQ(scene.flows.grid.window.right, 4);
}

TEST(Scene, PressureHasNoMeanOutsideTheParticles) {
  const TemporaryFolder folder;
  const auto playback = disc_in_flow(folder, 1, [](double x, double y) {
    // The triangles at the node (1, 1) are in the disc of radius 0.5, whose pressure must not
    // count.
    return std::array{0.0, 0.0, std::hypot(x - 1, y - 1) < 0.1 ? 1e6 : 7.0};
  });
  const auto flows = scene_of(playback, {0}, {0}, 2000).flows;
  ASSERT_EQ(flows.frames.size(), 1U);
  EXPECT_NEAR(flows.frames[0].pressure.front(), 0, 1e-6);
  EXPECT_LT(flows.pressure_colours.high, 10);
  EXPECT_EQ(flows.top_speed, 0);
  EXPECT_TRUE(flows.frames[0].lines.empty());
}

TEST(Scene, TakesKnownFlowsIfTheyAreOnTheSameGrid) {
  const TemporaryFolder folder;
  const auto playback = disc_in_flow(folder, 3, report::turning);
  auto known = scene_of(playback, {0, 1, 2}, {0, 1, 2}, 2000).flows;
  known.frames.at(1).speed.front() = 42;
  const auto first_speed = [&](std::size_t points) {
    return scene_of(playback, {0, 2}, {1}, points, known).flows.frames.at(0).speed.front();
  };
  EXPECT_EQ(first_speed(2000), 42);
  EXPECT_NE(first_speed(1000), 42);
  // The picture with the flows of the page is the picture without them.
  FlowFrames of_page;
  (void)particles_page(playback, "Turning", &of_page);
  EXPECT_EQ(of_page.frames.size(), 3U);
  EXPECT_EQ(particles_picture(playback, "Turning", 3, &of_page),
            particles_picture(playback, "Turning", 3));
}

TEST(Scene, TopSpeedIsThatOutsideTheParticles) {
  const TemporaryFolder folder;
  const auto flows = scene_of(disc_in_flow(folder, 3, report::turning), {0}, {0, 2}, 2000).flows;
  ASSERT_EQ(flows.frames.size(), 2U);
  EXPECT_EQ(flows.frames[1].frame, 2U);
  // The corners turn at sqrt(5); a few of the 2000 points are faster than the top of the scale.
  EXPECT_NEAR(flows.top_speed, std::sqrt(5.0), 0.1);
  EXPECT_FALSE(flows.frames[0].lines.empty());
}

TEST(Scene, SpheresOnAnAxisAreDiscsBetweenTwoWalls) {
  Playback playback;
  playback.dimension = 1;
  playback.radii = {1, 2};
  playback.frames.resize(1);
  playback.frames[0].positions = {3, 6};
  // Side, floor and lid of a cylinder, as domain.hpp has them.
  playback.frames[0].planes = {{.point = {0, -5, 0}, .normal = {0, 1, 0}},
                               {.point = {0, 0, 0}, .normal = {1, 0, 0}},
                               {.point = {10, 0, 0}, .normal = {-1, 0, 0}}};
  const auto plane = scene_of(playback, {0}, {}, 2).playback;
  EXPECT_EQ(plane.dimension, 2);
  EXPECT_THAT(plane.frames[0].positions, ::testing::ElementsAre(0, 3, 0, 6));
  const std::vector<PlanePosition> expected = {{.point = {-5, 0, 0}, .normal = {1, 0, 0}},
                                               {.point = {0, 0, 0}, .normal = {0, 1, 0}},
                                               {.point = {0, 10, 0}, .normal = {0, -1, 0}},
                                               {.point = {5, 0, 0}, .normal = {-1, 0, 0}}};
  EXPECT_EQ(plane.frames[0].planes, expected);
}

TEST(ShownFlows, AreAtMostSoManyAndIncludeTheFirstAndTheLast) {
  Playback playback;
  playback.frames.resize(1000);
  for (std::size_t f = 0; f < 999; ++f) playback.frames[f].flow = "flow.vtu";
  const auto shown = shown_flows(playback);
  EXPECT_EQ(shown.frames.front(), 0U);
  EXPECT_EQ(shown.frames.back(), 998U);
  EXPECT_LE(2 * shown.frames.size() * shown.points, kFlowBytesOfPage);
  EXPECT_GE(shown.points, 10000U);
  EXPECT_TRUE(shown_flows(one_particle()).frames.empty());
}

TEST(SpeedColours, DarkenEvenly) {
  const auto green = [](double share) {
    return std::stoi(report::speed_colour(share).substr(3, 2), nullptr, 16);
  };
  EXPECT_EQ(report::speed_colour(0), "#f3fcfd");
  for (int i = 0; i < 10; ++i) EXPECT_GT(green(i / 10.0), green((i + 1) / 10.0));
  const auto ticks = report::speed_scale(0.137, 2).ticks;
  EXPECT_EQ(ticks.front().second, "0");
  EXPECT_EQ(ticks.back().second, "0.1");
  // A fluid at rest.
  EXPECT_EQ(report::speed_scale(0, 2).ticks.size(), 1U);
}

}  // namespace
}  // namespace viscontact::particles
