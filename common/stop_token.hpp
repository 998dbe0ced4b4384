// A flag by which a long computation is asked to stop. All parts with long computations take a
// StopToken and check it between two pieces of work; they do not know who requests the stop. Only
// throw_if_stop_requested() throws, Error(kInterrupted). app/arguments/interrupt.cpp sets the flag
// at Ctrl-C. A change must keep that checking is safe on any thread.
#pragma once

#include <atomic>

#include "viscontact/common/error.hpp"

namespace viscontact {

/// A view of a flag that requests a stop. A copy views the same flag; the flag must outlive all its
/// views. A default token never requests a stop. std::stop_token is not used, because a signal
/// handler may set a lock-free atomic, but not call request_stop().
class StopToken {
 public:
  StopToken() = default;
  /// A view of `flag`, which requests a stop while it is true.
  explicit StopToken(const std::atomic<bool>& flag) : flag_(&flag) {}

  /// True if the flag requests a stop. It may be called on any thread.
  bool stop_requested() const { return flag_ != nullptr && *flag_; }

  /// Throws Error(kInterrupted) if stop_requested(); otherwise does nothing.
  void throw_if_stop_requested() const {
    if (stop_requested())
      throw Error(ErrorKind::kInterrupted, "interrupted; everything finished so far is kept");
  }

 private:
  const std::atomic<bool>* flag_ = nullptr;
};

}  // namespace viscontact
