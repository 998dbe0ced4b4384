// How much of space a view of particles holds, and what of planes is seen in it.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "viscontact/particles/io/playback.hpp"

namespace viscontact {

/// From where to where along an axis [L]; of nothing, low > high.
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

/// What a view of these frames should hold: all particles, or the central 98 % of each frame if the others have flown far away, and the planes
/// next to them. Never flat in a direction of the playback's.
ViewBox view_box_of(const particles::Playback& playback, const std::vector<std::size_t>& frames);

using Polygon = std::vector<particles::Vector>;  ///< convex, its corners in order [L]

/// What of a polygon has normal.(x - point) >= 0.
Polygon clipped(const Polygon& polygon, const particles::Vector& point,
                const particles::Vector& normal);

/// What of a polygon in plane `own` is in the room and on the free side of the other planes.
Polygon clipped_to_view(Polygon polygon, const ViewBox& room,
                        const std::vector<particles::PlanePosition>& planes, std::size_t own,
                        int dimension);

}  // namespace viscontact
