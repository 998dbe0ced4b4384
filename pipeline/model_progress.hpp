// How far a model of motion has come, on a terminal.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <utility>

#include "viscontact/terminal/progress.hpp"

namespace viscontact {

/// Shows on a terminal how far a model has come in the motion's time, ten times a second at most.
class ProgressOfModel {
 public:
  /// `which`: the model in words.
  ProgressOfModel(std::string which, double end_time)
      : which_(std::move(which)), end_time_(end_time) {}

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
