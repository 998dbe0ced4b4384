// Computes rows on several threads (rows.hpp). Threads compute rows in any order, but the rows must
// be passed on in order, so that the file does not depend on the number of threads.
#include "viscontact/sweep/rows.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

namespace viscontact::sweep {

std::string as_field(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == ',' || c == '\n' || c == '\r'; }, ';');
  return text;
}

std::uint64_t run_rows(const Rows& rows, std::uint64_t begin, int jobs,
                       const std::function<void(std::uint64_t index, const std::string& row)>& take,
                       const StopToken& stop) {
  const std::uint64_t size = rows.size;
  // At most so many rows are begun and not yet taken. This limits the memory.
  const std::uint64_t window = 32 * static_cast<std::uint64_t>(jobs);
  std::mutex mutex;
  std::condition_variable row_taken;
  std::map<std::uint64_t, std::string> finished;
  std::uint64_t next = begin, taken = begin;
  std::exception_ptr error;
  const auto work = [&] {
    std::unique_lock lock(mutex);
    for (;;) {
      row_taken.wait(lock, [&] { return error || next >= size || next < taken + window; });
      if (error || next >= size || stop.stop_requested()) return;
      const std::uint64_t index = next++;
      lock.unlock();
      std::string row;
      std::exception_ptr thrown;
      try {
        row = rows.row(index, stop);
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      if (thrown && stop.stop_requested()) return;  // the stop came while a row was computed
      if (thrown) {
        error = thrown;
        row_taken.notify_all();
        return;
      }
      finished.emplace(index, std::move(row));
      try {
        for (auto first = finished.begin();
             first != finished.end() && first->first == taken && !error;
             first = finished.erase(first)) {
          take(taken, first->second);
          ++taken;
        }
      } catch (...) {
        error = std::current_exception();
      }
      row_taken.notify_all();
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < jobs; ++i) threads.emplace_back(work);
  }
  if (error) std::rethrow_exception(error);
  return taken;
}

}  // namespace viscontact::sweep
