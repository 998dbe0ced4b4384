// Ctrl-C as a question that long computations ask between two pieces of work.
#pragma once

namespace viscontact {

/// From now on SIGINT, SIGTERM and SIGHUP set a flag instead of ending the process. SIGHUP is what
/// a process gets whose terminal or connection is lost; it stays ignored if it was ignored before,
/// as `nohup` arranges. Called once, by app/.
void catch_interrupts();

/// True once one of these signals came.
bool interrupted();

/// Throws Error(kInterrupted) if interrupted().
void throw_if_interrupted();

}  // namespace viscontact
