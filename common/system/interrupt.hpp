// Turns Ctrl-C and similar signals into a flag, which long computations check between two pieces of
// work.
#pragma once

namespace viscontact {

/// After this call SIGINT, SIGTERM and SIGHUP set a flag instead of ending the process. A process
/// gets SIGHUP when its terminal or connection is lost; the signal stays ignored if it was ignored
/// before, as `nohup` arranges. app/ calls this function once.
void catch_interrupts();

/// True after one of these signals has come.
bool interrupted();

/// Throws Error(kInterrupted) if interrupted().
void throw_if_interrupted();

}  // namespace viscontact
