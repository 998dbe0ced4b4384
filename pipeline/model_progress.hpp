// The progress line of `simulate`: how far a model has come in the motion's time.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <utility>

#include "viscontact/terminal/progress.hpp"

namespace viscontact {

/// Shows the percentage of the motion's time that a model has computed, at most ten times a second.
class ProgressOfModel {
 public:
  /// `which` names the model in words; `end_time` [T] > 0 is the end of the motion.
  ProgressOfModel(std::string which, double end_time)
      : which_(std::move(which)), end_time_(end_time) {}

  /// To be called after each step with the time [T] that the model has reached.
  void operator()(double time) {
    constexpr auto kBetween = std::chrono::milliseconds(100);
    const auto now = std::chrono::steady_clock::now();
    if (now - shown_ < kBetween) return;
    shown_ = now;
    show_progress(fmt::format("simulate: {}, {:.0f} %", which_, 100 * time / end_time_));
  }

 private:
  std::string which_;
  double end_time_;
  std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();
};

}  // namespace viscontact
