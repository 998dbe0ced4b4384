// Planes beside the spheres: bodies after them whose motion is that of the flow, (9.18).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/suspensions/cell/pair_search.hpp"
#include "viscontact/suspensions/values/affine_motion.hpp"

namespace viscontact::suspensions {

/// A plane that may move along itself, so that its place does not change.
struct PlaneBody {
  Vector normal{};   ///< unit normal into the free side
  double level = 0;  ///< normal.x of its points [L]
};

/// The walls of the domain and the planes, in the order of particles::obstacles_of(). Throws
/// Error(kBadInput) if the flow changes along one of them or goes through it, or if a plane turns
/// or has a load.
std::vector<PlaneBody> planes_beside(const particles::Setting& setting);

/// Throws Error(kBadInput) if a plane has not the mean velocity of the flow between two times [T],
/// whose mean gradient [1/T] is `gradient`.
void check_plane_motions(const particles::Setting& setting, const Matrix& gradient, double from,
                         double to);

/// Adds the pairs of spheres and planes with gaps below `range` radii to `pairs`, in order of
/// first, second. Plane k is the body `radii.size() + k`.
void add_plane_pairs(std::span<const PlaneBody> planes, std::span<const double> positions,
                     std::span<const double> radii, double range, std::vector<NearPair>& pairs);

}  // namespace viscontact::suspensions
