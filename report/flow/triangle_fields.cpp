// Divides quadratic triangles into straight ones, interpolates values at pixels, and follows level
// lines from side to side (triangle_fields.hpp). The tables of new points and triangles below
// belong together.
#include "viscontact/report/flow/triangle_fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "viscontact/report/flow/pixel_scan.hpp"

namespace viscontact::report {
namespace {

using Index = std::uint32_t;
constexpr double kOutside = std::numeric_limits<double>::quiet_NaN();

/// A key for a pair of points, which does not depend on their order.
std::uint64_t pair_key(Index a, Index b) {
  constexpr int kHalf = 32;
  return (static_cast<std::uint64_t>(std::min(a, b)) << kHalf) | std::max(a, b);
}

bool touches(const Window& window, const freefem_axi::CurvedMesh& mesh,
             const freefem_axi::CurvedMesh::Triangle& triangle) {
  Window box{window.right, window.left, window.top, window.bottom};
  for (const auto node : triangle) {
    const auto& [rho, z] = mesh.nodes[node];
    box = {std::min(box.left, rho), std::max(box.right, rho), std::min(box.bottom, z),
           std::max(box.top, z)};
  }
  return box.left < window.right && box.right > window.left && box.bottom < window.top &&
         box.top > window.bottom;
}

/// A new point of a curved triangle that is divided into 16: the middle between two of its nodes.
/// `weights` are the values of the six quadratic shape functions at this point, first those of the
/// vertices, then those of the middles of the opposite sides.
struct NewPoint {
  std::size_t first, second;
  std::array<double, 6> weights;
};
constexpr std::array<NewPoint, 9> kNewPoints = {{
    {0, 5, {0.375, -0.125, 0, 0, 0, 0.75}},
    {5, 1, {-0.125, 0.375, 0, 0, 0, 0.75}},
    {1, 3, {0, 0.375, -0.125, 0.75, 0, 0}},
    {3, 2, {0, -0.125, 0.375, 0.75, 0, 0}},
    {2, 4, {-0.125, 0, 0.375, 0, 0.75, 0}},
    {4, 0, {0.375, 0, -0.125, 0, 0.75, 0}},
    {4, 5, {0, -0.125, -0.125, 0.25, 0.5, 0.5}},
    {5, 3, {-0.125, 0, -0.125, 0.5, 0.25, 0.5}},
    {3, 4, {-0.125, -0.125, 0, 0.5, 0.5, 0.25}},
}};
// The 16 triangles. Points 0 to 5 are the nodes; from 6 on they are the new points in the order
// above.
constexpr std::array<std::array<std::size_t, 3>, 16> kSixteen = {{{0, 6, 11},
                                                                  {6, 5, 12},
                                                                  {6, 12, 11},
                                                                  {11, 12, 4},
                                                                  {5, 7, 13},
                                                                  {7, 1, 8},
                                                                  {7, 8, 13},
                                                                  {13, 8, 3},
                                                                  {4, 14, 10},
                                                                  {14, 3, 9},
                                                                  {14, 9, 10},
                                                                  {10, 9, 2},
                                                                  {5, 13, 12},
                                                                  {12, 13, 14},
                                                                  {12, 14, 4},
                                                                  {13, 3, 14}}};

}  // namespace

LinearField straightened(const freefem_axi::CurvedMesh& mesh, const std::vector<double>& values,
                         const Window& window, const std::vector<std::array<double, 2>>& gradient) {
  LinearField field;
  std::unordered_map<std::size_t, Index> numbers;        // point of each node
  std::unordered_map<std::uint64_t, Index> new_numbers;  // point between each pair of points
  const auto add = [&](double rho, double z, double value) {
    field.points.push_back({rho, z});
    field.values.push_back(value);
    return static_cast<Index>(field.points.size() - 1);
  };
  // The value of Hermite's cubic at the middle between two nodes, continued linearly to the point
  // (rho, z) nearby.
  const auto between = [&](std::size_t a, std::size_t b, double rho, double z) {
    double value = (values[a] + values[b]) / 2;
    const std::array<double, 2> to = {rho, z};
    for (std::size_t i = 0; i < 2; ++i) {
      const double side = mesh.nodes[b][i] - mesh.nodes[a][i];
      const double off = to[i] - (mesh.nodes[a][i] + mesh.nodes[b][i]) / 2;
      value += (gradient[a][i] - gradient[b][i]) * side / 8 +
               (gradient[a][i] + gradient[b][i]) / 2 * off;
    }
    return value;
  };
  for (const auto& triangle : mesh.triangles) {
    if (!touches(window, mesh, triangle)) continue;
    std::array<Index, kNewPoints.size() + 6> all{};
    for (std::size_t i = 0; i < 6; ++i) {
      const auto node = triangle[i];
      const auto [place, is_new] = numbers.try_emplace(node);
      if (is_new) place->second = add(mesh.nodes[node][0], mesh.nodes[node][1], values[node]);
      all[i] = place->second;
    }
    for (std::size_t i = 0; i < kNewPoints.size(); ++i) {
      const auto& point = kNewPoints[i];
      const auto [place, is_new] =
          new_numbers.try_emplace(pair_key(all[point.first], all[point.second]));
      if (is_new) {
        double rho = 0, z = 0, value = 0;
        for (std::size_t j = 0; j < 6; ++j) {
          rho += point.weights[j] * mesh.nodes[triangle[j]][0];
          z += point.weights[j] * mesh.nodes[triangle[j]][1];
          value += point.weights[j] * values[triangle[j]];
        }
        if (!gradient.empty())
          value = between(triangle[point.first], triangle[point.second], rho, z);
        place->second = add(rho, z, value);
      }
      all[6 + i] = place->second;
    }
    for (const auto& [a, b, c] : kSixteen) field.triangles.push_back({all[a], all[b], all[c]});
  }
  return field;
}

std::vector<double> pixels(const LinearField& field, const Window& window, std::size_t columns,
                           std::size_t rows) {
  std::vector<double> picture(columns * rows, kOutside);
  for (const auto& triangle : field.triangles)
    for (const double side : {1.0, -1.0}) {
      std::array<double, 3> x{}, z{}, v{};
      for (std::size_t i = 0; i < 3; ++i) {
        x[i] = side * field.points[triangle[i]][0];
        z[i] = field.points[triangle[i]][1];
        v[i] = field.values[triangle[i]];
      }
      for_each_pixel(x, z, window, columns, rows, [&](std::size_t pixel, double w1, double w2) {
        picture[pixel] = v[0] + w1 * (v[1] - v[0]) + w2 * (v[2] - v[0]);
      });
    }
  // The centre of a pixel that the boundary crosses may be outside the triangles.
  fill_next_to_known(picture, columns);
  return picture;
}

void fill_next_to_known(std::vector<double>& picture, std::size_t columns) {
  const auto inner = picture;
  const auto rows = picture.size() / columns;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      if (!std::isnan(inner[row * columns + column])) continue;
      double sum = 0;
      int count = 0;
      for (auto r = row - std::min<std::size_t>(row, 1); r <= std::min(row + 1, rows - 1); ++r)
        for (auto c = column - std::min<std::size_t>(column, 1);
             c <= std::min(column + 1, columns - 1); ++c)
          if (const double value = inner[r * columns + c]; !std::isnan(value)) {
            sum += value;
            ++count;
          }
      if (count > 0) picture[row * columns + column] = sum / count;
    }
}

std::pair<double, double> extremes(const LinearField& field, const Window& window) {
  std::pair<double, double> result = {std::numeric_limits<double>::infinity(),
                                      -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < field.points.size(); ++i) {
    const auto& [rho, z] = field.points[i];
    if (rho > window.right || z < window.bottom || z > window.top) continue;
    result.first = std::min(result.first, field.values[i]);
    result.second = std::max(result.second, field.values[i]);
  }
  return result;
}

std::vector<Polyline> level_lines(const LinearField& field, double level) {
  // The points of a level line are its crossings with sides of triangles. Each crossing has at most
  // two neighbours along the line, one in each triangle at the side.
  struct Crossing {
    std::pair<double, double> point;
    std::array<std::uint64_t, 2> next{};
    int neighbours = 0;
    bool drawn = false;
  };
  std::unordered_map<std::uint64_t, Crossing> crossings;
  const auto above = [&](Index i) { return field.values[i] >= level; };
  for (const auto& triangle : field.triangles) {
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
  for (auto& [key, crossing] : crossings)  // the lines that are left are closed
    if (!crossing.drawn) {
      lines.push_back(follow(key));
      lines.back().push_back(lines.back().front());
    }
  return lines;
}

}  // namespace viscontact::report
