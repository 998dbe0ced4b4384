// Reads the columns to draw from a sweep's CSV file row by row, because it may be larger than the
// memory, and draws them.
#include "viscontact/report/pictures/sweep_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/report/pictures/colours.hpp"
#include "viscontact/report/pictures/gnuplot.hpp"
#include "viscontact/report/pictures/sweep_axes.hpp"

namespace viscontact::report {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// Reads row by row, after the lines of the head with "#" and the line with the names of columns.
class SweepRows {
 public:
  explicit SweepRows(const std::filesystem::path& path) : path_(path), file_(path) {
    std::string line;
    constexpr std::string_view kUnits = "# units: ";
    while (std::getline(file_, line) && line.starts_with("#"))
      if (line.starts_with(kUnits)) units_ = Units::of_words(line.substr(kUnits.size()));
    names_ = csv_fields(line);
  }

  /// The indices of a column and of the column by which it is divided, if there is one.
  struct Place {
    std::size_t column;
    std::optional<std::size_t> divisor;
  };
  /// `name` is "COLUMN" or "COLUMN/KEY"; the column in the file is COLUMN followed by `ending`.
  /// Throws Error(kBadInput), which lists the columns, if the file has no such column.
  Place find(const std::string& name, const std::string& ending = "") const {
    const auto slash = name.find('/');
    if (slash == std::string::npos) return {index_of(name + ending), {}};
    return {index_of(name.substr(0, slash) + ending), index_of(name.substr(slash + 1))};
  }

  /// Reads the next row that is not blank; returns false at the end of the file.
  bool next() {
    std::string line;
    do
      if (!std::getline(file_, line)) return false;
    while (line.find_first_not_of(" \t\r,") == std::string::npos);
    fields_ = csv_fields(line);
    return true;
  }

  const Units& units() const { return units_; }  ///< those of the case; may be empty

  /// The value in the row that was read last; NaN if it is missing or not a number.
  double value(const Place& place) const {
    return place.divisor ? number(place.column) / number(*place.divisor) : number(place.column);
  }

 private:
  double number(std::size_t column) const {
    return column < fields_.size() ? parse_number(fields_[column]).value_or(kNoValue) : kNoValue;
  }

  std::size_t index_of(const std::string& name) const {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end())
      throw_bad_input({path_.string()}, "has no column '{}'; its columns are: {}", name,
                      fmt::join(names_, ", "));
    return static_cast<std::size_t>(found - names_.begin());
  }

  std::filesystem::path path_;
  std::ifstream file_;
  Units units_;
  std::vector<std::string> names_, fields_;
};

/// True if all finite values are > 0 and span a decade or more. The axis then is logarithmic,
/// because a linear axis would show little of the small values.
bool is_logarithmic(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return low > 0 && high >= 10 * low;
}

constexpr int kSweepWidth = 860;  // [pixels]
constexpr const char *kMean = ".mean",
                     *kError = ".standard_error";  // as in particle_runs/case/particles_study.cpp

void check_has_value(const std::filesystem::path& path, const std::vector<double>& values,
                     bool one_column) {
  if (std::ranges::none_of(values, [](double v) { return std::isfinite(v); }))
    throw_bad_input({path.string()},
                    one_column ? "has no value to draw in the column that was asked for"
                               : "has no value to draw in the columns that were asked for");
}

