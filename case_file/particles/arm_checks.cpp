// Reads the lengths of arms and checks them against the particles and each other (arm_checks.hpp).
#include "viscontact/case_file/particles/arm_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "viscontact/case_file/vector_values.hpp"

namespace viscontact::case_file {
namespace {

using particles::Arm;
using particles::index_of;
using particles::operator-;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators

particles::ArmLength read_pieces_of_length(const TomlSection& length) {
  particles::PiecewiseLinearLength pieces;
  for (const auto& row : length.rows("pieces", 2, kModeratelyPositiveOr0)) {
    if (pieces.points.empty() ? row[0] != 0 : !(row[0] > pieces.points.back()[0]))
      length.fail("pieces", fmt::format("contains the time {}; the first time must be 0 and each "
                                        "other time later than the one before it",
                                        row[0]));
    if (!(row[1] > 0))
      length.fail("pieces", fmt::format("contains the length {}; it must be > 0", row[1]));
    pieces.points.push_back({row[0], row[1]});
  }
  if (length.has("period")) {
    pieces.period = length.number("period", kModeratelyPositive);
    const auto& last = pieces.points.back();
    if (last[0] > pieces.period)
      length.fail("period", fmt::format("is {}; it must be at least the last time of the pieces, "
                                        "{}",
                                        pieces.period, last[0]));
    if (last[0] == pieces.period) {
      // The next period begins there.
      if (last[1] != pieces.points.front()[1])
        length.fail("pieces",
                    fmt::format("ends with the length {} at the end of the period; it must be {}, "
                                "with which the next period begins",
                                last[1], pieces.points.front()[1]));
      pieces.points.pop_back();
      if (pieces.points.empty()) length.fail("period", "is 0");
    }
  }
  return pieces;
}

std::string arm_in_words(const ParticlesCase& c, const Arm& arm) {
  return fmt::format("between particles {} and {}", c.particles.id(index_of(arm.first)),
                     c.particles.id(index_of(arm.second)));
}

/// Times that decide about several arms.
std::vector<double> times_of(std::span<const Arm* const> arms, double end) {
  std::vector<double> times;
  for (const auto* arm : arms) {
    const auto own = particles::decisive_times(arm->length, end);
    times.insert(times.end(), own.begin(), own.end());
  }
  std::ranges::sort(times);
  return times;
}

void check_arm(const TomlSection& section, const Arm& arm, const ParticlesCase& c) {
  // Distances of places that are given with six digits are accepted. The first step corrects them.
  constexpr double kRounded = 1e-6;
  const double length = particles::length_at(arm.length, 0);
  const double distance = distance_at_start(c, arm.first, arm.second);
  if (!(std::abs(length - distance) <= kRounded * distance))
    section.fail("length", fmt::format("is {} at the start, but the centres of particles {} and {} "
                                       "are {:.9g} apart; it must begin with their distance",
                                       length, c.particles.id(index_of(arm.first)),
                                       c.particles.id(index_of(arm.second)), distance));
  const double touching =
      c.particles.radii[index_of(arm.first)] + c.particles.radii[index_of(arm.second)];
  const std::array of = {&arm};
  for (const double time : times_of(of, c.end_time)) {
    const double here = particles::length_at(arm.length, time);
    if (!(here >= touching * (1 - kRounded)))
      section.fail("length", fmt::format("is {:.9g} at time {:.9g}, where its particles would "
                                         "overlap; it must be at least the sum of their radii, {}",
                                         here, time, touching));
  }
}

/// Checks that arm `sides[0]` is never longer than the two others together.
void check_triangle(std::span<const TomlSection> sections, const ParticlesCase& c,
                    std::array<std::size_t, 3> sides) {
  const auto& arms = c.setting.links.arms;
  const std::array of = {&arms[sides[0]], &arms[sides[1]], &arms[sides[2]]};
  // Equality, where all three are on a line, is lost in rounding.
  constexpr double kRounding = 1e-9;
  for (const double time : times_of(of, c.end_time)) {
    const auto length = [&](std::size_t side) {
      return particles::length_at(of[side]->length, time);
    };
    if (length(0) > (1 + kRounding) * (length(1) + length(2)))
      sections[sides[0]].fail(
          "length",
          fmt::format("is {:.9g} at time {:.9g}, more than the sum {:.9g} of the arms {} and {}; "
                      "these three arms cannot meet in a triangle",
                      length(0), time, length(1) + length(2), arm_in_words(c, *of[1]),
                      arm_in_words(c, *of[2])));
  }
}

}  // namespace

particles::ArmLength read_arm_length(const TomlSection& section) {
  if (!section.is_table("length"))
    return particles::PiecewiseLinearLength{{{0, section.number("length", kModeratelyPositive)}}};
  const auto length = section.section("length");
  if (length.has("pieces")) {
    auto pieces = read_pieces_of_length(length);
    length.finish();
    return pieces;
  }
  particles::SinusoidalLength wave;
  wave.mean = length.number("mean", kModeratelyPositive);
  wave.amplitude = length.number("amplitude", kModerate);
  wave.angular_frequency = length.number("angular_frequency", kModerate);
  if (length.has("phase")) wave.phase = length.number("phase", kModerate);
  if (!(std::abs(wave.amplitude) < wave.mean))
    length.fail("amplitude", fmt::format("is {}; it must be smaller than the mean length, {}",
                                         wave.amplitude, wave.mean));
  length.finish();
  return wave;
}

double distance_at_start(const ParticlesCase& c, std::int32_t first, std::int32_t second) {
  return particles::norm(particles::nearest_image(
      particles::cell_of(c.setting.domain),
      c.particles.position(index_of(second)) - c.particles.position(index_of(first))));
}

void check_arms(std::span<const TomlSection> sections, const ParticlesCase& c) {
  const auto& arms = c.setting.links.arms;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> between;
  for (std::size_t k = 0; k < arms.size(); ++k) {
    if (!between.emplace(std::minmax(arms[k].first, arms[k].second), k).second)
      sections[k].fail("between", fmt::format("names the same particles as an arm before it; there "
                                              "must be one arm {}",
                                              arm_in_words(c, arms[k])));
    check_arm(sections[k], arms[k], c);
  }
  // All triangles: for each arm, the particles that arms connect with both of its ends.
  std::map<std::int32_t, std::vector<std::int32_t>> neighbours;
  for (const auto& arm : arms) {
    neighbours[arm.first].push_back(arm.second);
    neighbours[arm.second].push_back(arm.first);
  }
  for (std::size_t k = 0; k < arms.size(); ++k)
    for (const auto third : neighbours[arms[k].first]) {
      const auto other = between.find(std::minmax(arms[k].second, third));
      if (third == arms[k].second || other == between.end()) continue;
      check_triangle(sections, c,
                     {k, between.at(std::minmax(arms[k].first, third)), other->second});
    }
}

}  // namespace viscontact::case_file
