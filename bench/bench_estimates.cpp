// Measures how often the error of a row is at most its error estimate, for random rows of every
// geometry with an exact solution.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/freefem_axi/accuracy/exact_rows.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact {
namespace {

std::vector<freefem_axi::SolvedRow> solve_all(const freefem_axi::FreeFem& freefem,
                                              const std::vector<freefem_axi::ExactRow>& rows) {
  std::vector<freefem_axi::SolvedRow> solved;
  std::mutex mutex;  // protects `solved` and the output
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = 0; (i = next++) < rows.size();) try {
        auto row = freefem_axi::solve(freefem, rows[i]);
        const std::scoped_lock lock(mutex);
        if (row.ratio() > 1 || !row.says_reached())
          fmt::print("  {}, ratio {:.2f}\n", row.in_words(), row.ratio());
        solved.push_back(std::move(row));
      } catch (const Error& error) {
        const std::scoped_lock lock(mutex);
        fmt::print("  {}, gap {}: {}\n", freefem_axi::geometry_in_words(rows[i].tabulation),
                   rows[i].gap(), error.what());
      }
  };
  std::vector<std::jthread> workers;
  for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i)
    workers.emplace_back(work);
  workers.clear();  // waits until all threads have ended
  return solved;
}

void print_coverage(const char* name, std::size_t asked, std::vector<freefem_axi::SolvedRow> rows) {
  if (rows.empty()) return;
  const auto share = [&](auto&& test) {
    return 100 * static_cast<double>(std::ranges::count_if(rows, test)) /
           static_cast<double>(rows.size());
  };
  std::ranges::sort(rows, {}, &freefem_axi::SolvedRow::ratio);
  double seconds = 0;
  for (const auto& row : rows) seconds += row.answer.seconds;
  fmt::print("{:<14} {:>5} {:>7} {:>10.1f}% {:>8.2f} {:>8.2f} {:>11.1f}% {:>11.1f}% {:>8.2f}\n",
             name, rows.size(), asked - rows.size(),
             share([](const freefem_axi::SolvedRow& row) { return row.ratio() <= 1; }),
             rows[rows.size() / 2].ratio(), rows.back().ratio(),
             share([](const freefem_axi::SolvedRow& row) { return !row.says_reached(); }),
             share([](const freefem_axi::SolvedRow& row) {
               return row.says_reached() && row.error() > row.row.tabulation.relative_accuracy;
             }),
             seconds / static_cast<double>(rows.size()));
  std::fflush(stdout);
}

void measure(std::size_t rows_per_geometry, double finest_accuracy, unsigned seed,
             const std::string& only) {
  const auto freefem = freefem_axi::default_freefem();
  fmt::print("{:<14} {:>5} {:>7} {:>11} {:>8} {:>8} {:>12} {:>12} {:>8}\n", "geometry", "rows",
             "failed", "err <= est", "median", "largest", "est > asked", "err > asked", "seconds");
  for (const auto& rows : freefem_axi::exact_rows()) {
    if (!only.empty() && only != rows.name) continue;
    freefem_axi::Random random(seed);
    std::vector<freefem_axi::ExactRow> drawn;
    for (std::size_t i = 0; i < rows_per_geometry; ++i) {
      const double accuracy = freefem_axi::log_uniform(random, finest_accuracy, 1e-5);
      drawn.push_back(rows.draw(random, accuracy));
    }
    print_coverage(rows.name, drawn.size(), solve_all(freefem, drawn));
  }
}

}  // namespace
}  // namespace viscontact

// bench_estimates [ROWS_PER_GEOMETRY=100 [FINEST_ACCURACY=1e-7 [SEED=1 [GEOMETRY]]]]
//
// Accuracies are log-uniform from FINEST_ACCURACY to 1e-5. Prints every row whose error is above
// its estimate or whose estimate is above the accuracy, and those that fail, which do not count.
// Then prints for each geometry the share of rows whose error is at most the estimate, median and
// largest value of error/estimate, the share of rows whose estimate is above the accuracy (est >
// asked), and the share of the other rows whose error is above the accuracy (err > asked). With the
// defaults it takes hours on one core.
int main(int argc, char** argv) {
  try {
    const std::vector<std::string> words(argv, argv + argc);
    const auto word = [&](std::size_t i, const char* otherwise) {
      return i < words.size() ? words[i] : otherwise;
    };
    viscontact::measure(std::stoul(word(1, "100")), std::stod(word(2, "1e-7")),
                        static_cast<unsigned>(std::stoul(word(3, "1"))), word(4, ""));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return EXIT_FAILURE;
  }
}
