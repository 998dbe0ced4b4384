// Runs the script collinear_spheres.edp and reads its answer. The script computes with viscosity 1.
#include "viscontact/swimmer/tabulation/collinear_spheres.hpp"

#include <fmt/format.h>

#include <cassert>
#include <chrono>
#include <sstream>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::swimmer {
namespace {

/// The arguments of the script: "-name" and "value" in turn.
std::vector<std::string> arguments_of(const CollinearSpheres& spheres,
                                      const std::vector<double>& gaps) {
  const Tube tube = spheres.tube.value_or(Tube{});  // radius 0: unbounded
  std::vector<std::string> arguments = {"-spheres",         std::to_string(spheres.radii.size()),
                                        "-containerRadius", format_number(tube.radius),
                                        "-containerHeight", format_number(tube.height.value_or(0))};
  freefem_axi::append_mesh_arguments(arguments, spheres.relative_accuracy);
  for (std::size_t i = 0; i < spheres.radii.size(); ++i) {
    arguments.push_back(fmt::format("-radius{}", i + 1));
    arguments.push_back(format_number(spheres.radii[i]));
  }
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    arguments.push_back(fmt::format("-gap{}", i + 1));
    arguments.push_back(format_number(gaps[i]));
  }
  return arguments;
}

/// Reads the lines "viscontact-entry I J VALUE ESTIMATE" of the script's output into `row`, in
/// their order; VALUE times `viscosity` [M/(L T)] is the entry [M/T]. False if an entry is missing
/// or is not a number, or if there are too many.
bool read_entries(const std::string& output, double viscosity, ResistanceRow& row) {
  std::istringstream lines(output);
  std::size_t found = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, value, estimate;
    std::size_t i = 0, j = 0;
    if (!(words >> name >> i >> j >> value >> estimate) || name != "viscontact-entry") continue;
    const auto entry = parse_number(value);
    const auto error = parse_number(estimate);
    if (!entry || !error || found == row.entries.size()) return false;
    row.entries[found] = *entry * viscosity;
    row.relative_error_estimates[found++] = *error;
  }
  return found == row.entries.size();
}

}  // namespace

std::string surroundings_in_words(const CollinearSpheres& spheres) {
  if (!spheres.tube) return "unbounded";
  if (!spheres.tube->height)
    return fmt::format("tube of radius {}", format_number(spheres.tube->radius));
  return fmt::format("closed cylinder, radius {}, height {}", format_number(spheres.tube->radius),
                     format_number(*spheres.tube->height));
}

ResistanceRow solve_resistance(const freefem_axi::FreeFem& freefem, const CollinearSpheres& spheres,
                               const std::vector<double>& gaps) {
  assert(gaps.size() + 1 == spheres.radii.size());
  const auto start = std::chrono::steady_clock::now();
  const auto result =
      freefem_axi::run_freefem(freefem, "collinear_spheres.edp", arguments_of(spheres, gaps));
  ResistanceRow row;
  row.gaps = gaps;
  row.entries.resize(entry_count(spheres.radii.size()));
  row.relative_error_estimates.resize(row.entries.size());
  std::istringstream answer(freefem_axi::line_after(result.output, "viscontact-result"));
  double largest_estimate = 0;
  answer >> largest_estimate >> row.degrees_of_freedom >> row.observed_order;
  if (result.exit_status != 0 || !answer || !read_entries(result.output, spheres.viscosity, row)) {
    std::vector<std::string> words;
    words.reserve(gaps.size());
    for (const double gap : gaps) words.push_back(format_number(gap));
    throw Error(ErrorKind::kExternalProgram, "FreeFEM failed at gaps {} (exit status {}): {}",
                fmt::join(words, ", "), result.exit_status,
                freefem_axi::failure_in_words(result, freefem.row_limit));
  }
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return row;
}

}  // namespace viscontact::swimmer
