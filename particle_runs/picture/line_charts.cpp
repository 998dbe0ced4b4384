// Axes, ticks and lines of charts.
#include "viscontact/particle_runs/picture/line_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "viscontact/report/page.hpp"

namespace viscontact::particles {
namespace {

/// Sizes in page units, of which a chart is kWidth wide, by eye.
struct LineChartTuning {
  static constexpr double kWidth = 500, kHeight = 370, kLeft = 62, kRight = 14, kTop = 34,
                          kBottom = 84, kLineOfLegend = 17, kEntry = 145;
  static constexpr std::size_t kEntriesInLine = 3;
  static constexpr double kTicks = 5;  // about, on an axis
  // More points of a curve could not be told apart.
  static constexpr std::size_t kMostPoints = 1500;
};

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double x) {
    if (!std::isfinite(x)) return;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  /// Replaces a range without a length.
  void widen() {
    if (!(low <= high)) *this = {0, 1};
    if (low == high) high = low + std::max(1.0, std::abs(low));
  }
};

/// 1, 2 or 5 times a power of ten.
double tick_distance(const Range& range) {
  const double rough = (range.high - range.low) / LineChartTuning::kTicks;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10 * power;
}

class ChartFrame {
 public:
  ChartFrame(const LineChart& chart, double left) : left_(left + LineChartTuning::kLeft) {
    y_.add(0);
    for (const auto& curve : chart.curves)
      for (const auto& [x, y] : curve.points) {
        x_.add(x);
        y_.add(y);
      }
    if (chart.top) y_.high = *chart.top;
    x_.widen();
    y_.widen();
    if (!chart.top) y_.high += 0.05 * (y_.high - y_.low);
  }

  static constexpr double width() {
    return LineChartTuning::kWidth - LineChartTuning::kLeft - LineChartTuning::kRight;
  }
  static constexpr double height() {
    return LineChartTuning::kHeight - LineChartTuning::kTop - LineChartTuning::kBottom;
  }
  double left() const { return left_; }
  static constexpr double bottom() { return LineChartTuning::kTop + height(); }
  double x(double value) const { return left_ + width() * (value - x_.low) / (x_.high - x_.low); }
  double y(double value) const {
    return bottom() - height() * (value - y_.low) / (y_.high - y_.low);
  }

  std::string axes(const LineChart& chart) const {
    std::string text = fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
        "stroke=\"#333\"/>\n",
        left_, LineChartTuning::kTop, width(), height());
    const auto ticks = [](const Range& range, const auto& draw) {
      const double distance = tick_distance(range);
      const double slack = 1e-9 * distance;
      for (double k = std::ceil((range.low - slack) / distance); k * distance <= range.high + slack;
           ++k)
        draw(k * distance, fmt::format("{:.6g}", k == 0 ? 0.0 : k * distance));
    };
    ticks(x_, [&](double at, const std::string& number) {
      text += fmt::format(
          "<path d=\"M{0:.1f} {1:.1f}v5\" stroke=\"#333\"/><text x=\"{0:.1f}\" y=\"{2:.1f}\" "
          "text-anchor=\"middle\">{3}</text>\n",
          x(at), bottom(), bottom() + 18, number);
    });
    ticks(y_, [&](double at, const std::string& number) {
      text += fmt::format(
          "<path d=\"M{0:.1f} {1:.1f}h{2:.1f}\" stroke=\"#333\" stroke-opacity=\".12\"/>"
          "<text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
          left_, y(at), width(), left_ - 6, y(at) + 4, number);
    });
    text += fmt::format(
        "<text x=\"{0:.1f}\" y=\"20\" text-anchor=\"middle\" font-weight=\"bold\">{1}</text>\n"
        "<text x=\"{0:.1f}\" y=\"{2:.1f}\" text-anchor=\"middle\">{3}</text>\n"
        "<text transform=\"translate({4:.1f} {5:.1f}) rotate(-90)\" "
        "text-anchor=\"middle\">{6}</text>\n",
        left_ + width() / 2, report::escaped(chart.title), bottom() + 38,
        report::escaped(chart.x_label), left_ - 46, LineChartTuning::kTop + height() / 2,
        report::escaped(chart.y_label));
    return text;
  }

  std::string line(const ChartCurve& curve) const {
    const std::size_t every = curve.points.size() / LineChartTuning::kMostPoints + 1;
    std::string path;
    bool is_interrupted = true;
    const std::size_t count = curve.points.size();
    for (std::size_t n = 0; n < count; n += every) {
      const std::size_t k = n + every < count ? n : count - 1;  // the last point is drawn
      const auto [at, value] = curve.points[k];
      if (!std::isfinite(at) || !std::isfinite(value)) {
        is_interrupted = true;
        continue;
      }
      path += fmt::format("{}{:.1f} {:.1f}", is_interrupted ? "M" : "L", x(at), y(value));
      is_interrupted = false;
    }
    return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"{}/>\n",
                       path, curve.colour, curve.is_dashed ? " stroke-dasharray=\"7 4\"" : "");
  }

 private:
  double left_;
  Range x_, y_;
};

/// Entry `number` of the legend, below the axis.
std::string legend_of(const ChartFrame& frame, const ChartCurve& curve, std::size_t number) {
  using Tuning = LineChartTuning;
  const double y = ChartFrame::bottom() + 62 +
                   Tuning::kLineOfLegend * static_cast<double>(number / Tuning::kEntriesInLine);
  const double x =
      frame.left() + Tuning::kEntry * static_cast<double>(number % Tuning::kEntriesInLine);
  return fmt::format(
      "<path d=\"M{:.1f} {:.1f}h24\" stroke=\"{}\" stroke-width=\"2.4\"{}/><text x=\"{:.1f}\" "
      "y=\"{:.1f}\">{}</text>\n",
      x, y - 4, curve.colour, curve.is_dashed ? " stroke-dasharray=\"7 4\"" : "", x + 29, y,
      report::escaped(curve.legend));
}

}  // namespace

std::string line_charts(std::span<const LineChart> charts) {
  const double width = LineChartTuning::kWidth * static_cast<double>(charts.size());
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" "
      "font-family=\"Helvetica, "
      "Arial, sans-serif\" font-size=\"12\" fill=\"#222\">\n<rect width=\"{0:g}\" height=\"{1:g}\" "
      "fill=\"#fff\"/>\n",
      width, LineChartTuning::kHeight);
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const auto& chart = charts[c];
    const ChartFrame frame(chart, LineChartTuning::kWidth * static_cast<double>(c));
    text += frame.axes(chart);
    text += fmt::format(
        "<clipPath id=\"chart{0}\"><rect x=\"{1:.1f}\" y=\"{2:.1f}\" width=\"{3:.1f}\" "
        "height=\"{4:.1f}\"/></clipPath>\n<g clip-path=\"url(#chart{0})\">\n",
        c, frame.left(), LineChartTuning::kTop, ChartFrame::width(), ChartFrame::height());
    for (const auto& curve : chart.curves) text += frame.line(curve);
    text += "</g>\n";
    for (std::size_t k = 0; k < chart.curves.size(); ++k)
      text += legend_of(frame, chart.curves[k], k);
  }
  return text + "</svg>\n";
}

}  // namespace viscontact::particles
