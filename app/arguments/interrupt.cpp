// The handler sets a lock-free flag only, because a signal can come in the middle of any function.
#include "viscontact/app/arguments/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace viscontact::app {
namespace {

// The flag is a global variable, because a signal handler has no other access to data, and atomic,
// because other threads read it.
std::atomic<bool> signal_came = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void remember_signal(int) { signal_came = true; }

// True if the program was started with SIGHUP ignored, as by nohup. main() would ask too late,
// because some libraries set handlers while they are loaded; one of them is the MPI that SUNDIALS
// of Debian 13 needs. A function in .preinit_array runs before the functions of all libraries.
bool hangup_is_ignored = false;

void look_at_hangup() {
  struct sigaction action = {};
  hangup_is_ignored = sigaction(SIGHUP, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

[[gnu::used, gnu::section(".preinit_array")]] void (*const kLookFirst)() = look_at_hangup;

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = remember_signal;  // without SA_RESTART, a signal ends a waiting call
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  if (hangup_is_ignored)
    std::signal(SIGHUP, SIG_IGN);
  else
    sigaction(SIGHUP, &action, nullptr);
  // With SIGXFSZ ignored, a limit on the size of files makes a write fail with an error, which is
  // reported, instead of ending the process.
  std::signal(SIGXFSZ, SIG_IGN);
}

StopToken interrupt_token() { return StopToken(signal_came); }

}  // namespace viscontact::app
