// Distributes the rows over threads, each of which runs one FreeFEM process at a time.
#include "viscontact/freefem_axi/journal/tabulate.hpp"

#include <atomic>
#include <cassert>
#include <chrono>
#include <mutex>
#include <thread>

#include "viscontact/common/error.hpp"
#include "viscontact/freefem_axi/journal/row_journal.hpp"

namespace viscontact::freefem_axi {
namespace {

/// The version is needed before the first row, so that a missing FreeFEM is reported once and not
/// for each row. A worker with a name is a job on a cluster, whose messages may go unread. If
/// FreeFEM is missing there, each of `points` is also written to the journal as failed.
std::string version_for(const RowWorker& worker, const std::vector<RowPoint>& points,
                        const std::filesystem::path& journal_file, const std::string& hash) {
  try {
    return freefem_version(worker.freefem);
  } catch (const Error& error) {
    if (!worker.name.empty() && error.kind() == ErrorKind::kExternalProgram) {
      RowJournal journal(journal_file, hash);
      for (const auto& point : points) journal.append(FailedRow{point, error.what()});
    }
    throw;
  }
}

/// The row is failed if it throws Error(kExternalProgram). Other errors are thrown.
JournalEntry solve(const FreeFem& freefem, const std::string& version, const TablePlan& plan,
                   const RowPoint& point) {
  try {
    return FinishedRow{point, plan.solve(freefem, point), version};
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kExternalProgram) throw;
    return FailedRow{point, error.what()};
  }
}

}  // namespace

void compute_rows(const RowWorker& worker, const TablePlan& plan,
                  const std::vector<RowPoint>& points, const std::filesystem::path& table_path,
                  const TabulateReport& report) {
  assert(worker.jobs >= 1 && report);
  const auto missing = missing_points(read_row_record(table_path, plan), points);
  if (missing.empty()) return;
  const auto journal_file = journal_path(table_path, worker.name);
  const std::string version = version_for(worker, missing, journal_file, plan.hash);
  RowJournal journal(journal_file, plan.hash);

  std::mutex mutex;  // protects the journal and the report
  std::exception_ptr fatal;
  std::atomic<std::size_t> next = 0;
  std::size_t finished = 0;
  const auto start = std::chrono::steady_clock::now();
  const auto work = [&] {
    for (std::size_t i = 0;
         !worker.freefem.stop.stop_requested() && (i = next++) < missing.size();) {
      try {
        if (!read_row_record(table_path, plan).finished.contains(missing[i])) {
          const auto entry = solve(worker.freefem, version, plan, missing[i]);
          const std::scoped_lock lock(mutex);
          journal.append(entry);
        }
      } catch (...) {
        // The cause is not this row, but for example Ctrl-C or a full disk, so that the other rows
        // would fail, too.
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
      report({points.size() - left, points.size(),
              elapsed / static_cast<double>(finished) * static_cast<double>(left)});
    }
  };
  {
    std::vector<std::jthread> workers;
    workers.reserve(static_cast<std::size_t>(worker.jobs));
    for (int i = 0; i < worker.jobs; ++i) workers.emplace_back(work);
  }
  if (fatal) std::rethrow_exception(fatal);
  worker.freefem.stop.throw_if_stop_requested();
}

}  // namespace viscontact::freefem_axi
