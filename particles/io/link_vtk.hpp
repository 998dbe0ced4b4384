// The links of a state as a VTK file for ParaView. Lengths, masses and times are in the units of
// the case. A change must keep the names and numbers, which users' ParaView states contain.
#pragma once

#include <string>

#include "viscontact/particles/setting.hpp"

namespace viscontact::particles {

/// Content of a VTK XML PolyData file (VTK's file formats, "XML file formats"; appended raw data)
/// with a vertex for each hinge, at its place, and a line for each spring and each arm, between the
/// centres of its particles. In a periodic domain the line goes to the nearest image of the second
/// particle. Each cell has
///
/// - kind: 0 hinge, 1 spring, 2 arm;
/// - id: number of the link in its list of the case, from 0;
/// - force: in the last step, on the body of a hinge or on the second particle [M L/T^2].
std::string write_links(const Setting& setting, const State& state);

}  // namespace viscontact::particles
