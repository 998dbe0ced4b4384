// Fields on triangular meshes for drawing: values at pixels, and level lines. Points are (rho, z)
// [L] of the half-plane.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "viscontact/freefem_axi/row_picture.hpp"

namespace viscontact::report {

/// A rectangle of the half-plane or of its mirror image [L].
struct Window {
  double left = 0, right = 0, bottom = 0, top = 0;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

/// A field that is linear on each of a set of straight triangles.
struct LinearField {
  std::vector<std::array<double, 2>> points;
  std::vector<double> values;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Divides each curved triangle that touches the window into 16 straight triangles, and
/// interpolates the field. `values` are the values at the nodes of the quadratic elements. If
/// `gradient` is not empty, it is the gradient at the nodes; then the field is the cubic Hermite
/// interpolant along the lines between neighbouring nodes, and its level lines have no corners
/// where the gradient is small.
LinearField straightened(const freefem_axi::CurvedMesh& mesh, const std::vector<double>& values,
                         const Window& window,
                         const std::vector<std::array<double, 2>>& gradient = {});

/// The values of the field at the centres of the pixels of a window, row by row from the bottom,
/// each row from the left. The window may extend to negative rho, because the field is symmetric
/// about the axis. A pixel outside the triangles is NaN, unless it is next to a pixel inside.
std::vector<double> pixels(const LinearField& field, const Window& window, std::size_t columns,
                           std::size_t rows);

/// Gives each pixel that is NaN the mean value of those of its up to eight neighbours that are not.
/// The pixels are row by row, with `columns` in a row.
void fill_next_to_known(std::vector<double>& picture, std::size_t columns);

/// The smallest and the largest value at the points in the window.
std::pair<double, double> extremes(const LinearField& field, const Window& window);

using Polyline = std::vector<std::pair<double, double>>;

/// The lines on which the field equals `level`, joined across triangles.
std::vector<Polyline> level_lines(const LinearField& field, double level);

}  // namespace viscontact::report
