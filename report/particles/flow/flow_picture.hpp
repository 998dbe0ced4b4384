// The flow behind the particles in a panel of the still picture, as SVG.
#pragma once

#include <string>

#include "viscontact/report/particles/flow/flow_frames.hpp"
#include "viscontact/report/particles/frame_picture.hpp"

namespace viscontact::report {

/// The speed as coloured bands, and the streamlines with arrows.
std::string flow_picture(const FlowFrames& flows, const FlowFrame& frame, const Projection& view);

}  // namespace viscontact::report
