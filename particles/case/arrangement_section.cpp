// Reads the section [arrangement] of a case of many particles, which places particles at random,
// and the species (kinds) of particles that arrangements and sources have. In the units of the
// case, radii [L], masses [M], densities and shares are from 1e-100 to 1e100 (mass and density in a
// fluid also 0), sigma is from 1e-6 to 1, a fraction in (0, 1), the gap [L] >= 0, a count 1 to 1e6.
// A wrong value, and particles that do not fit, are an Error(kBadInput) with the line. This file is
// used by particle_tables.cpp and source_section.cpp. A change must keep keys and defaults, which
// users' cases rely on.
#include <algorithm>
#include <limits>
#include <string_view>

#include "viscontact/particles/case/particles_sections.hpp"
#include "viscontact/particles/domain/region.hpp"

namespace viscontact::particles {
namespace {

// Each function whose name ends in _keys declares the keys of a table: name, range, meaning and
// default. When a case is read (keys.reads() is true), such a function stores the values in its
// second argument, and Error(kBadInput) with the line is thrown for a key that is missing, unknown
// or out of range. The same functions make the tables of docs/case-file.md; then nothing is thrown.
constexpr std::string_view kRadiusWords =
    "a number, a list of numbers, `{ uniform = [a, b] }` or `{ lognormal = { median, sigma } }`";

/// Keys of a distribution of radii whose logarithm is normally distributed: the median radius [L]
/// and the standard deviation sigma of the logarithm [1].
void lognormal_keys(case_file::Keys& keys, RadiusDistribution& radius) {
  // A free choice: with sigma = 1, all but 6 in 1e5 radii are within a factor of 55 of the median.
  constexpr Allowed kSigma = {[](double v) { return v >= 1e-6 && v <= 1; }, "from 1e-6 to 1"};
  keys.required("median", case_file::number(radius.median, kModeratelyPositive), {"median radius"});
  keys.required("sigma", case_file::number(radius.sigma, kSigma),
                {"standard deviation of the logarithm of the radius"});
}

/// Reads the two ends of a uniform distribution, the smallest and the largest radius [L]. Throws
/// Error(kBadInput) unless 0 < smallest < largest.
void read_uniform(const case_file::TomlSection& section, std::string_view key,
                  RadiusDistribution& radius) {
  const auto ends = section.numbers(key, kModeratelyPositive);
  section.require(ends.size() == 2 && ends[0] < ends[1], key,
                  "must be two numbers, the smallest and the largest radius");
  radius.from = ends[0];
  radius.to = ends[1];
}

/// Keys of a table of radii, of which exactly one must be given: `uniform` or `lognormal`.
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

/// Reads the key `radius`: a number [L], a list of numbers [L], or a table of radii.
void read_radius(const case_file::TomlSection& section, std::string_view key,
                 RadiusDistribution& radius) {
  if (section.is_table(key))
    case_file::read_keys(section.section(key), distribution_keys, radius);
  else if (section.is_array(key))
    radius.list = section.numbers(key, kModeratelyPositive);
  else
    radius.list = {section.number(key, kModeratelyPositive)};
}

/// Keys of a species. If `is_listed`, they are in a table of the list `species`, otherwise in the
/// section itself. `has_fluid` says that the case has a fluid, in which masses may be 0.
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

/// Reads the list `species`, one table for each species.
void read_species(const case_file::TomlSection& section, std::string_view key,
                  std::vector<Species>& all, bool has_fluid) {
  for (const auto& table : section.sections(key))
    case_file::read_keys(table, species_keys, all.emplace_back(), has_fluid, true);
}

/// The values of the keys of [arrangement].
struct ArrangementKeys {
  std::vector<Species> species;
  std::size_t count = 0;     // number of particles; 0: not given
  double fraction = 0;       // fraction of the area or volume of the domain, < 1; 0: not given
  double smallest_gap = -1;  // [L]; -1: not given
  std::uint64_t seed = 1;    // of the random numbers, from 0 to 2^31 - 1
};

/// Keys of [arrangement]. `dimension` is 2 (discs) or 3 (spheres). The number of particles is given
/// either by `count` or by the fraction of the domain that they cover.
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
                 "0.05 smallest radius"});
  keys.optional("seed", case_file::count(asked.seed, 0, std::numeric_limits<int>::max()),
                {"the same seed gives the same arrangement, bit for bit on every machine"});
}

}  // namespace

/// Keys of all species: either a list `species`, or the keys of one species in the section itself.
/// Appends the species to `all`.
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

/// Reads [arrangement], draws its particles and places them at rest. Appends them to c.particles,
/// in a fluid also angles, angular velocities and moments of inertia, and keeps in c.arrangement
/// what was asked for. c.setting must have the domain and the fluid. Throws Error(kBadInput) if the
/// domain is neither a disc nor a box, for more than kLargestCount (1 000 000) particles, for too
/// few free ids, and if the particles do not fit.
void read_arrangement(const case_file::TomlSection& section, ParticlesCase& c) {
  auto& p = c.particles;
  const auto& domain = c.setting.domain;
  const bool has_fluid = c.setting.fluid.has_value();
  section.require(
      std::holds_alternative<DiscDomain>(domain) || std::holds_alternative<BoxDomain>(domain),
      section.has("species") ? "species" : "radius",
      "belongs to an arrangement, which needs a section [domain] with a disc or a box");
  ArrangementKeys keys;
  case_file::read_keys(section, arrangement_keys, keys, p.dimension, has_fluid);
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
  constexpr double kGapOfRadius = 0.05;  // free; a change alters the arrangements of seeds
  if (asked.smallest_gap < 0) asked.smallest_gap = kGapOfRadius * std::ranges::min(asked.radii);
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
    p.inertias.push_back(homogeneous_inertia(2, mass, radius));
  }
  add_missing_ids(p);
  c.arrangement = std::move(asked);
}

/// The tables of docs/case-file.md for these keys.
std::vector<case_file::KeyTable> arrangement_tables() {
  return {case_file::describe_keys("[arrangement]", arrangement_keys, 2, true),
          case_file::describe_keys("a table of species", species_keys, true, true),
          case_file::describe_keys("a table of radii", distribution_keys)};
}

}  // namespace viscontact::particles
