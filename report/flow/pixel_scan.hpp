// Visits the pixels whose centres are in a triangle. Lengths are in the unit of the case.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "viscontact/report/flow/triangle_fields.hpp"

namespace viscontact::report {

/// Calls visit(pixel, w1, w2) for each pixel of the window whose centre is in the triangle with
/// corners (x[i], y[i]). `pixel` counts row by row from the bottom, each row from the left. w1 and
/// w2 are the barycentric coordinates of corners 1 and 2.
template <class Visit>
void for_each_pixel(const std::array<double, 3>& x, const std::array<double, 3>& y,
                    const Window& window, std::size_t columns, std::size_t rows,
                    const Visit& visit) {
  const double width = window.width() / static_cast<double>(columns);
  const double height = window.height() / static_cast<double>(rows);
  // A barycentric coordinate may be this far below 0, and a pixel centre this share of a pixel
  // outside, so that a centre on a side belongs to at least one triangle in spite of round-off.
  constexpr double kSlack = 1e-9;
  // The range of pixels in one direction whose centres are between two coordinates.
  const auto range = [](double low, double high, double start, double step, std::size_t count) {
    const auto clamp = [&](double place) {
      return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count)));
    };
    return std::pair(clamp(std::ceil((low - start) / step - 0.5 - kSlack)),
                     clamp(std::floor((high - start) / step - 0.5 + kSlack) + 1));
  };
  const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (area == 0) return;
  const auto [left, right] = std::ranges::minmax(x);
  const auto [bottom, top] = std::ranges::minmax(y);
  const auto [first_column, end_column] = range(left, right, window.left, width, columns);
  const auto [first_row, end_row] = range(bottom, top, window.bottom, height, rows);
  for (auto row = first_row; row < end_row; ++row)
    for (auto column = first_column; column < end_column; ++column) {
      const double px = window.left + (static_cast<double>(column) + 0.5) * width;
      const double py = window.bottom + (static_cast<double>(row) + 0.5) * height;
      const double w1 = ((px - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (py - y[0])) / area;
      const double w2 = ((x[1] - x[0]) * (py - y[0]) - (px - x[0]) * (y[1] - y[0])) / area;
      if (w1 < -kSlack || w2 < -kSlack || w1 + w2 > 1 + kSlack) continue;
      visit(row * columns + column, w1, w2);
    }
}

}  // namespace viscontact::report
