// Turns Ctrl-C and similar signals into a request to stop, which main() hands to the libraries.
#pragma once

#include "viscontact/common/stop_token.hpp"

namespace viscontact::app {

/// After this call SIGINT, SIGTERM and SIGHUP request a stop instead of ending the process. A
/// process gets SIGHUP when its terminal or connection is lost; the signal stays ignored if it was
/// ignored before, as `nohup` arranges. main() calls this function once.
void catch_interrupts();

/// The token that requests a stop after one of these signals has come.
StopToken interrupt_token();

}  // namespace viscontact::app
