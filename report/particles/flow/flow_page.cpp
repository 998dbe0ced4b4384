// Encodes flows for the page and writes its controls and scales for them (flow_page.hpp).
#include "viscontact/report/particles/flow/flow_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "viscontact/report/particles/flow/speed_colours.hpp"

namespace viscontact::report {
namespace {

constexpr int kScaleColours = 64;          // between which the page interpolates
constexpr double kLevels = 254;            // highest level of a byte
constexpr unsigned char kNothing = 255;    // level of a point without flow
constexpr std::uint16_t kNoArrow = 65535;  // place of the arrow of a line without one
constexpr double kLineSteps = 65535;       // steps of a coordinate across the window

template <class Number>
void append_number(Bytes& bytes, Number value) {
  const auto at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// Appends a byte for each value. `share` gives the place of a value on its scale, from 0 to 1.
template <class Share>
void append_levels(Bytes& bytes, const std::vector<float>& field, std::size_t columns,
                   const Share& share) {
  // The page interpolates between points, so that points just outside the flow need values.
  constexpr int kLayers = 3;
  std::vector<double> values(field.begin(), field.end());
  for (int layer = 0; layer < kLayers; ++layer) fill_next_to_known(values, columns);
  for (const double value : values)
    bytes.push_back(std::isnan(value) ? kNothing
                                      : static_cast<unsigned char>(std::lround(
                                            kLevels * std::clamp(share(value), 0.0, 1.0))));
}

void append_lines(Bytes& bytes, const FlowFrame& frame, const Window& window) {
  const auto write = [&](std::size_t number) {
    append_number(bytes, static_cast<std::uint16_t>(number));
  };
  const auto step = [](double share) {
    return static_cast<std::size_t>(std::lround(kLineSteps * std::clamp(share, 0.0, 1.0)));
  };
  // A line with more points than a 16-bit number can count is left out; so would be many lines.
  constexpr std::size_t kMost = 65000;
  const auto is_short = [&](const StreamLine& line) { return line.points.size() < kMost; };
  const auto count = static_cast<std::size_t>(std::ranges::count_if(frame.lines, is_short));
  write(std::min(count, kMost));
  std::size_t written = 0;
  for (const auto& line : frame.lines) {
    if (!is_short(line) || written++ >= kMost) continue;
    write(line.points.size());
    write(line.arrow > 0 ? static_cast<std::size_t>(line.arrow) : kNoArrow);
    for (const auto& [x, y] : line.points) {
      write(step((x - window.left) / window.width()));
      write(step((y - window.bottom) / window.height()));
    }
  }
}

std::vector<std::string> speed_scale() {
  std::vector<std::string> colours;
  for (int c = 0; c < kScaleColours; ++c)
    colours.push_back(speed_colour(static_cast<double>(c) / (kScaleColours - 1)));
  return colours;
}

/// The place of a pressure on the scale, from 0 to 1.
double share_of(const PressureColours& colours, double pressure) {
  const double low = colours.at(colours.low), high = colours.at(colours.high);
  return (colours.at(pressure) - low) / (high - low);
}

std::vector<std::string> pressure_scale(const PressureColours& colours) {
  const double low = colours.at(colours.low), high = colours.at(colours.high);
  std::vector<std::string> scale;
  for (int c = 0; c < kScaleColours; ++c)
    scale.push_back(
        colours.colour_at(std::lerp(low, high, static_cast<double>(c) / (kScaleColours - 1))));
  return scale;
}

/// The places and texts on the scale of the pressure, without those that would touch another one.
std::vector<std::pair<double, std::string>> pressure_ticks(const PressureColours& colours) {
  constexpr double kApart = 0.11;  // of the width of the scale
  std::vector<std::pair<double, std::string>> ticks;
  for (auto [pressure, text] : colours.ticks()) {
    const double share = share_of(colours, pressure);
    if (share < 0 || share > 1 || std::ranges::any_of(ticks, [&](const auto& other) {
          return std::abs(other.first - share) < kApart;
        }))
      continue;
    if (text.starts_with("-")) text.replace(0, 1, "−");
    ticks.emplace_back(share, text);
  }
  return ticks;
}

std::string legend_of(const FlowFrames& flows) {
  std::string text;
  if (flows.top_speed > 0) {
    std::vector<std::pair<double, std::string>> ticks;
    for (const auto& [speed, number] : speed_ticks(flows.top_speed))
      ticks.emplace_back(speed / flows.top_speed, number);
    text += "<div id=speed-scale>" + scale_html(kSpeedWords, speed_scale(), ticks) + "</div>\n";
  }
  const auto& colours = flows.pressure_colours;
  const auto ticks = pressure_ticks(colours);
  std::string words = kPressureWords;
  if (colours.linear_below > 0)
    words += fmt::format(", logarithmic beyond {:.3g}", colours.linear_below);
  return text + "<div id=pressure-scale hidden>" +
         scale_html(words, pressure_scale(colours), ticks) + "</div>\n";
}

}  // namespace

ShownFlows shown_flows(const particles::Playback& playback) {
  constexpr std::size_t kMostFlows = 150, kMostPoints = 60'000;
  std::vector<std::size_t> with_flow;
  for (std::size_t f = 0; f < playback.frames.size(); ++f)
    if (!playback.frames[f].flow.empty()) with_flow.push_back(f);
  ShownFlows shown;
  const auto count = std::min(with_flow.size(), kMostFlows);
  for (std::size_t i = 0; i < count; ++i)
    shown.frames.push_back(with_flow[count < 2 ? 0 : i * (with_flow.size() - 1) / (count - 1)]);
  if (count > 0) shown.points = std::min(kMostPoints, kFlowBytesOfPage / 2 / count);
  return shown;
}

FlowOfPage flow_of_page(const FlowFrames& flows, const particles::Playback& playback) {
  FlowOfPage page{.settings = "null", .blocks = {}, .controls = "", .legend = ""};
  if (flows.frames.empty()) return page;
  Bytes times, speeds, pressures, lines, offsets;
  for (const auto& frame : flows.frames) {
    append_number(times, playback.frames[frame.frame].time);
    append_levels(speeds, frame.speed, flows.grid.columns,
                  [&](double speed) { return flows.top_speed > 0 ? speed / flows.top_speed : 0; });
    append_levels(pressures, frame.pressure, flows.grid.columns,
                  [&](double pressure) { return share_of(flows.pressure_colours, pressure); });
    append_number(offsets, static_cast<std::uint32_t>(lines.size() / sizeof(std::uint16_t)));
    append_lines(lines, frame, flows.grid.window);
  }
  append_number(offsets, static_cast<std::uint32_t>(lines.size() / sizeof(std::uint16_t)));
  page.blocks = {{"flow-times", times},
                 {"flow-speed", speeds},
                 {"flow-pressure", pressures},
                 {"flow-lines", lines},
                 {"flow-offsets", offsets}};
  const auto& window = flows.grid.window;
  const auto list = [](const auto& colours) {
    return fmt::format("{}", fmt::join(colours, "\",\""));
  };
  page.settings = fmt::format(
      "{{\"window\":[{},{},{},{}],\"columns\":{},\"rows\":{},\"hasAxis\":{},\"lineColour\":\"{}\","
      "\"speed\":[\"{}\"],\"pressure\":[\"{}\"]}}",
      window.left, window.right, window.bottom, window.top, flows.grid.columns, flows.grid.rows,
      flows.has_axis, kStreamLineColour, list(speed_scale()),
      list(pressure_scale(flows.pressure_colours)));
  page.controls =
      "<label>Flow <select id=flow><option value=speed selected>speed<option "
      "value=pressure>pressure<option value=none>none</select></label>\n"
      "<label><input type=checkbox id=streamlines checked> Streamlines</label>\n";
  page.legend = legend_of(flows);
  return page;
}

std::string scale_html(const std::string& words, const std::vector<std::string>& colours,
                       const std::vector<std::pair<double, std::string>>& ticks) {
  std::string places;
  for (const auto& [share, text] : ticks)
    places += fmt::format("<span style=\"left:{:.2f}%\">{}</span>", 100 * share, text);
  return fmt::format(
      "<div class=films><span>{}</span>\n<div class=scale><div class=bar "
      "style=\"background:linear-gradient(to right,{})\"></div>\n<div class=ticks>{}</div>"
      "</div></div>\n",
      words, fmt::join(colours, ","), places);
}

}  // namespace viscontact::report
