// Which versions of what made a result.
#pragma once

#include <map>
#include <string>

namespace viscontact {

/// Viscontact and the libraries it was built with: name to version.
std::map<std::string, std::string> library_versions();

/// The version that FreeFEM gives of itself, or "not found".
std::string freefem_version_or_not_found();

}  // namespace viscontact