/// Draws lines, one for each column, for each combination of values of the keys plot.others. If the
/// file has means, each point has a bar of one standard error to both sides.
std::string plot_lines(const std::filesystem::path& path, const SweepPlot& plot,
                       const results::PictureFormat& format, const StopToken& stop) {
  SweepRows rows(path);
  const auto x = rows.find(plot.x);
  std::vector<SweepRows::Place> places, errors;
  for (const auto& column : plot.columns) {
    places.push_back(rows.find(column, plot.is_of_means ? kMean : ""));
    if (plot.is_of_means) errors.push_back(rows.find(column, kError));
  }
  constexpr std::array kColours = {kBlue,   kVermilion, kBluishGreen, kReddishPurple,
                                   kOrange, kSkyBlue,   kBlack};
  std::vector<SweepRows::Place> others;
  for (const auto& key : plot.others) others.push_back(rows.find(key));
  Panel panel{"",
              axis_label(plot.x, rows.units()),
              common_axis_label(plot.columns, rows.units()),
              false,
              false,
              {kLegendBelow},
              {}};
  std::vector<Curve> bars;
  // The index of the first curve for each combination of values of the keys plot.others.
  std::map<std::vector<double>, std::size_t> first_curves;
  const auto first_curve_of_row = [&] {
    std::vector<double> values;
    std::string words;
    for (std::size_t k = 0; k < others.size(); ++k) {
      values.push_back(rows.value(others[k]));
      words += fmt::format("{}{} = {:.6g}", k == 0 ? "" : ", ", plot.others[k], values[k]);
    }
    const auto [found, is_new] = first_curves.insert({values, panel.curves.size()});
    for (std::size_t i = 0; is_new && i < places.size(); ++i) {
      const auto* colour = kColours[panel.curves.size() % kColours.size()];
      const auto column = plot.columns.size() == 1 ? "" : plot.columns[i];
      panel.curves.push_back(
          {column + (column.empty() || words.empty() ? "" : ", ") + words,
           fmt::format("linespoints pointtype 7 pointsize 0.4 linewidth 2 linecolor rgb '{}'",
                       colour),
           {}});
      if (plot.is_of_means)
        bars.push_back(
            {"",
             fmt::format("linespoints pointtype 2 pointsize 0.3 linewidth 1 linecolor rgb '{}'",
                         colour),
             {}});
    }
    return found->second;
  };
  std::vector<double> xs, ys, lower_ends;
  const auto has_keys = [&] {
    return !std::isnan(rows.value(x)) && std::ranges::all_of(others, [&](const auto& key) {
      return !std::isnan(rows.value(key));
    });
  };
  while (rows.next()) {
    if (!has_keys()) continue;  // NaN has no place in an order
    const auto first = first_curve_of_row();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double at = rows.value(x), y = rows.value(places[i]);
      panel.curves[first + i].points.emplace_back(at, y);
      xs.push_back(at);
      ys.push_back(y);
      if (errors.empty()) continue;
      const double error = rows.value(errors[i]);
      lower_ends.push_back(y - error);
      auto& points = bars[first + i].points;
      points.insert(points.end(), {{at, y - error}, {at, y + error}, {at, kNoValue}});
    }
  }
  check_has_value(path, ys, false);
  // The rows of a sweep with random samples are not in the order of x.
  for (auto& curve : panel.curves)
    std::ranges::sort(curve.points, {}, &std::pair<double, double>::first);
  panel.curves.insert(panel.curves.end(), bars.begin(), bars.end());
  // Room around the curves, so that bars of errors at the ends can be seen.
  if (!bars.empty())
    panel.settings.emplace_back("set offsets graph 0.04, graph 0.04, graph 0.06, graph 0.06");
  panel.x_log = is_logarithmic(xs);
  // On a logarithmic axis, a bar of errors that reaches 0 would have no lower end.
  panel.y_log =
      is_logarithmic(ys) && std::ranges::none_of(lower_ends, [](double end) { return end <= 0; });
  for (const auto& [axis, logarithmic] : {std::pair('x', panel.x_log), std::pair('y', panel.y_log)})
    if (logarithmic) panel.settings.push_back(fmt::format("set format {} '1e%T'", axis));
  return draw_picture(format, {panel}, kSweepWidth, 520, stop);
}

// A logarithmic axis shows decimal logarithms.
double scaled(double value, bool logarithmic) { return logarithmic ? std::log10(value) : value; }

std::string label(const std::string& name, const Units& units, bool logarithmic) {
  return fmt::format("{}{}", logarithmic ? "log10 " : "", axis_label(name, units));
}

/// `low` and `high` are the ends: values or, if the axis is logarithmic, decimal logarithms.
struct MapAxis {
  std::set<double> values;
  bool logarithmic = false;
  double low = 0, high = 0;
};

/// The axis of these values, at least two. It extends beyond both ends by half the mean step.
MapAxis axis_of(const std::set<double>& values) {
  assert(values.size() >= 2);
  const bool logarithmic = is_logarithmic({values.begin(), values.end()});
  const double first = scaled(*values.begin(), logarithmic);
  const double last = scaled(*values.rbegin(), logarithmic);
  const double margin = (last - first) / static_cast<double>(values.size() - 1) / 2;
  return {values, logarithmic, first - margin, last + margin};
}

