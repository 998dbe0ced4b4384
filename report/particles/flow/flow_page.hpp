// The flow in the page of a motion of particles. A change must agree with
// report/particles/page/flow.js, which draws it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "viscontact/report/particles/flow/flow_frames.hpp"
#include "viscontact/report/particles/page_data.hpp"

namespace viscontact::report {

/// The largest size of the flow in a page, before it is written in base64 [bytes], about: the
/// points of all flows together, at one byte for the speed and one for the pressure. The
/// streamlines add about a tenth.
inline constexpr std::size_t kFlowBytesOfPage = 9'000'000;

/// The frames whose flow the page shows: all that have one, or evenly chosen ones if there are
/// many, and the number of points of the grid of each.
struct ShownFlows {
  std::vector<std::size_t> frames;
  std::size_t points = 0;
};
ShownFlows shown_flows(const particles::Playback& playback);

/// The parts of the page that show the flow; all empty if there is none.
struct FlowOfPage {
  std::string settings;  ///< a JSON object; "null" if there is no flow
  /// Names and contents of blocks of numbers: times [T] as doubles; for each flow and point a byte
  /// of the speed and of the pressure, 0 to 254 from the lower to the upper end of the scale, 255
  /// where there is no flow; streamlines as 16-bit numbers (the number of lines; for each line the
  /// number of its points, the place of its arrow or 65535, and its points as multiples of 1/65535
  /// of the window), and the begin of each flow in them, then the end.
  std::vector<std::pair<const char*, Bytes>> blocks;
  std::string controls, legend;  ///< HTML
};
FlowOfPage flow_of_page(const FlowFrames& flows, const particles::Playback& playback);

/// HTML of a scale of colours: `ticks` are shares of its width with their texts.
std::string scale_html(const std::string& words, const std::vector<std::string>& colours,
                       const std::vector<std::pair<double, std::string>>& ticks);

}  // namespace viscontact::report
