// The frames of a simulation, kept in memory for pages and pictures (particles/picture). Lengths,
// masses and times are in the units of the case. run/particles_pages.cpp reads them. A change must
// keep the memory of a frame small, because a run may have thousands.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "viscontact/common/text/units.hpp"
#include "viscontact/particles/current_contacts.hpp"
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::particles {

/// Particles, planes and contacts at one time.
struct Frame {
  double time = 0;  ///< [T]
  /// Flat array [L], `dimension` numbers for each particle; single precision suffices. They are NaN
  /// for a particle that is not there yet.
  std::vector<float> positions;
  std::vector<PlanePosition> planes;     ///< all obstacles, in the order of domain.hpp
  std::vector<CurrentContact> contacts;  ///< glued (gamma < 0) or touching
  std::vector<float> angles{};           ///< of each disc [rad]; empty if none turns
  /// Of each sphere in space, unit quaternions (w, x, y, z); empty if none turns.
  std::vector<float> orientations{};
  std::vector<float> speeds{};  ///< of each particle [L/T]; empty: not known
  /// File of the flow around the particles (flow_vtk.hpp); empty if there is none. A picture reads
  /// the flows one after the other, because all of them may be too large for the memory.
  std::filesystem::path flow{};
};

/// The links that a page or a picture shows, which are the same in all frames.
struct DrawnLinks {
  using Ends = std::array<std::int32_t, 2>;  ///< numbers of two particles
  std::vector<Vector> hinges{};              ///< their places [L]
  std::vector<Ends> springs{},               ///< the particles of each spring
      arms{};                                ///< the particles of each arm
  /// True if there is nothing to draw.
  bool empty() const { return hinges.empty() && springs.empty() && arms.empty(); }
};

/// All frames that a page or a picture shows.
struct Playback {
  int dimension = 2;         ///< of space: 1, 2 or 3
  Units units{};             ///< of the case; may be empty
  std::vector<float> radii;  ///< [L]
  /// Masses, of discs in a fluid per length [M, M/L]; empty: not known.
  std::vector<float> masses{};
  /// Semi-axes of each particle in the plane, the first one along its angle [L]; empty: all are
  /// discs.
  std::vector<std::array<double, 2>> semi_axes{};
  /// Which particles are plates with round ends, as in Fluid; empty: none is.
  std::vector<char> plates{};
  std::vector<Frame> frames;        ///< in order of time, from the start on
  bool is_in_fluid = false;         ///< whether the particles are in a fluid that is computed
  std::vector<std::int32_t> ids{};  ///< as in Particles
  PeriodicCell cell{};              ///< as in Particles
  /// Number of the rigid body of each particle, -1: none; empty if there are no bodies.
  std::vector<std::int32_t> bodies{};
  /// The links; empty if there are none.
  DrawnLinks links{};
  /// mu_s >= 0 of contacts that stick and slide; empty: there is no friction.
  std::optional<double> friction_coefficient{};
};

/// Position of particle k in a frame [L].
inline Vector position(const Playback& playback, const Frame& frame, std::size_t k) {
  Vector x{};
  const auto dimension = static_cast<std::size_t>(playback.dimension);
  for (std::size_t d = 0; d < dimension; ++d) x[d] = frame.positions[k * dimension + d];
  return x;
}

}  // namespace viscontact::particles
