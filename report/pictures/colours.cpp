// Colours between the nodes of a scale; ends, numbers and words of scales. Colour-blind readers
// must be able to tell the colours apart.
#include "viscontact/report/pictures/colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numbers>

namespace viscontact::report {
namespace {

/// Free choices of scales, by eye.
struct ScaleTuning {
  // Largest number of a scale with the number 0 only: a double cannot represent a quarter of it and
  // its decade accurately.
  static constexpr double kSmallest = 1e-300;
  // Relative rounding error of a number beside a scale.
  static constexpr double kRounding = 1e-9;
  // Ends of a scale that differ by at most this fraction of their size are moved apart. The numbers
  // beside it have three digits, so a reader could not tell such ends apart.
  static constexpr double kEqual = 1e-9;
  // Intervals of a linear scale, and numbers of each sign beside a logarithmic one, about.
  static constexpr double kIntervals = 5;
  static constexpr int kMostOfASign = 4;
  // Least distance of numbers over the width of the scale.
  static constexpr double kApart = 0.11;
  // Intervals in which gnuplot interpolates colours; more cannot be seen.
  static constexpr int kSteps = 40;
  // The words name a pressure beyond 1.2 times the end of the scale. Pressures nearer to the end
  // would have nearly its colour anyway.
  static constexpr double kWorthAWord = 1.2;
  // Share of the pixels that may be beyond each end of a scale. The upper end is cut if the largest
  // pressure is more than kMuchFarther times the pressure above which this share of the pixels
  // lies, and the lower end in the same way.
  static constexpr double kBeyond = 0.005, kMuchFarther = 3;
  // The scale is logarithmic beyond the usual pressure if an end is cut, or is more than this
  // number of times the usual pressure.
  static constexpr double kLogarithmic = 10;
};

struct ColourNode {
  double place;               ///< on the scale [1]
  std::array<double, 3> rgb;  ///< red, green, blue from 0 to 255
};

/// The colour "#rrggbb" at a place of a scale with at least two nodes in the order of their places.
/// Red, green and blue are linear between the nodes; outside they are those of the nearest node.
std::string colour_between(const std::vector<ColourNode>& nodes, double place) {
  std::size_t i = 1;
  while (i + 1 < nodes.size() && nodes[i].place < place) ++i;
  const auto &a = nodes[i - 1], &b = nodes[i];
  const double share = std::clamp((place - a.place) / (b.place - a.place), 0.0, 1.0);
  std::array<long, 3> rgb{};
  for (std::size_t c = 0; c < rgb.size(); ++c)
    rgb[c] = std::lround(std::lerp(a.rgb[c], b.rgb[c], share));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

/// `colours` >= 2 colours at evenly spaced shares from 0 to 1; colour(share) is that at a share.
template <class Colour>
std::vector<std::string> evenly_spaced(int colours, const Colour& colour) {
  assert(colours >= 2);
  std::vector<std::string> all;
  for (int c = 0; c < colours; ++c) all.push_back(colour(static_cast<double>(c) / (colours - 1)));
  return all;
}

/// Round numbers from 0 to `top` >= 0 in about four intervals, as shares of `top` with their texts.
/// The result has only the number 0 if `top` is at most kSmallest.
std::vector<std::pair<double, std::string>> round_ticks(double top) {
  if (!(top > ScaleTuning::kSmallest)) return {{0, "0"}};
  const double rough = top / 4, decade = std::pow(10, std::floor(std::log10(rough)));
  const double step = decade * (rough < 1.5 * decade ? 1
                                : rough < 3 * decade ? 2
                                : rough < 7 * decade ? 5
                                                     : 10);
  std::vector<std::pair<double, std::string>> ticks;
  for (int i = 0; i * step <= top * (1 + ScaleTuning::kRounding); ++i)
    ticks.emplace_back(i * step / top, fmt::format("{:.3g}", i * step));
  return ticks;
}

/// The colour at a place from -1 to 1 of ColorBrewer's scale RdBu, safe for colour-blind readers.
std::string red_blue(double place) {
  static const std::vector<ColourNode> kRedBlue = {
      {-1, {33, 102, 172}}, {-0.66, {103, 169, 207}}, {-0.3, {209, 229, 240}},
      {0, {250, 250, 250}}, {0.3, {253, 219, 199}},   {0.66, {239, 138, 98}},
      {1, {178, 24, 43}}};
  return colour_between(kRedBlue, place);
}

/// A number with three digits and a short exponent: 1e6 in place of 1e+06.
std::string short_number(double value) {
  std::string text = fmt::format("{:.3g}", value);
  if (const auto e = text.find("e+"); e != std::string::npos)
    text.erase(e + 1, text[e + 2] == '0' ? 2 : 1);
  return text;
}

/// The smallest number >= `value` > 0 that is 1, 2 or 5 times a power of ten.
double rounded_up(double value) {
  assert(value > 0);
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double mantissa : {1.0, 2.0, 5.0})
    if (value <= mantissa * decade) return mantissa * decade;
  return 10 * decade;
}

std::vector<double> sorted_finite(const std::vector<double>& values) {
  std::vector<double> sorted;
  std::ranges::copy_if(values, std::back_inserter(sorted),
                       [](double v) { return std::isfinite(v); });
  std::ranges::sort(sorted);
  if (sorted.empty()) sorted.push_back(0);
  return sorted;
}

/// The scale with low < high, as gnuplot needs it. If the two ends differ by at most kEqual times
/// their size, they are moved apart.
PressureColours widened(PressureColours colours) {
  if (colours.high - colours.low > ScaleTuning::kEqual * std::abs(colours.high)) return colours;
  const double half = colours.high == 0 ? 1 : std::abs(colours.high);
  colours.low -= half;
  colours.high += half;
  return colours;
}

}  // namespace

std::string film_colour(double share) {
  // Colour-blind readers, and readers of a grey print, can tell the colours of the published scale
  // viridis apart.
  static const std::vector<ColourNode> kViridis = {
      {0, {253, 231, 37}},     {0.125, {173, 220, 48}}, {0.25, {94, 201, 98}},
      {0.375, {40, 174, 128}}, {0.5, {33, 145, 140}},   {0.625, {44, 114, 142}},
      {0.75, {59, 82, 139}},   {0.875, {71, 45, 123}},  {1, {68, 1, 84}}};
  return colour_between(kViridis, share);
}

ColourScale film_scale(double lowest, int colours, const std::string& words) {
  assert(lowest < 0);
  ColourScale scale{words, evenly_spaced(colours, film_colour), {}};
  std::ranges::reverse(scale.colours);
  for (const auto& [share, text] : round_ticks(-lowest))
    scale.ticks.emplace_back(1 - share, share > 0 ? "−" + text : text);
  return scale;
}

std::string friction_colour(double share) {
  static const std::vector<ColourNode> kGreyToOrange = {{0, {90, 90, 90}}, {1, {213, 94, 0}}};
  return colour_between(kGreyToOrange, share);
}

ColourScale friction_scale(int colours, const std::string& words) {
  return {words, evenly_spaced(colours, friction_colour), {{0, "0"}, {0.5, "0.5"}, {1, "1"}}};
}

std::string speed_colour(double share) {
  // In the colour space OKLab (Ottosson 2020), in which equal steps look equal, the lightness falls
  // evenly from 0.985 to 0.6 and the hue goes from 205 to 254 degrees.
  static const std::vector<ColourNode> kBlues = {{0, {243, 252, 253}},   {0.2, {182, 235, 248}},
                                                 {0.4, {128, 212, 245}}, {0.6, {88, 186, 238}},
                                                 {0.8, {67, 157, 226}},  {1, {64, 128, 206}}};
  return colour_between(kBlues, share);
}

ColourScale speed_scale(double top, int colours, const std::string& unit) {
  assert(!(top < 0));
  return {"speed of the fluid [" + unit + "]", evenly_spaced(colours, speed_colour),
          round_ticks(top)};
}

double PressureColours::at(double pressure) const {
  return linear_below > 0 ? std::asinh(pressure / linear_below) / std::numbers::ln10 : pressure;
}

std::string PressureColours::colour_at(double place) const {
  return red_blue(place / std::max(std::abs(at(low)), std::abs(at(high))));
}

std::vector<std::pair<double, std::string>> PressureColours::ticks() const {
  std::vector<std::pair<double, std::string>> ticks;
  if (!(linear_below > 0)) {
    const double step = rounded_up((high - low) / ScaleTuning::kIntervals);
    for (double n = std::ceil(low / step - ScaleTuning::kRounding);
         n <= high / step + ScaleTuning::kRounding; ++n)
      ticks.emplace_back(n * step, short_number(n == 0 ? 0 : n * step));
    return ticks;
  }
  const int decades = static_cast<int>(
      std::floor(std::log10(std::max(std::abs(low), std::abs(high)) / linear_below)));
  const int every = decades / (ScaleTuning::kMostOfASign + 1) + 1;
  ticks.emplace_back(0, "0");
  for (int i = 0; i <= decades; i += every) {
    const double pressure = linear_below * std::pow(10, i);
    ticks.emplace_back(pressure, short_number(pressure));
    ticks.emplace_back(-pressure, "-" + short_number(pressure));
  }
  return ticks;
}

double PressureColours::share_of(double pressure) const {
  return (at(pressure) - at(low)) / (at(high) - at(low));
}

ColourScale PressureColours::scale(int colours, const std::string& unit) const {
  ColourScale scale{
      "pressure less its mean [" + unit + "]",
      evenly_spaced(colours,
                    [&](double share) { return colour_at(std::lerp(at(low), at(high), share)); }),
      {}};
  if (linear_below > 0) scale.words += fmt::format(", logarithmic beyond {:.3g}", linear_below);
  for (auto [pressure, text] : ticks()) {
    const double share = share_of(pressure);
    if (share < 0 || share > 1 || std::ranges::any_of(scale.ticks, [&](const auto& other) {
          return std::abs(other.first - share) < ScaleTuning::kApart;
        }))
      continue;
    if (text.starts_with("-")) text.replace(0, 1, "−");
    scale.ticks.emplace_back(share, text);
  }
  return scale;
}

std::vector<std::string> PressureColours::settings() const {
  const double from = at(low), to = at(high);
  std::string palette;
  for (int i = 0; i <= ScaleTuning::kSteps; ++i) {
    const double place = std::lerp(from, to, static_cast<double>(i) / ScaleTuning::kSteps);
    palette += fmt::format("{}{:.9g} '{}'", i == 0 ? "" : ", ", place, colour_at(place));
  }
  std::string words = "pressure (unit: viscosity x velocity / length)";
  std::string ticks = "set cbtics autofreq format '%.3g'";
  if (linear_below > 0) {
    std::string places;
    for (const auto& [pressure, text] : this->ticks())
      places += fmt::format("{}'{}' {:.6g}", places.empty() ? "" : ", ", text, at(pressure));
    ticks = "set cbtics (" + places + ")";
    words += fmt::format("\\nlogarithmic beyond {}", short_number(linear_below));
  }
  if (largest > ScaleTuning::kWorthAWord * high && largest > 0)
    words += fmt::format("{} above {} one colour (largest {})", linear_below > 0 ? ";" : "\\n",
                         short_number(high), short_number(largest));
  if (smallest < ScaleTuning::kWorthAWord * low && smallest < 0)
    words += fmt::format("\\nbelow {} one colour (smallest {})", short_number(low),
                         short_number(smallest));
  return {"set palette defined (" + palette + ")",
          fmt::format("set cbrange [{:.9g}:{:.9g}]", from, to), ticks,
          "set cblabel \"" + words + "\" offset 1.2"};
}

PressureColours proportional_colours(const std::vector<double>& pressures) {
  const auto sorted = sorted_finite(pressures);
  return widened({sorted.front(), sorted.back(), sorted.front(), sorted.back(), 0});
}

PressureColours robust_colours(const std::vector<double>& pixels, double usual) {
  assert(!(usual < 0));
  const auto sorted = sorted_finite(pixels);
  const auto few =
      static_cast<std::size_t>(ScaleTuning::kBeyond * static_cast<double>(sorted.size()));
  auto colours = proportional_colours(sorted);
  const double low = sorted[few], high = sorted[sorted.size() - 1 - few];
  if (high > 0 && colours.high > ScaleTuning::kMuchFarther * high) colours.high = rounded_up(high);
  if (low < 0 && colours.low < ScaleTuning::kMuchFarther * low) colours.low = -rounded_up(-low);
  const bool cut = colours.high < sorted.back() || colours.low > sorted.front();
  if (cut ||
      std::max(std::abs(colours.low), std::abs(colours.high)) > ScaleTuning::kLogarithmic * usual)
    colours.linear_below = std::pow(10, std::round(std::log10(usual)));
  return widened(colours);
}

}  // namespace viscontact::report
