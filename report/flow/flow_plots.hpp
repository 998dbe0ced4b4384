// Pictures of one row of a table of lubrication forces: the mesh in the gap between sphere and
// wall, the flow around the sphere and the flow in the gap. Lengths, masses and times are in the
// units of the case. `tabulate --plot` makes them (pipeline/tabulate/picture_stage.cpp). A gnuplot
// that is missing or fails throws Error(kExternalProgram). A change must keep that each function
// returns one complete SVG.
#pragma once

#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/freefem_axi/row_picture.hpp"

namespace viscontact::report {

// `picture` is the flow of a row of the table that `tabulation` describes (neither that nor the
// motion is checked). It is computed in the half-plane of the distance from the axis and the
// height; pictures show its mirror image, too. If the gap is thin, heights are stretched, and the
// title says so. All throw Error(kExternalProgram) if gnuplot is missing, fails or takes ten
// minutes, and Error(kInterrupted) if `stop` requests a stop.

/// The finest mesh in the gap, and on it the coarsest mesh, whose triangles were each divided into
/// 16 or more triangles of the finest.
std::string plot_mesh(const freefem_axi::RowPicture& picture,
                      const freefem_axi::Tabulation& tabulation, const StopToken& stop = {});

/// The flow of an approaching sphere within about three radii of its centre (all of the fluid if it
/// is not much larger): pressure as colours, and streamlines between which equal amounts flow.
std::string plot_flow(const freefem_axi::RowPicture& picture,
                      const freefem_axi::Tabulation& tabulation, const StopToken& stop = {});

/// The flow of an approaching sphere in the gap: pressure and streamlines likewise.
std::string plot_gap_flow(const freefem_axi::RowPicture& picture,
                          const freefem_axi::Tabulation& tabulation, const StopToken& stop = {});

/// The flow of a sphere that slides, rolls or spins, in the plane through the axis and the
/// direction of motion: speed as colours, and direction as arrows. If the sphere spins, the colours
/// show the velocity about the axis. With `in_gap`, only the part in the gap.
std::string plot_motion(const freefem_axi::RowPicture& picture,
                        const freefem_axi::Tabulation& tabulation, bool in_gap,
                        const StopToken& stop = {});

}  // namespace viscontact::report
