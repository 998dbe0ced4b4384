#include "app/doctor.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/versions.hpp"
#include "common/error.hpp"
#include "common/process.hpp"
#include "freefem_axi/tabulation.hpp"

namespace viscontact {
namespace {

bool line(bool good, const std::string& what) {
  fmt::print("{} {}\n", good ? "ok     " : "MISSING", what);
  return good;
}

/// A row of which the exact value is known: gap 0.1 below a sphere of radius 1 in a container so
/// wide that it does not matter at 1e-4 (Brenner 1961: 11.45915720340955722964).
bool solve_known_row(const FreeFem& freefem) {
  constexpr double kBrenner = 11.45915720340955722964;
  constexpr double kTolerance = 1e-4;
  Tabulation tabulation;
  tabulation.viscosity = tabulation.radius = 1;
  tabulation.container = Container{40, 80};
  tabulation.relative_accuracy = kTolerance;
  const auto row = solve_row(freefem, tabulation, 0.1, -1);
  const double error = std::abs(row.drag_factor / kBrenner - 1);
  return line(
      error < kTolerance,
      fmt::format("FreeFEM solves gap 0.1: drag factor {:.7g}, relative error {:.1e}, {:.1f} s",
                  row.drag_factor, error, row.seconds));
}

bool examine_freefem() {
  try {
    const auto freefem = default_freefem();
    line(true, fmt::format("FreeFEM {} ({}; scripts in {})", freefem_version(freefem),
                           freefem.executable, freefem.script_folder.string()));
    return solve_known_row(freefem);
  } catch (const Error& error) {
    if (error.exit_code() == ExitCode::kInterrupted) throw;
    return line(false, error.what());
  }
}

bool examine_gnuplot() {
  const auto gnuplot = run_process({"gnuplot", "--version"});
  if (!gnuplot.started || gnuplot.exit_status != 0)
    return line(false, "gnuplot, for the report's plots; apt-get install gnuplot-nox");
  return line(true, gnuplot.output.substr(0, gnuplot.output.find('\n')));
}

}  // namespace

bool examine() {
  for (const auto& [program, version] : library_versions())
    line(true, fmt::format("{} {}", program, version));
  const bool has_gnuplot = examine_gnuplot();
  return examine_freefem() && has_gnuplot;
}

}  // namespace viscontact
