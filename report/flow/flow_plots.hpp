// Pictures of one row of a tabulation: its mesh in the gap, the flow around the sphere, the flow in the gap.
#pragma once

#include <string>

#include "viscontact/freefem_axi/row_picture.hpp"

namespace viscontact {

/// Each as one SVG, mirrored about the axis so that the sphere is whole, in the case's units. Where the gap is thin, its heights are
/// stretched, and the title says so. Throw Error(kExternalProgram) if gnuplot is missing or fails.

/// The finest mesh in the gap, and upon it the coarsest, of which each triangle became 16 or more.
std::string plot_mesh(const RowPicture& picture, const Tabulation& tabulation);

/// Pressure as colours, and streamlines at equal steps of the stream function, within about three radii of the sphere's centre; all
/// of the fluid if that is little more.
std::string plot_flow(const RowPicture& picture, const Tabulation& tabulation);

/// The same in the gap.
std::string plot_gap_flow(const RowPicture& picture, const Tabulation& tabulation);

}  // namespace viscontact
