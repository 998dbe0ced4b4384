// Translates a plot into panels of gnuplot and into JSON. The keys of the JSON and the names of
// kinds of points must agree with the scripts in report/page.
#include "viscontact/report/report_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "viscontact/report/pictures/gnuplot.hpp"

namespace viscontact::report {
namespace {

/// The text with % doubled, because gnuplot reads the name of a tick as a format.
std::string doubled_percent(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '%' ? std::string("%%") : std::string(1, c);
  return result;
}

constexpr int kWidth = 860;  // [pixels]

/// The names that gnuplot (pointtype) and curves.js have for a kind of point. The rows must be in
/// the order of PointKind.
struct PointName {
  PointKind kind;
  int gnuplot;
  const char* page;
};
constexpr auto kPointNames = std::to_array<PointName>({{PointKind::kNone, 0, ""},
                                                       {PointKind::kCircle, 6, "circle"},
                                                       {PointKind::kDisc, 7, "disc"},
                                                       {PointKind::kSquare, 4, "square"},
                                                       {PointKind::kCross, 2, "cross"}});

const PointName& name_of(PointKind kind) { return kPointNames[static_cast<std::size_t>(kind)]; }

std::string gnuplot_style(const CurveStyle& style) {
  const bool points = style.point != PointKind::kNone;
  std::string text = style.width == 0 ? "points" : points ? "linespoints" : "lines";
  text += fmt::format(" linecolor rgb '{}' linewidth {}", style.colour,
                      style.width == 0 ? 1.5 : style.width);
  if (points)
    text +=
        fmt::format(" pointtype {} pointsize {}", name_of(style.point).gnuplot, style.point_size);
  if (!style.dash.empty()) text += fmt::format(" dashtype ({})", fmt::join(style.dash, ","));
  return text;
}

/// A bound of a range in gnuplot's syntax; "*" lets gnuplot choose.
std::string bound(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "*";
}

std::vector<std::string> gnuplot_settings(const PlotPanel& panel) {
  std::vector<std::string> settings = {
      fmt::format("set xrange [{}:{}]", bound(panel.x.low), bound(panel.x.high)),
      fmt::format("set yrange [{}:{}]", bound(panel.y.low), bound(panel.y.high)),
      panel.key == KeyPlace::kTopRight      ? "set key top right"
      : panel.key == KeyPlace::kBottomRight ? "set key bottom right"
                                            : kLegendBelow};
  if (panel.x.logarithmic) settings.emplace_back("set format x '1e%T'");
  if (panel.y.logarithmic) settings.emplace_back("set format y '1e%T'");
  if (!panel.rows.empty()) {
    std::string ticks;
    for (std::size_t i = 0; i < panel.rows.size(); ++i)
      ticks += fmt::format("{}{} {}", i == 0 ? "" : ", ",
                           quoted_for_gnuplot(doubled_percent(panel.rows[i])), i + 1);
    settings.push_back("set ytics (" + ticks + ")\nset lmargin 38");
  }
  return settings;
}

/// The number with eight digits; null if it is not finite. A picture cannot show more digits, and
/// they would make the page larger.
nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(std::stod(fmt::format("{:.8g}", value)))
                              : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json optional_number(const std::optional<double>& value) {
  return value ? number(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(const PlotAxis& axis) {
  return {{"label", axis.label},
          {"logarithmic", axis.logarithmic},
          {"low", optional_number(axis.low)},
          {"high", optional_number(axis.high)}};
}

nlohmann::ordered_json json_of(const PlotCurve& curve) {
  auto x = nlohmann::ordered_json::array(), y = nlohmann::ordered_json::array();
  for (const auto& point : curve.points) {
    x.push_back(number(point.first));
    y.push_back(number(point.second));
  }
  return {{"legend", curve.legend},
          {"colour", curve.style.colour},
          {"width", curve.style.width},
          {"dash", curve.style.dash},
          {"point", name_of(curve.style.point).page},
          {"pointSize", curve.style.point_size},
          {"x", std::move(x)},
          {"y", std::move(y)}};
}

}  // namespace

bool shows_something(const Plot& plot) {
  return std::ranges::any_of(plot.panels, [](const auto& panel) { return !panel.curves.empty(); });
}

std::string svg_of(const Plot& plot, const StopToken& stop) {
  std::vector<Panel> panels;
  for (const auto& panel : plot.panels) {
    panels.push_back({panel.title,
                      panel.x.label,
                      panel.y.label,
                      panel.x.logarithmic,
                      panel.y.logarithmic,
                      gnuplot_settings(panel),
                      {}});
    for (const auto& curve : panel.curves)
      panels.back().curves.push_back({curve.legend, gnuplot_style(curve.style), curve.points});
  }
  return draw_svg(panels, kWidth, plot.height, stop);
}

std::string json_of(const Plot& plot) {
  auto panels = nlohmann::ordered_json::array();
  for (const auto& panel : plot.panels) {
    panels.push_back({{"title", panel.title},
                      {"x", json_of(panel.x)},
                      {"y", json_of(panel.y)},
                      {"rows", panel.rows},
                      {"curves", nlohmann::ordered_json::array()}});
    for (const auto& curve : panel.curves) panels.back()["curves"].push_back(json_of(curve));
  }
  std::string text =
      nlohmann::ordered_json{{"name", plot.name}, {"panels", std::move(panels)}}.dump(
          -1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  // "</script>" in a title would end the script element, and "<!--" would begin a comment.
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos; ++at)
    text.replace(at, 1, "\\u003c");
  return text;
}

}  // namespace viscontact::report
