// Pictures of one row of a table of lubrication forces, in the units of the case.
#pragma once

#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/freefem_axi/row_picture.hpp"

namespace viscontact::report {

// `picture` must be the flow of a row of the table that `tabulation` describes, with the motion
// that the function needs: gap and radius > 0 [L], velocity [L/T] or angular velocity [1/T] not 0.
// Each drawing also shows the mirror image of the half-plane of the computation. If the gap is
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

/// The same in the gap, with a linear scale of colours.
std::string plot_gap_flow(const freefem_axi::RowPicture& picture,
                          const freefem_axi::Tabulation& tabulation, const StopToken& stop = {});

/// The flow of a sphere that slides, rolls or spins, in the plane through the axis and the
/// direction of motion. Colours show the speed and arrows the direction. If the sphere spins, the
/// colours show the size of the velocity about the axis, and there are no arrows. The picture shows
/// the gap only, or without `in_gap` the same part of the fluid as plot_flow().
std::string plot_motion(const freefem_axi::RowPicture& picture,
                        const freefem_axi::Tabulation& tabulation, bool in_gap,
                        const StopToken& stop = {});

}  // namespace viscontact::report
