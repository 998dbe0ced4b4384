// What a sweep varies: keys of a case and the values that each takes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace viscontact {

/// One key and its values. A range has `count` values from `first` to `last`, equally spaced or in geometric progression.
struct Variation {
  std::string key;  ///< as in a case file: "fluid.viscosity", "motion.external_force[0].value"
  std::vector<double> values;  ///< a list; empty: a range
  double first = 0, last = 0;
  bool logarithmic = false;
  std::uint64_t count = 0;  ///< of values, >= 1

  /// The i-th value, 0 <= i < count.
  double value(std::uint64_t i) const;

  /// The value at a share of the way in [0, 1): of a range, by its spacing; of a list, one of them.
  double at(double share) const;
};

/// Reads "KEY=A:B:log:N", "KEY=A:B:N" (equally spaced) or "KEY=V,V,...". "motion.mass" stands for "sphere.mass". Throws Error(kWrongUsage) that
/// says what is wrong: no key, no finite numbers, a range with log that does not stay on one side of 0, N not in [1, 1e9].
Variation parse_variation(std::string_view text);

/// The numbers of point `index` of the grid of all values, the last variation the fastest.
std::vector<std::pair<std::string, double>> grid_point(const std::vector<Variation>& variations,
                                                       std::uint64_t index);

/// The numbers of random sample `index`: independent of each other, always the same for a seed.
std::vector<std::pair<std::string, double>> random_point(const std::vector<Variation>& variations,
                                                         std::uint64_t index, std::uint64_t seed);

/// Number of points of the grid. Throws Error(kWrongUsage) beyond 1e12.
std::uint64_t grid_size(const std::vector<Variation>& variations);

}  // namespace viscontact
