#include "freefem_axi/tabulate.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "common/error.hpp"
#include "common/interrupt.hpp"
#include "common/number.hpp"
#include "freefem_axi/row_journal.hpp"

namespace viscontact {
namespace {

struct GridPoint {
  double gap, velocity;
};

std::vector<GridPoint> grid_of(const Tabulation& tabulation) {
  std::vector<GridPoint> grid;
  for (const double velocity : tabulation.reference_velocities)
    for (const double gap : tabulation.gaps) grid.push_back({gap, velocity});
  return grid;
}

}  // namespace

ForceTable tabulate(const FreeFem& freefem, const Tabulation& tabulation, int jobs,
                    const std::filesystem::path& journal_path,
                    const std::function<void(const TabulateProgress&)>& report) {
  ForceTable table;
  table.versions["FreeFEM"] =
      freefem_version(freefem);  // first: if FreeFEM is missing, say so once
  table.viscosity = tabulation.viscosity;
  table.radius = tabulation.radius;
  table.geometry = geometry_in_words(tabulation);
  table.container = container_in_words(tabulation);
  table.case_hash = tabulation_hash(tabulation);

  RowJournal journal(journal_path, table.case_hash);
  const auto grid = grid_of(tabulation);
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (!journal.find(grid[i].gap, grid[i].velocity)) missing.push_back(i);

  std::mutex mutex;  // of the journal, the failures and the report
  std::vector<std::string> failures;
  std::exception_ptr fatal;
  std::atomic<std::size_t> next = 0;
  std::size_t finished = 0;
  const auto start = std::chrono::steady_clock::now();
  const auto work = [&] {
    for (std::size_t i = 0; !interrupted() && (i = next++) < missing.size();) {
      const auto [gap, velocity] = grid[missing[i]];
      try {
        const auto row = solve_row(freefem, tabulation, gap, velocity);
        const std::scoped_lock lock(mutex);
        journal.append(row);
      } catch (const Error& error) {
        const std::scoped_lock lock(mutex);
        if (error.exit_code() == ExitCode::kInterrupted) return;
        if (error.exit_code() != ExitCode::kExternalProgram) {
          // Not the row's fault (a full disk): no other row would do better.
          if (!fatal) fatal = std::current_exception();
          next = missing.size();
          return;
        }
        failures.emplace_back(error.what());
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!fatal) fatal = std::current_exception();
        next = missing.size();
        return;
      }
      const std::scoped_lock lock(mutex);
      ++finished;
      const double elapsed =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const std::size_t left = missing.size() - finished;
      report({grid.size() - left, grid.size(),
              elapsed / static_cast<double>(finished) * static_cast<double>(left)});
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < jobs; ++i) workers.emplace_back(work);
  }
  if (fatal) std::rethrow_exception(fatal);
  throw_if_interrupted();
  if (!failures.empty())
    throw Error(ExitCode::kExternalProgram,
                fmt::format("{} of {} rows failed, the others are kept:\n{}", failures.size(),
                            grid.size(), fmt::join(failures, "; ")));
  for (const auto& [gap, velocity] : grid)
    table.rows.push_back(journal.find(gap, velocity).value());
  return table;
}

}  // namespace viscontact
