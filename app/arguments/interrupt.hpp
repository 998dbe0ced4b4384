// Ctrl-C and similar signals as a request to stop.
#pragma once

#include "viscontact/common/stop_token.hpp"

namespace viscontact::app {

/// After this call SIGINT, SIGTERM and SIGHUP request a stop instead of ending the process. A
/// process gets SIGHUP when its terminal or connection is lost. SIGHUP stays ignored if it was
/// ignored when the program started, which is what `nohup` does. SIGXFSZ (a file reaches the limit
/// of its size) is ignored from now on, so that the write fails instead. A system that refuses the
/// handlers leaves the signals as they are.
void catch_interrupts();

/// The token of the program. It requests a stop as soon as one of the signals has come after
/// catch_interrupts(), and from then on until the process ends. It is valid until the process ends.
StopToken interrupt_token();

}  // namespace viscontact::app
