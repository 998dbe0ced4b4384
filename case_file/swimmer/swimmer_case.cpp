// Reads the case of a swimmer (swimmer_case.hpp). Lengths are in the unit of the case. A change must
// keep the arms of a grid bit for bit, because finished rows and tables are found by their gaps.
#include "viscontact/case_file/swimmer/swimmer_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "viscontact/case_file/swimmer/stroke_section.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/lubrication/resistance/chebyshev_arms.hpp"

namespace viscontact::case_file {
namespace {

constexpr Allowed kFraction = {[](double v) { return v > 0 && v < 1; }, "between 0 and 1"};

std::vector<double> read_radii(const TomlSection& section) {
  auto radii = section.numbers("radii", kPositive);
  if (radii.size() < lubrication::kFewestSpheres || radii.size() > lubrication::kMostSpheres)
    section.fail("radii", fmt::format("has {} numbers; it must have {} to {}", radii.size(),
                                      lubrication::kFewestSpheres, lubrication::kMostSpheres));
  // With a larger ratio the mesh around the small sphere would be too fine for FreeFEM's indices.
  constexpr double kLargestRatio = 100;
  const auto [smallest, largest] = std::ranges::minmax(radii);
  if (largest > kLargestRatio * smallest)
    section.fail("radii", fmt::format("has a ratio of {:.4g}; it must be at most {}",
                                      largest / smallest, kLargestRatio));
  return radii;
}

/// Reads { from, to, count } of arm k: distances of centres. Returns the gaps.
std::vector<double> read_gaps(const TomlSection& grid, const std::vector<double>& radii,
                              std::size_t k) {
  const double both_radii = radii[k] + radii[k + 1];
  const double from = grid.number("from", kPositive);
  const double to = grid.number("to", kPositive);
  const int count = grid.count("count", 3, 200);
  grid.finish();
  if (!(from > both_radii))
    grid.fail("from", fmt::format("is {}; it must be greater than {}, the sum of the radii of "
                                  "spheres {} and {}, which touch there",
                                  from, both_radii, k + 1, k + 2));
  constexpr double kSmallestGap = 1e-6;  // over the smaller radius; as far as tests go
  if (const double least = kSmallestGap * std::min(radii[k], radii[k + 1]);
      from - both_radii < least)
    grid.fail("from",
              fmt::format("is {}, a gap of {:.3g}; a gap must be at least {} of the smaller "
                          "radius, so from must be at least {}",
                          from, from - both_radii, kSmallestGap, both_radii + least));
  if (!(to > from))
    grid.fail("to", fmt::format("is {}; it must be greater than from, {}", to, from));
  constexpr double kLargestArm = 1e4;  // over both radii
  if (to > kLargestArm * both_radii)
    grid.fail("to", fmt::format("is {}; it must be at most {} times the sum of both radii, {}", to,
                                kLargestArm, kLargestArm * both_radii));
  auto gaps = lubrication::chebyshev_arms(from, to, count);
  for (auto& gap : gaps) gap -= both_radii;
  return gaps;
}

/// Reads `arms`: one table for all arms, or an array with one table for each.
std::vector<std::vector<double>> read_grid(const TomlSection& section,
                                           const std::vector<double>& radii) {
  std::vector<std::vector<double>> grid;
  const std::size_t arms = radii.size() - 1;
  if (section.is_array("arms")) {
    const auto tables = section.sections("arms");
    if (tables.size() != arms)
      section.fail("arms",
                   fmt::format("has {} tables; it must have {}, one for each arm, or be one "
                               "table for all arms",
                               tables.size(), arms));
    for (std::size_t k = 0; k < arms; ++k) grid.push_back(read_gaps(tables[k], radii, k));
  } else {
    const auto table = section.section("arms");
    for (std::size_t k = 0; k < arms; ++k) grid.push_back(read_gaps(table, radii, k));
  }
  constexpr double kMostRows = 100000;
  double rows = 1;
  for (const auto& gaps : grid) rows *= static_cast<double>(gaps.size());
  if (rows > kMostRows)
    section.fail("arms", fmt::format("makes a table of {} rows; at most {} are allowed, so take a "
                                     "smaller count",
                                     rows, kMostRows));
  return grid;
}

/// Reads `container`: "unbounded" or { radius, height }; without a height it is a long tube.
std::optional<freefem_axi::Tube> read_tube(const TomlSection& section, const SwimmerCase& c) {
  if (!section.has("container")) return {};
  if (section.is_text("container")) {
    if (const auto text = section.text("container"); text != "unbounded")
      section.fail("container",
                   fmt::format("is '{}'; it must be \"unbounded\", {{ radius = ... }} for a long "
                               "tube, or {{ radius = ..., height = ... }}",
                               text));
    return {};
  }
  const auto table = section.section("container");
  freefem_axi::Tube tube{table.number("radius", kPositive), {}};
  if (table.has("height")) tube.height = table.number("height", kPositive);
  table.finish();
  const auto& radii = c.spheres.radii;
  constexpr double kNarrowest = 1.01, kWidest = 1e3;  // over the largest radius
  const double largest = std::ranges::max(radii);
  if (!(tube.radius >= kNarrowest * largest && tube.radius <= kWidest * largest))
    table.fail("radius", fmt::format("is {}; it must be {} to {} times the largest radius of the "
                                     "spheres, {}, or the container must be \"unbounded\"",
                                     tube.radius, kNarrowest, kWidest, largest));
  double longest = radii.front() + radii.back();
  for (std::size_t k = 0; k + 1 < radii.size(); ++k)
    longest += c.gaps[k].back() + radii[k] + radii[k + 1];
  if (tube.height && !(*tube.height > longest && *tube.height <= kWidest * longest))
    table.fail("height", fmt::format("is {}; it must be greater than {}, the length of the swimmer "
                                     "with the longest arms, and at most {} times that",
                                     *tube.height, longest, kWidest));
  return tube;
}

SwimmerCase read_case_of(const TomlSection& root, const std::string& text,
                         const std::filesystem::path& path) {
  SwimmerCase c;
  c.text = text;
  c.path = path;
  c.title = root.has("title") ? root.text("title") : "";
  const auto fluid = root.section("fluid");
  c.spheres.viscosity = fluid.number("viscosity", kPositive);
  fluid.finish();
  const auto swimmer = root.section("swimmer");
  c.spheres.radii = read_radii(swimmer);
  c.gaps = read_grid(swimmer, c.spheres.radii);
  c.spheres.relative_accuracy = swimmer.number("relative_accuracy", kFraction);
  c.spheres.tube = read_tube(swimmer, c);
  swimmer.finish();
  read_strokes(root, c);
  root.finish();
  return c;
}

}  // namespace

bool is_swimmer_case(const std::filesystem::path& path) {
  return TomlSection::parse(read_file(path), path.string()).has("swimmer");
}

SwimmerCase read_swimmer_case(const std::filesystem::path& path) {
  const auto text = read_file(path);
  return read_case_of(TomlSection::parse(text, path.string()), text, path);
}

SwimmerCaseTemplate::SwimmerCaseTemplate(const std::filesystem::path& path)
    : path_(path), text_(read_file(path)), root_(TomlSection::parse(text_, path.string())) {
  (void)with({});
}

SwimmerCase SwimmerCaseTemplate::with(
    std::span<const std::pair<std::string, double>> numbers) const {
  return read_case_of(root_.with_numbers(numbers), text_, path_);
}

}  // namespace viscontact::case_file
