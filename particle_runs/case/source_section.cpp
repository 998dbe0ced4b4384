// Reads [[source]].
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>
#include <variant>

#include "viscontact/arrangement/species.hpp"
#include "viscontact/particle_runs/case/particles_sections.hpp"

namespace viscontact::particles {
namespace {

/// An empty member means that the table does not have its key.
struct SourceKeys {
  Source source;
  std::optional<std::size_t> number;  // particles in all, 1 to kLargestCount
  std::optional<double> rate;         // particles per time [1/T]
};

/// Reads the corners of the box into `source`. Throws if a coordinate of `to` is less than that of
/// `from`.
void region_keys(case_file::Keys& keys, Source& source, int dimension) {
  keys.required("from", vector(source.from, dimension), {"corner with the smallest coordinates"});
  keys.required("to", vector(source.to, dimension), {"corner with the largest coordinates"});
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    keys.require(source.from[d] <= source.to[d], "to",
                 "contains {}; it must be at least {}, the same coordinate of from", source.to[d],
                 source.from[d]);
}

/// Before the call, asked.source.end must hold the default of `end` [T]. Throws if `rate` and
/// `number` are both missing, and if `end` is not later than `begin`. read_source() completes the
/// members largest_count, rate and seed of asked.source.
void source_keys(case_file::Keys& keys, SourceKeys& asked, int dimension) {
  auto& source = asked.source;
  all_species_keys(keys, source.species, false);
  const auto read_region = [&](const case_file::TomlSection& section, std::string_view key) {
    case_file::read_keys(section.section(key), region_keys, source, dimension);
  };
  keys.required("region", case_file::custom("`{ from, to }`", read_region),
                {"the box in which the centres of new particles are"});
  const bool has_rate =
      keys.optional("rate", case_file::number(asked.rate, kModeratelyPositive),
                    {"particles in a unit of time, the first one at `begin`", "from `number`"});
  int number = 0;
  const bool has_number = keys.optional(
      "number", case_file::count(number, 1, kLargestCount),
      {"number of particles in all; without `rate` they come evenly from `begin` to `end`",
       "from `rate`"});
  if (has_number) asked.number = static_cast<std::size_t>(number);
  keys.require(has_rate || has_number, "rate",
               "and number are missing; a source must have one of them, and may have both");
  keys.optional("begin", case_file::number(source.begin, kNotNegative),
                {"time of the first particle"});
  keys.optional("end", case_file::number(source.end, kModeratelyPositive),
                {"time after which no particle comes", "`end_time`"});
  keys.require(source.end > source.begin, "end", "is {}; it must be later than begin, {}",
               source.end, source.begin);
  keys.optional("velocity", vector(source.velocity, dimension),
                {"velocity of each particle when it comes", "zeros"});
  keys.optional("seed", case_file::count(source.seed, 0, std::numeric_limits<int>::max()),
                {"of radii and places: the same seed gives the same particles on every machine"});
}

/// Throws if a corner of the region is outside the domain or, at time 0, behind an obstacle.
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
    section.require(is_free, "region",
                    "has the corner ({}), which is outside the domain or behind a plane; the "
                    "region must be inside",
                    fmt::join(x.begin(), x.begin() + c.particles.dimension, ", "));
  }
}

/// Throws Error(kBadInput) if the case has a fluid, if the region does not fit (check_region()),
/// and for more than kLargestCount particles.
Source read_source(const case_file::TomlSection& section, const ParticlesCase& c) {
  section.require(!c.setting.fluid, "region",
                  "belongs to a source of particles; the case must not have a section [fluid]");
  SourceKeys keys{.source = {}, .number = {}, .rate = {}};
  keys.source.end = c.end_time;
  case_file::read_keys(section, source_keys, keys, c.particles.dimension);
  auto source = std::move(keys.source);
  source.largest_count = keys.number.value_or(kLargestCount + 1);
  source.rate = keys.rate ? *keys.rate
                          : static_cast<double>(source.largest_count) / (source.end - source.begin);
  // Two sources with the same seed in the case must not add the same particles.
  source.seed = splitmix_hash(source.seed) + c.setting.sources.size();
  check_region(section, source, c);
  section.require(source.due(source.end) <= kLargestCount, "rate",
                  "makes more than {} particles; at most {} are allowed", kLargestCount,
                  kLargestCount);
  return source;
}

/// The radii of all particles that a source adds until it ends.
struct RadiiOfSource {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0, sum = 0;  // [L]
  std::size_t count = 0;
};

RadiiOfSource radii_of(const Source& source, int dimension) {
  RadiiOfSource radii;
  const auto widen = [&](double radius) {
    radii.smallest = std::min(radii.smallest, radius);
    radii.largest = std::max(radii.largest, radius);
  };
  const DrawnSpecies all(source.species, dimension, source.seed);
  for (const auto& particle : drawn(all, source.due(source.end))) {
    widen(particle.radius);
    radii.sum += particle.radius;
    ++radii.count;
  }
  // The bounds of a uniform distribution are included, so that the seed does not decide whether a
  // case is accepted.
  for (const auto& species : source.species) {
    if (species.radius.kind != RadiusDistribution::Kind::kUniform) continue;
    widen(species.radius.from);
    widen(species.radius.to);
  }
  return radii;
}

