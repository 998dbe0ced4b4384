// The least squares for psi have an equation for each two neighbouring points. That of two points
// that are not both in the fluid has a small weight, so that the matrix is never singular.
#include "viscontact/report/flow/stream_lines.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace viscontact::report {
namespace {

using Index = std::uint32_t;

/// Free choices of the lines and their arrows.
struct StreamLineTuning {
  // Least length of a line with an arrow and distance of arrows, over the longer side of the
  // window.
  static constexpr double kShort = 0.12, kApart = 0.14;
  // Shares of the points at which an arrow is tried and the directions of line and flow compared.
  static constexpr std::array<double, 9> kPlaces = {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9};
  // Distance of points that are left out from the line, over a step of the grid.
  static constexpr double kTolerance = 0.1;
  // Weight of the equation between two neighbouring points that are not both in the fluid.
  static constexpr double kOutside = 1e-5;
  // Largest share of points that may have left or entered the fluid without a new factorisation.
  static constexpr double kNearly = 0.005;
};

/// A key for a pair of points, which does not depend on their order.
std::uint64_t pair_key(Index a, Index b) {
  constexpr int kHalf = 32;
  return (static_cast<std::uint64_t>(std::min(a, b)) << kHalf) | std::max(a, b);
}

/// Distance [L] of the point p from the straight line through a and b, or from a if a equals b.
double distance(const Polyline::value_type& p, const Polyline::value_type& a,
                const Polyline::value_type& b) {
  const double x = b.first - a.first, y = b.second - a.second, length = std::hypot(x, y);
  const double px = p.first - a.first, py = p.second - a.second;
  return length > 0 ? std::abs(x * py - y * px) / length : std::hypot(px, py);
}

/// The line with fewer points. Each point that is left out is at most `tolerance` [L] away from the
/// straight line through the neighbouring points that are kept (Douglas & Peucker 1973).
Polyline simplified(const Polyline& line, double tolerance) {
  if (line.size() < 3) return line;
  std::vector<char> is_kept(line.size(), 0);
  is_kept.front() = is_kept.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> parts = {{0, line.size() - 1}};
  while (!parts.empty()) {
    const auto [first, last] = parts.back();
    parts.pop_back();
    double farthest = 0;
    std::size_t at = first;
    for (auto i = first + 1; i < last; ++i)
      if (const double far = distance(line[i], line[first], line[last]); far > farthest) {
        farthest = far;
        at = i;
      }
    if (!(farthest > tolerance)) continue;
    is_kept[at] = 1;
    parts.insert(parts.end(), {{first, at}, {at, last}});
  }
  Polyline kept;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (is_kept[i] != 0) kept.push_back(line[i]);
  return kept;
}

/// The field has two triangles for each cell of the grid whose four corners have numbers as values.
LinearField field_on(const Grid& grid, const std::vector<double>& values) {
  LinearField field;
  field.values = values;
  for (std::size_t row = 0; row < grid.rows; ++row)
    for (std::size_t column = 0; column < grid.columns; ++column)
      field.points.push_back({grid.x(column), grid.y(row)});
  for (std::size_t row = 0; row + 1 < grid.rows; ++row)
    for (std::size_t column = 0; column + 1 < grid.columns; ++column) {
      const auto a = static_cast<Index>(row * grid.columns + column), b = a + 1;
      const auto c = static_cast<Index>(a + grid.columns), d = c + 1;
      if (std::isnan(values[a] + values[b] + values[c] + values[d])) continue;
      field.triangles.push_back({a, b, d});
      field.triangles.push_back({a, d, c});
    }
  return field;
}

std::size_t nearest_point(const Grid& grid, const Polyline::value_type& place) {
  const auto nearest = [](double steps, std::size_t count) {
    return static_cast<std::size_t>(
        std::clamp(std::round(steps), 0.0, static_cast<double>(count - 1)));
  };
  return nearest((place.second - grid.window.bottom) / grid.step_y(), grid.rows) * grid.columns +
         nearest((place.first - grid.window.left) / grid.step_x(), grid.columns);
}

double length_of(const Polyline& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i)
    length += std::hypot(line[i].first - line[i - 1].first, line[i].second - line[i - 1].second);
  return length;
}

