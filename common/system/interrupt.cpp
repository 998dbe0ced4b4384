#include "viscontact/common/system/interrupt.hpp"

#include <atomic>
#include <csignal>

#include "viscontact/common/error.hpp"

namespace viscontact {
namespace {

// A signal handler can reach nothing but a global, and that must be atomic without a lock: other threads read it.
std::atomic<bool> signal_came = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void remember_signal(int) { signal_came = true; }

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = remember_signal;  // no SA_RESTART: waits end at once
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction before = {};
  if (sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
    sigaction(SIGHUP, &action, nullptr);
  // A limit on the size of files then makes a write fail, which is reported, instead of ending the process.
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() { return signal_came; }

void throw_if_interrupted() {
  if (interrupted())
    throw Error(ErrorKind::kInterrupted, "interrupted; everything finished so far is kept");
}

}  // namespace viscontact
