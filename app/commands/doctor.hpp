// The command `doctor`: checks which programs are installed, and says how to install missing ones.
#pragma once

namespace viscontact {

/// Prints the findings to standard output, one line each or as JSON. Solves a small problem with
/// FreeFEM and compares the drag with Brenner's exact value. True if nothing is missing or wrong.
bool examine(bool json);

}  // namespace viscontact
