// The data of the page that plays a motion of particles, as binary numbers in the units of the
// case. A change must agree with report/particles/page/motion.js, which reads them.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particles/io/playback.hpp"

namespace viscontact::report {

using Bytes = std::vector<unsigned char>;

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
  /// Names and contents of the blocks of numbers in the page.
  std::vector<std::pair<const char*, Bytes>> blocks{};
};

/// Chooses as many frames as fit into a page of 24 MB, of which `other_bytes` are taken, and
/// encodes them. If even two frames are too large, the contacts are left out.
PageData page_data(const particles::Playback& playback, double lowest_gamma,
                   std::size_t other_bytes = 0);

/// The size of so many bytes in base64.
constexpr std::size_t base64_size(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

/// The bytes in base64 (RFC 4648).
std::string base64(const Bytes& bytes);

}  // namespace viscontact::report
