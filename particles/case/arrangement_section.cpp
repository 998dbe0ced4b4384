// Reads [arrangement] and [[source]] of a case of many particles, and the species of their particles
// (particles_sections.hpp). Lengths, masses and times are in the units of the case. A wrong value is
// an Error(kBadInput) with its line. A change must keep keys and defaults, which users' cases rely
// on. Used by particle_tables.cpp.
#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>

#include "viscontact/particles/case/particles_sections.hpp"

namespace viscontact::particles {
namespace {

constexpr int kMostDrawn = 1000000;  // with which times and memory were measured (bench/README.md)
constexpr std::string_view kRadiusWords =
    "a number, a list of numbers, `{ uniform = [a, b] }` or `{ lognormal = { median, sigma } }`";

void lognormal_keys(case_file::Keys& keys, RadiusDistribution& radius) {
  // Four standard deviations, beyond which 6 in 1e5 radii are, are then a factor of 55.
  constexpr Allowed kSigma = {[](double v) { return v >= 1e-6 && v <= 1; }, "from 1e-6 to 1"};
  keys.required("median", case_file::number(radius.median, kModeratelyPositive), {"median radius"});
  keys.required("sigma", case_file::number(radius.sigma, kSigma),
                {"standard deviation of the logarithm of the radius"});
}

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

void read_radius(const case_file::TomlSection& section, std::string_view key,
                 RadiusDistribution& radius) {
  if (section.is_table(key))
    case_file::read_keys(section.section(key), distribution_keys, radius);
  else if (section.is_array(key))
    radius.list = section.numbers(key, kModeratelyPositive);
  else
    radius.list = {section.number(key, kModeratelyPositive)};
}

/// The keys of a species, which are those of the whole section if it has one species.
void species_keys(case_file::Keys& keys, Species& species, bool has_fluid, bool is_listed) {
  keys.required("radius", case_file::custom(kRadiusWords, read_radius, species.radius),
                {"radius of each particle. The radii of a list are taken in turn"});
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
      {"mass of each particle", "required without `density`; in a fluid 0",
       "from 1e-100 to 1e100, in a fluid also 0"});
}

void read_species(const case_file::TomlSection& section, std::string_view key,
                  std::vector<Species>& all, bool has_fluid) {
  for (const auto& table : section.sections(key))
    case_file::read_keys(table, species_keys, all.emplace_back(), has_fluid, true);
}

/// Either the list `species`, or one species whose keys stand in the section itself.
void all_species_keys(case_file::Keys& keys, std::vector<Species>& all, const bool& has_fluid) {
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

/// What [arrangement] says before the particles are placed.
struct ArrangementKeys {
  std::vector<Species> species;
  std::size_t count = 0;  // 0: not given
  double fraction = 0;    // of the area or volume of the domain
  double smallest_gap = -1;
  std::uint64_t seed = 1;
};

void arrangement_keys(case_file::Keys& keys, ArrangementKeys& asked, int dimension,
                      bool has_fluid) {
  all_species_keys(keys, asked.species, has_fluid);
  const std::string_view fraction = dimension == 3 ? "volume_fraction" : "area_fraction";
  const std::string_view other = dimension == 3 ? "area_fraction" : "volume_fraction";
  keys.require(!keys.has(other), other, "must be {} in {} dimensions", fraction, dimension);
  keys.require(!(keys.has("count") && keys.has(fraction)), "count",
               "must be left out, because {} is given", fraction);
  keys.required_if(!keys.has(fraction), "count", case_file::count(asked.count, 1, kMostDrawn),
                   {"number of particles", "required without a fraction"});
  for (const std::string_view key : {"area_fraction", "volume_fraction"})
    if (!keys.reads() || key == fraction)
      keys.optional(key, case_file::number(asked.fraction, case_file::kFraction),
                    {key == "area_fraction"
                         ? "in place of `count`: area of these discs over the area of the domain"
                         : "in place of `count`: volume of these spheres over that of the domain",
                     "from `count`"});
  keys.optional("smallest_gap", case_file::number(asked.smallest_gap, kNotNegative),
                {"least gap of two of the particles (also across periodic sides), of one and "
                 "another particle, and of one and a wall",
                 "0.05 smallest radius"});
  keys.optional("seed", case_file::count(asked.seed, 0, std::numeric_limits<int>::max()),
                {"the same seed gives the same arrangement, bit for bit on every machine"});
}

/// A table [[source]].
struct SourceKeys {
  Source source;
  std::optional<std::size_t> number;
  std::optional<double> rate;
};

void region_keys(case_file::Keys& keys, Source& source, int dimension) {
  keys.required("from", vector(source.from, dimension), {"corner with the smallest coordinates"});
  keys.required("to", vector(source.to, dimension), {"corner with the largest coordinates"});
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    keys.require(source.from[d] <= source.to[d], "to",
                 "contains {}; it must be at least {}, the same coordinate of from", source.to[d],
                 source.from[d]);
}

void source_keys(case_file::Keys& keys, SourceKeys& asked, int dimension) {
  const bool has_fluid = false;
  auto& source = asked.source;
  all_species_keys(keys, source.species, has_fluid);
  const auto read_region = [&](const case_file::TomlSection& section, std::string_view key) {
    case_file::read_keys(section.section(key), region_keys, source, dimension);
  };
  keys.required("region", case_file::custom("`{ from, to }`", read_region),
                {"the box in which the centres of new particles are"});
  const bool has_rate =
      keys.optional("rate", case_file::number(asked.rate, kModeratelyPositive),
                    {"particles in a unit of time, the first one at `from`", "from `number`"});
  int number = 0;
  const bool has_number = keys.optional(
      "number", case_file::count(number, 1, kMostDrawn),
      {"number of particles in all; without `rate` they come evenly from `from` to `until`",
       "from `rate`"});
  if (has_number) asked.number = static_cast<std::size_t>(number);
  keys.require(has_rate || has_number, "rate",
               "and number are missing; a source must have one of them, and may have both");
  keys.optional("from", case_file::number(source.begin, kNotNegative),
                {"time of the first particle"});
  keys.optional("until", case_file::number(source.end, kModeratelyPositive),
                {"time after which no particle comes", "`end_time`"});
  keys.require(source.end > source.begin, "until", "is {}; it must be later than from, {}",
               source.end, source.begin);
  keys.optional("velocity", vector(source.velocity, dimension),
                {"velocity of each particle when it comes", "zeros"});
  keys.optional("seed", case_file::count(source.seed, 0, std::numeric_limits<int>::max()),
                {"of radii and places: the same seed gives the same particles on every machine"});
}

/// Throws an error if a corner of the region is outside the domain or behind an obstacle.
void check_region(const case_file::TomlSection& section, const Source& source,
                  const ParticlesCase& c) {
  const auto* box = std::get_if<BoxDomain>(&c.setting.domain);
  const auto obstacles = positions_of(obstacles_of(c.setting), 0);
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vector x{};
    for (std::size_t d = 0; d < 3; ++d)
      x[d] = ((corner >> d & 1U) != 0 ? source.to : source.from)[d];
    bool is_free = true;
    for (const auto& place : obstacles) is_free = is_free && gap(place, x, 0) >= 0;
    for (std::size_t d = 0; box != nullptr && d < box->dimension(); ++d)
      is_free = is_free && box->from[d] <= x[d] && x[d] <= box->to[d];
    section.require(
        is_free, "region",
        "has the corner ({}), which is outside the domain or behind a plane; the region "
        "must be inside",
        fmt::join(x.begin(), x.begin() + c.particles.dimension, ", "));
  }
}

}  // namespace

