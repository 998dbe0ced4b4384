// The part of space that a view of particles shows, and the visible parts of planes in it. Lengths
// are in the units of the case.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "viscontact/particles/io/playback.hpp"

namespace viscontact::report {

/// An interval along an axis [L]; empty if low > high.
struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double from, double to) {
    low = std::min(low, from);
    high = std::max(high, to);
  }
};

/// A box [L].
struct ViewBox {
  particles::Vector low{}, high{};
};

/// The box that a view of these frames should show: all particles (or the central 98 % of each
/// frame, if the others have flown far away), and the planes next to them. If there is a `domain`
/// and the particles can be seen in it, it shows all of the domain. In the directions of periods it
/// is the cell. The box has a positive size in each direction of the playback's dimension.
ViewBox view_box_of(const particles::Playback& playback, const std::vector<std::size_t>& frames,
                    const std::optional<ViewBox>& domain = {});

using Polygon = std::vector<particles::Vector>;  ///< convex, its corners in order [L]

/// The part of a polygon with normal.(x - point) >= 0.
Polygon clipped(const Polygon& polygon, const particles::Vector& point,
                const particles::Vector& normal);

/// The part of a polygon that is in the box and on the free side of all planes except plane number
/// `own`, in which the polygon is.
Polygon clipped_to_view(Polygon polygon, const ViewBox& box,
                        const std::vector<particles::PlanePosition>& planes, std::size_t own,
                        int dimension);

}  // namespace viscontact::report
