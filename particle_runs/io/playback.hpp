// The frames of a simulation, its states at the output times, as HTML pages and pictures show them.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "viscontact/common/text/units.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {

/// Particles, planes and contacts at one time. It is kept small, because a run may have thousands.
struct Frame {
  double time = 0;  ///< [T]
  /// Flat array [L], Playback::dimension numbers for each particle; single precision is enough for
  /// a picture. They are NaN for a particle that a source has not added yet.
  std::vector<float> positions;
  std::vector<PlanePosition> planes;     ///< all obstacles, in the order of obstacles_of()
  std::vector<CurrentContact> contacts;  ///< as contacts_of() lists them
  std::vector<float> angles{};           ///< of each disc [rad]; empty if none turns
  /// Unit quaternions (w, x, y, z) of spheres in space; empty if none turns.
  std::vector<float> orientations{};
  std::vector<float> speeds{};  ///< of each particle [L/T], >= 0; empty: not known
  /// With lubrication in a periodic box: displacement along x of the image across the period y [L].
  std::optional<double> offset{};
  /// Of a cell that a flow strains: PeriodicCell::vectors [L].
  std::optional<std::array<Vector, 3>> periods{};
  /// File of the flow around the particles (flow_vtk.hpp); empty if there is none. All flows
  /// together may be too large for the memory.
  std::filesystem::path flow{};
};

/// The links that a page or a picture shows, the same in all frames.
struct DrawnLinks {
  using Ends = std::array<std::int32_t, 2>;  ///< numbers of two particles
  std::vector<Vector> hinges{};              ///< places [L]
  std::vector<Ends> springs{}, arms{};
  bool empty() const { return hinges.empty() && springs.empty() && arms.empty(); }
};

struct Playback {
  int dimension = 2;  ///< 1, 2 or 3
  /// The axis that points upwards in pictures of a motion in space, 1 or 2.
  std::size_t up = 2;
  /// The place in the case of the origin of all places here [L]. It is 0 unless the motion is so
  /// far from the origin of the case that single precision would not show it. Files of flows have
  /// the places of the case.
  Vector origin{};
  Units units{};             ///< names of the units of the case, such as "m"; may be empty
  std::vector<float> radii;  ///< of each particle [L], > 0
  /// The mass of each particle [M], >= 0, of discs in a fluid per length [M/L]; empty: not known.
  std::vector<float> masses{};
  std::vector<Shape> shapes{};  ///< of each particle; empty: all are discs or spheres
  std::vector<Frame> frames;    ///< in the order of their times, from the start on
  bool is_in_fluid = false;
  /// The id of each particle, >= 0; empty: particle k has the id k.
  std::vector<std::int32_t> ids{};
  PeriodicCell cell{};  ///< that of the case at the start
  /// Number of the rigid body of each particle, -1: none; empty if there are no bodies.
  std::vector<std::int32_t> bodies{};
  DrawnLinks links{};
  std::string note{};    ///< a sentence below the title of the page; may be empty
  std::string charts{};  ///< SVG below the motion on the page; may be empty
  /// The coefficient is >= 0; empty: there is no friction.
  std::optional<double> friction_coefficient{};
};

/// The cell at the time of a frame. In a sheared cell images have moved since the start.
inline PeriodicCell cell_at(const Playback& playback, const Frame& frame) {
  auto cell = playback.cell;
  cell.moved_for = frame.time;
  cell.offset = frame.offset;
  if (frame.periods) cell.vectors = frame.periods;
  return cell;
}

/// Position of particle k in a frame [L]. The first `dimension` components are NaN if a source has
/// not added the particle yet; the others are 0.
inline Vector position(const Playback& playback, const Frame& frame, std::size_t k) {
  Vector x{};
  const auto dimension = static_cast<std::size_t>(playback.dimension);
  assert((k + 1) * dimension <= frame.positions.size());
  for (std::size_t d = 0; d < dimension; ++d) x[d] = frame.positions[k * dimension + d];
  return x;
}

}  // namespace viscontact::particles