void read_arrangement(const case_file::TomlSection& section, ParticlesCase& c) {
  auto& p = c.particles;
  const auto& domain = c.setting.domain;
  const bool has_fluid = c.setting.fluid.has_value();
  section.require(
      std::holds_alternative<DiscDomain>(domain) || std::holds_alternative<BoxDomain>(domain),
      "radius", "belongs to an arrangement, which needs a section [domain] with a disc or a box");
  ArrangementKeys keys;
  case_file::read_keys(section, arrangement_keys, keys, p.dimension, has_fluid);
  const std::string_view key = keys.count > 0     ? "count"
                               : p.dimension == 3 ? "volume_fraction"
                                                  : "area_fraction";
  const DrawnSpecies species(keys.species, p.dimension, keys.seed);
  const auto particles = keys.count > 0
                             ? drawn(species, keys.count)
                             : drawn_to_size(species, p.dimension, keys.fraction * size_of(domain),
                                             static_cast<std::size_t>(kMostDrawn) + 1);
  section.require(particles.size() <= static_cast<std::size_t>(kMostDrawn), key,
                  "makes more than {} particles of these radii; at most {} are allowed", kMostDrawn,
                  kMostDrawn);
  Arrangement asked{.radii = {}, .smallest_gap = keys.smallest_gap, .seed = keys.seed};
  for (const auto& particle : particles) asked.radii.push_back(particle.radius);
  constexpr double kGapOfRadius = 0.05;
  if (asked.smallest_gap < 0) asked.smallest_gap = kGapOfRadius * std::ranges::min(asked.radii);
  const auto centres = case_file::at_key(section, key, [&] { return arrange(asked, domain, p); });

  constexpr int kLargestId = std::numeric_limits<int>::max();
  const auto largest_id = p.ids.empty() ? 0 : std::ranges::max(p.ids);
  const auto last_id = static_cast<std::size_t>(largest_id) + particles.size();
  section.require(p.ids.empty() || last_id <= static_cast<std::size_t>(kLargestId), key,
                  "needs ids above {}, the largest id of the other particles; at most {} is "
                  "possible",
                  largest_id, kLargestId);
  p.positions.insert(p.positions.end(), centres.begin(), centres.end());
  p.velocities.resize(p.positions.size());
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const auto [radius, mass] = particles[k];
    p.radii.push_back(radius);
    p.masses.push_back(mass);
    if (!p.ids.empty()) p.ids.push_back(largest_id + 1 + static_cast<std::int32_t>(k));
    if (!has_fluid) continue;
    p.angles.push_back(0);
    p.angular_velocities.push_back(0);
    p.inertias.push_back(homogeneous_inertia(2, mass, radius));
  }
  c.arrangement = std::move(asked);
}

