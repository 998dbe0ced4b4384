// Arranges frames of a motion side by side in an SVG, with the scale of gamma below. Sizes
// are in units of the page.
#include "viscontact/report/particles/particles_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "viscontact/report/html/page.hpp"
#include "viscontact/report/particles/film_colours.hpp"
#include "viscontact/report/particles/flow/flow_frames.hpp"
#include "viscontact/report/particles/flow/flow_picture.hpp"
#include "viscontact/report/particles/flow/speed_colours.hpp"
#include "viscontact/report/particles/frame_picture.hpp"
#include "viscontact/report/particles/view_box.hpp"

namespace viscontact::report {
namespace {

using particles::dot;
using particles::Frame;
using particles::Playback;

// Sizes of the picture and of its margins, title and captions [page units].
constexpr double kPictureWidth = 1000, kMostHeight = 900, kEdge = 16, kTitle = 44, kCaption = 30;

/// The indices of frames at evenly spaced times.
std::vector<std::size_t> chosen_frames(const Playback& playback, int panels) {
  const auto& frames = playback.frames;
  if (frames.empty()) return {};
  panels =
      std::min(std::clamp(panels, 1, 6), static_cast<int>(std::min<std::size_t>(frames.size(), 6)));
  if (panels == 1) return {frames.size() - 1};
  std::vector<std::size_t> chosen;
  for (int i = 0; i < panels; ++i) {
    const double time =
        std::lerp(frames.front().time, frames.back().time, static_cast<double>(i) / (panels - 1));
    const auto nearest = std::ranges::min_element(
        frames, {}, [&](const Frame& frame) { return std::abs(frame.time - time); });
    chosen.push_back(static_cast<std::size_t>(nearest - frames.begin()));
  }
  chosen.back() = frames.size() - 1;
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

/// The number of columns of panels with which the picture has about the proportions of a slide and
/// few empty places.
int columns_for(int panels, double width_over_height) {
  constexpr double kSlide = 2.2;  // width over height of the picture
  int best = 1;
  double least = std::numeric_limits<double>::infinity();
  for (int columns = 1; columns <= panels; ++columns) {
    const int rows = (panels + columns - 1) / columns;
    const double misfit =
        std::abs(std::log(columns * width_over_height / rows / kSlide)) + (rows * columns - panels);
    if (misfit < least) {
      least = misfit;
      best = columns;
    }
  }
  return best;
}

/// A scale of colours with its numbers below.
struct ColourBar {
  std::vector<std::string> colours;                   ///< from left to right
  std::vector<std::pair<double, std::string>> ticks;  ///< shares of the width, and texts
  std::string words;
};

ColourBar film_bar(double lowest, const std::string& words, bool touching) {
  ColourBar bar;
  for (int c = kContactColours; c-- > 0;) bar.colours.push_back(film_colour(c, kContactColours));
  for (const double tick : film_ticks(lowest))
    bar.ticks.emplace_back(1 - tick / lowest, film_tick_text(tick));
  bar.words = words + std::string(touching ? "; thin and grey: touching, no film" : "");
  return bar;
}

ColourBar speed_bar(double top) {
  constexpr int kColours = 20;
  ColourBar bar;
  for (int c = 0; c < kColours; ++c)
    bar.colours.push_back(speed_colour(static_cast<double>(c) / (kColours - 1)));
  for (const auto& [speed, text] : speed_ticks(top)) bar.ticks.emplace_back(speed / top, text);
  bar.words = std::string(kSpeedWords) + "; equal flow between streamlines";
  return bar;
}

std::string picture_of(const ColourBar& bar, double left, double top, double width) {
  constexpr int kHeight = 12;  // [page units]
  std::string text;
  const double step = width / static_cast<double>(bar.colours.size());
  for (std::size_t c = 0; c < bar.colours.size(); ++c)
    text += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{}\" fill=\"{}\"/>\n",
        left + static_cast<double>(c) * step, top, step + (c + 1 < bar.colours.size() ? 0.3 : 0),
        kHeight, bar.colours[c]);
  text += "<g font-size=\"12\" text-anchor=\"middle\">\n";
  for (const auto& [share, number] : bar.ticks)
    text += fmt::format(
        "<path d=\"M{0:.2f} {1:.2f}v4\" stroke=\"#333\"/>"
        "<text x=\"{0:.2f}\" y=\"{2:.2f}\">{3}</text>\n",
        left + width * share, top + kHeight, top + kHeight + 16, number);
  return text + fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text></g>\n", left + width / 2,
                            top + kHeight + 34, bar.words);
}

/// The flow behind the particles of frame `f`; empty if there is none.
std::string flow_behind(const FlowFrames& flows, std::size_t f, const Projection& view) {
  const auto flow = std::ranges::find(flows.frames, f, &FlowFrame::frame);
  return flow == flows.frames.end() ? "" : flow_picture(flows, *flow, view);
}

/// Returns the size of the projected box [L], and puts its upper left corner into that of the
/// panel.
std::pair<double, double> show_box(Projection& view, const ViewBox& box) {
  Interval x, y;
  for (int corner = 0; corner < 8; ++corner) {
    const particles::Vector p = {((corner & 1) != 0 ? box.high : box.low)[0],
                                 ((corner & 2) != 0 ? box.high : box.low)[1],
                                 ((corner & 4) != 0 ? box.high : box.low)[2]};
    x.add(dot(view.right, p), dot(view.right, p));
    y.add(dot(view.up, p), dot(view.up, p));
  }
  view.left = x.low;
  view.top = y.high;
  return {x.high - x.low, y.high - y.low};
}

/// The beginning of the SVG, with the title.
std::string opening(const std::string& title, double height, bool has_bodies) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" fill=\"#1a1a1a\">\n"
      "<title>{2}</title>\n"
      "<defs><radialGradient id=\"ball\" cx=\".36\" cy=\".32\" r=\".72\">"
      "<stop offset=\"0\" stop-color=\"#e3eef7\"/><stop offset=\".5\" stop-color=\"#a3bfd8\"/>"
      "<stop offset=\"1\" stop-color=\"#5b7f9f\"/></radialGradient>{5}</defs>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "<text x=\"{3:.0f}\" y=\"29\" font-size=\"{4:.1f}\" text-anchor=\"middle\">{2}</text>\n",
      kPictureWidth, height, escaped(title), kPictureWidth / 2,
      // A character is on average about half as wide as high.
      std::min(20.0, 2 * (kPictureWidth - 2 * kEdge) / static_cast<double>(title.size() + 1)),
      has_bodies ? "<radialGradient id=\"body\" cx=\".36\" cy=\".32\" r=\".72\">"
                   "<stop offset=\"0\" stop-color=\"#f6ead0\"/><stop offset=\".5\" "
                   "stop-color=\"#dcc79c\"/><stop offset=\"1\" stop-color=\"#a98d55\"/>"
                   "</radialGradient>"
                 : "");
}

