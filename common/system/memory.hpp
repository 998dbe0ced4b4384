// How this process takes memory from the system.
#pragma once

namespace viscontact {

/// Freed memory stays with the process and is used again. Otherwise the C library gives the arrays
/// of each time step back to the system, which takes up to a third of the time of a step of a
/// packing. For programs; a library must leave the choice to the program.
void keep_freed_memory();

}  // namespace viscontact
