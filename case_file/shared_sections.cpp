// The keys of [fluid], [sphere] and [tabulation].
#include "viscontact/case_file/shared_sections.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "viscontact/freefem_axi/geometry.hpp"

namespace viscontact::case_file {
namespace {

using freefem_axi::Container;
using freefem_axi::Tabulation;

// In radii. At smaller gaps FreeFEM's matrices are too ill-conditioned for double precision.
constexpr double kSmallestGap = 1e-8;

double ball_volume(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

/// `count` gaps [L] with equal ratios of neighbours if is_logarithmic, else with equal differences.
struct GapGrid {
  double from = 0, to = 0;
  int count = 0;
  bool is_logarithmic = true;
};

void grid_keys(Keys& keys, GapGrid& grid) {
  keys.required("from", number(grid.from, kPositive), {"the smallest gap"});
  keys.required("to", number(grid.to, kPositive), {"the largest gap, greater than `from`"});
  keys.required("count", count(grid.count, 2, 100000), {"the number of gaps"});
  keys.required("spacing", one_of(grid.is_logarithmic, {{"log", true}, {"linear", false}}),
                {"equal ratios of neighbours, or equal differences"});
}

/// A list of gaps [L], or a grid, which is sorted. Finished rows and tables are found again by
/// their gaps, bit for bit. Throws Error(kBadInput) for a gap that occurs twice, a grid whose `to`
/// is not greater than `from`, or a grid with more gaps than there are doubles between its ends.
void read_gaps(const TomlSection& section, std::string_view key, Tabulation& tabulation) {
  auto& gaps = tabulation.gaps;
  if (section.is_array(key)) {
    gaps = section.numbers(key, kPositive);
    std::ranges::sort(gaps);
    section.require(std::ranges::adjacent_find(gaps) == gaps.end(), key,
                    "contains the same gap twice; each gap must be given once");
    return;
  }
  const auto table = section.section(key);
  GapGrid grid;
  read_keys(table, grid_keys, grid);
  const auto [from, to, count, is_logarithmic] = grid;
  table.require(to > from, "to", "is {}; it must be greater than from, {}", to, from);
  for (int i = 0; i < count; ++i) {
    const double w = static_cast<double>(i) / (count - 1);
    gaps.push_back(is_logarithmic ? from * std::pow(to / from, w) : std::lerp(from, to, w));
  }
  gaps.back() = to;
  table.require(std::ranges::adjacent_find(gaps, std::greater_equal()) == gaps.end(), "count",
                "is {}; there are not so many different numbers of double precision from {} to {}",
                count, from, to);
}

/// One key for each parameter of this geometry; the values are added to
/// tabulation.geometry_parameters in the order of geometry.parameters.
void geometry_keys(Keys& keys, Tabulation& tabulation, const freefem_axi::Geometry& geometry) {
  for (const auto& parameter : geometry.parameters) {
    double& value = tabulation.geometry_parameters.emplace_back(parameter.fallback.value_or(0));
    if (parameter.fallback)
      keys.optional(parameter.key, number(value, parameter.allowed), {});
    else
      keys.required(parameter.key, number(value, parameter.allowed), {});
  }
}

/// The name of the geometry (`kind`) and its parameters.
void read_geometry(const TomlSection& parent, std::string_view key, Tabulation& tabulation) {
  const auto section = parent.section(key);
  tabulation.geometry = section.text("kind");
  const auto& geometry = at_key(
      section, "kind", [&]() -> auto& { return freefem_axi::find_geometry(tabulation.geometry); });
  read_keys(section, [&](Keys& keys) { geometry_keys(keys, tabulation, geometry); });
}

void container_keys(Keys& keys, Container& container) {
  keys.required("radius", number(container.radius, kPositive), {"radius of the cylinder"});
  keys.required("height", number(container.height, kPositive), {"distance of its ends"});
}

/// A closed cylinder, or "unbounded". Throws Error(kBadInput) if the sphere and its neighbour, such
/// as a plane, do not fit into it at every gap, or if it is longer or wider than 2e5 radii.
void read_container(const TomlSection& section, std::string_view key, Tabulation& tabulation) {
  const auto& geometry = freefem_axi::find_geometry(tabulation.geometry);
  section.require(geometry.takes_container, key,
                  "must be left out, because a {} is its own container", tabulation.geometry);
  if (section.is_text(key)) {
    section.require(section.text(key) == "unbounded", key,
                    "is '{}'; it must be \"unbounded\" or a table {{ radius = ..., height = ... }}",
                    section.text(key));
    return;
  }
  const auto table = section.section(key);
  Container container;
  read_keys(table, container_keys, container);
  const auto space = geometry.required_space(tabulation.radius, tabulation.gaps.back(),
                                             tabulation.geometry_parameters);
  table.require(container.radius > space.container_radius, "radius",
                "is {}; it must be greater than {}, the radius of sphere and neighbour",
                container.radius, space.container_radius);
  table.require(
      container.height > space.container_height, "height",
      "is {}; it must be greater than {}, what the largest gap, the sphere and its neighbour need",
      container.height, space.container_height);
  // In larger containers FreeFEM's mesh generator cannot make edges that are short enough for the
  // gap (boundary_edges.idp). The drag there is nearly that in unbounded fluid.
  constexpr double kLargestLength = 2e5;  // in radii of the sphere
  for (const auto& [name, length] :
       {std::pair("radius", container.radius), std::pair("height", container.height)})
    table.require(
        length <= kLargestLength * tabulation.radius, name,
        "is {}; it must be at most {} sphere radii, {}, or the container must be \"unbounded\"",
        length, kLargestLength, kLargestLength * tabulation.radius);
  tabulation.container = container;
}

/// A name, a list of names, or "all", which are all motions of the geometry.
void read_motions(const TomlSection& section, std::string_view key, Tabulation& tabulation) {
  const auto names = section.is_array(key) ? section.texts(key) : std::vector{section.text(key)};
  tabulation.motions =
      at_key(section, key, [&] { return freefem_axi::parse_motions(names, tabulation.geometry); });
}

/// Throws Error(kBadInput) unless all gaps, which rise, are from kSmallestGap radii to the largest
/// gap for which the geometry has room.
void check_gaps(const TomlSection& section, const Tabulation& tabulation) {
  assert(!tabulation.gaps.empty());
  const double narrowest = tabulation.gaps.front(), widest = tabulation.gaps.back();
  section.require(narrowest >= kSmallestGap * tabulation.radius, "gaps",
                  "goes down to {}; a gap must be at least {} sphere radii, which is {}", narrowest,
                  kSmallestGap, kSmallestGap * tabulation.radius);
  const auto space = freefem_axi::find_geometry(tabulation.geometry)
                         .required_space(tabulation.radius, widest, tabulation.geometry_parameters);
  section.require(space.largest_gap > 0, "geometry",
                  "leaves no room for the sphere; give it a larger radius");
  // largest_gap is a difference of lengths, which a gap of this size may exceed by rounding.
  section.require(widest <= space.largest_gap * (1 + 1e-12), "gaps",
                  "goes up to {}; in this {} a gap must be at most {}", widest, tabulation.geometry,
                  space.largest_gap);
}

/// The velocities stay in the order of the case. None is 0 or occurs twice.
void read_velocities(const TomlSection& section, std::string_view key, Tabulation& tabulation) {
  auto velocities = tabulation.reference_velocities = section.numbers(key, kNotZero);
  std::ranges::sort(velocities);
  section.require(std::ranges::adjacent_find(velocities) == velocities.end(), key,
                  "contains the same velocity twice; each velocity must be given once");
}

/// Gaps and geometry come first, because motions and container are checked against them.
void tabulation_keys(Keys& keys, Tabulation& tabulation) {
  keys.required("gaps", custom("a list, or `{ from, to, count, spacing }`", read_gaps, tabulation),
                {.meaning = "the gaps q at which FreeFEM computes the force, at least 1e-8 r each",
                 .example = "{ from = 1e-3, to = 2.0, count = 20, spacing = \"log\" }"});
  keys.required("reference_velocities", custom("a list, none 0", read_velocities, tabulation),
                {.meaning = "velocities u0 of the sphere; negative: approaching. One is enough, "
                            "because Stokes flow is linear",
                 .example = "[-1.0]"});
  keys.required(
      "relative_accuracy", number(tabulation.relative_accuracy, kFraction),
      {.meaning = "largest relative error estimate that is asked of each row", .example = "1e-5"});
  keys.optional("geometry", custom("`{ kind, ... }`", read_geometry, tabulation),
                {.meaning = "what the sphere approaches",
                 .fallback = "`{ kind = \"plane\" }`",
                 .example = "{ kind = \"plane\" }"});
  keys.optional(
      "motion",
      custom("`\"approach\"`, `\"slide\"`, `\"roll\"`, `\"spin\"`, `\"axial_strain\"`, "
             "`\"shear_strain\"`, `\"twofold_strain\"`, a list of these, or `\"all\"`",
             read_motions, tabulation),
      {"[motions](motions.md) that are tabulated; `\"all\"` are those that the geometry has. The "
       "reference velocities are those of each motion, angular ones for roll and spin, rates of "
       "strain. `run` needs "
       "the approach alone",
       "`\"approach\"`",
       {},
       "\"approach\""});
  if (keys.reads()) check_gaps(keys.section(), tabulation);
  keys.required_if(!keys.reads() || freefem_axi::find_geometry(tabulation.geometry).takes_container,
                   "container",
                   custom("`{ radius, height }` or `\"unbounded\"`", read_container, tabulation),
                   {"a closed cylinder around the fluid, or none",
                    "required but for a cavity",
                    {},
                    "{ radius = 40.0, height = 80.0 }"});
}

}  // namespace

Tabulation read_tabulation(const TomlSection& section, double viscosity, double radius) {
  assert(viscosity > 0 && radius > 0);
  Tabulation tabulation;
  tabulation.viscosity = viscosity;
  tabulation.radius = radius;
  read_keys(section, tabulation_keys, tabulation);
  return tabulation;
}

std::vector<KeyTable> tables_of_tabulation() {
  return {describe_keys("[tabulation]", tabulation_keys),
          describe_keys("tabulation.gaps", grid_keys),
          describe_keys("tabulation.container", container_keys)};
}

void fluid_keys(Keys& keys, double& viscosity, double& density) {
  viscosity_keys(keys, viscosity);
  keys.optional(
      "density", number(density, kNotNegative),
      {.meaning = "density rho_f, for the Reynolds number and, with `gravity`, the buoyancy",
       .example = "0.0"});
}

void sphere_keys(Keys& keys, double& radius, double& density, double& mass, bool needs_mass) {
  keys.required("radius", number(radius, kPositive),
                {.meaning = "radius r of the sphere", .example = "1.0"});
  std::optional<double> given;
  keys.optional("density", number(given, kPositive),
                {"density rho_p of the sphere, in place of `mass`", "from `mass`"});
  if (given) {
    density = *given;
    mass = density * ball_volume(radius);
    keys.require(std::isnormal(mass), "density",
                 "makes the mass {} with the radius {}; a double does not hold this mass", mass,
                 radius);
    const int line = keys.has("mass") ? keys.section().line("density") : 0;
    keys.require(!keys.has("mass"), "mass",
                 "must be left out, because the mass follows from density{}; only one of the two "
                 "may be given",
                 line > 0 ? fmt::format(" in line {}", line) : "");
  }
  keys.require(!needs_mass || given || keys.has("mass"), "mass",
               "is missing; it must be a number {}, or the sphere must have a density",
               kPositive.words);
  keys.required_if(needs_mass && !given, "mass", number(mass, kPositive),
                   {"mass m of the sphere",
                    "required with a section `[motion]` or `[rolling]`, or `density`",
                    {},
                    "20.0"});
}

double mass_less_displaced_fluid(double mass, double fluid_density, double radius) {
  assert(mass >= 0 && fluid_density >= 0 && radius >= 0);
  return mass - fluid_density * ball_volume(radius);
}

}  // namespace viscontact::case_file
