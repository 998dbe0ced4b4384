// The numbers of the page that plays a motion of particles, encoded as blocks, which motion.js,
// colouring.js and flow.js in particle_runs/picture/page read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particle_runs/picture/scene.hpp"

namespace viscontact::particles {

/// The bytes of a block of numbers, which are little-endian.
using Bytes = std::vector<unsigned char>;

/// The blocks of a page: the id of the HTML element that holds a block, and the content.
using Blocks = std::vector<std::pair<const char*, Bytes>>;

/// The part of a motion that the page shows, and its encoding.
struct PageData {
  std::vector<std::size_t> frames;  ///< indices in Playback::frames of the shown frames, increasing
  /// Frames 0, every_frame, 2 every_frame, ... and the last frame are shown, and particles 0,
  /// every_particle, 2 every_particle, ...
  std::size_t every_frame = 1, every_particle = 1;
  bool contacts = true;
  /// Bytes of a coordinate: 2 if it is a 16-bit number of steps from `low`, 4 if it is a float [L].
  /// Two bytes are chosen if `step` is at most 1/50 of the smallest radius in every direction,
  /// which is too small to be seen.
  int position_bytes = 2;
  /// A coordinate is the entry of `low` plus the number in the block times the entry of `step` [L];
  /// 0 and 1 if the numbers are floats.
  std::array<double, 3> low{}, step{1, 1, 1};
  /// For each shown particle, the place in `frames` of the first frame in which it exists. Empty if
  /// all particles exist in all frames.
  std::vector<std::int32_t> first_frames{};
  double top_speed = 0;  ///< largest speed of the shown frames [L/T]; 0: no speeds
  Blocks blocks{};       ///< without the flow
};

/// Chooses as many frames as fit into a page of 24 MB beside `others`, the blocks of the flow, and
/// encodes them. If two frames are still too many, contacts are left out. The blocks are those of
/// the f shown frames, the n shown particles, the m obstacles and the c pairs that are in contact
/// in any shown frame; blocks of facts that the motion does not have are missing:
///   radii          n floats [L]
///   firstFrames    n int32: PageData::first_frames
///   masses         n floats [M]
///   speeds         f n bytes: 0 to 255 for speeds from 0 to PageData::top_speed
///   semiAxes       2 n floats [L]: both semi-axes of each particle; of one with sides the radius
///                  of the largest disc in it and that of its corners
///   cornerCounts   n bytes: number of corners of a particle with sides, else 0
///   corners        2 floats for each corner [L]: its place relative to centre and angle
///   ids, bodies    n int32 each: id, and number of the rigid body or -1
///   angles         f n floats [rad], for discs that turn
///   orientations   4 f n floats: unit quaternions (w, x, y, z), for spheres that turn
///   images         c int8, in a periodic cell: image of the second particle, -13 to 13
///   times          f doubles [T]
///   positions      f n times 2 or 3 coordinates: uint16 or floats (PageData::position_bytes)
///   planes         6 f m floats: a point [L] and the unit normal into the side of the particles;
///                  of a circle its centre, 0, 0 and its radius [L]
///   pairs          2 c int32: numbers of the particles among the shown ones, or -1 - j for
///                  obstacle j in place of the first
///   offsets        f + 1 uint32: where each frame begins in contacts, then the length of contacts
///   contacts       the bytes of all contacts, frame by frame: see readContacts() in motion.js
PageData page_data(const Scene& scene, const Blocks& others);

/// The blocks of n flows on a grid of p points; no blocks if there is no flow.
///   flow-times     n doubles, the times [T]
///   flow-speed     n p bytes: flow by flow, row by row from the bottom, each row from the left; 0
///                  to 254 for speeds from 0 to FlowFrames::top_speed, 255 where there is no flow
///   flow-pressure  n p bytes in the same order; 0 to 254 from the lower to the upper end of
///                  FlowFrames::pressure_colours, 255 where there is no flow
///   flow-lines     16-bit numbers: for each flow the number of its streamlines, and for each of
///                  these the number of its points, the place of its arrow (65535: none), and x and
///                  y of each point in 65535 steps across the grid's window, from the left and the
///                  bottom
///   flow-offsets   n + 1 32-bit numbers: where each flow begins in flow-lines, counted in 16-bit
///                  numbers, and then the length of flow-lines
Blocks flow_blocks(const Scene& scene);

}  // namespace viscontact::particles
