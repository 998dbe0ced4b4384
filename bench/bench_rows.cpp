// Error, cost and memory of single rows of the tabulation, against Brenner's exact series. Run by bench/run.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <string>

#include "common/error.hpp"
#include "freefem_axi/freefem.hpp"
#include "tests/oracles/brenner.hpp"

namespace viscontact {
namespace {

double number_in(const std::string& line, int word) {
  std::istringstream words(line);
  double value = 0;
  for (int i = 0; i <= word; ++i) words >> value;
  return value;
}

void measure_row(const FreeFem& freefem, double gap) {
  const auto start = std::chrono::steady_clock::now();
  const auto result = run_freefem(freefem, "plane.edp",
                                  {"-radius",
                                   "1",
                                   "-gap",
                                   fmt::format("{}", gap),
                                   "-viscosity",
                                   "1",
                                   "-velocity",
                                   "-1",
                                   "-containerRadius",
                                   "80",
                                   "-containerHeight",
                                   "160",
                                   "-accuracy",
                                   "1e-5",
                                   "-cells",
                                   "2",
                                   "-levels",
                                   "3",
                                   "-attempts",
                                   "3"});
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double exact = 6 * std::numbers::pi * brenner_drag_factor(gap);
  const auto error = [&](const std::string& line, int word) {
    return number_in(line, word) / exact - 1;
  };
  const auto reported = line_after(result.output, "viscontact-result");
  fmt::print("{:<8} {:>12.1e} {:>12.1e} {:>12.1e} {:>10.1e} {:>9.0f} {:>8.2f} {:>8.0f}\n", gap,
             error(line_after(result.output, "viscontact-level 0"), 0),
             error(line_after(result.output, "viscontact-level 1"), 0), error(reported, 0),
             number_in(reported, 1), number_in(reported, 2), seconds,
             static_cast<double>(result.peak_memory_kb) / 1024);
}

}  // namespace
}  // namespace viscontact

int main() {
  try {
    const auto freefem = viscontact::default_freefem();
    fmt::print("{:<8} {:>12} {:>12} {:>12} {:>10} {:>9} {:>8} {:>8}\n", "gap/r", "err mesh 1",
               "err mesh 2", "err result", "estimate", "unknowns", "seconds", "peak MB");
    for (const double gap : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 1.0, 2.0})
      viscontact::measure_row(freefem, gap);
  } catch (const viscontact::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return EXIT_FAILURE;
  }
}
