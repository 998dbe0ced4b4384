// A flag by which a long computation is asked to stop between two pieces of work.
#pragma once

#include <atomic>

#include "viscontact/common/error.hpp"

namespace viscontact {

/// A view of a flag that requests a stop; the flag must outlive all its views. A default token
/// never requests a stop. std::stop_token is not used, because a signal handler may set a lock-free
/// atomic, but not call request_stop().
class StopToken {
 public:
  StopToken() = default;
  /// `flag` requests a stop while it is true.
  explicit StopToken(const std::atomic<bool>& flag) : flag_(&flag) {}

  /// It may be called on any thread.
  bool stop_requested() const { return flag_ != nullptr && *flag_; }

  /// Throws Error(kInterrupted) if a stop is requested.
  void throw_if_stop_requested() const {
    if (stop_requested())
      throw Error(ErrorKind::kInterrupted, "interrupted; everything finished so far is kept");
  }

 private:
  const std::atomic<bool>* flag_ = nullptr;
};

}  // namespace viscontact