/// An upper bound of the radius [L] with which a particle has a place in the region of the source;
/// infinity if nothing bounds the radius. Each wall and plane at rest bounds it, and half of the
/// distance between opposite sides of a box does, too.
double largest_radius_between_walls(const Source& source, const Setting& setting) {
  double radius = std::numeric_limits<double>::infinity();
  for (const auto& obstacle : obstacles_of(setting)) {
    if (!obstacle.velocity.pieces.empty() || norm(obstacle.angular_velocity) > 0 || obstacle.load)
      continue;
    Vector farthest{};  // point of the region that is farthest from the obstacle
    for (std::size_t d = 0; d < 3; ++d)
      farthest[d] = obstacle.start.is_curved()
                        ? std::clamp(obstacle.start.point[d], source.from[d], source.to[d])
                        : (obstacle.start.normal[d] > 0 ? source.to : source.from)[d];
    radius = std::min(radius, gap(obstacle.start, farthest, 0));
  }
  if (const auto* box = std::get_if<BoxDomain>(&setting.domain))
    for (std::size_t d = 0; d < box->dimension(); ++d)
      if (!box->periodic[d]) radius = std::min(radius, (box->to[d] - box->from[d]) / 2);
  return radius;
}

/// Throws if the largest particle of a source has no place in the region, or would touch its own
/// image in the next period. Also throws if a radius is too small, or the region too far from the
/// origin, for solver.tolerance. `mean_radii` are the least and the largest mean radius of all
/// particles during the run.
void check_radii(const case_file::TomlSection& section, const Source& source,
                 const RadiiOfSource& radii, const std::array<double, 2>& mean_radii,
                 const ParticlesCase& c) {
  const auto key = section.has("species") ? "species" : "radius";
  const double room = largest_radius_between_walls(source, c.setting);
  section.require(radii.largest <= room, key,
                  "gives particles the radius {:.6g}, for which the region has no place; between "
                  "walls and planes it has places for radii up to {:.6g}",
                  radii.largest, room);
  for (const double period : periods_of(c.setting.domain)) {
    const double largest = period / (2 + kLeastGapToImage);
    section.require(period == 0 || radii.largest <= largest, key,
                    "gives particles the radius {:.6g}, which is too large for the period of the "
                    "domain, {}: they would touch their own images; it must be at most {:.6g}",
                    radii.largest, period, largest);
  }
  const double tolerance = c.setting.solver.tolerance;
  const double smallest = c.particles.count() == 0
                              ? radii.smallest
                              : std::min(radii.smallest, std::ranges::min(c.particles.radii));
  section.require(tolerance * mean_radii[1] <= kToleranceOfRadius * smallest, key,
                  "gives particles radii from {:.6g} to {:.6g}, for which solver.tolerance, {}, is "
                  "too large: the tolerance times the mean radius of all particles, {:.3g}, must "
                  "be at most a hundredth of each radius; the smallest one is {:.6g}",
                  radii.smallest, radii.largest, tolerance, tolerance * mean_radii[1], smallest);
  const double farthest = largest_resolved_distance(tolerance, mean_radii[0]);
  for (const auto& corner : {source.from, source.to})
    for (const double x : corner)
      section.require(std::abs(x) <= farthest, "region",
                      "is too far from the origin for gaps to be known to solver.tolerance; each "
                      "coordinate must be at most {:.3g} in magnitude",
                      farthest);
}

}  // namespace

void read_sources(const case_file::TomlSection& root, ParticlesCase& c) {
  if (!root.has("source")) return;
  const auto& p = c.particles;
  auto& sources = c.setting.sources;
  const auto sections = root.sections("source");
  std::vector<RadiiOfSource> radii;
  double sum = std::accumulate(p.radii.begin(), p.radii.end(), 0.0);
  std::size_t count = 0;
  for (const auto& section : sections) {
    sources.push_back(read_source(section, c));
    radii.push_back(radii_of(sources.back(), p.dimension));
    sum += radii.back().sum;
    count += radii.back().count;
    require_ids(section, section.has("number") ? "number" : "rate", p, count);
  }
  // The mean radius changes while sources add particles.
  const double at_end = sum / static_cast<double>(p.count() + count);
  const double at_start = p.count() > 0 ? mean_radius(p) : at_end;
  for (std::size_t s = 0; s < sections.size(); ++s)
    check_radii(sections[s], sources[s], radii[s],
                {std::min(at_start, at_end), std::max(at_start, at_end)}, c);
}

std::vector<case_file::KeyTable> source_tables() {
  return {case_file::describe_keys("[[source]]", source_keys, 2),
          case_file::describe_keys("source.region", region_keys, 2)};
}

}  // namespace viscontact::particles
