// The numbers of the page that plays a motion: chooses the frames, particles and contacts that fit
// into it, and encodes them, and the flow, as blocks that its script reads. Numbers are in the
// units of the case; nothing is thrown. The layout of the blocks must agree with the scripts in
// particles/picture/page. Used by particles_page.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particles/picture/scene.hpp"

namespace viscontact::particles {

/// The content of a block of numbers. The numbers are written as they are in memory, and the script
/// reads them as little-endian.
using Bytes = std::vector<unsigned char>;

/// Names and contents of the blocks of numbers in the page.
using Blocks = std::vector<std::pair<const char*, Bytes>>;

/// The bytes in base64 (RFC 4648).
std::string base64(const Bytes& bytes);

/// The part of a motion that the page shows, and its encoding.
struct PageData {
  std::vector<std::size_t> frames;  ///< indices of the shown frames
  std::size_t every_frame = 1, every_particle = 1;
  bool contacts = true;
  /// Positions are 16-bit multiples of `step` from `low` (position_bytes = 2) if `step` is small
  /// compared with every particle, otherwise 32-bit floats (position_bytes = 4). `low` and `step`
  /// are in [L].
  int position_bytes = 2;
  std::array<double, 3> low{}, step{1, 1, 1};
  /// For each shown particle, the first of `frames` in which it is there. Empty: all are always
  /// there.
  std::vector<std::int32_t> first_frames{};
  double top_speed = 0;  ///< largest speed of the shown frames [L/T]; 0: not known
  Blocks blocks{};       ///< all that the script reads of these frames
};

/// Chooses as many frames as fit into a page of 24 MB beside `others`, the blocks of the flow, and
/// encodes them. If even two frames are too large, the contacts are left out.
PageData page_data(const Scene& scene, const Blocks& others);

/// The blocks of the flow, none if there is none: times [T] as doubles; for each flow and point a
/// byte of the speed and of the pressure, 0 to 254 from the lower to the upper end of the scale,
/// 255 where there is no flow; streamlines as 16-bit numbers (the number of lines; for each line
/// the number of its points, the place of its arrow or 65535, and its points as multiples of
/// 1/65535 of the window), and the begin of each flow in them, then the end.
Blocks flow_blocks(const Scene& scene);

}  // namespace viscontact::particles
