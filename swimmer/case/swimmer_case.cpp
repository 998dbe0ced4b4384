// Functions named ..._keys declare the keys of a section and read them into their last arguments.
#include "viscontact/swimmer/case/swimmer_case.hpp"

#include <algorithm>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/lubrication/scaling.hpp"
#include "viscontact/swimmer/resistance/resistance_fit.hpp"

namespace viscontact::swimmer {
namespace {

/// Bounds of a case.
struct SwimmerLimits {
  // Largest radius over the smallest. With a larger ratio the mesh around the small sphere has more
  // elements than FreeFEM can number.
  static constexpr double kLargestRatio = 100;
  // Least gap over the smaller radius; tests go down to this value.
  static constexpr double kLeastGap = 1e-6;
  // Longest arm over the sum of both radii.
  static constexpr double kLargestArm = 1e4;
  // Arms between two spheres in a table. fit_resistance() needs three values of each gap.
  static constexpr int kFewestArms = 3, kMostArms = 200;
  // A row takes 2 to 17 s, as in data/tables/three_spheres.csv, so that so many rows take days.
  static constexpr double kMostRows = 100000;
  // Radius of a tube over the largest radius of a sphere. kWidest also limits the height over the
  // length of the swimmer.
  static constexpr double kNarrowest = 1.01, kWidest = 1e3;
  // Relative error of an arm, as in resistance_fit.cpp, because an arm, a gap plus two radii, is
  // rounded.
  static constexpr double kRounding = 1e-12;
};

/// Throws Error(kBadInput) unless there are kFewestSpheres to kMostSpheres radii [L].
void read_radii(const case_file::TomlSection& section, std::string_view key,
                std::vector<double>& radii) {
  radii = section.numbers(key, kPositive);
  section.require(radii.size() >= kFewestSpheres && radii.size() <= kMostSpheres, key,
                  "has {} numbers; it must have {} to {}", radii.size(), kFewestSpheres,
                  kMostSpheres);
  const auto [smallest, largest] = std::ranges::minmax(radii);
  section.require(largest <= SwimmerLimits::kLargestRatio * smallest, key,
                  "has a ratio of {:.4g}; it must be at most {}", largest / smallest,
                  SwimmerLimits::kLargestRatio);
}

/// `count` lengths of an arm in the table [L], from `from` to `to`.
struct ArmGrid {
  double from = 0, to = 0;
  int count = 0;
};

void arm_keys(case_file::Keys& keys, ArmGrid& grid) {
  keys.required("from", case_file::number(grid.from, kPositive),
                {"the shortest arm, greater than the sum of both radii, so that the gap is at "
                 "least 1e-6 of the smaller radius"});
  keys.required("to", case_file::number(grid.to, kPositive), {"the longest arm"});
  keys.required("count",
                case_file::count(grid.count, SwimmerLimits::kFewestArms, SwimmerLimits::kMostArms),
                {"the number of arms between them"});
}

/// The gaps between the surfaces of spheres k and k + 1 in the table [L], rising; k counts from 0.
/// Finished rows of a table are found by their gaps, so that the gaps must stay the same bit for
/// bit.
std::vector<double> read_arm_gaps(const case_file::TomlSection& section,
                                  const std::vector<double>& radii, std::size_t k) {
  const double both_radii = radii[k] + radii[k + 1];
  ArmGrid grid;
  case_file::read_keys(section, arm_keys, grid);
  const auto [from, to, count] = grid;
  section.require(from > both_radii, "from",
                  "is {}; it must be greater than {}, the sum of the radii of spheres {} and {}, "
                  "which touch there",
                  from, both_radii, k + 1, k + 2);
  const double least = SwimmerLimits::kLeastGap * std::min(radii[k], radii[k + 1]);
  section.require(from - both_radii >= least, "from",
                  "is {}, a gap of {:.3g}; a gap must be at least {} of the smaller radius, so "
                  "from must be at least {}",
                  from, from - both_radii, SwimmerLimits::kLeastGap, both_radii + least);
  section.require(to > from, "to", "is {}; it must be greater than from, {}", to, from);
  section.require(to <= SwimmerLimits::kLargestArm * both_radii, "to",
                  "is {}; it must be at most {} times the sum of both radii, {}", to,
                  SwimmerLimits::kLargestArm, SwimmerLimits::kLargestArm * both_radii);
  auto gaps = chebyshev_arms(from, to, count);
  for (auto& gap : gaps) gap -= both_radii;
  return gaps;
}

double rows_of(const SwimmerCase& c) {
  double rows = 1;
  for (const auto& gaps : c.gaps) rows *= static_cast<double>(gaps.size());
  return rows;
}

/// Reads `arms`, which is one table for all arms or an array with a table for each arm.
void read_grid(const case_file::TomlSection& section, std::string_view key, SwimmerCase& c) {
  const auto& radii = c.spheres.radii;
  const std::size_t arms = radii.size() - 1;
  const bool has_list = section.is_array(key);
  const auto tables = has_list ? section.sections(key)
                               : std::vector<case_file::TomlSection>(arms, section.section(key));
  section.require(tables.size() == arms, key,
                  "has {} tables; it must have {}, one for each arm, or be one table for all arms",
                  tables.size(), arms);
  for (std::size_t k = 0; k < arms; ++k) c.gaps.push_back(read_arm_gaps(tables[k], radii, k));
  section.require(rows_of(c) <= SwimmerLimits::kMostRows, key,
                  "makes a table of {} rows; at most {} are allowed, so take a smaller count",
                  rows_of(c), SwimmerLimits::kMostRows);
}

/// Reads `table`, a file with a table of resistance matrices, and scales it to the radii and the
/// viscosity of the case.
void read_given_table(const case_file::TomlSection& section, std::string_view key, SwimmerCase& c) {
  for (const auto* other : {"arms", "relative_accuracy"})
    section.require(!section.has(other), other, "must be left out, because `table` gives a table");
  c.table_file = c.path.parent_path() / section.file_name(key);
  const auto table = read_resistance_table(*c.table_file);
  section.require(table.radii.size() == c.spheres.radii.size(), key,
                  "is a table of {} spheres; it must have {}, as many as `radii`",
                  table.radii.size(), c.spheres.radii.size());
  c.table = in_file(c.table_file->string(),
                    [&] { return scaled_to(table, c.spheres.viscosity, c.spheres.radii); });
  c.gaps = gap_grid(c.table);
}

void tube_keys(case_file::Keys& keys, Tube& tube) {
  keys.required("radius", case_file::number(tube.radius, kPositive), {"radius of the tube"});
  keys.optional("height", case_file::number(tube.height, kPositive),
                {"height of a closed cylinder with the swimmer in the middle", "a long tube"});
}

/// Reads `container`, which is "unbounded" or { radius, height } [L]; without a height it is a long
/// tube.
void read_tube(const case_file::TomlSection& section, std::string_view key, SwimmerCase& c) {
  if (section.is_text(key)) {
    section.require(section.text(key) == "unbounded", key,
                    "is '{}'; it must be \"unbounded\", {{ radius = ... }} for a long tube, or {{ "
                    "radius = ..., height = ... }}",
                    section.text(key));
    return;
  }
  const auto table = section.section(key);
  auto& tube = c.spheres.tube.emplace();
  case_file::read_keys(table, tube_keys, tube);
  const auto& radii = c.spheres.radii;
  const double largest = std::ranges::max(radii);
  table.require(tube.radius >= SwimmerLimits::kNarrowest * largest &&
                    tube.radius <= SwimmerLimits::kWidest * largest,
                "radius",
                "is {}; it must be {} to {} times the largest radius of the spheres, {}, or the "
                "container must be \"unbounded\"",
                tube.radius, SwimmerLimits::kNarrowest, SwimmerLimits::kWidest, largest);
  double longest = radii.front() + radii.back();
  for (std::size_t k = 0; k + 1 < radii.size(); ++k)
    longest += c.gaps[k].back() + radii[k] + radii[k + 1];
  if (tube.height)
    table.require(*tube.height > longest && *tube.height <= SwimmerLimits::kWidest * longest,
                  "height",
                  "is {}; it must be greater than {}, the length of the swimmer with the longest "
                  "arms, and at most {} times that",
                  *tube.height, longest, SwimmerLimits::kWidest);
}

void swimmer_keys(case_file::Keys& keys, SwimmerCase& c) {
  keys.required("radii", case_file::custom("2 to 10 numbers > 0", read_radii, c.spheres.radii),
                {"radii in the order of the line; the largest is at most 100 times the smallest"});
  keys.optional(
      "table", case_file::custom("a CSV file", read_given_table, c),
      {"a [table](file-formats.md#resistance-matrices-csv) of spheres with the same ratios of "
       "radii, in any units and for any viscosity, which is scaled to this case",
       "the table is computed, for `arms`"});
  keys.required_if(!c.table_file, "arms",
                   case_file::custom("`{ from, to, count }`, or a list of these, one for each arm",
                                     read_grid, c),
                   {"the arms of the table; not with `table`"});
  keys.required_if(!c.table_file, "relative_accuracy",
                   case_file::number(c.spheres.relative_accuracy, case_file::kFraction),
                   {"asked of every entry of each resistance matrix; not with `table`"});
  keys.optional(
      "container",
      case_file::custom("`\"unbounded\"`, `{ radius }` or `{ radius, height }`", read_tube, c),
      {"what is around the line: nothing, a long tube without slip, or a closed cylinder with the "
       "swimmer in the middle",
       "`\"unbounded\"`"});
  if (!c.table_file) return;
  const auto around = surroundings_in_words(c.spheres);
  keys.require(c.table.container.empty() || lubrication::same_words(c.table.container, around),
               "table",
               "was computed for the container '{}', scaled to this case; the case has '{}'",
               c.table.container, around);
}

/// What is wrong with the length `arm` [L] of arm k, counted from 0; empty if it is in the table.
std::string fault_of_arm(double arm, std::size_t k, const SwimmerCase& c) {
  const double both_radii = c.spheres.radii[k] + c.spheres.radii[k + 1];
  const double from = c.gaps[k].front() + both_radii, to = c.gaps[k].back() + both_radii;
  if (arm >= from * (1 - SwimmerLimits::kRounding) && arm <= to * (1 + SwimmerLimits::kRounding))
    return "";
  if (!(arm > both_radii))
    return fmt::format(
        "makes arm x{} {:.9g}; spheres {} and {} would overlap, as the sum of their radii is "
        "{:.9g}",
        k + 1, arm, k + 1, k + 2, both_radii);
  return fmt::format(
      "makes arm x{} {:.9g}; the table has arms from {:.9g} to {:.9g}, so change the stroke or "
      "swimmer.arms",
      k + 1, arm, from, to);
}

/// Reads a number for each arm into `place`, or one number for all arms.
void read_arms(const case_file::TomlSection& section, std::string_view key, Eigen::VectorXd& place,
               const SwimmerCase& c, const Allowed& allowed) {
  const auto arms = static_cast<Eigen::Index>(c.gaps.size());
  const auto numbers = section.is_array(key)
                           ? section.numbers(key, allowed)
                           : std::vector(c.gaps.size(), section.number(key, allowed));
  section.require(numbers.size() == c.gaps.size(), key,
                  "has {} numbers; it must have {}, one for each arm", numbers.size(),
                  c.gaps.size());
  place = Eigen::Map<const Eigen::VectorXd>(numbers.data(), arms);
}

/// Throws Error(kBadInput), which names `key`, if an arm [L] is outside the table.
void check_arms(const case_file::TomlSection& section, std::string_view key,
                const Eigen::VectorXd& arms, const SwimmerCase& c) {
  for (std::size_t k = 0; k < c.gaps.size(); ++k)
    if (const auto fault = fault_of_arm(arms[static_cast<Eigen::Index>(k)], k, c); !fault.empty())
      section.fail(key, fault);
}

/// Reads a stroke from a CSV file with the columns time [T], x1, x2, ... [L]. The argument without
/// a name is the period, which the file itself gives.
void read_samples(const case_file::TomlSection& section, std::string_view key, double,
                  SwimmerCase& c) {
  section.require(!section.has("period"), "period",
                  "must be left out, because the times in the file give the period");
  const auto path = c.path.parent_path() / section.text(key);
  const std::string file = path.string();
  std::vector<std::string> columns = {"time"};
  for (std::size_t k = 0; k < c.gaps.size(); ++k) columns.push_back(fmt::format("x{}", k + 1));
  std::vector<double> times;
  std::vector<Eigen::VectorXd> samples;
  read_csv_rows(read_file(path), file, columns, columns.size(),
                [&](std::span<const std::optional<double>> fields, int line) {
                  for (std::size_t i = 0; i < columns.size(); ++i)
                    if (!fields[i])
                      throw_bad_input({file, line, columns[i]}, columns[i] + " is empty");
                  if (!times.empty() && !(*fields[0] > times.back()))
                    throw_bad_input({file, line, "time"},
                                    "time is {}; it must be greater than in the row above, {}",
                                    *fields[0], times.back());
                  times.push_back(*fields[0]);
                  Eigen::VectorXd arms(static_cast<Eigen::Index>(c.gaps.size()));
                  for (std::size_t k = 0; k < c.gaps.size(); ++k) {
                    arms[static_cast<Eigen::Index>(k)] = *fields[k + 1];
                    if (const auto fault = fault_of_arm(*fields[k + 1], k, c); !fault.empty())
                      throw_bad_input({file, line, columns[k + 1]}, fault);
                  }
                  samples.push_back(arms);
                });
  if (samples.size() < 3)
    throw_bad_input({file},
                    "has {} rows; a stroke needs at least 3, of which the last one closes the loop",
                    samples.size());
  c.stroke_files.push_back(path);
  c.stroke = in_file(file, [&] { return sampled_stroke(times, samples); });
}

/// Reads the corners of a stroke that takes the time `period` [T].
void read_corners(const case_file::TomlSection& section, std::string_view key, double period,
                  SwimmerCase& c) {
  const auto rows = section.rows(key, c.gaps.size(), kPositive);
  section.require(rows.size() >= 2, key,
                  "has one corner; a stroke needs at least two, and three to swim");
  std::vector<Eigen::VectorXd> corners;
  for (const auto& row : rows) {
    corners.emplace_back(
        Eigen::Map<const Eigen::VectorXd>(row.data(), static_cast<Eigen::Index>(row.size())));
    check_arms(section, key, corners.back(), c);
  }
  for (std::size_t i = 0; i < corners.size(); ++i)
    section.require(corners[i] != corners[(i + 1) % corners.size()], key,
                    "has the same corner twice in a row, as number {}; the loop closes by itself, "
                    "so leave the second one out",
                    i + 1);
  c.stroke = polygon_stroke(corners, period);
}

/// The arms centre + semi_axes cos(t + phases), with t from 0 to 2 pi. Each member has a number for
/// each arm; centre and semi_axes are in [L], phases in [rad].
struct Ellipse {
  Eigen::VectorXd centre, semi_axes, phases;
};

/// Reads `phase` [rad]: one number if there are two arms, or a list without the phase of the first
/// arm, which is 0.
void read_phases(const case_file::TomlSection& section, std::string_view key,
                 Eigen::VectorXd& phases) {
  const auto arms = static_cast<std::size_t>(phases.size());
  if (section.is_array(key)) {
    const auto numbers = section.numbers(key, kFinite);
    section.require(numbers.size() + 1 == arms, key,
                    "has {} numbers; it must have {}, one for each arm but the first",
                    numbers.size(), arms - 1);
    phases.tail(phases.size() - 1) = Eigen::Map<const Eigen::VectorXd>(
        numbers.data(), static_cast<Eigen::Index>(numbers.size()));
    return;
  }
  section.require(arms == 2, key, "must be an array with the phase of each arm but the first");
  phases[1] = section.number(key, kFinite);
}

void ellipse_keys(case_file::Keys& keys, Ellipse& ellipse, const SwimmerCase& c) {
  constexpr std::string_view kArms = "a number for each arm, or one number for all";
  keys.required("centre", case_file::custom(kArms, read_arms, ellipse.centre, c, kPositive),
                {"x1 = `centre[0]` + `semi_axes[0]` cos t, x2 = `centre[1]` + `semi_axes[1]` cos(t "
                 "+ `phase`), with t from 0 to 2 pi in a period"});
  keys.required("semi_axes",
                case_file::custom(kArms, read_arms, ellipse.semi_axes, c, kNotNegative),
                {"not all 0"});
  ellipse.phases = Eigen::VectorXd::Zero(ellipse.centre.size());
  keys.required_if(
      !keys.reads() || c.gaps.size() > 1, "phase",
      case_file::custom("a number; with more than two arms a list", read_phases, ellipse.phases),
      {"of the second arm to the last, in radians; one arm has none"});
}

void read_ellipse(const case_file::TomlSection& section, std::string_view key, double period,
                  SwimmerCase& c) {
  const auto table = section.section(key);
  Ellipse ellipse;
  case_file::read_keys(table, ellipse_keys, ellipse, c);
  const auto& [centre, semi_axes, phases] = ellipse;
  table.require(semi_axes.maxCoeff() != 0, "semi_axes", "has only zeros; an arm must move");
  check_arms(table, "semi_axes", centre + semi_axes, c);
  check_arms(table, "semi_axes", centre - semi_axes, c);
  c.stroke = elliptic_stroke(centre, semi_axes, phases, period);
}

void stroke_keys(case_file::Keys& keys, SwimmerCase& c) {
  const int kinds = static_cast<int>(keys.has("corners")) + static_cast<int>(keys.has("ellipse")) +
                    static_cast<int>(keys.has("file"));
  keys.require(kinds == 1, "corners",
               "is one of three ways to give a stroke: exactly one of corners, ellipse and file "
               "must be there");
  double period = 1;
  keys.optional("period", case_file::number(period, kPositive),
                {"duration of the stroke; not with `file`"});
  keys.optional("corners",
                case_file::custom("at least two shapes `[x1, x2, ...]`", read_corners, period, c),
                {"straight legs from one shape to the next and back to the first. Each leg takes "
                 "an equal share of the period, at constant velocity",
                 "or `ellipse` or `file`"});
  keys.optional("ellipse",
                case_file::custom("`{ centre, semi_axes, phase }`", read_ellipse, period, c),
                {"an ellipse in the space of shapes, see below", "or `corners` or `file`"});
  keys.optional("file", case_file::custom("a CSV file", read_samples, period, c),
                {"with the columns `time`, `x1`, `x2`, ...: straight legs between its rows, at "
                 "constant velocity. The last row has the arms of the first one",
                 "or `corners` or `ellipse`"});
  if (c.stroke) c.optimal_period = c.stroke->period;
}

void optimal_keys(case_file::Keys& keys, SwimmerCase& c) {
  auto& request = c.optimal.emplace();
  keys.required("displacement", case_file::number(request.displacement, kNotZero),
                {"displacement of the stroke, > 0 towards the last sphere"});
  keys.require(c.gaps.size() >= 2, "displacement",
               "cannot be reached by two spheres, whose strokes are reciprocal; a swimmer needs at "
               "least three radii");
  keys.required(
      "through",
      case_file::custom("one number for each arm", read_arms, request.through, c, kPositive),
      {"the shape at which the stroke begins and ends"});
  if (keys.reads()) check_arms(keys.section(), "through", request.through, c);
  keys.optional("period", case_file::number(c.optimal_period, kPositive),
                {"duration of the stroke", "that of `[stroke]`, or 1"});
  const auto rows = static_cast<std::size_t>(rows_of(c));
  const bool is_given = keys.optional(
      "polynomials",
      case_file::count(request.polynomials, static_cast<int>(kFewestPolynomials), 1000),
      {"polynomials of each arm. All together must not be more than the rows of the table, which "
       "cannot determine them otherwise",
       "20, less if the table is small"});
  const auto parameters = static_cast<std::size_t>(request.polynomials) * c.gaps.size();
  if (is_given)
    keys.require(parameters <= rows, "polynomials",
                 "is {}; {} polynomials for each of {} arms are {} parameters, more than the {} "
                 "rows of the table can determine; take at most {}",
                 request.polynomials, request.polynomials, c.gaps.size(), parameters, rows,
                 rows / c.gaps.size());
  else if (keys.reads())
    request.polynomials = std::clamp(static_cast<Eigen::Index>(rows / c.gaps.size()),
                                     kFewestPolynomials, request.polynomials);
}

}  // namespace

void read_root(const case_file::TomlSection& root, SwimmerCase& c) {
  case_file::read_title_and_units(root, c);
  case_file::read_keys(root.section("fluid"), case_file::viscosity_keys, c.spheres.viscosity);
  case_file::read_keys(root.section("swimmer"), swimmer_keys, c);
  if (root.has("stroke")) case_file::read_keys(root.section("stroke"), stroke_keys, c);
  if (root.has("optimal")) case_file::read_keys(root.section("optimal"), optimal_keys, c);
  root.finish();
}

std::vector<case_file::KeyTable> tables_of_swimmer_case() {
  return {case_file::describe_keys("[swimmer]", swimmer_keys),
          case_file::describe_keys("swimmer.arms", arm_keys),
          case_file::describe_keys("swimmer.container", tube_keys),
          case_file::describe_keys("[stroke]", stroke_keys),
          case_file::describe_keys("stroke.ellipse", ellipse_keys, SwimmerCase{}),
          case_file::describe_keys("[optimal]", optimal_keys)};
}

std::vector<std::filesystem::path> files_of(const SwimmerCase& c) {
  std::vector<std::filesystem::path> files = {c.path};
  if (c.table_file) files.push_back(*c.table_file);
  files.insert(files.end(), c.stroke_files.begin(), c.stroke_files.end());
  return files;
}

SwimmerCase read_swimmer_case(const std::filesystem::path& path) {
  return case_file::read_case_file<SwimmerCase>(path);
}

}  // namespace viscontact::swimmer