/// The line, which has at least two points, in the direction of the flow, simplified, and with an
/// arrow. The line gets no arrow if it is short, or if each place that is tried is in a particle
/// (is_body is 1) or near one of `arrows`, those of other lines, to which the new place is added.
StreamLine directed(Polyline line, const Grid& grid, const FlowOnGrid& flow,
                    const std::vector<char>& is_body, Polyline& arrows) {
  assert(line.size() >= 2);
  const auto at = [&](double share) {
    return static_cast<std::size_t>(share * static_cast<double>(line.size() - 1));
  };
  double along = 0;
  for (const double share : StreamLineTuning::kPlaces) {
    const auto i = std::min(at(share), line.size() - 2);
    const auto point = nearest_point(grid, line[i]);
    const double u = flow.velocity_x[point], v = flow.velocity_y[point];
    if (std::isfinite(u) && std::isfinite(v))
      along += u * (line[i + 1].first - line[i].first) + v * (line[i + 1].second - line[i].second);
  }
  if (along < 0) std::ranges::reverse(line);
  StreamLine result;
  const double larger = std::max(grid.window.width(), grid.window.height());
  std::size_t arrow = 0;
  const auto is_free = [&](const Polyline::value_type& place) {
    return is_body[nearest_point(grid, place)] == 0 &&
           std::ranges::none_of(arrows, [&](const auto& other) {
             return std::hypot(place.first - other.first, place.second - other.second) <
                    StreamLineTuning::kApart * larger;
           });
  };
  if (length_of(line) > StreamLineTuning::kShort * larger)
    for (const double share : StreamLineTuning::kPlaces)
      if (const auto i = at(share); i > 0 && is_free(line[i])) {
        arrow = i;
        arrows.push_back(line[i]);
        break;
      }
  // The parts before and after the arrow are simplified separately, so that the arrow stays at a
  // point of the line.
  const double tolerance =
      StreamLineTuning::kTolerance * std::min(grid.step_x(), grid.step_y());  // [L]
  const auto middle = line.begin() + static_cast<std::ptrdiff_t>(arrow);
  result.points = simplified({line.begin(), middle + 1}, tolerance);
  if (arrow > 0) result.arrow = static_cast<int>(result.points.size()) - 1;
  const auto rest = simplified({middle, line.end()}, tolerance);
  result.points.insert(result.points.end(), rest.begin() + 1, rest.end());
  return result;
}

}  // namespace

std::vector<Polyline> level_lines(const LinearField& field, double level) {
  assert(field.values.size() == field.points.size());
  // The points of a level line are its crossings with sides of triangles. Each crossing has at most
  // two neighbours on the line, one in each triangle at the side.
  struct Crossing {
    std::pair<double, double> point;
    std::array<std::uint64_t, 2> next{};
    int neighbours = 0;
    bool drawn = false;
  };
  std::unordered_map<std::uint64_t, Crossing> crossings;
  const auto above = [&](Index i) { return field.values[i] >= level; };
  for (const auto& triangle : field.triangles) {
    const bool first = above(triangle[0]);
    if (above(triangle[1]) == first && above(triangle[2]) == first) continue;
    std::array<std::uint64_t, 2> keys{};
    std::size_t found = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = std::min(triangle[i], triangle[(i + 1) % 3]);
      const Index b = std::max(triangle[i], triangle[(i + 1) % 3]);
      if (above(a) == above(b)) continue;
      const double w = (level - field.values[a]) / (field.values[b] - field.values[a]);
      const auto key = pair_key(a, b);
      crossings[key].point = {std::lerp(field.points[a][0], field.points[b][0], w),
                              std::lerp(field.points[a][1], field.points[b][1], w)};
      keys[found++] = key;
    }
    if (found != 2) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      auto& crossing = crossings[keys[i]];
      if (crossing.neighbours < 2)
        crossing.next[static_cast<std::size_t>(crossing.neighbours++)] = keys[1 - i];
    }
  }
  std::vector<Polyline> lines;
  const auto follow = [&](std::uint64_t key) {
    Polyline line;
    for (bool more = true; more;) {
      auto& crossing = crossings.at(key);
      crossing.drawn = true;
      line.push_back(crossing.point);
      more = false;
      for (int i = 0; i < crossing.neighbours && !more; ++i)
        if (const auto next = crossing.next[static_cast<std::size_t>(i)];
            !crossings.at(next).drawn) {
          key = next;
          more = true;
        }
    }
    return line;
  };
  for (auto& [key, crossing] : crossings)
    if (!crossing.drawn && crossing.neighbours == 1) lines.push_back(follow(key));
  for (auto& [key, crossing] : crossings)  // the remaining lines are closed
    if (!crossing.drawn) {
      lines.push_back(follow(key));
      lines.back().push_back(lines.back().front());
    }
  return lines;
}

/// The factor of the normal equations for psi, and the points (1: in the fluid) for which it was
/// computed.
struct StreamLines::Equations {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
  std::vector<char> is_fluid;
  bool is_analysed = false;

  /// Weight [1] of the equation between two neighbouring points.
  static double weight(bool both_in_fluid) {
    return both_in_fluid ? 1 : StreamLineTuning::kOutside;
  }

