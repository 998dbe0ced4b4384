// Versions of the programs and libraries that make a result, for its provenance. A change must keep
// the names, which files contain.
#pragma once

#include <map>
#include <string>

#include "viscontact/common/stop_token.hpp"

namespace viscontact::results {

/// The versions of Viscontact and of the libraries it was built with, by name.
std::map<std::string, std::string> library_versions();

/// The version that FreeFEM reports, or "not found" if FreeFEM cannot be run.
std::string freefem_version_or_not_found(const StopToken& stop = {});

}  // namespace viscontact::results
