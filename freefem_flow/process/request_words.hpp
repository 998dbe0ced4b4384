// Numbers and boundaries of meshes in the words of the protocol (docs/fluid-solver.md, which a
// change must follow). Numbers are written so that they read back to the same double.
#pragma once

#include <span>
#include <string>

#include "viscontact/freefem_flow/mesh_boundary.hpp"

namespace viscontact::freefem_flow {

/// Appends numbers with a space before each. Throws Error(kNotConverged) if one of them is not
/// finite, with the words `what` it is.
void append(std::string& text, std::span<const double> values, const char* what);

/// The boundary of a mesh. Errors as append().
std::string words_of(const MeshBoundary& boundary);

}  // namespace viscontact::freefem_flow
