// Reads a sweep's file row by row, because it may be larger than the memory, and draws it.
#include "viscontact/report/flow/sweep_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <set>

#include "viscontact/common/error.hpp"
#include "viscontact/common/number.hpp"
#include "viscontact/report/gnuplot.hpp"

namespace viscontact {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

/// Reads the chosen columns of a sweep's file, row by row.
class SweepRows {
 public:
  explicit SweepRows(const std::filesystem::path& path) : path_(path), file_(path) {
    std::string line;
    while (std::getline(file_, line) && line.starts_with("#")) continue;
    names_ = fields_of(line);
  }

  /// The indices of a column and of the key by which it is divided, if any.
  struct Place {
    std::size_t column;
    std::optional<std::size_t> divisor;
  };
  Place find(const std::string& name) const {
    const auto slash = name.find('/');
    if (slash == std::string::npos) return {index_of(name), {}};
    return {index_of(name.substr(0, slash)), index_of(name.substr(slash + 1))};
  }

  /// Reads the next row; returns false at the end. Blank lines are skipped.
  bool next() {
    std::string line;
    do
      if (!std::getline(file_, line)) return false;
    while (line.find_first_not_of(" \t\r,") == std::string::npos);
    fields_ = fields_of(line);
    return true;
  }

  double value(const Place& place) const {
    const double value = parse_number(fields_.at(place.column)).value_or(kNothing);
    return place.divisor ? value / parse_number(fields_.at(*place.divisor)).value_or(kNothing)
                         : value;
  }

 private:
  std::size_t index_of(const std::string& name) const {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end())
      throw_bad_input({path_.string()}, fmt::format("has no column '{}'; its columns are: {}", name,
                                                    fmt::join(names_, ", ")));
    return static_cast<std::size_t>(found - names_.begin());
  }

  std::filesystem::path path_;
  std::ifstream file_;
  std::vector<std::string> names_, fields_;
};

/// True if all finite values are positive and span a decade or more, so that a logarithmic axis
/// shows more.
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
// Colours that colour-blind readers tell apart (Okabe & Ito 2008).
constexpr std::array kCurveColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                      "#E69F00", "#56B4E9", "#000000"};

std::string plot_lines(const std::filesystem::path& path, const SweepPlot& plot) {
  SweepRows rows(path);
  const auto x = rows.find(plot.x);
  std::vector<SweepRows::Place> places;
  for (const auto& column : plot.columns) places.push_back(rows.find(column));
  Panel panel{"",    plot.x, plot.columns.size() == 1 ? plot.columns[0] : "",
              false, false,  {"set key below Left reverse noopaque"},
              {}};
  for (std::size_t i = 0; i < places.size(); ++i)
    panel.curves.push_back(
        {plot.columns.size() == 1 ? "" : plot.columns[i],
         fmt::format("linespoints pointtype 7 pointsize 0.4 linewidth 2 linecolor rgb '{}'",
                     kCurveColours[i % kCurveColours.size()]),
         {}});
  std::vector<double> xs, ys;
  while (rows.next())
    for (std::size_t i = 0; i < places.size(); ++i) {
      panel.curves[i].points.emplace_back(rows.value(x), rows.value(places[i]));
      xs.push_back(rows.value(x));
      ys.push_back(rows.value(places[i]));
    }
  if (std::ranges::none_of(ys, [](double y) { return std::isfinite(y); }))
    throw_bad_input({path.string()}, "has no value to draw in the columns that were asked for");
  // The rows of random samples are not in the order of x.
  for (auto& curve : panel.curves)
    std::ranges::sort(curve.points, {}, &std::pair<double, double>::first);
  panel.x_log = is_logarithmic(xs);
  panel.y_log = is_logarithmic(ys);
  for (const auto& [axis, logarithmic] : {std::pair('x', panel.x_log), std::pair('y', panel.y_log)})
    if (logarithmic) panel.settings.push_back(fmt::format("set format {} '1e%T'", axis));
  return draw_svg({panel}, kSweepWidth, 520);
}

