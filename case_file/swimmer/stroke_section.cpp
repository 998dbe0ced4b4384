// Reads strokes: corners, ellipses, files of samples, and what is asked of the optimal stroke
// (stroke_section.hpp). Lengths and times are in the units of the case.
#include "viscontact/case_file/swimmer/stroke_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viscontact/case_file/sections.hpp"
#include "viscontact/common/text/csv.hpp"

namespace viscontact::case_file {
namespace {

/// The arms of the table: the centres' distances between which each arm may be.
struct ArmInterval {
  double from = 0, to = 0;
};

std::vector<ArmInterval> intervals_of(const SwimmerCase& c) {
  std::vector<ArmInterval> intervals;
  for (std::size_t k = 0; k < c.gaps.size(); ++k) {
    const double both_radii = c.spheres.radii[k] + c.spheres.radii[k + 1];
    intervals.push_back({c.gaps[k].front() + both_radii, c.gaps[k].back() + both_radii});
  }
  return intervals;
}

/// What is wrong with an arm that leaves the table; empty if nothing is.
std::string fault_of_arm(double arm, std::size_t k, const SwimmerCase& c) {
  const auto [from, to] = intervals_of(c)[k];
  constexpr double kRounding = 1e-12;
  if (arm >= from * (1 - kRounding) && arm <= to * (1 + kRounding)) return "";
  const double both_radii = c.spheres.radii[k] + c.spheres.radii[k + 1];
  if (!(arm > both_radii))
    return fmt::format(
        "makes arm x{} {:.9g}; spheres {} and {} would overlap, as the sum of their "
        "radii is {:.9g}",
        k + 1, arm, k + 1, k + 2, both_radii);
  return fmt::format(
      "makes arm x{} {:.9g}; the table has arms from {:.9g} to {:.9g}, so change "
      "the stroke or swimmer.arms",
      k + 1, arm, from, to);
}

/// One number for each arm, or one number for all of them.
Eigen::VectorXd read_arms(const TomlSection& section, std::string_view key, const SwimmerCase& c,
                          const Allowed& allowed) {
  const auto arms = static_cast<Eigen::Index>(c.gaps.size());
  if (!section.is_array(key)) return Eigen::VectorXd::Constant(arms, section.number(key, allowed));
  const auto numbers = section.numbers(key, allowed);
  if (numbers.size() != c.gaps.size())
    section.fail(key, fmt::format("has {} numbers; it must have {}, one for each arm",
                                  numbers.size(), c.gaps.size()));
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), arms);
}

void check_arms(const TomlSection& section, std::string_view key, const Eigen::VectorXd& arms,
                const SwimmerCase& c) {
  for (std::size_t k = 0; k < c.gaps.size(); ++k)
    if (const auto fault = fault_of_arm(arms[static_cast<Eigen::Index>(k)], k, c); !fault.empty())
      section.fail(key, fault);
}

reduced_model::Stroke read_corners(const TomlSection& section, const SwimmerCase& c,
                                   double period) {
  const auto rows = section.rows("corners", c.gaps.size(), kPositive);
  if (rows.size() < 2)
    section.fail("corners", "has one corner; a stroke needs at least two, and three to swim");
  std::vector<Eigen::VectorXd> corners;
  for (const auto& row : rows) {
    corners.emplace_back(
        Eigen::Map<const Eigen::VectorXd>(row.data(), static_cast<Eigen::Index>(row.size())));
    check_arms(section, "corners", corners.back(), c);
  }
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (corners[i] == corners[(i + 1) % corners.size()])
      section.fail("corners", fmt::format("has the same corner twice in a row, as number {}; the "
                                          "loop closes by itself, so leave the second one out",
                                          i + 1));
  return reduced_model::polygon_stroke(corners, period);
}

reduced_model::Stroke read_ellipse(const TomlSection& section, const SwimmerCase& c,
                                   double period) {
  const auto ellipse = section.section("ellipse");
  const auto centre = read_arms(ellipse, "centre", c, kPositive);
  const auto semi_axes = read_arms(ellipse, "semi_axes", c, kNotNegative);
  Eigen::VectorXd phases = Eigen::VectorXd::Zero(centre.size());
  if (ellipse.is_array("phase")) {
    const auto numbers = ellipse.numbers("phase", kFinite);
    if (numbers.size() + 1 != c.gaps.size())
      ellipse.fail("phase", fmt::format("has {} numbers; it must have {}, one for each arm but the "
                                        "first",
                                        numbers.size(), c.gaps.size() - 1));
    for (std::size_t k = 0; k < numbers.size(); ++k)
      phases[static_cast<Eigen::Index>(k) + 1] = numbers[k];
  } else if (c.gaps.size() == 2) {
    phases[1] = ellipse.number("phase", kFinite);
  } else if (c.gaps.size() > 2 || ellipse.has("phase")) {
    ellipse.fail("phase", "must be an array with the phase of each arm but the first");
  }
  ellipse.finish();
  if (semi_axes.maxCoeff() == 0) ellipse.fail("semi_axes", "has only zeros; an arm must move");
  check_arms(ellipse, "semi_axes", centre + semi_axes, c);
  check_arms(ellipse, "semi_axes", centre - semi_axes, c);
  return reduced_model::elliptic_stroke(centre, semi_axes, phases, period);
}

