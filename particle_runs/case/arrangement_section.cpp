// Reads [arrangement] and the species of arrangements and sources.
#include <algorithm>
#include <limits>
#include <string_view>

#include "viscontact/arrangement/species.hpp"
#include "viscontact/particle_runs/case/particles_sections.hpp"
#include "viscontact/particles/domain/region.hpp"

namespace viscontact::particles {
namespace {

constexpr std::string_view kRadiusWords =
    "a number, a list of numbers, `{ uniform = [a, b] }` or `{ lognormal = { median, sigma } }`";

/// Keys of a lognormal distribution of radii.
void lognormal_keys(case_file::Keys& keys, RadiusDistribution& radius) {
  // With sigma = 1, all but 6 in 1e5 radii are within a factor of 55 of the median.
  constexpr Allowed kSigma = {[](double v) { return v >= 1e-6 && v <= 1; }, "from 1e-6 to 1"};
  keys.required("median", case_file::number(radius.median, kModeratelyPositive), {"median radius"});
  keys.required("sigma", case_file::number(radius.sigma, kSigma),
                {"standard deviation of the logarithm of the radius"});
}

/// Throws Error(kBadInput) unless 0 < smallest < largest radius.
void read_uniform(const case_file::TomlSection& section, std::string_view key,
                  RadiusDistribution& radius) {
  const auto ends = section.numbers(key, kModeratelyPositive);
  section.require(ends.size() == 2 && ends[0] < ends[1], key,
                  "must be two numbers, the smallest and the largest radius");
  radius.from = ends[0];
  radius.to = ends[1];
}

void distribution_keys(case_file::Keys& keys, RadiusDistribution& radius) {
  using Kind = RadiusDistribution::Kind;
  const bool is_uniform =
      keys.optional("uniform", case_file::custom("`[a, b]`", read_uniform, radius),
                    {"all radii from a to b are equally likely", "one of both is required"});
  const auto read_lognormal = [&](const case_file::TomlSection& section, std::string_view key) {
    case_file::read_keys(section.section(key), lognormal_keys, radius);
  };
  const bool is_lognormal =
      keys.optional("lognormal", case_file::custom("`{ median, sigma }`", read_lognormal),
                    {"the logarithm is normally distributed", "one of both is required"});
  keys.require(is_uniform != is_lognormal, "uniform",
               "and lognormal exclude each other; a table of radii must have one of them");
  radius.kind = is_uniform ? Kind::kUniform : Kind::kLognormal;
}

/// Reads a number [L], a list of numbers [L], or a table of radii.
void read_radius(const case_file::TomlSection& section, std::string_view key,
                 RadiusDistribution& radius) {
  if (section.is_table(key))
    case_file::read_keys(section.section(key), distribution_keys, radius);
  else if (section.is_array(key))
    radius.list = section.numbers(key, kModeratelyPositive);
  else
    radius.list = {section.number(key, kModeratelyPositive)};
}

/// If `is_listed`, the keys are in a table of the list `species`, otherwise in the section itself.
/// In a fluid masses may be 0.
void species_keys(case_file::Keys& keys, Species& species, bool has_fluid, bool is_listed) {
  keys.required_if(true, "radius", case_file::custom(kRadiusWords, read_radius, species.radius),
                   {"radius of each particle. The radii of a list are taken in turn",
                    is_listed ? "required" : "required without `species`"});
  if (is_listed)
    keys.optional("share", case_file::number(species.share, kModeratelyPositive),
                  {"part of the number of particles, relative to the shares of all species"});
  const bool has_density = keys.optional(
      "density", case_file::number(species.density, kModeratelyPositiveOr0),
      {"in place of `mass`: mass of a disc over its area, or of a sphere over its volume",
       "from `mass`"});
  keys.require(!has_density || !keys.has("mass"), "mass",
               "must be left out, because density gives the masses");
  keys.require(!has_density || species.density > 0 || has_fluid, "density",
               "is 0; particles without a fluid must have a mass");
  if (has_density && keys.reads()) return;
  keys.required_if(
      !has_fluid, "mass",
      case_file::number(species.mass, has_fluid ? kModeratelyPositiveOr0 : kModeratelyPositive),
      {"mass of each particle",
       has_fluid ? "required without `density`; in a fluid 0" : "required without `density`",
       has_fluid ? "from 1e-100 to 1e100, in a fluid also 0" : "from 1e-100 to 1e100"});
}

void read_species(const case_file::TomlSection& section, std::string_view key,
                  std::vector<Species>& all, bool has_fluid) {
  for (const auto& table : section.sections(key))
    case_file::read_keys(table, species_keys, all.emplace_back(), has_fluid, true);
}

struct ArrangementKeys {
  std::vector<Species> species;
  std::size_t count = 0;     // number of particles; 0: not given
  double fraction = 0;       // fraction of the area or volume of the domain, < 1; 0: not given
  double smallest_gap = -1;  // [L]; -1: not given
  std::uint64_t seed = 1;    // of the random numbers, from 0 to 2^31 - 1
};

/// `dimension` is 2 (discs) or 3 (spheres). The number of particles is given either by `count` or
/// by the fraction of the domain that they cover.
void arrangement_keys(case_file::Keys& keys, ArrangementKeys& asked, int dimension,
                      bool has_fluid) {
  all_species_keys(keys, asked.species, has_fluid);
  const std::string_view fraction = dimension == 3 ? "volume_fraction" : "area_fraction";
  const std::string_view other = dimension == 3 ? "area_fraction" : "volume_fraction";
  keys.require(!keys.has(other), other, "must be {} in {} dimensions", fraction, dimension);
  keys.require(!(keys.has("count") && keys.has(fraction)), "count",
               "must be left out, because {} is given", fraction);
  keys.required_if(!keys.has(fraction), "count", case_file::count(asked.count, 1, kLargestCount),
                   {"number of particles", "required without a fraction"});
  for (const std::string_view key : {"area_fraction", "volume_fraction"})
    if (!keys.reads() || key == fraction)
      keys.optional(
          key, case_file::number(asked.fraction, case_file::kFraction),
          {key == "area_fraction"
               ? "in place of `count`: area of these discs over the area of the domain that planes "
                 "leave free"
               : "in place of `count`: volume of these spheres over that of the domain "
                 "that planes leave free",
           "from `count`"});
  keys.optional("smallest_gap", case_file::number(asked.smallest_gap, kNotNegative),
                {"least gap of two of the particles (also across periodic sides), of one and "
                 "another particle, and of one and a wall or plane",
                 "0.05 smallest radius, less near the densest packing"});
  keys.optional("seed", case_file::count(asked.seed, 0, std::numeric_limits<int>::max()),
                {"the same seed gives the same arrangement, bit for bit on every machine"});
}

}  // namespace

void all_species_keys(case_file::Keys& keys, std::vector<Species>& all, bool has_fluid) {
  const bool is_list = keys.optional(
      "species", case_file::custom("a list of tables", read_species, all, has_fluid),
      {"several kinds of particles; then `radius`, `density` and `mass` are theirs", "one kind"});
  for (const auto* key : {"radius", "density", "mass"})
    keys.require(!is_list || !keys.has(key), key,
                 "must be left out, because species is given; it belongs to a table of species");
  if (!is_list) {
    all.emplace_back();
    species_keys(keys, all.back(), has_fluid, false);
  }
}

void read_arrangement(const case_file::TomlSection& section, ParticlesCase& c) {
  auto& p = c.particles;
  const auto& domain = c.setting.domain;
  const bool has_fluid = c.setting.fluid.has_value();
  section.require(
      std::holds_alternative<DiscDomain>(domain) || std::holds_alternative<BoxDomain>(domain),
      section.has("species") ? "species" : "radius",
      "belongs to an arrangement, which needs a section [domain] with a disc or a box");
  ArrangementKeys keys;
  case_file::read_keys(section, arrangement_keys, keys, p.dimension, may_lack_mass(c.setting));
  const std::string_view key = keys.count > 0     ? "count"
                               : p.dimension == 3 ? "volume_fraction"
                                                  : "area_fraction";
  const auto planes = positions_of(c.setting.planes, 0);
  const DrawnSpecies species(keys.species, p.dimension, keys.seed);
  const auto particles =
      keys.count > 0 ? drawn(species, keys.count)
                     : drawn_to_size(species, p.dimension, keys.fraction * measure(domain, planes),
                                     kLargestCount + 1);
  section.require(particles.size() <= kLargestCount, key,
                  "makes more than {} particles of these radii; at most {} are allowed",
                  kLargestCount, kLargestCount);
  Arrangement asked{.radii = {}, .smallest_gap = keys.smallest_gap, .seed = keys.seed};
  for (const auto& particle : particles) asked.radii.push_back(particle.radius);
  if (asked.smallest_gap < 0)
    asked.smallest_gap = default_gap(asked.radii, p.dimension, measure(domain, planes));
  require_ids(section, key, p, particles.size());
  const auto centres =
      case_file::at_key(section, key, [&] { return arrange(asked, domain, p, planes); });

  p.positions.insert(p.positions.end(), centres.begin(), centres.end());
  p.velocities.resize(p.positions.size());
  for (const auto& [radius, mass] : particles) {
    p.radii.push_back(radius);
    p.masses.push_back(mass);
    if (!has_fluid) continue;
    p.angles.push_back(0);
    p.angular_velocities.push_back(0);
    p.inertias.push_back(round_shape(2, radius).inertia(mass));
  }
  add_missing_ids(p);
  c.arrangement = std::move(asked);
}

std::vector<case_file::KeyTable> arrangement_tables() {
  return {case_file::describe_keys("[arrangement]", arrangement_keys, 2, true),
          case_file::describe_keys("a table of species", species_keys, true, true),
          case_file::describe_keys("a table of radii", distribution_keys)};
}

}  // namespace viscontact::particles