  /// Factorises the matrix for these points, unless it was factorised before for nearly the same.
  void prepare(const Grid& grid, std::vector<char> points) {
    if (is_fluid.size() == points.size()) {
      std::size_t different = 0;
      for (std::size_t i = 0; i < points.size(); ++i) different += points[i] != is_fluid[i] ? 1 : 0;
      if (static_cast<double>(different) <=
          StreamLineTuning::kNearly * static_cast<double>(points.size()))
        return;
    }
    is_fluid = std::move(points);
    using Entry = Eigen::Triplet<double>;
    std::vector<Entry> entries;
    entries.emplace_back(0, 0, 1);  // fixes psi, which is determined up to a constant only
    for_each_side(grid, [&](std::size_t a, std::size_t b, bool) {
      const double w = weight(is_fluid[a] != 0 && is_fluid[b] != 0);
      const auto i = static_cast<int>(a), j = static_cast<int>(b);
      entries.insert(entries.end(), {{i, i, w}, {j, j, w}, {i, j, -w}, {j, i, -w}});
    });
    const auto size = static_cast<Eigen::Index>(grid.size());
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (!is_analysed) factor.analyzePattern(matrix);
    is_analysed = true;
    factor.factorize(matrix);
  }

  /// Calls visit(a, b, is_horizontal) for the indices of each two neighbours in a row or a column.
  template <class Visit>
  static void for_each_side(const Grid& grid, const Visit& visit) {
    for (std::size_t row = 0; row < grid.rows; ++row)
      for (std::size_t column = 0; column < grid.columns; ++column) {
        const auto a = row * grid.columns + column;
        if (column + 1 < grid.columns) visit(a, a + 1, true);
        if (row + 1 < grid.rows) visit(a, a + grid.columns, false);
      }
  }
};

StreamLines::StreamLines(const Grid& grid, bool has_axis)
    : grid_(grid), has_axis_(has_axis), equations_(std::make_unique<Equations>()) {
  assert(!has_axis || grid.x(0) >= 0);
}
StreamLines::~StreamLines() = default;
StreamLines::StreamLines(StreamLines&&) noexcept = default;

std::vector<double> StreamLines::stream_function(const FlowOnGrid& flow) {
  assert(flow.velocity_x.size() == grid_.size() && flow.velocity_y.size() == grid_.size());
  auto u = flow.velocity_x, v = flow.velocity_y;
  std::vector<char> points(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) points[i] = std::isnan(u[i]) ? 0 : 1;
  equations_->prepare(grid_, std::move(points));
  // A point that has left the fluid since the matrix was factorised is next to the fluid. It gets
  // the mean velocity of its neighbours.
  fill_next_to_known(u, grid_.columns);
  fill_next_to_known(v, grid_.columns);
  const auto& is_fluid = equations_->is_fluid;
  Eigen::VectorXd right_side = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(u.size()));
  Equations::for_each_side(grid_, [&](std::size_t a, std::size_t b, bool is_horizontal) {
    double difference =
        is_horizontal ? -grid_.step_x() * (v[a] + v[b]) / 2 : grid_.step_y() * (u[a] + u[b]) / 2;
    if (has_axis_) difference *= (grid_.x(a % grid_.columns) + grid_.x(b % grid_.columns)) / 2;
    const bool both = is_fluid[a] != 0 && is_fluid[b] != 0;
    if (!both || std::isnan(difference)) return;
    right_side[static_cast<Eigen::Index>(a)] -= difference * Equations::weight(both);
    right_side[static_cast<Eigen::Index>(b)] += difference * Equations::weight(both);
  });
  const Eigen::VectorXd psi = equations_->factor.solve(right_side);
  std::vector<double> values(psi.data(), psi.data() + psi.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isnan(u[i])) values[i] = std::numeric_limits<double>::quiet_NaN();
  return values;
}

StreamLineSet StreamLines::of(const FlowOnGrid& flow, const std::vector<char>& is_body, int count) {
  assert(is_body.size() == grid_.size() && count > 0);
  const auto psi = stream_function(flow);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < psi.size(); ++i)
    if (std::isfinite(psi[i]) && is_body[i] == 0) {
      low = std::min(low, psi[i]);
      high = std::max(high, psi[i]);
    }
  StreamLineSet set;
  if (!(high > low)) return set;
  set.step = (high - low) / count;
  const auto field = field_on(grid_, psi);
  Polyline arrows;
  for (int n = 0; n < count; ++n) {
    const double level = std::lerp(low, high, (n + 0.5) / count);
    for (auto& line : level_lines(field, level))
      if (line.size() > 2)
        set.lines.push_back(directed(std::move(line), grid_, flow, is_body, arrows));
  }
  return set;
}

}  // namespace viscontact::report
