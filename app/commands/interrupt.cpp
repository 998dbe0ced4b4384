// Installs a signal handler with sigaction (interrupt.hpp). The handler may do nothing but set a
// lock-free flag, because a signal can come in the middle of any function.
#include "viscontact/app/commands/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace viscontact::app {
namespace {

// The flag is a global variable, because a signal handler has no other access to data, and atomic,
// because other threads read it.
std::atomic<bool> signal_came = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void remember_signal(int) { signal_came = true; }

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = remember_signal;  // no SA_RESTART: a system call that waits returns
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction before = {};
  if (sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
    sigaction(SIGHUP, &action, nullptr);
  // With SIGXFSZ ignored, a limit on the size of files makes a write fail with an error, which is
  // reported, instead of ending the process.
  std::signal(SIGXFSZ, SIG_IGN);
}

StopToken interrupt_token() { return StopToken(signal_came); }

}  // namespace viscontact::app
