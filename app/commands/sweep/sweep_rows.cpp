// Computes the rows of a sweep of one sphere or of a swimmer, shows the progress, and says how many
// failed (sweep_options.hpp).
#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "viscontact/app/commands/interrupt.hpp"
#include "viscontact/app/commands/sweep/sweep_options.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/sweep/sweep_file.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::app {
namespace {

/// The remaining time in words, "about 3 min left", estimated from the rows of this call.
class Remaining {
 public:
  std::string after(std::uint64_t done, std::uint64_t size) {
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

/// Says at how many points models or strokes (`what`) failed, "; ... failed at 3 points"; empty if
/// none did.
std::string failures_in_words(const sweep::SweepOutcome& outcome, const std::string& what) {
  const auto points = [](std::uint64_t n) {
    return fmt::format("{} point{}", n, n == 1 ? "" : "s");
  };
  std::string text;
  if (outcome.without_result > 0)
    text += fmt::format("; every {} failed at {}", what, points(outcome.without_result));
  if (outcome.with_some_results > 0)
    text += fmt::format("; some {}s failed at {}", what, points(outcome.with_some_results));
  return text.empty() ? text : text + " (the column 'failure' says why)";
}

}  // namespace

void write_rows(const SweepOptions& o, const sweep::Rows& rows,
                const std::vector<std::filesystem::path>& files, const std::string& what) {
  const auto provenance = results::provenance_of({files, {}});

  Remaining remaining;
  terminal::ProgressTimer progress;
  const auto computed = sweep::write_sweep(
      rows, o.output, o.jobs,
      results::output_text(o.output, TextKind::kHashComment, "", provenance),
      [&](std::uint64_t done, std::uint64_t size) {
        if (!progress.is_due()) return;
        terminal::show_progress(
            fmt::format("sweep: {} of {}{}", done, size, remaining.after(done, size)));
      },
      interrupt_token());
  terminal::clear_progress();
  const auto outcome = sweep::read_outcome(rows, o.output);
  terminal::say((computed == 0 ? fmt::format("sweep: {} is up to date", o.output)
                               : fmt::format("sweep: {} rows in {}{}", rows.size, o.output,
                                             computed < rows.size
                                                 ? fmt::format(", {} of them already computed",
                                                               rows.size - computed)
                                                 : "")) +
                failures_in_words(outcome, what));
  if (outcome.without_result == outcome.points)
    throw Error(ErrorKind::kNotConverged,
                fmt::format("{}: every {} failed at every point; the column 'failure' says why, "
                            "at the first point: {}",
                            o.output, what, outcome.first_failure));
}

}  // namespace viscontact::app
