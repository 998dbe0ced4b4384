// A flag by which a long computation is asked to stop. All parts with long computations have a
// StopToken as an argument and check it between two pieces of work; they do not know who requests
// the stop. Only throw_if_stop_requested() throws; its error is an Error(kInterrupted).
// app/arguments/interrupt.cpp sets the flag at Ctrl-C. The words of the error may be changed; a
// change must keep that the flag can be checked on any thread.
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
