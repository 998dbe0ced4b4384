// Flows as VTK files for ParaView. Lengths, masses and times are in the units of the case. `report`
// reads the files again to draw the flow; a change must keep their arrays and names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/vtk/flow_field.hpp"

namespace viscontact {

/// Content of a VTK XML UnstructuredGrid file (VTK's file formats, "XML file formats"; appended raw
/// data): quadratic triangles (VTK's cell type 22) with velocity [L/T], pressure [M/(L T^2)] and
/// speed [L/T] at their nodes. Unless `more` is empty, it has a value for each node, which is
/// written under the name `more_name`. x and y are those of VTK and z = 0; with `on_axis`, the flow
/// is in the half-plane x >= 0, y = 0 of VTK, and z is the axis.
std::string write_flow(const FlowField& flow, bool on_axis = false, std::string_view more_name = {},
                       const std::vector<double>& more = {});

/// Reads mesh, velocity and pressure from a file that write_flow wrote on a machine with the same
/// byte order. The numbers have the same bits. Throws Error(kBadInput), which names the file, if it
/// is not such a file or was cut short.
FlowField read_flow(const std::filesystem::path& path);

}  // namespace viscontact