void read_sources(const case_file::TomlSection& root, ParticlesCase& c) {
  if (!root.has("source")) return;
  for (const auto& section : root.sections("source")) {
    section.require(!c.setting.fluid, "region",
                    "belongs to a source of particles; the case must not have a section [fluid]");
    SourceKeys keys{.source = {}, .number = {}, .rate = {}};
    keys.source.end = c.end_time;
    case_file::read_keys(section, source_keys, keys, c.particles.dimension);
    auto& source = keys.source;
    source.most = keys.number.value_or(kMostDrawn);
    source.rate =
        keys.rate ? *keys.rate : static_cast<double>(source.most) / (source.end - source.begin);
    // Sources with one seed pour different particles.
    source.seed = splitmix_hash(source.seed) + c.setting.sources.size();
    check_region(section, source, c);
    section.require(source.due(source.end) < kMostDrawn || keys.number, "rate",
                    "makes more than {} particles; at most {} are allowed", kMostDrawn, kMostDrawn);
    c.setting.sources.push_back(std::move(source));
  }
}

std::vector<case_file::KeyTable> arrangement_tables() {
  return {case_file::describe_keys("[arrangement]", arrangement_keys, 2, false),
          case_file::describe_keys("a table of species", species_keys, false, true),
          case_file::describe_keys("a table of radii", distribution_keys),
          case_file::describe_keys("[[source]]", source_keys, 2),
          case_file::describe_keys("source.region", region_keys, 2)};
}

}  // namespace viscontact::particles