/// The panels of the chosen frames with their times, in rows of `columns`.
std::string panels_of(const PanelSettings& panel, const FlowFrames& flows,
                      const std::vector<std::size_t>& chosen, int columns) {
  std::string text;
  // If the height limits the scale, the panels are spread over the width.
  const double place = kPictureWidth / columns;
  for (int i = 0; i < static_cast<int>(chosen.size()); ++i) {
    const auto f = chosen[static_cast<std::size_t>(i)];
    const auto& frame = panel.playback.frames[f];
    const int row = i / columns;
    const double left = place * (i % columns) + (place - panel.width) / 2;
    const double top = kTitle + row * (panel.height + kCaption);
    text += fmt::format(
        "<svg x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\">\n{}"
        "<rect width=\"100%\" height=\"100%\" fill=\"none\" stroke=\"#ccc\"/>\n</svg>\n"
        "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"14\" text-anchor=\"middle\">t = "
        "{:.4g}</text>\n",
        left, top, panel.width, panel.height,
        frame_picture(panel, frame, flow_behind(flows, f, panel.view)), left + panel.width / 2,
        top + panel.height + 20, frame.time);
  }
  return text;
}

}  // namespace

std::string particles_picture(const Playback& original, const std::string& title, int panels) {
  // More than 20000 particles in a panel could not be told apart, nor more points of a flow.
  constexpr std::size_t kMostInPanel = 20000, kPointsOfFlow = 50000;
  const auto playback = in_plane(original);
  const bool has_axis = original.dimension == 1;
  const auto chosen = chosen_frames(playback, panels);
  const int count = static_cast<int>(chosen.size());
  const auto extent = flow_extent(playback, has_axis);
  PanelSettings panel{.playback = playback,
                      .box = view_box_of(playback, chosen, box_of(extent)),
                      .view = view_of(playback.dimension),
                      .lowest = lowest_gamma(playback),
                      .every = playback.radii.size() / (kMostInPanel + 1) + 1,
                      .is_in_fluid = extent.has_value()};
  FlowFrames flows;
  if (extent)
    flows = read_flows(playback, has_axis, common_part(*extent, panel.box), chosen, kPointsOfFlow);
  const auto [wide, high] = show_box(panel.view, panel.box);
  const int columns = columns_for(std::max(count, 1), wide / high);
  const int rows = (count + columns - 1) / columns;
  auto& scale = panel.view.scale;
  scale = (kPictureWidth - (columns + 1) * kEdge) / (columns * wide);
  if (rows > 0) scale = std::min(scale, (kMostHeight / rows - kCaption) / high);
  panel.width = scale * wide;
  panel.height = scale * high;
  const double bottom = kTitle + rows * (panel.height + kCaption) + 6;
  std::vector<ColourBar> bars;
  if (flows.top_speed > 0) bars.push_back(speed_bar(flows.top_speed));
  if (panel.lowest < 0)
    bars.push_back(film_bar(panel.lowest, film_words(original),
                            std::ranges::any_of(chosen, [&](std::size_t f) {
                              return has_contact_without_film(playback.frames[f]);
                            })));
  const bool slides = std::ranges::any_of(
      chosen, [&](std::size_t f) { return has_sliding_contact(playback.frames[f]); });
  auto svg =
      opening(title, bottom + (bars.empty() ? (slides ? 12 : 0) : 60), !playback.bodies.empty());
  svg += panels_of(panel, flows, chosen, columns);
  if (panel.every > 1)
    svg += fmt::format(
        "<text x=\"{:.0f}\" y=\"{:.2f}\" font-size=\"11\" text-anchor=\"end\">one particle in {} "
        "is drawn</text>\n",
        kPictureWidth - kEdge, bottom + 4, panel.every);
  if (slides)
    svg += fmt::format(
        "<text x=\"{:.0f}\" y=\"{:.2f}\" font-size=\"11\" fill=\"{}\">contacts that slide are "
        "orange</text>\n",
        kEdge, bottom + 4, kSlidingColour);
  constexpr double kBar = 360;  // width of a colour bar
  for (std::size_t b = 0; b < bars.size(); ++b) {
    const double middle =
        kPictureWidth * (static_cast<double>(b) + 0.5) / static_cast<double>(bars.size());
    svg += picture_of(bars[b], middle - kBar / 2, bottom, kBar);
  }
  return svg + "</svg>\n";
}

}  // namespace viscontact::report
