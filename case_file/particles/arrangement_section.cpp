// Reads [arrangement] (arrangement_section.hpp). Lengths and masses are in the units of the case. A
// change must keep the keys and their defaults, because users have written cases with them.
#include "viscontact/case_file/particles/arrangement_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <variant>

#include "viscontact/case_file/keys.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::case_file {
namespace {

constexpr Allowed kAreaFraction = {[](double v) { return v > 0 && v < 1; }, "between 0 and 1"};
// Squares of these numbers and of their inverses are finite and not 0.
constexpr Allowed kDiscSize = {[](double v) { return v >= 1e-100 && v <= 1e100; },
                               "from 1e-100 to 1e100"};
constexpr Allowed kDiscMass = {[](double v) { return v == 0 || (v >= 1e-100 && v <= 1e100); },
                               "0, or from 1e-100 to 1e100"};
constexpr int kMostDiscs = 1000000;

/// Reads `count`, or computes the count from `area_fraction`.
std::size_t read_count(const TomlSection& section, double radius, const particles::Domain& domain) {
  const bool has_fraction = section.has("area_fraction");
  if (has_fraction && section.has("count"))
    section.fail("count", "must be left out, because area_fraction is given");
  if (!has_fraction) return static_cast<std::size_t>(section.count("count", 1, kMostDiscs));
  const auto count =
      particles::count_of(section.number("area_fraction", kAreaFraction), radius, domain);
  if (count > static_cast<std::size_t>(kMostDiscs))
    section.fail("area_fraction", fmt::format("makes {} discs of this radius; at most {} are "
                                              "allowed",
                                              count, kMostDiscs));
  return count;
}

}  // namespace

particles::Arrangement read_arrangement(const TomlSection& section, const particles::Domain& domain,
                                        bool has_fluid, particles::Particles& p) {
  if (p.dimension != 2)
    section.fail("radius", "belongs to an arrangement of discs; space.dimension must be 2");
  if (!std::holds_alternative<particles::DiscDomain>(domain) &&
      !std::holds_alternative<particles::BoxDomain>(domain))
    section.fail("radius",
                 "belongs to an arrangement, which needs a section [domain] with a disc or a box");
  particles::Arrangement asked;
  asked.radius = section.number("radius", kDiscSize);
  asked.count = read_count(section, asked.radius, domain);
  constexpr double kGapInRadii = 0.05;
  asked.smallest_gap = section.has("smallest_gap") ? section.number("smallest_gap", kNotNegative)
                                                   : kGapInRadii * asked.radius;
  if (section.has("seed"))
    asked.seed =
        static_cast<std::uint64_t>(section.count("seed", 0, std::numeric_limits<int>::max()));
  const bool needs_mass = !has_fluid || section.has("mass");
  const double mass = needs_mass ? section.number("mass", has_fluid ? kDiscMass : kDiscSize) : 0;
  section.finish();
  const std::string_view key = section.has("count") ? "count" : "area_fraction";
  const auto centres = at_key(section, key, [&] { return particles::arrange(asked, domain, p); });

  const auto largest_id = p.ids.empty() ? 0 : std::ranges::max(p.ids);
  const auto last_id = static_cast<std::size_t>(largest_id) + asked.count;
  if (!p.ids.empty() && last_id > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    section.fail(key, fmt::format("needs ids above {}, the largest id of the other particles; at "
                                  "most {} is possible",
                                  largest_id, std::numeric_limits<int>::max()));
  p.positions.insert(p.positions.end(), centres.begin(), centres.end());
  p.velocities.resize(p.positions.size());
  for (std::size_t k = 0; k < asked.count; ++k) {
    p.radii.push_back(asked.radius);
    p.masses.push_back(mass);
    if (!p.ids.empty()) p.ids.push_back(largest_id + 1 + static_cast<std::int32_t>(k));
    if (!has_fluid) continue;
    p.angles.push_back(0);
    p.angular_velocities.push_back(0);
    p.inertias.push_back(mass * asked.radius * asked.radius / 2);
  }
  return asked;
}

}  // namespace viscontact::case_file
