// Computes the rows of a sweep, shows its progress, and says at its end how many rows failed.
#include "viscontact/pipeline/sweep_stage.hpp"

#include <fmt/format.h>

#include <cassert>
#include <chrono>
#include <optional>

#include "viscontact/common/error.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::pipeline {
namespace {

/// The remaining time in words, from the rows that this process computed.
class Remaining {
 public:
  /// The words when `done` of `size` rows are finished. They are empty if no row has been finished
  /// since the first call, because there is no estimate then.
  std::string after(std::uint64_t done, std::uint64_t size) {
    assert(done <= size);
    if (!first_) first_ = done;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    if (done <= *first_) return "";
    const double left =
        spent.count() / static_cast<double>(done - *first_) * static_cast<double>(size - done);
    return left > 90 ? fmt::format(", about {:.0f} min left", left / 60)
                     : fmt::format(", about {:.0f} s left", left);
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<std::uint64_t> first_;
};

/// At how many points every part of a row, or some parts, failed, such as "; every model failed at
/// 3 points"; empty if none failed.
std::string failures_in_words(const sweep::SweepOutcome& outcome, const std::string& part) {
  const auto points = [](std::uint64_t n) {
    return fmt::format("{} point{}", n, n == 1 ? "" : "s");
  };
  std::string text;
  if (outcome.without_result > 0)
    text += fmt::format("; every {} failed at {}", part, points(outcome.without_result));
  if (outcome.with_some_results > 0)
    text += fmt::format("; some {}s failed at {}", part, points(outcome.with_some_results));
  return text.empty() ? text : text + " (the column 'failure' says why)";
}

}  // namespace

std::uint64_t write_rows(const sweep::Study& study, const SweepStageRequest& request,
                         const results::Inputs& inputs,
                         const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
  assert(request.jobs >= 1);
  const auto computed =
      sweep::write_sweep(study, request.output, request.jobs,
                         results::output_text(request.output, TextKind::kHashComment, "",
                                              results::provenance_of(inputs)),
                         progress, request.stop);
  terminal::clear_progress();
  return computed;
}

void run_sweep(const sweep::Study& study, const SweepStageRequest& request,
               const results::Inputs& inputs, const std::string& part) {
  const auto& output = request.output;
  Remaining remaining;
  terminal::ProgressTimer timer;
  const auto computed =
      write_rows(study, request, inputs, [&](std::uint64_t done, std::uint64_t size) {
        if (timer.is_due())
          terminal::show_progress(
              fmt::format("sweep: {} of {}{}", done, size, remaining.after(done, size)));
      });
  const auto outcome = sweep::read_outcome(study, output);
  terminal::say((computed == 0 ? fmt::format("sweep: {} is up to date", output)
                               : fmt::format("sweep: {} rows in {}{}", study.size(), output,
                                             computed < study.size()
                                                 ? fmt::format(", {} of them already computed",
                                                               study.size() - computed)
                                                 : "")) +
                failures_in_words(outcome, part));
  if (outcome.without_result == outcome.points)
    throw Error(
        ErrorKind::kNotConverged,
        "{}: every {} failed at every point; the column 'failure' says why, at the first point: {}",
        output, part, outcome.first_failure);
}

}  // namespace viscontact::pipeline