std::string plot_map(const std::filesystem::path& path, const SweepPlot& plot) {
  SweepRows rows(path);
  const auto x = rows.find(plot.x), y = rows.find(plot.y), column = rows.find(plot.columns[0]);
  std::map<std::pair<double, double>, double> cells;
  std::set<double> xs, ys;
  std::vector<double> values;
  while (rows.next()) {
    xs.insert(rows.value(x));
    ys.insert(rows.value(y));
    cells[{rows.value(y), rows.value(x)}] = rows.value(column);
    values.push_back(rows.value(column));
  }
  if (xs.size() < 2 || ys.size() < 2)
    throw_bad_input({path.string()},
                    "is not a grid of at least two values in each direction, which a map needs");
  if (std::ranges::none_of(values, [](double v) { return std::isfinite(v); }))
    throw_bad_input({path.string()}, "has no value to draw in the column that was asked for");
  const bool log_x = is_logarithmic({xs.begin(), xs.end()});
  const bool log_y = is_logarithmic({ys.begin(), ys.end()});
  const bool log_value = is_logarithmic(values);
  const auto scaled = [](double v, bool logarithmic) { return logarithmic ? std::log10(v) : v; };
  // Programs that show a picture with few pixels smooth it. With eight pixels for each value, the
  // edges of the values stay sharp.
  constexpr std::size_t kDotsPerCell = 8;
  ColourField field;
  field.columns = kDotsPerCell * xs.size();
  field.rows = kDotsPerCell * ys.size();
  // The values are at the centres of cells, on the scale of the axis; so the picture extends half a
  // mean cell beyond the first and the last value.
  const auto margin = [&](const std::set<double>& all, bool logarithmic) {
    return (scaled(*all.rbegin(), logarithmic) - scaled(*all.begin(), logarithmic)) /
           static_cast<double>(all.size() - 1) / 2;
  };
  field.left = scaled(*xs.begin(), log_x) - margin(xs, log_x);
  field.right = scaled(*xs.rbegin(), log_x) + margin(xs, log_x);
  field.bottom = scaled(*ys.begin(), log_y) - margin(ys, log_y);
  field.top = scaled(*ys.rbegin(), log_y) + margin(ys, log_y);
  // Each pixel shows the nearest value, so that grids of unequal spacing are drawn at the right
  // place.
  const auto nearest = [&](const std::set<double>& all, bool logarithmic, double from, double to,
                           std::size_t dots) {
    std::vector<double> found;
    for (std::size_t i = 0; i < dots; ++i) {
      const double at =
          from + (to - from) * (static_cast<double>(i) + 0.5) / static_cast<double>(dots);
      found.push_back(*std::ranges::min_element(
          all, {}, [&](double value) { return std::abs(scaled(value, logarithmic) - at); }));
    }
    return found;
  };
  const auto columns = nearest(xs, log_x, field.left, field.right, field.columns);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double row : nearest(ys, log_y, field.bottom, field.top, field.rows))
    for (const double at : columns) {
      const auto cell = cells.find({row, at});
      const double value = cell == cells.end() ? kNothing : cell->second;
      const double shown = log_value && !(value > 0) ? kNothing : scaled(value, log_value);
      field.values.push_back(shown);
      if (std::isfinite(shown)) low = std::min(low, shown), high = std::max(high, shown);
    }
  const auto label = [](const std::string& name, bool logarithmic) {
    return logarithmic ? fmt::format("log10 {}", name) : name;
  };
  Panel panel{label(plot.columns[0], log_value),
              label(plot.x, log_x),
              label(plot.y, log_y),
              false,
              false,
              {fmt::format("set xrange [{}:{}]", field.left, field.right),
               fmt::format("set yrange [{}:{}]", field.bottom, field.top), "unset key"},
              {}};
  const double reach = std::max(-low, high);
  if (low < -reach / 10 && high > reach / 10) {
    // For values of both signs, a scale from blue over grey to red (Moreland 2009).
    panel.settings.emplace_back("set palette defined (-1 '#3b4cc0', 0 '#dddddd', 1 '#b40426')");
    panel.settings.push_back(fmt::format("set cbrange [{}:{}]", -reach, reach));
  } else {
    // The lightness of this scale (cividis, Nunez et al. 2018) increases throughout, so that
    // colour-blind readers and readers of prints can read it.
    panel.settings.emplace_back(
        "set palette defined (0 '#00224e', 0.25 '#35456c', 0.5 '#7c7b78', 0.75 '#bcae6c', 1 "
        "'#fee838')");
  }
  panel.field = std::move(field);
  return draw_svg({panel}, kSweepWidth, 620);
}

}  // namespace

std::string plot_sweep(const std::filesystem::path& sweep_file, const SweepPlot& plot) {
  return plot.y.empty() ? plot_lines(sweep_file, plot) : plot_map(sweep_file, plot);
}

}  // namespace viscontact
