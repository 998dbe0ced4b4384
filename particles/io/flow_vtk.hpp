// The flow around particles as VTK files for ParaView. Lengths, masses and times are in the units
// of the case.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::particles {

/// Content of a VTK XML UnstructuredGrid file (VTK's file formats, "XML file formats"; appended raw
/// data): quadratic triangles (VTK's cell type 22) with velocity, pressure and speed at their
/// nodes. With `dimension` 2, x and y are those of VTK and z = 0. With `dimension` 1, the flow is
/// in the half-plane x >= 0, y = 0, in which z is the axis.
std::string write_flow(const FlowField& flow, int dimension = 2);

/// Reads a file that write_flow wrote on a machine with the same byte order. The numbers have the
/// same bits. Throws Error(kBadInput), which names the file, if it is not such a file or was cut
/// short.
FlowField read_flow(const std::filesystem::path& path);

}  // namespace viscontact::particles
