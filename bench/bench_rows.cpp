// Rows of the tabulation: error against exact solutions, error estimate, CPU time [s] and memory;
// then the error of a textbook script (textbook.edp) in the same time.
#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "tests/oracles/bispherical/bispherical.hpp"
#include "tests/oracles/cylinder/sphere_in_cylinder.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact {
namespace {

double child_cpu_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// `estimate` is relative; the drag factor is the drag over Stokes' drag.
struct Row {
  double drag_factor = 0, estimate = 0, unknowns = 0, cpu_seconds = 0, peak_megabytes = 0;
};

Row solve(const freefem_axi::FreeFem& freefem, const freefem_axi::Tabulation& tabulation,
          double gap) {
  const double before = child_cpu_seconds();
  const auto result =
      freefem_axi::run_freefem(freefem, freefem_axi::find_geometry(tabulation.geometry).script,
                               freefem_axi::row_arguments(tabulation, gap, -1));
  Row row;
  row.cpu_seconds = child_cpu_seconds() - before;
  row.peak_megabytes = static_cast<double>(result.peak_memory_kb) / 1024;
  std::istringstream words(freefem_axi::line_after(result.output, "viscontact-result"));
  words >> row.drag_factor >> row.estimate >> row.unknowns;
  row.drag_factor /= 6 * std::numbers::pi;
  return row;
}

freefem_axi::Tabulation unit(std::string geometry, std::vector<double> parameters,
                             std::optional<freefem_axi::Container> container, double accuracy) {
  freefem_axi::Tabulation tabulation;
  tabulation.viscosity = 1;
  tabulation.radius = 1;
  tabulation.container = container;
  tabulation.relative_accuracy = accuracy;
  tabulation.geometry = std::move(geometry);
  tabulation.geometry_parameters = std::move(parameters);
  return tabulation;
}

void print_row(const freefem_axi::FreeFem& freefem, const std::string& what,
               const freefem_axi::Tabulation& tabulation, double gap, double exact) {
  const auto row = solve(freefem, tabulation, gap);
  fmt::print("{:<24} {:>8} {:>8} {:>9.1e} {:>9.1e} {:>9.0f} {:>7.2f} {:>8.0f}\n", what, gap,
             tabulation.relative_accuracy, std::abs(row.drag_factor / exact - 1), row.estimate,
             row.unknowns, row.cpu_seconds, row.peak_megabytes);
}

void print_header() {
  fmt::print("{:<24} {:>8} {:>8} {:>9} {:>9} {:>9} {:>7} {:>8}\n", "", "gap/r", "asked", "error",
             "estimate", "unknowns", "CPU s", "peak MB");
}

void measure_geometries(const freefem_axi::FreeFem& freefem) {
  print_header();
  for (const double accuracy : {1e-5, 1e-6}) {
    for (const double gap : {1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0}) {
      print_row(freefem, "plane, unbounded", unit("plane", {}, {}, accuracy), gap,
                bispherical_plane_factor(gap));
      print_row(freefem, "free surface, unbounded", unit("free_surface", {}, {}, accuracy), gap,
                free_surface_drag_factor(gap));
      print_row(freefem, "equal spheres", unit("sphere", {1, 0}, {}, accuracy), gap,
                two_sphere_drag_factor(gap, 1, 0));
      if (gap < 4)
        print_row(freefem, "cavity of radius 5", unit("cavity", {5}, {}, accuracy), gap,
                  cavity_drag_factor(gap, 5));
    }
    for (const double radius : {3.0, 5.0, 20.0, 80.0})
      for (const double gap : {1e-4, 1e-2, 1.0, 10.0})
        // The exact solution is for spheres below the middle of the container.
        if (gap + 1 <= radius)
          print_row(freefem, fmt::format("plane, {} x {}", radius, 2 * radius),
                    unit("plane", {}, freefem_axi::Container{radius, 2 * radius}, accuracy), gap,
                    sphere_in_cylinder_drag_factor(gap, radius, 2 * radius));
  }
  fmt::print("\nAt accuracy 1e-7, as the shipped tables\n");
  print_header();
  for (const double gap : {1e-4, 1e-2, 1.0, 10.0})
    print_row(freefem, "plane, unbounded", unit("plane", {}, {}, 1e-7), gap,
              bispherical_plane_factor(gap));
}

void measure_growth(const freefem_axi::FreeFem& freefem) {
  fmt::print("\nCost against the gap, at 1e-5\n");
  print_header();
  for (int i = -6; i <= 0; ++i) {
    const double gap = std::pow(10.0, i);
    print_row(freefem, "plane, unbounded", unit("plane", {}, {}, 1e-5), gap,
              bispherical_plane_factor(gap));
  }
}

/// Prints the error of a row and the smallest error that the textbook script reaches in the CPU
/// time of the row. The round of the script in which this time ends is included.
void measure_textbook(const freefem_axi::FreeFem& freefem) {
  const freefem_axi::FreeFem here{freefem.executable,
                                  std::string(VISCONTACT_SOURCE_FOLDER) + "/bench"};
  fmt::print(
      "\nBeside bench/textbook.edp, at equal CPU time\n{:<8} {:>12} {:>7} {:>14} {:>7} {:>8}\n",
      "gap/r", "error", "CPU s", "textbook error", "CPU s", "ratio");
  for (const double gap : {1.0, 0.1, 0.01, 0.001}) {
    const double exact = bispherical_plane_factor(gap);
    const auto row = solve(freefem, unit("plane", {}, {}, 1e-5), gap);
    const double error = std::abs(row.drag_factor / exact - 1);
    const auto result = freefem_axi::run_freefem(here, "textbook.edp",
                                                 {"-gap", fmt::format("{}", gap), "-rounds", "6"});
    double best = std::numeric_limits<double>::infinity(), seconds = 0;
    for (int round = 0; seconds < row.cpu_seconds; ++round) {
      std::istringstream words(
          freefem_axi::line_after(result.output, fmt::format("textbook {}", round)));
      double force = 0, unknowns = 0;
      if (!(words >> force >> unknowns >> seconds)) break;
      best = std::min(best, std::abs(force / (6 * std::numbers::pi * exact) - 1));
    }
    fmt::print("{:<8} {:>12.1e} {:>7.2f} {:>14.1e} {:>7.2f} {:>8.0f}\n", gap, error,
               row.cpu_seconds, best, seconds, best / error);
  }
}

}  // namespace
}  // namespace viscontact

int main() {
  try {
    const auto freefem = viscontact::freefem_axi::default_freefem();
    viscontact::measure_geometries(freefem);
    viscontact::measure_growth(freefem);
    viscontact::measure_textbook(freefem);
  } catch (const viscontact::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return EXIT_FAILURE;
  }
}
