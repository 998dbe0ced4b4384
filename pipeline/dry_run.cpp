// Computing times from finished rows, from a few rows that are computed now, or from measured
// constants.
#include "viscontact/pipeline/dry_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <nlohmann/json.hpp>

#include "viscontact/freefem_axi/journal/row_record.hpp"

namespace viscontact::pipeline {
namespace {

/// Wall time [s] of the rows that are not finished, if `jobs` of them are computed at once.
double remaining_seconds(const DryRun& run, int jobs) {
  assert(jobs >= 1 && run.finished <= run.rows);
  const auto left = run.rows - run.finished;
  return run.seconds_per_row * static_cast<double>(left) /
         static_cast<double>(std::clamp<std::uint64_t>(left, 1, static_cast<std::uint64_t>(jobs)));
}

/// A time [s] in words, such as "about 3 min".
std::string duration(double seconds) {
  constexpr double kMinute = 60, kHour = 3600, kDay = 86400;
  if (seconds < 0.1) return "less than 0.1 s";
  if (seconds < 10) return fmt::format("about {:.1f} s", seconds);
  if (seconds < 2 * kMinute) return fmt::format("about {:.0f} s", seconds);
  if (seconds < 2 * kHour) return fmt::format("about {:.0f} min", seconds / kMinute);
  if (seconds < 2 * kDay) return fmt::format("about {:.0f} h", seconds / kHour);
  return fmt::format("about {:.0f} days", seconds / kDay);
}

}  // namespace

DryRun dry_run(const CaseTable& one) {
  const auto& grid = one.plan.points;
  DryRun run{one.table.string(),        grid.size(), 0, 0, one.plan.typical_seconds,
             "the shipped tables' rows"};
  const auto record = freefem_axi::read_row_record(one.table, one.plan);
  const auto missing = freefem_axi::missing_points(record, grid);
  run.finished = grid.size() - missing.size();
  run.failed = freefem_axi::failures_of(record, missing).size();
  if (record.finished.empty()) return run;
  run.seconds_per_row = 0;
  for (const auto& [point, row] : record.finished)
    run.seconds_per_row += one.plan.seconds_of(row) / static_cast<double>(record.finished.size());
  run.basis = "its finished rows";
  return run;
}

DryRun dry_run(const sweep::Study& study, const std::string& output, const StopToken& stop) {
  assert(study.size() > 0);
  std::vector<std::uint64_t> sample = {0, study.size() / 2, study.size() - 1};
  sample.erase(std::unique(sample.begin(), sample.end()), sample.end());
  const auto start = std::chrono::steady_clock::now();
  for (const auto index : sample) (void)study.row(index, stop);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  // No row counts as failed: a row in which models fail is finished, and its column `failure` says
  // why.
  return {output,
          study.size(),
          sweep::finished_rows(study, output),
          0,
          spent.count() / static_cast<double>(sample.size()),
          fmt::format("{} of its rows, just computed", sample.size())};
}

std::string dry_run_text(const std::vector<DryRun>& runs, int jobs, bool json) {
  double total = 0;
  for (const auto& run : runs) total += remaining_seconds(run, jobs);
  if (json) {
    nlohmann::ordered_json all = {{"jobs", jobs}, {"seconds", total}};
    for (const auto& run : runs)
      all["outputs"].push_back({{"output", run.output},
                                {"rows", run.rows},
                                {"finished", run.finished},
                                {"failed", run.failed},
                                {"seconds_per_row", run.seconds_per_row},
                                {"estimated_from", run.basis}});
    return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  }
  std::string text;
  for (const auto& run : runs)
    text += fmt::format("{}: {} rows, {} of them finished{}; {:.2g} s a row (from {})\n",
                        run.output, run.rows, run.finished,
                        run.failed > 0 ? fmt::format(", {} failed", run.failed) : "",
                        run.seconds_per_row, run.basis);
  return text + fmt::format("{} with {} at once\n", duration(total), jobs);
}

}  // namespace viscontact::pipeline
