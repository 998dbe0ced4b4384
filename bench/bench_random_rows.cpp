// Rows at random gaps, geometries, containers, motions and units, none of which may fail; the units
// of radius, viscosity and velocity each vary over ten decades.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "bench/statistics.hpp"
#include "tests/freefem_axi/accuracy/exact_rows.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/freefem_axi/motion_row.hpp"

namespace viscontact {
namespace {

using freefem_axi::MotionGroup;
using freefem_axi::Random;

/// CPU seconds of all FreeFEM processes so far. On a shared machine they vary less than the time
/// that passes.
double cpu_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct RandomRow {
  std::string kind;
  freefem_axi::Tabulation tabulation;
  std::optional<MotionGroup> motions;  ///< nothing: the approach
  std::optional<double> drag_factor;   ///< the exact one of an approach, if it is known
};

/// A row of a kind without an exact value: another motion, a rough plane, or a free surface or a
/// pair of spheres in a container.
RandomRow draw_without_exact_value(Random& random, double accuracy) {
  const auto pick = [&](int count) {
    return static_cast<int>(freefem_axi::uniform(random, 0, count));
  };
  RandomRow row;
  const double gap = freefem_axi::log_uniform(random, 1e-6, 10);
  const double size = freefem_axi::log_uniform(random, 0.05, 20);
  const double moves = freefem_axi::uniform(random, -2, 2);
  const double turns = freefem_axi::uniform(random, -2, 2);
  const int geometry = pick(5);
  switch (geometry) {
    case 0:
      row.tabulation = freefem_axi::exact_row("plane", gap, {}, accuracy, 1).tabulation;
      break;
    case 1:
      row.tabulation = freefem_axi::exact_row("free_surface", gap, {}, accuracy, 1).tabulation;
      break;
    case 2:
      row.tabulation =
          freefem_axi::exact_row("sphere", gap, {size, moves, turns}, accuracy, 1).tabulation;
      break;
    case 3:
      row.tabulation = freefem_axi::draw_cavity(random, accuracy).tabulation;
      break;
    default: {
      const double wavelength = freefem_axi::log_uniform(random, 0.05, 1);
      row.tabulation =
          freefem_axi::exact_row("rough_plane", gap, {0.2 * wavelength, wavelength}, accuracy, 1)
              .tabulation;
    }
  }
  const double least = 2 * std::max(1., geometry == 2 ? size : 1.);
  if (geometry != 3 && pick(2) == 1) {
    const double radius = least * freefem_axi::log_uniform(random, 1.1, 20);
    row.tabulation.container = freefem_axi::Container{radius, gap + 2 * least + 2 * radius};
  }
  // The approach is drawn where its drag is not known exactly.
  const bool may_approach = geometry == 4 || row.tabulation.container;
  const int motion = pick(3);
  if (motion == 2 || (motion == 1 && geometry == 4) || (motion == 0 && !may_approach))
    row.motions = MotionGroup::kAround;
  else if (motion == 1)
    row.motions = MotionGroup::kAcross;
  row.kind = row.tabulation.geometry + (row.tabulation.container ? ", container" : "") +
             (!row.motions                           ? ", approach"
              : *row.motions == MotionGroup::kAcross ? ", slide and roll"
                                                     : ", spin");
  return row;
}

RandomRow draw(Random& random, int number) {
  const double accuracy = freefem_axi::log_uniform(random, 1e-5, 1e-2);
  const auto kinds = freefem_axi::exact_rows();
  const auto kind = static_cast<std::size_t>(number) % (2 * kinds.size());
  RandomRow row;
  if (kind < kinds.size()) {
    const auto exact = kinds[kind].draw(random, accuracy);
    row = {std::string(kinds[kind].name) + ", exact drag", exact.tabulation, {}, exact.drag_factor};
  } else {
    row = draw_without_exact_value(random, accuracy);
  }
  const auto unit = [&] { return freefem_axi::log_uniform(random, 1e-5, 1e5); };
  const double radius = unit(), viscosity = unit(), speed = unit();
  row.tabulation = freefem_axi::in_units(row.tabulation, radius, viscosity, speed);
  return row;
}

struct Solved {
  double estimate = 0;          ///< relative error estimate
  double mismatch = 0;          ///< relative difference between reactions and stress
  double seconds = 0;           ///< CPU time [s]
  std::optional<double> ratio;  ///< error over its estimate
};

Solved solve(const freefem_axi::FreeFem& freefem, const RandomRow& row) {
  const double gap = row.tabulation.gaps.front();
  std::string output;
  Solved solved;
  const double before = cpu_seconds();
  if (row.motions) {
    (void)solve_motions(freefem, row.tabulation, *row.motions, gap, {}, &output);
  } else {
    const auto answer = solve_row(freefem, row.tabulation, gap,
                                  row.tabulation.reference_velocities.front(), {}, &output);
    if (row.drag_factor)
      solved.ratio =
          std::abs(answer.force_factor / *row.drag_factor - 1) / answer.relative_error_estimate;
  }
  solved.seconds = cpu_seconds() - before;
  std::istringstream words(freefem_axi::line_after(output, "viscontact-result"));
  double force = 0, unknowns = 0, order = 0;
  words >> force >> solved.estimate >> unknowns >> order >> solved.mismatch;
  return solved;
}

std::string in_words(const RandomRow& row) {
  const auto& t = row.tabulation;
  return fmt::format("{}: {}, {}, gap/r {:.6g}, asked {:.2g}, r {:.3g}, mu {:.3g}, u {:.3g}",
                     row.kind, geometry_in_words(t), container_in_words(t),
                     t.gaps.front() / t.radius, t.relative_accuracy, t.radius, t.viscosity,
                     t.reference_velocities.front());
}

struct Sums {
  int failed = 0;
  std::vector<double> ratios, estimates, mismatches, seconds;
};

void print_sums(const std::string& kind, const Sums& sums) {
  const auto largest = [](const std::vector<double>& values) {
    return values.empty() ? 0 : std::ranges::max(values);
  };
  const auto middle = [](const std::vector<double>& values) {
    return values.empty() ? 0 : median(values);
  };
  fmt::print("{:<38} {:>5} {:>6} {:>7.2f} {:>7.2f} {:>9.2g} {:>9.1e} {:>7.2f} {:>7.2f}\n", kind,
             sums.seconds.size(), sums.failed, middle(sums.ratios), largest(sums.ratios),
             largest(sums.estimates), largest(sums.mismatches), middle(sums.seconds),
             largest(sums.seconds));
}

int measure(int rows, std::uint64_t seed) {
  const auto freefem = freefem_axi::default_freefem();
  Random random(seed);
  std::map<std::string, Sums> kinds;
  Sums all;
  for (int n = 0; n < rows; ++n) {
    const auto row = draw(random, n);
    auto& sums = kinds[row.kind];
    try {
      const auto solved = solve(freefem, row);
      if (solved.ratio && *solved.ratio > 1)
        fmt::print("  error {:.2f} times its estimate, {}\n", *solved.ratio, in_words(row));
      const double asked = row.tabulation.relative_accuracy;
      if (solved.estimate > asked)
        fmt::print("  estimate {:.2g} times what was asked, {}\n", solved.estimate / asked,
                   in_words(row));
      if (all.seconds.empty() || solved.seconds > std::ranges::max(all.seconds))
        fmt::print("  row {} took {:.1f} s, {}\n", n, solved.seconds, in_words(row));
      for (Sums* to : {&sums, &all}) {
        if (solved.ratio) to->ratios.push_back(*solved.ratio);
        to->estimates.push_back(solved.estimate / asked);
        to->mismatches.push_back(solved.mismatch);
        to->seconds.push_back(solved.seconds);
      }
    } catch (const Error& error) {
      fmt::print("  row {} FAILED, {}: {}\n", n, in_words(row), error.what());
      ++sums.failed;
      ++all.failed;
    }
    std::fflush(stdout);
  }
  fmt::print("{:<38} {:>5} {:>6} {:>15} {:>9} {:>9} {:>15}\n", "", "", "", "error/estimate",
             "estimate", "stress", "CPU seconds");
  fmt::print("{:<38} {:>5} {:>6} {:>7} {:>7} {:>9} {:>9} {:>7} {:>7}\n", "kind", "done", "failed",
             "median", "most", "/asked", "differs", "median", "most");
  for (const auto& [kind, sums] : kinds) print_sums(kind, sums);
  print_sums("all", all);
  return all.failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace viscontact

// bench_random_rows [ROWS=2000 [SEED=1]]
//
// Prints every row that fails, that has a larger error than its estimate, or that took longer than
// all rows before it. Then prints for each kind of row how many there were and how many failed, the
// median and the largest ratio of error to estimate where the exact drag is known, the largest
// estimate over the asked accuracy, the largest difference between reactions and stress (row.idp),
// and the CPU seconds of the median and the longest row. Ends with exit code 1 if a row failed.
// 2000 rows take an hour of one core.
int main(int argc, char** argv) {
  try {
    return viscontact::measure(argc > 1 ? std::atoi(argv[1]) : 2000,
                               argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return EXIT_FAILURE;
  }
}
