// The keys of a case that a sweep varies, and the values of each key, in its unit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace viscontact::sweep {

/// A key and its values: a list of values, or a range of `count` values from `first` to `last`, at
/// equal distances or in geometric progression.
struct Variation {
  std::string key;  ///< as in a case file: "fluid.viscosity"
  /// Empty for a range.
  std::vector<double> values;
  double first = 0;          ///< of a range, in the unit of the key
  double last = 0;           ///< likewise
  bool logarithmic = false;  ///< the values of a range are in geometric progression
  std::uint64_t count = 0;   ///< number of values, from 1 to 1e9 in a range

  /// Value i < count, in the unit of the key. It must stay the same bit for bit, because a sweep
  /// that continues compares the values with those in its finished rows.
  double value(std::uint64_t i) const;

  /// The value of a range at the fraction `share` [1] of the way from `first` to `last`, 0 <= share
  /// < 1. If `logarithmic` is true, the way is that of the logarithms. The value of a list of n
  /// values is element floor(n share), counted from 0.
  double at(double share) const;
};

/// Reads "KEY=A:B:log:N" (geometric progression), "KEY=A:B:N" (equal distances) or "KEY=V,V,...".
/// Throws Error(kBadInput), which names the fault: the key is missing, the text has another form, a
/// number is not finite, a logarithmic range contains 0 or changes sign, or N is not an integer
/// from 1 to 1e9. A case need not have the key.
Variation parse_variation(std::string_view text);

/// Keys and values of point `index` < grid_size() of the grid, which combines every value of each
/// variation with every value of the others. From one point to the next, the last variation changes
/// first.
std::vector<std::pair<std::string, double>> grid_point(const std::vector<Variation>& variations,
                                                       std::uint64_t index);

/// Keys and values of random sample `index`. Each value is independent of all others and uniformly
/// distributed over its range or its list; in a logarithmic range its logarithm is. Equal arguments
/// give equal values, which come from a hash (common/splitmix.hpp) of `seed`, `index` and the
/// number of the variation.
std::vector<std::pair<std::string, double>> random_point(const std::vector<Variation>& variations,
                                                         std::uint64_t index, std::uint64_t seed);

/// 1 if nothing is varied. Throws Error(kWrongUsage) for more than 1e12, which would take too long.
std::uint64_t grid_size(const std::vector<Variation>& variations);

struct PlaceOfRanges {
  std::string file;  ///< path of the case
  int line = 0;      ///< of `vary` in its section [sweep], from 1
};

/// The points of a sweep: a grid, or random points. In a sweep of randomly arranged particles a
/// point has several draws, which are arrangements with different seeds. Each draw is a row, and
/// the draws of a point follow each other. count() and rows() throw as grid_size() does.
struct Points {
  std::vector<Variation> variations;
  std::uint64_t samples = 0;  ///< number of random points; 0: the whole grid
  std::uint64_t seed = 1;     ///< of the random points
  /// Number of draws at each point; 0: one row without a draw, with the seed of the case.
  std::uint64_t draws = 0;
  /// The value of arrangement.seed in the first draw; it grows by 1 from draw to draw.
  std::uint64_t first_draw = 1;
  /// Where a case gives `variations`; nothing: they are those of the option --vary.
  std::optional<PlaceOfRanges> place;

  std::uint64_t count() const;  ///< number of points
  std::uint64_t rows() const;   ///< points times draws, or points if `draws` is 0
  /// The varied keys, and arrangement.seed if there are draws.
  std::vector<std::string> keys() const;
  /// Keys and values of row `index` < rows(), in the order of keys().
  std::vector<std::pair<std::string, double>> numbers(std::uint64_t index) const;
  std::string key_fields(std::uint64_t index) const;  ///< the values of a row as fields of CSV
  bool is_varied(const std::string& key) const;
};

/// The text " KEY = VALUE KEY = VALUE ..." for messages; it begins with a space.
std::string in_words(const std::vector<std::pair<std::string, double>>& numbers);

/// A text that is different for different points. Its hash identifies a sweep without draws, which
/// are not in the text.
std::string text_of(const Points& points);

/// The key of a case whose value differs between draws.
inline constexpr const char* kDrawKey = "arrangement.seed";

}  // namespace viscontact::sweep
