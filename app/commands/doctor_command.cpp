// `doctor`: which programs are installed, how to install missing ones, and whether FreeFEM computes
// a drag factor (drag divided by Stokes' drag in unbounded fluid) of known value.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/arguments/interrupt.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::app {
namespace {

struct Finding {
  bool good;         ///< false: something is missing or wrong
  std::string what;  ///< one line
};

using Report = std::function<void(const Finding&)>;

/// Computes the drag factor of a sphere at a gap of 0.1 radii above a plane. The container (radius
/// 40, height 80) is so wide that it changes the factor by less than kTolerance. kBrenner is the
/// exact value, from the series of Brenner (1961).
Finding solve_known_row(const freefem_axi::FreeFem& freefem) {
  constexpr double kBrenner = 11.45915720340955722964;
  constexpr double kTolerance = 1e-4;  // small enough to show a wrong installation
  freefem_axi::Tabulation tabulation;
  tabulation.viscosity = tabulation.radius = 1;
  tabulation.container = freefem_axi::Container{40, 80};
  tabulation.relative_accuracy = kTolerance;
  const auto row = freefem_axi::solve_row(freefem, tabulation, 0.1, -1);
  const double error = std::abs(row.force_factor / kBrenner - 1);
  return {error < kTolerance,
          fmt::format("FreeFEM solves gap 0.1: drag factor {:.7g}, relative error {:.1e}, {:.1f} s",
                      row.force_factor, error, row.seconds)};
}

void examine_freefem(const Report& report) {
  try {
    auto freefem = freefem_axi::default_freefem(interrupt_token());
    // The row takes about a second, so version_limit, the shorter time limit, is long enough.
    freefem.row_limit = freefem.version_limit;
    report(
        {true, fmt::format("FreeFEM {} ({}; scripts in {})", freefem_axi::freefem_version(freefem),
                           freefem.executable, freefem.script_folder.string())});
    report(solve_known_row(freefem));
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    report({false, error.what()});
  }
}

Finding examine_gnuplot() {
  // gnuplot answers within a second; any longer limit would do.
  constexpr auto kLongest = std::chrono::minutes(1);
  const auto gnuplot =
      run_process({"gnuplot", "--version"}, {}, {}, {}, kLongest, interrupt_token());
  if (!gnuplot.started || gnuplot.exit_status != 0)
    return {false,
            "gnuplot, for --plot and for the report's still pictures; apt-get install gnuplot-nox"};
  return {true, gnuplot.output.substr(0, gnuplot.output.find('\n'))};
}

void print_line(const Finding& finding) {
  const auto word = finding.good
                        ? terminal::coloured("ok     ", terminal::Colour::kGreen, STDOUT_FILENO)
                        : terminal::coloured("MISSING", terminal::Colour::kRed, STDOUT_FILENO);
  fmt::print("{} {}\n", word, finding.what);
}

/// Prints the findings as lines or as JSON: an array of objects with the keys `ok` (true or false)
/// and `what` (a text). Returns true if nothing is missing or wrong.
bool examine(bool json) {
  std::vector<Finding> findings;
  const Report report = [&](const Finding& finding) {
    findings.push_back(finding);
    if (!json) print_line(finding);
  };
  for (const auto& [program, version] : results::library_versions())
    report({true, fmt::format("{} {}", program, version)});
  report(examine_gnuplot());
  examine_freefem(report);
  if (json) {
    auto all = nlohmann::ordered_json::array();
    for (const auto& finding : findings)
      all.push_back({{"ok", finding.good}, {"what", finding.what}});
    fmt::print("{}\n", all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  }
  return std::ranges::all_of(findings, &Finding::good);
}

}  // namespace

void add_doctor(CLI::App& app, bool& healthy) {
  auto* command =
      app.add_subcommand("doctor", "say what is installed, and how to install what is missing");
  auto json = std::make_shared<bool>(false);
  add_json(*command, *json);
  command->callback([&healthy, json] { healthy = examine(*json); });
}

}  // namespace viscontact::app
