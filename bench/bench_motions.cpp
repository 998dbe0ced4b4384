// Errors, error estimates and times of the motions across the axis and around it at random gaps,
// beside a plane, a free surface, spheres, and in a cavity.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/statistics.hpp"
#include "tests/oracles/bispherical/pair_loads.hpp"
#include "viscontact/common/splitmix.hpp"
#include "viscontact/freefem_axi/motion_row.hpp"
#include "viscontact/freefem_axi/pair_loads.hpp"

namespace viscontact {
namespace {

using freefem_axi::MotionGroup;
using lubrication::Action;

constexpr double kAccuracy = 1e-5;

struct Sums {
  std::vector<double> errors, ratios, cost;

  void add(const Action& row, const Action& exact, double diagonal, const std::string& what) {
    const auto one = [&](double error, double estimate, const char* name) {
      if (estimate == 0) return;  // the force of a sphere that spins
      errors.push_back(error);
      ratios.push_back(error / estimate);
      if (error > estimate)
        fmt::print("  {}: {} has error {:.2g}, estimate {:.2g}\n", what, name, error, estimate);
    };
    one(std::abs(row.force_factor - exact.force_factor) / diagonal, row.relative_error_estimate,
        "force");
    one(std::abs(row.torque_factor - exact.torque_factor) / diagonal, row.torque_error_estimate,
        "torque");
  }
};

freefem_axi::Tabulation random_pair(SplitMix64& random, int number) {
  freefem_axi::Tabulation tabulation;
  tabulation.viscosity = tabulation.radius = 1;
  tabulation.relative_accuracy = kAccuracy;
  const std::vector<std::string> geometries = {"plane", "free_surface", "sphere", "cavity"};
  tabulation.geometry = geometries.at(static_cast<std::size_t>(number) % geometries.size());
  if (tabulation.geometry == "sphere") {
    // Every second neighbour has a velocity and a rotation of its own.
    const double most = number % 8 == 2 ? 2 : 0;
    const double radius = log_uniform(random, 0.2, 5);
    const double velocity_ratio = most * (2 * random.unit() - 1);
    const double rotation_ratio = most * (2 * random.unit() - 1);
    tabulation.geometry_parameters = {radius, velocity_ratio, rotation_ratio};
  }
  if (tabulation.geometry == "cavity") tabulation.geometry_parameters = {12};
  return tabulation;
}

void measure_motions(int rows, std::uint64_t seed) {
  const auto freefem = freefem_axi::default_freefem();
  SplitMix64 random(seed);
  Sums sums;
  for (int n = 0; n < rows; ++n) {
    auto tabulation = random_pair(random, n);
    const double gap = log_uniform(random, 1e-3, 10);
    double seconds = 0;
    const auto approach = solve_row(freefem, tabulation, gap, 1);
    for (const auto group : {MotionGroup::kAcross, MotionGroup::kAround}) {
      tabulation.relative_accuracy = kAccuracy;
      const auto row = solve_motions(freefem, tabulation, group, gap);
      seconds += row.front().seconds;
      tabulation.relative_accuracy = kAccuracy / 100;
      const auto exact = solve_motions(freefem, tabulation, group, gap);
      for (std::size_t i = 0; i < row.size(); ++i) {
        const auto& result = row[i];
        const bool slides = group == MotionGroup::kAcross && i == 0;
        const double diagonal = slides ? result.force_factor : result.torque_factor;
        const auto what = fmt::format("{}, gap {:.4g}, motion {}",
                                      freefem_axi::geometry_in_words(tabulation), gap, i);
        sums.add(result, exact[i], diagonal, what);
        if (result.neighbour)
          sums.add(*result.neighbour, *exact[i].neighbour, diagonal, what + ", neighbour");
      }
    }
    const double cost = (approach.seconds + seconds) / approach.seconds;
    constexpr double kMost = 4;
    if (cost > kMost)
      fmt::print("  {}, gap {:.4g}: all motions cost {:.1f} times the approach\n",
                 freefem_axi::geometry_in_words(tabulation), gap, cost);
    sums.cost.push_back(cost);
  }
  const auto true_estimates = std::ranges::count_if(sums.ratios, [](double r) { return r <= 1; });
  fmt::print(
      "{} entries at {}: error median {:.2g}, largest {:.2g}; at most the estimate: {:.1f} %; "
      "error "
      "over estimate: median {:.2g}, largest {:.2g}; all motions over the approach: median {:.2f}, "
      "largest {:.2f}\n",
      sums.errors.size(), kAccuracy, median(sums.errors), std::ranges::max(sums.errors),
      100 * static_cast<double>(true_estimates) / static_cast<double>(sums.ratios.size()),
      median(sums.ratios), std::ranges::max(sums.ratios), median(sums.cost),
      std::ranges::max(sums.cost));
}

/// Loads of a group in the order of freefem_axi::PairLoads::loads, by bispherical harmonics.
std::vector<double> exact_loads(const PairLoads& exact, const freefem_axi::PairLoads& of) {
  const auto& matrix = of.group == MotionGroup::kAlong    ? exact.axial
                       : of.group == MotionGroup::kAcross ? exact.transverse
                       : of.group == MotionGroup::kAround ? exact.spin
                                                          : exact.twofold;
  if (of.sources_of_body == 0) return {};
  std::vector<double> loads(of.loads.size());
  for (std::size_t body = 0; body < of.bodies; ++body)
    for (std::size_t load = 0; load < of.loads_of_body; ++load)
      for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
        const auto source = static_cast<std::size_t>(column);
        const bool is_trace = load >= of.sources_of_body;
        loads.at(of.place(body, load, source / of.sources_of_body, source % of.sources_of_body)) =
            is_trace ? exact.trace(static_cast<Eigen::Index>(body), column)
                     : matrix(static_cast<Eigen::Index>(body * of.sources_of_body + load), column);
      }
  return loads;
}

/// Seconds of the processor that the ended processes of FreeFEM took. Unlike the time of a row, it
/// hardly depends on what else the machine does.
double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Times of rows with all motions and strains over those of all motions alone, in turn plane and
/// sphere. Both at the accuracy that shipped tables have.
void measure_strains(int rows, std::uint64_t seed) {
  constexpr double kOfTables = 1e-6;
  const auto freefem = freefem_axi::default_freefem();
  SplitMix64 random(seed);
  std::vector<double> costs, ratios;
  double largest_estimate = 0;
  for (int n = 0; n < rows; ++n) {
    auto tabulation = random_pair(random, 2 * n);
    if (tabulation.geometry == "sphere") tabulation.geometry_parameters.resize(1);
    tabulation.geometry_parameters.resize(tabulation.geometry == "sphere" ? 3 : 0);
    tabulation.relative_accuracy = kOfTables;
    const double gap = log_uniform(random, 1e-3, 5);
    double start = cpu_seconds(), strains = 0;
    (void)solve_row(freefem, tabulation, gap, 1);
    for (const auto group : {MotionGroup::kAcross, MotionGroup::kAround})
      (void)solve_motions(freefem, tabulation, group, gap);
    const double motions = cpu_seconds() - start;
    const auto exact = tabulation.geometry == "sphere"
                           ? exact_pair_loads(1, tabulation.geometry_parameters.at(0), gap)
                           : exact_loads_above_plane(1, gap);
    std::string times;
    for (const auto group :
         {MotionGroup::kAlong, MotionGroup::kAcross, MotionGroup::kAround, MotionGroup::kTwofold}) {
      start = cpu_seconds();
      const auto loads = solve_pair_loads(freefem, tabulation, group, gap);
      const double seconds = cpu_seconds() - start;
      strains += seconds;
      times += fmt::format(" {:.1f}", seconds);
      largest_estimate = std::max(largest_estimate, loads.largest_relative_error);
      const auto expected = exact_loads(exact, loads);
      for (std::size_t i = 0; i < expected.size(); ++i)
        ratios.push_back(std::abs(loads.loads[i] - expected[i]) / loads.errors[i]);
    }
    costs.push_back(strains / motions);
    fmt::print("  {}, gap {:.4g}: motions {:.1f} s, with strains{} = {:.1f} s, {:.2f} times\n",
               freefem_axi::geometry_in_words(tabulation), gap, motions, times, strains,
               costs.back());
  }
  fmt::print(
      "with strains over all motions: median {:.2f}, largest {:.2f}; {} loads: estimates over "
      "the size at most {:.2g}, errors over their estimates: median {:.2g}, largest {:.2g}\n",
      median(costs), std::ranges::max(costs), ratios.size(), largest_estimate, median(ratios),
      std::ranges::max(ratios));
}

/// The largest |load| of a kind (force, torque, stresslet, trace) by any source of the group.
double largest_of_kind(const freefem_axi::PairLoads& loads, std::size_t load) {
  double largest = 0;
  for (std::size_t body = 0; body < loads.bodies; ++body)
    for (std::size_t of = 0; of < loads.bodies; ++of)
      for (std::size_t source = 0; source < loads.sources_of_body; ++source)
        largest = std::max(largest, std::abs(loads.loads[loads.place(body, load, of, source)]));
  return largest;
}

struct ExactSums {
  std::vector<double> ratios;  ///< error over its estimate
  std::vector<double> errors;  ///< error over the largest load of its kind
  double largest_estimate = 0, asymmetry = 0, traction_mismatch = 0;

