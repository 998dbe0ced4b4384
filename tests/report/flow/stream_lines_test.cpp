// Streamlines of flows whose stream function is known.
#include "viscontact/report/flow/stream_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "tests/report/flow/flows.hpp"

namespace viscontact::report {
namespace {

FlowOnGrid flow_at(const Grid& grid, const std::function<bool(double, double)>& is_fluid,
                   const FlowAt& at) {
  FlowOnGrid flow;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double x = grid.x(i % grid.columns), y = grid.y(i / grid.columns);
    const auto [u, v, p] = is_fluid(x, y) ? at(x, y) : std::array<double, 3>{NAN, NAN, NAN};
    flow.velocity_x.push_back(u);
    flow.velocity_y.push_back(v);
    flow.pressure.push_back(p);
  }
  return flow;
}

constexpr auto kEverywhere = [](double, double) { return true; };

std::vector<char> no_bodies(const Grid& grid) { return std::vector<char>(grid.size(), 0); }

TEST(StreamLines, OfARotationAreCircles) {
  const Grid grid{{-1, 1, -1, 1}, 101, 101};
  // A hole with fluid on all sides must not bend them.
  const auto flow = flow_at(
      grid, [](double x, double y) { return std::hypot(x, y) > 0.2; },
      [](double x, double y) {
        return std::array{-y, x, 0.0};
      });
  const auto lines = StreamLines(grid, false).of(flow, no_bodies(grid), 12).lines;
  ASSERT_GE(lines.size(), 12U);
  for (const auto& line : lines) {
    const auto& [x0, y0] = line.points.front();
    const double radius = std::hypot(x0, y0);
    for (const auto& [x, y] : line.points)
      // A tenth of a step of the grid is left out when lines are simplified.
      EXPECT_NEAR(std::hypot(x, y), radius, 0.2 * grid.step_x());
    if (line.arrow <= 0) continue;
    const auto at = static_cast<std::size_t>(line.arrow);
    const auto& [x, y] = line.points[at];
    const auto& [before_x, before_y] = line.points[at - 1];
    EXPECT_GT(before_x * y - before_y * x, 0) << "the arrow points against the flow";
  }
  EXPECT_TRUE(std::ranges::any_of(lines, [](const auto& line) { return line.arrow > 0; }));
}

// In a uniform flow along an axis the same amount flows through rings of equal area, so that the
// squares of the distances of the lines from the axis are evenly spaced.
TEST(StreamLines, AlongAnAxisEncloseEqualFlows) {
  const Grid grid{{0, 1, 0, 1}, 101, 101};
  const auto flow = flow_at(grid, kEverywhere, [](double, double) {
    return std::array{0.0, -2.0, 0.0};
  });
  const auto lines = StreamLines(grid, true).of(flow, no_bodies(grid), 4).lines;
  ASSERT_EQ(lines.size(), 4U);
  std::set<double> squares;
  for (const auto& line : lines) {
    squares.insert(line.points.front().first * line.points.front().first);
    EXPECT_NEAR(line.points.front().second, 1, 1e-9);  // downwards, with the flow
    EXPECT_NEAR(line.points.back().second, 0, 1e-9);
  }
  double expected = 0.125;
  for (const double square : squares) {
    EXPECT_NEAR(square, expected, 1e-3);  // linear interpolation between points 0.01 apart
    expected += 0.25;
  }
}

TEST(StreamLines, HaveArrowsOutsideTheParticlesAndApart) {
  const Grid grid{{0, 1, 0, 1}, 51, 51};
  const auto flow = flow_at(grid, kEverywhere, [](double, double) {
    return std::array{1.0, 0.0, 0.0};
  });
  auto is_body = no_bodies(grid);
  const auto in_body = [](double x) { return x > 0.3 && x < 0.7; };
  for (std::size_t i = 0; i < grid.size(); ++i) is_body[i] = in_body(grid.x(i % 51)) ? 1 : 0;
  Polyline arrows;
  for (const auto& line : StreamLines(grid, false).of(flow, is_body, 20).lines)
    if (line.arrow > 0) arrows.push_back(line.points[static_cast<std::size_t>(line.arrow)]);
  ASSERT_GE(arrows.size(), 4U);
  for (std::size_t i = 0; i < arrows.size(); ++i) {
    EXPECT_FALSE(in_body(arrows[i].first)) << arrows[i].first;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE(std::hypot(arrows[i].first - arrows[j].first, arrows[i].second - arrows[j].second),
                0.13);
  }
}

// The factor of an earlier flow may be used only if the fluid is nearly where it was.
TEST(StreamLines, DoNotDependOnTheFlowBefore) {
  const Grid grid{{-1, 1, -1, 1}, 61, 61};
  const auto at = [](double x, double y) { return std::array{-y, x, 0.0}; };
  const auto left = flow_at(
      grid, [](double x, double) { return x < 0.5; }, at);
  const auto right = flow_at(
      grid, [](double x, double) { return x > -0.5; }, at);
  StreamLines both(grid, false);
  both.of(left, no_bodies(grid), 8).lines;
  const auto again = both.of(right, no_bodies(grid), 8).lines;
  const auto alone = StreamLines(grid, false).of(right, no_bodies(grid), 8).lines;
  ASSERT_EQ(again.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(again[i].points, alone[i].points);
}

TEST(StreamLines, AreNoneIfNothingMoves) {
  const Grid grid{{0, 1, 0, 1}, 11, 11};
  const auto flow = flow_at(grid, kEverywhere, [](double, double) {
    return std::array{0.0, 0.0, 1.0};
  });
  EXPECT_TRUE(StreamLines(grid, false).of(flow, no_bodies(grid), 8).lines.empty());
}

}  // namespace
}  // namespace viscontact::report
