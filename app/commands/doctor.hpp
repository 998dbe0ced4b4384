// What is installed, and how to mend what is missing.
#pragma once

namespace viscontact {

/// Prints what is there to standard output, one line each or as JSON, and solves a small problem with FreeFEM
/// against Brenner's exact value. True if nothing is missing.
bool examine(bool json);

}  // namespace viscontact
