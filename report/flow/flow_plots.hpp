// Pictures of one row of a table of lubrication forces: the mesh in the gap between sphere and
// wall, the flow around the sphere and the flow in the gap. Lengths, masses and times are in the
// units of the case: gap and radius [L], > 0, velocity [L/T] or angular velocity [1/T], not 0, and
// pressure [M/(L T^2)]; none of them is checked. `tabulate --plot` makes the pictures
// (pipeline/tabulate/picture_stage.cpp). A gnuplot that is missing or fails throws
// Error(kExternalProgram). A change must keep that each function returns one complete SVG; sizes,
// colours and numbers of lines in flow_plots.cpp are free choices.
#pragma once

#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/freefem_axi/row_picture.hpp"

namespace viscontact::report {

// `picture` must be the flow of a row of the table that `tabulation` describes, with the motion
// that the function needs; neither is checked. The flow was computed in the half-plane of the
// distance from the axis and the height; each drawing also shows its mirror image. If the gap is
// thin, heights are stretched, and the title says so. Each function returns the text of an SVG and
// throws Error(kExternalProgram) if gnuplot is missing, fails or takes ten minutes, and
// Error(kInterrupted) if `stop` requests a stop.

/// The finest mesh in the gap, and over it the coarsest mesh, from which the finest was made by
/// dividing each triangle into 16 or more. The sphere may have any motion.
std::string plot_mesh(const freefem_axi::RowPicture& picture,
                      const freefem_axi::Tabulation& tabulation, const StopToken& stop = {});

/// The flow of an approaching sphere within about three radii of its centre, or all of the fluid if
/// it reaches at most 6 radii from the axis and is at most 12 radii high. Colours show the
/// pressure, and equal amounts flow between neighbouring streamlines.
std::string plot_flow(const freefem_axi::RowPicture& picture,
                      const freefem_axi::Tabulation& tabulation, const StopToken& stop = {});

/// The flow of an approaching sphere in the gap, with the pressure as colours and with streamlines
/// between which equal amounts flow.
std::string plot_gap_flow(const freefem_axi::RowPicture& picture,
                          const freefem_axi::Tabulation& tabulation, const StopToken& stop = {});

/// The flow of a sphere that slides, rolls or spins, in the plane through the axis and the
/// direction of motion. Colours show the speed and arrows the direction. If the sphere spins, the
/// colours show the size of the velocity about the axis, and there are no arrows. If `in_gap` is
/// true, the picture shows the gap only; otherwise it shows the same part of the fluid as
/// plot_flow().
std::string plot_motion(const freefem_axi::RowPicture& picture,
                        const freefem_axi::Tabulation& tabulation, bool in_gap,
                        const StopToken& stop = {});

}  // namespace viscontact::report