  void add(const freefem_axi::PairLoads& loads, const std::vector<double>& expected) {
    for (std::size_t load = 0; load < loads.loads_of_body; ++load)
      for (std::size_t body = 0; body < loads.bodies; ++body)
        for (std::size_t of = 0; of < loads.bodies; ++of)
          for (std::size_t source = 0; source < loads.sources_of_body; ++source) {
            const auto i = loads.place(body, load, of, source);
            const double error = std::abs(loads.loads[i] - expected[i]);
            ratios.push_back(error / loads.errors[i]);
            errors.push_back(error / largest_of_kind(loads, load));
          }
    largest_estimate = std::max(largest_estimate, loads.largest_relative_error);
    asymmetry = std::max(asymmetry, loads.asymmetry);
    traction_mismatch = std::max(traction_mismatch, loads.traction_mismatch);
  }
};

/// Rows with everything at 1e-6 beside exact ones; every fifth is above a plane.
void measure_exact(int rows, std::uint64_t seed) {
  constexpr double kOfTables = 1e-6;
  const auto freefem = freefem_axi::default_freefem();
  SplitMix64 random(seed);
  ExactSums sums;
  int true_rows = 0;
  for (int n = 0; n < rows; ++n) {
    freefem_axi::Tabulation tabulation;
    tabulation.viscosity = tabulation.radius = 1;
    tabulation.relative_accuracy = kOfTables;
    const double ratio = log_uniform(random, 0.2, 5), gap = log_uniform(random, 1e-3, 5);
    const bool plane = n % 5 == 4;
    tabulation.geometry = plane ? "plane" : "sphere";
    if (!plane) tabulation.geometry_parameters = {ratio, 0, 0};
    const auto exact = plane ? exact_loads_above_plane(1, gap) : exact_pair_loads(1, ratio, gap);
    ExactSums row;
    const double start = cpu_seconds();
    for (const auto group :
         {MotionGroup::kAlong, MotionGroup::kAcross, MotionGroup::kAround, MotionGroup::kTwofold}) {
      const auto loads = solve_pair_loads(freefem, tabulation, group, gap);
      row.add(loads, exact_loads(exact, loads));
      sums.add(loads, exact_loads(exact, loads));
    }
    const double worst = std::ranges::max(row.ratios);
    if (worst <= 1) ++true_rows;
    fmt::print(
        "{} {}, gap {:.4g}: {} loads, error at most {:.2g} of the largest of its kind and {:.2g} "
        "of its "
        "estimate, estimate at most {:.2g}, traction {:.1e}, {:.1f} CPU s\n",
        n + 1, freefem_axi::geometry_in_words(tabulation), gap, row.ratios.size(),
        std::ranges::max(row.errors), worst, row.largest_estimate, row.traction_mismatch,
        cpu_seconds() - start);
    std::fflush(stdout);
  }
  fmt::print(
      "{} loads of {} rows: errors over the largest of their kind median {:.2g}, largest {:.2g}; "
      "over "
      "their estimates median {:.2g}, largest {:.2g}; all estimates true in {} rows; estimates at "
      "most {:.2g}; asymmetry at most {:.1e}, difference from tractions {:.1e}\n",
      sums.errors.size(), rows, median(sums.errors), std::ranges::max(sums.errors),
      median(sums.ratios), std::ranges::max(sums.ratios), true_rows, sums.largest_estimate,
      sums.asymmetry, sums.traction_mismatch);
}

}  // namespace
}  // namespace viscontact

// bench_motions [ROWS=12 [SEED=1]]: prints every entry whose error is above its estimate and every
// row whose cost is high, then sums over all entries, and the time of all motions over that of the
// approach alone. The reference is the same row at a hundredth of the accuracy, whose own error was
// checked above a plane against exact values (tests/freefem_axi/motions).
// bench_motions strains [ROWS=6 [SEED=1]]: times of rows with strains.
// bench_motions exact [ROWS=60 [SEED=1]]: errors and estimates of rows with strains.
int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "exact") {
    viscontact::measure_exact(argc > 2 ? std::atoi(argv[2]) : 60,
                              argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1);
    return 0;
  }
  if (argc > 1 && std::string(argv[1]) == "strains") {
    viscontact::measure_strains(argc > 2 ? std::atoi(argv[2]) : 6,
                                argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1);
    return 0;
  }
  viscontact::measure_motions(argc > 1 ? std::atoi(argv[1]) : 12,
                              argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
}
