// Pictures of one row of a tabulation: the mesh in the gap, the flow around the sphere and the flow
// in the gap. Lengths, masses and times are in the units of the case. `tabulate --plot` makes them;
// a change must keep that each function returns a complete SVG. Used by pipeline/.
#pragma once

#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/freefem_axi/row_picture.hpp"

namespace viscontact::report {

// Each function returns one SVG. The half-plane is mirrored about the axis, so that the whole
// sphere is seen. If the gap is thin, heights are drawn larger than widths, and the title says so.
// The functions throw Error(kExternalProgram) if gnuplot is missing or fails, and
// Error(kInterrupted) if `stop` requests a stop.

/// The finest mesh in the gap, and on it the coarsest mesh, each triangle of which was divided into
/// 16 or more triangles of the finest mesh.
std::string plot_mesh(const freefem_axi::RowPicture& picture,
                      const freefem_axi::Tabulation& tabulation, const StopToken& stop = {});

/// Pressure as colours, and streamlines at equal steps of the stream function, within about three
/// radii of the sphere's centre. A container that is not much larger is shown whole.
std::string plot_flow(const freefem_axi::RowPicture& picture,
                      const freefem_axi::Tabulation& tabulation, const StopToken& stop = {});

/// Pressure and streamlines in the gap.
std::string plot_gap_flow(const freefem_axi::RowPicture& picture,
                          const freefem_axi::Tabulation& tabulation, const StopToken& stop = {});

/// The flow of a sphere that slides, rolls or spins, in a cut through the axis along the motion:
/// the speed as colours and the direction as arrows; for spinning, the azimuthal velocity as
/// colours. `in_gap`: the part in the gap.
std::string plot_motion(const freefem_axi::RowPicture& picture,
                        const freefem_axi::Tabulation& tabulation, bool in_gap,
                        const StopToken& stop = {});

}  // namespace viscontact::report
