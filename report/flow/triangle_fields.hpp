// Fields on triangles, made ready to be drawn: as pixels, and as the lines along which one is constant.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "viscontact/freefem_axi/row_picture.hpp"

namespace viscontact {

/// A rectangle of the half-plane or of its mirror image [L].
struct Window {
  double left = 0, right = 0, bottom = 0, top = 0;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

/// Straight triangles with a field that is linear on each.
struct LinearField {
  std::vector<std::array<double, 2>> points;
  std::vector<double> values;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The curved triangles that touch the window, each as 16 straight ones, with the quadratic field that `values` are the nodes of. If its
/// `gradient` at the nodes is known better than that (not empty), the field is cubic along the lines between neighbouring nodes, and
/// its level lines have no corners where its gradient is small.
LinearField straightened(const CurvedMesh& mesh, const std::vector<double>& values,
                         const Window& window,
                         const std::vector<std::array<double, 2>>& gradient = {});

/// The field at the pixels of a picture of the window, row by row from the bottom, each row from the left. The field is symmetric about
/// the axis: a window may reach to negative rho. A pixel outside the triangles is NaN, unless it is next to one inside.
std::vector<double> pixels(const LinearField& field, const Window& window, std::size_t columns,
                           std::size_t rows);

using Polyline = std::vector<std::pair<double, double>>;

/// The lines on which the field has that level, joined across triangles.
std::vector<Polyline> level_lines(const LinearField& field, double level);

}  // namespace viscontact
