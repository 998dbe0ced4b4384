// Ctrl-C as a question that long computations ask between two pieces of work.
#pragma once

namespace viscontact {

/// From now on SIGINT and SIGTERM set a flag instead of ending the process. Called once, by app/.
void catch_interrupts();

/// True once SIGINT or SIGTERM came.
bool interrupted();

/// Throws Error(kInterrupted) if interrupted().
void throw_if_interrupted();

}  // namespace viscontact