/// For each pixel along the axis, the nearest value, so that uneven steps of values are seen.
std::vector<double> values_of_pixels(const MapAxis& axis) {
  // Some programs smooth a picture of few pixels. With eight pixels for each value, edges stay
  // sharp.
  const auto pixels = 8 * axis.values.size();
  std::vector<double> found;
  for (std::size_t i = 0; i < pixels; ++i) {
    const double at = axis.low + (axis.high - axis.low) * (static_cast<double>(i) + 0.5) /
                                     static_cast<double>(pixels);
    found.push_back(*std::ranges::min_element(axis.values, {}, [&](double value) {
      return std::abs(scaled(value, axis.logarithmic) - at);
    }));
  }
  return found;
}

/// Commands of gnuplot for the colours of values, or of their decimal logarithms, from `low` to
/// `high`. The colours show the sign if values of both signs occur, and the smaller extreme is more
/// than a tenth of the larger one in size.
std::vector<std::string> map_colours(double low, double high) {
  const double reach = std::max(-low, high);
  if (low < -reach / 10 && high > reach / 10)
    // From blue over grey at 0 to red (Moreland 2009).
    return {"set palette defined (-1 '#3b4cc0', 0 '#dddddd', 1 '#b40426')",
            fmt::format("set cbrange [{}:{}]", -reach, reach)};
  // The lightness of this scale (cividis, Nunez et al. 2018) increases from end to end, so that
  // colour-blind readers and readers of grey prints can read it.
  return {
      "set palette defined (0 '#00224e', 0.25 '#35456c', 0.5 '#7c7b78', 0.75 '#bcae6c', 1 "
      "'#fee838')"};
}

/// The colours of the map show the first of plot.columns. Throws Error(kBadInput) if one of the two
/// keys has fewer than two values.
std::string plot_map(const std::filesystem::path& path, const SweepPlot& plot,
                     const results::PictureFormat& format, const StopToken& stop) {
  SweepRows rows(path);
  const auto x = rows.find(plot.x), y = rows.find(plot.y);
  const auto column = rows.find(plot.columns[0], plot.is_of_means ? kMean : "");
  std::map<std::pair<double, double>, double> cells;
  std::set<double> xs, ys;
  std::vector<double> values;
  while (rows.next()) {
    const double at_x = rows.value(x), at_y = rows.value(y);
    if (!std::isfinite(at_x) || !std::isfinite(at_y)) continue;  // NaN has no place in a set
    xs.insert(at_x);
    ys.insert(at_y);
    cells[{at_y, at_x}] = rows.value(column);
    values.push_back(rows.value(column));
  }
  if (xs.size() < 2 || ys.size() < 2)
    throw_bad_input({path.string()},
                    "is not a grid of at least two values in each direction, which a map needs");
  check_has_value(path, values, true);
  const auto horizontal = axis_of(xs), vertical = axis_of(ys);
  const bool logarithmic = is_logarithmic(values);
  const auto columns = values_of_pixels(horizontal), lines = values_of_pixels(vertical);
  ColourField field{columns.size(),
                    lines.size(),
                    horizontal.low,
                    horizontal.high,
                    vertical.low,
                    vertical.high,
                    {}};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double line : lines)
    for (const double at : columns) {
      const auto cell = cells.find({line, at});
      const double value = cell == cells.end() ? kNoValue : cell->second;
      const double shown = logarithmic && !(value > 0) ? kNoValue : scaled(value, logarithmic);
      field.values.push_back(shown);
      if (std::isfinite(shown)) low = std::min(low, shown), high = std::max(high, shown);
    }
  Panel panel{label(plot.columns[0], rows.units(), logarithmic),
              label(plot.x, rows.units(), horizontal.logarithmic),
              label(plot.y, rows.units(), vertical.logarithmic),
              false,
              false,
              {fmt::format("set xrange [{}:{}]", field.left, field.right),
               fmt::format("set yrange [{}:{}]", field.bottom, field.top), "unset key"},
              {}};
  std::ranges::move(map_colours(low, high), std::back_inserter(panel.settings));
  panel.field = std::move(field);
  return draw_picture(format, {panel}, kSweepWidth, 620, stop);
}

}  // namespace

std::string plot_sweep(const std::filesystem::path& sweep_file, const SweepPlot& plot,
                       const results::PictureFormat& format, const StopToken& stop) {
  assert(!plot.columns.empty());
  return plot.y.empty() ? plot_lines(sweep_file, plot, format, stop)
                        : plot_map(sweep_file, plot, format, stop);
}

}  // namespace viscontact::report