/// Reads a CSV file with the columns time, x1, x2, ...
reduced_model::Stroke read_samples(const TomlSection& section, SwimmerCase& c) {
  const auto path = c.path.parent_path() / section.text("file");
  const std::string file = path.string();
  std::vector<std::string> columns = {"time"};
  for (std::size_t k = 0; k < c.gaps.size(); ++k) columns.push_back(fmt::format("x{}", k + 1));
  std::vector<double> times;
  std::vector<Eigen::VectorXd> samples;
  CsvComments comments;
  std::set<std::string> contradictions;
  read_csv_rows(path, columns, columns.size(), comments, contradictions,
                [&](std::span<const std::optional<double>> fields, int line) {
                  const FilePosition here{file, line};
                  for (std::size_t i = 0; i < columns.size(); ++i)
                    if (!fields[i]) throw_bad_input(here, columns[i] + " is empty");
                  if (!times.empty() && !(*fields[0] > times.back()))
                    throw_bad_input(here, fmt::format("time is {}; it must be greater than in the "
                                                      "row above, {}",
                                                      *fields[0], times.back()));
                  times.push_back(*fields[0]);
                  Eigen::VectorXd arms(static_cast<Eigen::Index>(c.gaps.size()));
                  for (std::size_t k = 0; k < c.gaps.size(); ++k) {
                    arms[static_cast<Eigen::Index>(k)] = *fields[k + 1];
                    if (const auto fault = fault_of_arm(*fields[k + 1], k, c); !fault.empty())
                      throw_bad_input(here, fault);
                  }
                  samples.push_back(arms);
                });
  if (samples.size() < 3)
    throw_bad_input({file}, fmt::format("has {} rows; a stroke needs at least 3, of which the last "
                                        "one closes the loop",
                                        samples.size()));
  c.stroke_files.push_back(path);
  return with_place(file, [&] { return reduced_model::sampled_stroke(times, samples); });
}

reduced_model::Stroke read_stroke(const TomlSection& section, SwimmerCase& c) {
  int kinds = 0;
  for (const char* key : {"corners", "ellipse", "file"}) kinds += section.has(key) ? 1 : 0;
  if (kinds != 1)
    section.fail("corners",
                 "is one of three ways to give a stroke: exactly one of corners, ellipse "
                 "and file must be there");
  if (section.has("file")) {
    if (section.has("period"))
      section.fail("period", "must be left out, because the times in the file give the period");
    return read_samples(section, c);
  }
  const double period = section.has("period") ? section.number("period", kPositive) : 1;
  return section.has("corners") ? read_corners(section, c, period)
                                : read_ellipse(section, c, period);
}

reduced_model::OptimalStrokeRequest read_optimal(const TomlSection& section, SwimmerCase& c) {
  reduced_model::OptimalStrokeRequest request;
  request.displacement = section.number("displacement", kNotZero);
  if (c.gaps.size() < 2)
    section.fail("displacement",
                 "cannot be reached by two spheres, whose strokes are reciprocal; a "
                 "swimmer needs at least three radii");
  request.through = read_arms(section, "through", c, kPositive);
  check_arms(section, "through", request.through, c);
  if (section.has("period")) c.optimal_period = section.number("period", kPositive);
  if (section.has("polynomials")) {
    request.polynomials =
        section.count("polynomials", static_cast<int>(reduced_model::kFewestPolynomials), 1000);
    std::size_t rows = 1;
    for (const auto& gaps : c.gaps) rows *= gaps.size();
    const auto parameters = static_cast<std::size_t>(request.polynomials) * c.gaps.size();
    if (parameters > rows)
      section.fail("polynomials",
                   fmt::format("is {}; {} polynomials for each of {} arms are {} parameters, more "
                               "than the {} rows of the table can determine; take at most {}",
                               request.polynomials, request.polynomials, c.gaps.size(), parameters,
                               rows, rows / c.gaps.size()));
  } else {
    std::size_t rows = 1;
    for (const auto& gaps : c.gaps) rows *= gaps.size();
    request.polynomials = std::clamp(static_cast<Eigen::Index>(rows / c.gaps.size()),
                                     reduced_model::kFewestPolynomials, request.polynomials);
  }
  section.finish();
  return request;
}

}  // namespace

void read_strokes(const TomlSection& root, SwimmerCase& c) {
  if (root.has("stroke")) {
    const auto section = root.section("stroke");
    c.stroke = read_stroke(section, c);
    c.optimal_period = c.stroke->period;
    section.finish();
  }
  if (root.has("optimal")) c.optimal = read_optimal(root.section("optimal"), c);
}

}  // namespace viscontact::case_file
