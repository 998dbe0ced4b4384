// Turns Ctrl-C and similar signals into a request to stop. main.cpp and the commands of app/ pass
// this request as a StopToken to the libraries, which check it during long computations and then
// throw Error(kInterrupted). Nothing is thrown here. Further signals may be added; a change must
// keep that the signal handler only sets a flag.
#pragma once

#include "viscontact/common/stop_token.hpp"

namespace viscontact::app {

/// After this call SIGINT, SIGTERM and SIGHUP request a stop instead of ending the process. A
/// process gets SIGHUP when its terminal or connection is lost. SIGHUP stays ignored if it was
/// ignored when the program started, which is what `nohup` does. SIGXFSZ (a file reaches the limit
/// of its size) is ignored from now on, so that the write fails instead. Whether the system accepts
/// the handlers is not checked. main() calls this function once.
void catch_interrupts();

/// The token of the program. It requests a stop as soon as SIGINT, SIGTERM or SIGHUP has come after
/// catch_interrupts(), and from then on until the process ends. It is valid until the process ends.
StopToken interrupt_token();

}  // namespace viscontact::app
