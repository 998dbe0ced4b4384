// Reads the section [tabulation]: gaps, velocities, geometry and container. Lengths are in the unit
// of the case. A change must keep the gaps of a grid bit for bit, because finished rows and tables
// are found again by their gaps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "viscontact/case_file/sections.hpp"
#include "viscontact/freefem_axi/geometry.hpp"

namespace viscontact::case_file {
namespace {

constexpr Allowed kFraction = {[](double v) { return v > 0 && v < 1; }, "between 0 and 1"};

/// Reads `gaps` [L]: a list, or { from, to, count, spacing }. Returns them in rising order.
std::vector<double> read_gaps(const TomlSection& tabulation) {
  if (tabulation.is_array("gaps")) {
    auto gaps = tabulation.numbers("gaps", kPositive);
    std::ranges::sort(gaps);
    if (std::ranges::adjacent_find(gaps) != gaps.end())
      tabulation.fail("gaps", "contains the same gap twice; each gap must be given once");
    return gaps;
  }
  const auto grid = tabulation.section("gaps");
  const double from = grid.number("from", kPositive);
  const double to = grid.number("to", kPositive);
  const int count = grid.count("count", 2, 100000);
  const std::string spacing = grid.text("spacing");
  grid.finish();
  if (!(to > from))
    grid.fail("to", fmt::format("is {}; it must be greater than from, {}", to, from));
  if (spacing != "log" && spacing != "linear")
    grid.fail("spacing", fmt::format("is '{}'; it must be \"log\" or \"linear\"", spacing));
  std::vector<double> gaps;
  for (int i = 0; i < count; ++i) {
    const double w = static_cast<double>(i) / (count - 1);
    gaps.push_back(spacing == "log" ? from * std::pow(to / from, w) : std::lerp(from, to, w));
  }
  gaps.back() = to;
  if (std::ranges::adjacent_find(gaps, std::greater_equal()) != gaps.end())
    grid.fail("count", fmt::format("is {}; there are not so many different numbers of double "
                                   "precision from {} to {}",
                                   count, from, to));
  return gaps;
}

void read_geometry(const TomlSection& tabulation_section, freefem_axi::Tabulation& tabulation) {
  if (!tabulation_section.has("geometry")) return;  // the default geometry is a plane
  const auto section = tabulation_section.section("geometry");
  tabulation.geometry = section.text("kind");
  const auto& geometry = at_key(
      section, "kind", [&]() -> auto& { return freefem_axi::find_geometry(tabulation.geometry); });
  for (const auto& parameter : geometry.parameters) {
    const std::string key(parameter.key);
    tabulation.geometry_parameters.push_back(parameter.fallback && !section.has(key)
                                                 ? *parameter.fallback
                                                 : section.number(key, parameter.allowed));
  }
  section.finish();
}

/// Reads `container`: { radius, height } [L], which must contain the sphere and its neighbour at
/// every gap, or "unbounded".
void read_container(const TomlSection& section, const freefem_axi::RequiredSpace& space,
                    freefem_axi::Tabulation& tabulation) {
  if (!freefem_axi::find_geometry(tabulation.geometry).takes_container) {
    if (section.has("container"))
      section.fail("container", fmt::format("must be left out, because a {} is its own container",
                                            tabulation.geometry));
    return;
  }
  if (section.is_text("container")) {
    if (const auto text = section.text("container"); text != "unbounded")
      section.fail(
          "container",
          fmt::format(
              "is '{}'; it must be \"unbounded\" or a table {{ radius = ..., height = ... }}",
              text));
    return;
  }
  const auto table = section.section("container");
  const freefem_axi::Container container{table.number("radius", kPositive),
                                         table.number("height", kPositive)};
  table.finish();
  if (!(container.radius > space.container_radius))
    table.fail("radius",
               fmt::format("is {}; it must be greater than {}, the radius of sphere and neighbour",
                           container.radius, space.container_radius));
  if (!(container.height > space.container_height))
    table.fail(
        "height",
        fmt::format("is {}; it must be greater than {}, what the largest gap, the sphere and "
                    "its neighbour need",
                    container.height, space.container_height));
  // In larger containers FreeFEM's mesh generator cannot make edges that are short enough for the
  // gap (graded_boundary.idp). The drag in a container of this size is nearly that in unbounded
  // fluid.
  constexpr double kLargestLength = 2e5;
  for (const auto& [key, length] :
       {std::pair("radius", container.radius), std::pair("height", container.height)})
    if (length > kLargestLength * tabulation.radius)
      table.fail(key, fmt::format(
                          "is {}; it must be at most {} sphere radii, {}, or the container must be "
                          "\"unbounded\"",
                          length, kLargestLength, kLargestLength * tabulation.radius));
  tabulation.container = container;
}

/// Reads `motion`: a name, a list of names, or "all", every motion that the geometry has.
std::vector<lubrication::MotionKind> read_motions(const TomlSection& section,
                                                  const std::string& geometry) {
  using lubrication::MotionKind;
  if (!section.has("motion")) return {MotionKind::kApproach};
  const auto names =
      section.is_array("motion") ? section.texts("motion") : std::vector{section.text("motion")};
  return at_key(section, "motion", [&] { return freefem_axi::parse_motions(names, geometry); });
}

}  // namespace

freefem_axi::Tabulation read_tabulation(const TomlSection& section, double viscosity,
                                        double radius) {
  freefem_axi::Tabulation tabulation;
  tabulation.viscosity = viscosity;
  tabulation.radius = radius;
  tabulation.gaps = read_gaps(section);
  tabulation.reference_velocities = section.numbers("reference_velocities", kNotZero);
  auto velocities = tabulation.reference_velocities;
  std::ranges::sort(velocities);
  if (std::ranges::adjacent_find(velocities) != velocities.end())
    section.fail("reference_velocities",
                 "contains the same velocity twice; each velocity must be given once");
  tabulation.relative_accuracy = section.number("relative_accuracy", kFraction);
  read_geometry(section, tabulation);
  tabulation.motions = read_motions(section, tabulation.geometry);
  // At smaller gaps the matrices are too ill-conditioned for double precision.
  constexpr double kSmallestGap = 1e-8;
  if (const double narrowest = tabulation.gaps.front(); narrowest < kSmallestGap * radius)
    section.fail("gaps",
                 fmt::format("goes down to {}; a gap must be at least {} sphere radii, which is {}",
                             narrowest, kSmallestGap, kSmallestGap * radius));
  const double widest = tabulation.gaps.back();
  const auto space = freefem_axi::find_geometry(tabulation.geometry)
                         .required_space(radius, widest, tabulation.geometry_parameters);
  if (!(space.largest_gap > 0))
    section.fail("geometry", "leaves no room for the sphere; give it a larger radius");
  // largest_gap is the difference of two lengths. A gap that equals it up to rounding errors is
  // allowed.
  if (!(widest <= space.largest_gap * (1 + 1e-12)))
    section.fail("gaps", fmt::format("goes up to {}; in this {} a gap must be at most {}", widest,
                                     tabulation.geometry, space.largest_gap));
  read_container(section, space, tabulation);
  section.finish();
  return tabulation;
}

}  // namespace viscontact::case_file
