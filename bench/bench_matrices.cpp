// Errors, error estimates, time and memory of resistance matrices of three spheres on a line in
// unbounded fluid, beside exact ones (tests/oracles/collinear_spheres.hpp).
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "bench/statistics.hpp"
#include "tests/oracles/collinear_spheres.hpp"
#include "viscontact/common/splitmix.hpp"
#include "viscontact/swimmer/resistance/resistance_table.hpp"
#include "viscontact/swimmer/tabulation/collinear_spheres.hpp"

namespace viscontact {
namespace {

constexpr double kAccuracy = 1e-5;

void measure(int rows, std::uint64_t seed) {
  const auto freefem = freefem_axi::default_freefem();
  SplitMix64 random(seed);
  std::vector<double> errors, ratios, seconds;
  for (int n = 0; n < rows; ++n) {
    std::vector<double> radii = {1, 1, 1}, gaps;
    if (n % 2 == 1)
      for (double& radius : radii) radius = log_uniform(random, 0.5, 2);
    for (std::size_t k = 0; k < 2; ++k)
      gaps.push_back(log_uniform(random, 0.02, 8) * std::min(radii[k], radii[k + 1]));
    const auto row = swimmer::solve_resistance(freefem, {1, radii, {}, kAccuracy}, gaps);
    seconds.push_back(row.seconds);
    const auto exact = exact_resistance(radii, gaps);
    const auto computed = swimmer::matrix_of(row, 3);
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = i; j < 3; ++j) {
        const double scale =
            std::max(std::abs(exact(i, j)), 1e-3 * std::sqrt(exact(i, i) * exact(j, j)));
        const double error = std::abs(computed(i, j) - exact(i, j)) / scale;
        const auto at =
            swimmer::entry_position(static_cast<std::size_t>(i), static_cast<std::size_t>(j), 3);
        errors.push_back(error);
        ratios.push_back(error / row.relative_error_estimates[at]);
        if (ratios.back() > 1)
          fmt::print(
              "  radii {:.4g} {:.4g} {:.4g}, gaps {:.4g} {:.4g}: R{}{} has error {:.2g}, "
              "estimate {:.2g}\n",
              radii[0], radii[1], radii[2], gaps[0], gaps[1], i + 1, j + 1, error,
              row.relative_error_estimates[at]);
      }
  }
  const auto true_estimates = std::ranges::count_if(ratios, [](double r) { return r <= 1; });
  fmt::print(
      "{} entries at {}: error median {:.2g}, largest {:.2g}; at most the estimate: {:.1f} %; "
      "error over estimate: median {:.2g}, largest {:.2g}; seconds a row: median {:.1f}, "
      "largest {:.1f}\n",
      errors.size(), kAccuracy, median(errors), std::ranges::max(errors),
      100 * static_cast<double>(true_estimates) / static_cast<double>(ratios.size()),
      median(ratios), std::ranges::max(ratios), median(seconds), std::ranges::max(seconds));
}

void measure_ten() {
  for (const double gap : {1.0, 8.0}) {
    const auto row =
        swimmer::solve_resistance(freefem_axi::default_freefem(),
                                  {1, std::vector(10, 1.0), {}, kAccuracy}, std::vector(9, gap));
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    fmt::print(
        "ten spheres, gaps {}: {:.1f} s, {:.0f} unknowns, largest estimate {:.2g}, peak memory "
        "{:.0f} MB\n",
        gap, row.seconds, row.degrees_of_freedom, row.relative_error_estimate,
        static_cast<double>(usage.ru_maxrss) / 1024);
  }
}

}  // namespace
}  // namespace viscontact

// bench_matrices [ROWS=20 [SEED=1]]: prints every entry whose error is above its estimate, then
// sums over all entries; last, the time [s] and the peak memory of one row of ten spheres.
int main(int argc, char** argv) {
  viscontact::measure(argc > 1 ? std::atoi(argv[1]) : 20,
                      argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
  viscontact::measure_ten();
}
