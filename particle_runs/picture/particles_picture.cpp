// Panels, flow and scales of colours of the still picture. Sizes are in page units, of which the
// picture is 1000 wide.
#include "viscontact/particle_runs/picture/particles_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "viscontact/particle_runs/picture/frame_picture.hpp"
#include "viscontact/report/page.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of the picture, by eye.
struct StillPictureTuning {
  // Width of the picture, largest height of all panels, margin, title and caption.
  static constexpr double kPictureWidth = 1000, kMostHeight = 900, kEdge = 16, kTitle = 44,
                          kCaption = 30;
  // Width over height of all panels.
  static constexpr double kSlide = 2.2;
  // Height and width of the bar of a scale of colours, and height of a scale with its numbers and
  // words.
  static constexpr int kBarHeight = 12;
  static constexpr double kBar = 360, kHeightOfBars = 60;
  // Two scales stand beside each other; the words of more scales would not fit in the width.
  static constexpr std::size_t kBarsInRow = 2;
  // Number of colours of the speed.
  static constexpr int kBands = 20;
  // Points of a line that are nearer than this to the last one could not be seen.
  static constexpr double kNear = 0.5;
  // Length of an arrowhead and half its width.
  static constexpr double kLength = 5, kHalfWidth = 2.2;
  // In a panel, more particles or points of a flow could not be told apart. If the web page shows
  // flows on more points, the picture takes as many.
  static constexpr std::size_t kMostInPanel = 20000, kPointsOfFlow = 50000;
};

/// The indices of the frames that are drawn, increasing: those whose times are nearest to evenly
/// spaced times, each once. Empty without frames.
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

/// With this number of columns all panels together are about as wide as a slide.
int columns_for(int panels, double width_over_height) {
  assert(panels >= 1);
  int best = 1;
  double least = std::numeric_limits<double>::infinity();
  for (int columns = 1; columns <= panels; ++columns) {
    const int rows = (panels + columns - 1) / columns;
    const double misfit =
        std::abs(std::log(columns * width_over_height / rows / StillPictureTuning::kSlide)) +
        (rows * columns - panels);
    if (misfit < least) {
      least = misfit;
      best = columns;
    }
  }
  return best;
}

/// The upper left corner of the bar is (left, top); numbers and words are below the bar.
std::string picture_of(const report::ColourScale& bar, double left, double top, double width) {
  using Tuning = StillPictureTuning;
  assert(!bar.colours.empty());
  std::string text;
  const double step = width / static_cast<double>(bar.colours.size());
  for (std::size_t c = 0; c < bar.colours.size(); ++c)
    text += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{}\" fill=\"{}\"/>\n",
        left + static_cast<double>(c) * step, top, step + (c + 1 < bar.colours.size() ? 0.3 : 0),
        Tuning::kBarHeight, bar.colours[c]);
  text += "<g font-size=\"12\" text-anchor=\"middle\">\n";
  for (const auto& [share, number] : bar.ticks)
    text += fmt::format(
        "<path d=\"M{0:.2f} {1:.2f}v4\" stroke=\"#333\"/>"
        "<text x=\"{0:.2f}\" y=\"{2:.2f}\">{3}</text>\n",
        left + width * share, top + Tuning::kBarHeight, top + Tuning::kBarHeight + 16, number);
  return text + fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text></g>\n", left + width / 2,
                            top + Tuning::kBarHeight + 34, bar.words);
}

/// The speed as a field on triangles, for level lines. One more ring of points surrounds the grid.
/// Its points have the places of the outermost points of the grid, but the speed -1, so that level
/// lines are closed.
report::LinearField closed_field(const report::Grid& grid, const FlowFrame& frame) {
  std::vector<double> speeds(frame.speed.begin(), frame.speed.end());
  // Points without flow, which are in solids, take the speed of their neighbours, layer by layer.
  const auto is_unknown = [](double v) { return std::isnan(v); };
  for (auto layer = std::max(grid.columns, grid.rows);
       layer > 0 && std::ranges::any_of(speeds, is_unknown); --layer)
    report::fill_next_to_known(speeds, grid.columns);
  report::LinearField field;
  const auto columns = grid.columns + 2, rows = grid.rows + 2;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const auto i = std::clamp<std::size_t>(column, 1, grid.columns) - 1;
      const auto j = std::clamp<std::size_t>(row, 1, grid.rows) - 1;
      const bool is_added = i + 1 != column || j + 1 != row;
      field.points.push_back({grid.x(i), grid.y(j)});
      field.values.push_back(is_added ? -1 : speeds[j * grid.columns + i]);
    }
  for (std::size_t row = 0; row + 1 < rows; ++row)
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const auto a = static_cast<std::uint32_t>(row * columns + column);
      const auto c = static_cast<std::uint32_t>(a + columns);
      field.triangles.push_back({a, a + 1, c + 1});
      field.triangles.push_back({a, c + 1, c});
    }
  return field;
}

/// Appends a line [L] to an SVG path. Points that are too near to the last appended point are
/// left out, because they could not be seen, but never the first and the last point.
void append_path(std::string& path, const report::Polyline& line, const Projection& view) {
  double last_x = 0, last_y = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector at = {line[i].first, line[i].second, 0};
    const double x = view.x(at), y = view.y(at);
    if (i > 0 && i + 1 < line.size() &&
        std::hypot(x - last_x, y - last_y) < StillPictureTuning::kNear)
      continue;
    path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x, y);
    last_x = x;
    last_y = y;
  }
}

/// SVG path of an arrowhead with its tip at point number `at` of a line [L], in the direction of
/// the line; empty if this point and the point before it have the same place.
std::string arrow_head(const report::Polyline& line, std::size_t at, const Projection& view) {
  using Tuning = StillPictureTuning;
  assert(at >= 1 && at < line.size());
  const Vector tip = {line[at].first, line[at].second, 0};
  const Vector tail = {line[at - 1].first, line[at - 1].second, 0};
  const double x = view.x(tip), y = view.y(tip), dx = x - view.x(tail), dy = y - view.y(tail);
  const double length = std::hypot(dx, dy);
  if (!(length > 0)) return "";
  const double a = Tuning::kLength * dx / length, b = Tuning::kLength * dy / length;
  const double c = -Tuning::kHalfWidth * dy / length, d = Tuning::kHalfWidth * dx / length;
  return fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z", x, y, x - a + c, y - b + d,
                     x - a - c, y - b - d);
}

/// SVG of the flow on its grid: bands of colour for the speed, from 0 to FlowFrames::top_speed, and
/// streamlines with arrows.
std::string half_picture(const FlowFrames& flows, const FlowFrame& frame, const Projection& view) {
  const auto& window = flows.grid.window;
  const double left = view.x({window.left, 0, 0}), top = view.y({0, window.top, 0});
  auto text = fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", left,
      top, view.scale * window.width(), view.scale * window.height(), report::speed_colour(0));
  const auto speed = closed_field(flows.grid, frame);
  if (flows.top_speed > 0)
    for (int band = 1; band < StillPictureTuning::kBands; ++band) {
      std::string path;
      for (const auto& line :
           report::level_lines(speed, flows.top_speed * band / StillPictureTuning::kBands))
        append_path(path, line, view);
      if (!path.empty())
        text += fmt::format(
            "<path fill=\"{}\" fill-rule=\"evenodd\" d=\"{}\"/>\n",
            report::speed_colour(static_cast<double>(band) / (StillPictureTuning::kBands - 1)),
            path);
    }
  std::string lines, arrows;
  for (const auto& line : frame.lines) {
    append_path(lines, line.points, view);
    if (line.arrow > 0)
      arrows += arrow_head(line.points, static_cast<std::size_t>(line.arrow), view);
  }
  return text + fmt::format(
                    "<path fill=\"none\" stroke=\"{0}\" stroke-opacity=\".6\" stroke-width=\".7\" "
                    "d=\"{1}\"/>\n<path fill=\"{0}\" fill-opacity=\".75\" d=\"{2}\"/>\n",
                    report::kStreamLineColour, lines, arrows);
}

/// With an axis, the grid covers one half of the picture; the other half is its mirror image.
std::string flow_picture(const FlowFrames& flows, const FlowFrame& frame, const Projection& view) {
  auto half = half_picture(flows, frame, view);
  if (!flows.has_axis) return half;
  return half + fmt::format("<g transform=\"translate({:.4f} 0) scale(-1 1)\">\n{}</g>\n",
                            2 * view.x({0, 0, 0}), half);
}

std::string flow_behind(const FlowFrames& flows, std::size_t f, const Projection& view) {
  const auto flow = std::ranges::find(flows.frames, f, &FlowFrame::frame);
  return flow == flows.frames.end() ? "" : flow_picture(flows, *flow, view);
}

/// Returns width and height of the box as the reader sees it [L]. Sets `left` and `top` of the view
/// so that the upper left corner of the box has the coordinates (0, 0) in the panel. A box in space
/// is seen from the same distance as by nearness() of view.js.
std::pair<double, double> show_box(Projection& view, const ViewBox& box, int dimension) {
  if (dimension == 3) {
    view.middle = 0.5 * (box.low + box.high);
    view.distance = 4 * norm(box.high - box.low);
  }
  Interval x, y;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector p = {((corner & 1) != 0 ? box.high : box.low)[0],
                      ((corner & 2) != 0 ? box.high : box.low)[1],
                      ((corner & 4) != 0 ? box.high : box.low)[2]};
    x.add(view.x(p), view.x(p));
    y.add(-view.y(p), -view.y(p));
  }
  view.left = x.low;
  view.top = y.high;
  return {x.high - x.low, y.high - y.low};
}

/// `colours[0]` is at the brightest point of a sphere, `colours[2]` at its rim.
std::string gradient(const char* id, const std::array<SceneStyle::Colour, 4>& colours) {
  return fmt::format(
      "<radialGradient id=\"{}\" cx=\".36\" cy=\".32\" r=\".72\">"
      "<stop offset=\"0\" stop-color=\"{}\"/><stop offset=\".5\" stop-color=\"{}\"/>"
      "<stop offset=\"1\" stop-color=\"{}\"/></radialGradient>",
      id, colours[0], colours[1], colours[2]);
}

/// The beginning of the SVG: size, title (plain text, escaped here), gradients and background.
std::string opening(const std::string& title, double height, bool has_bodies) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 "
      "0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" fill=\"#1a1a1a\">\n"
      "<title>{2}</title>\n<defs>{5}{6}</defs>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "<text x=\"{3:.0f}\" y=\"29\" font-size=\"{4:.1f}\" text-anchor=\"middle\">{2}</text>\n",
      StillPictureTuning::kPictureWidth, height, report::escaped(title),
      StillPictureTuning::kPictureWidth / 2,
      // A long title has a smaller font. A character is on average half as wide as high.
      std::min(20.0, 2 * (StillPictureTuning::kPictureWidth - 2 * StillPictureTuning::kEdge) /
                         static_cast<double>(title.size() + 1)),
      gradient("ball", kStyle.ball), has_bodies ? gradient("body", kStyle.ball_of_body) : "");
}

std::string panels_of(const PanelSettings& panel, const std::vector<std::size_t>& chosen,
                      int columns) {
  assert(columns >= 1);
  const auto& units = panel.scene.playback.units;
  std::string text;
  // If the height limits the scale, the panels do not fill the width and stand apart.
  const double place = StillPictureTuning::kPictureWidth / columns;
  for (int i = 0; i < static_cast<int>(chosen.size()); ++i) {
    const auto f = chosen[static_cast<std::size_t>(i)];
    const auto& frame = panel.scene.playback.frames[f];
    const int row = i / columns;
    const double left = place * (i % columns) + (place - panel.width) / 2;
    const double top =
        StillPictureTuning::kTitle + row * (panel.height + StillPictureTuning::kCaption);
    text += fmt::format(
        "<svg x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\">\n{}"
        "<rect width=\"100%\" height=\"100%\" fill=\"none\" stroke=\"#ccc\"/>\n</svg>\n"
        "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"14\" text-anchor=\"middle\">t = "
        "{:.4g}{}{}</text>\n",
        left, top, panel.width, panel.height,
        frame_picture(panel, frame, flow_behind(panel.scene.flows, f, panel.view)),
        left + panel.width / 2, top + panel.height + 20, frame.time, units.are_said() ? " " : "",
        units.time);
  }
  return text;
}

}  // namespace

std::string particles_picture(const Playback& original, const std::string& title, int panels,
                              const FlowFrames* known) {
  using Tuning = StillPictureTuning;
  const auto chosen = chosen_frames(original, panels);
  const int count = static_cast<int>(chosen.size());
  // The picture has at least as many points as the flows of the web page, so that it can use
  // `known`.
  const auto scene = scene_of(original, chosen, chosen,
                              std::max(Tuning::kPointsOfFlow, shown_flows(original).points),
                              known != nullptr ? *known : FlowFrames{});
  PanelSettings panel{.scene = scene,
                      .view = view_of(scene.playback.dimension, scene.playback.up),
                      .every = scene.playback.radii.size() / (Tuning::kMostInPanel + 1) + 1};
  const auto [wide, high] = show_box(panel.view, scene.box, scene.playback.dimension);
  const int columns = columns_for(std::max(count, 1), wide / high);
  const int rows = (count + columns - 1) / columns;
  auto& scale = panel.view.scale;
  scale = (Tuning::kPictureWidth - (columns + 1) * Tuning::kEdge) / (columns * wide);
  if (rows > 0) scale = std::min(scale, (Tuning::kMostHeight / rows - Tuning::kCaption) / high);
  panel.width = scale * wide;
  panel.height = scale * high;
  const double bottom = Tuning::kTitle + rows * (panel.height + Tuning::kCaption) + 6;
  std::vector<report::ColourScale> bars;
  if (scene.flows.top_speed > 0) {
    bars.push_back(report::speed_scale(scene.flows.top_speed, Tuning::kBands,
                                       scene.playback.units.unit_or_dimension(0, 1, -1)));
    bars.back().words += "; equal flow between streamlines";
  }
  const bool has_films = scene.lowest_gamma < 0;
  if (has_films)
    bars.push_back(report::film_scale(scene.lowest_gamma, kContactColours, scene.film_words));
  const bool has_friction = scene.playback.friction_coefficient && scene.touches;
  if (has_friction) bars.push_back(report::friction_scale(kFrictionColours, kFrictionWords));
  // A line of words explains the colours that have no scale.
  auto words = scene.force_words;
  const auto say = [&](const char* more) {
    words += (words.empty() ? "" : "; ") + std::string(more);
  };
  if (scene.slides) say("contacts that slide are orange");
  if (has_films && scene.touches && !has_friction) say("contacts without a film are grey");
  const double top_of_bars = bottom + (words.empty() ? 0 : 16);
  const auto rows_of_bars = (bars.size() + Tuning::kBarsInRow - 1) / Tuning::kBarsInRow;
  auto svg = opening(title, top_of_bars + Tuning::kHeightOfBars * static_cast<double>(rows_of_bars),
                     !scene.playback.bodies.empty());
  svg += panels_of(panel, chosen, columns);
  if (panel.every > 1)
    svg += fmt::format(
        "<text x=\"{:.0f}\" y=\"{:.2f}\" font-size=\"11\" text-anchor=\"end\">one particle in {} "
        "is drawn</text>\n",
        Tuning::kPictureWidth - Tuning::kEdge, bottom + 4, panel.every);
  if (!words.empty())
    svg += fmt::format("<text x=\"{:.0f}\" y=\"{:.2f}\" font-size=\"12\">{}</text>\n",
                       Tuning::kEdge, bottom + 4, words);
  for (std::size_t b = 0; b < bars.size(); ++b) {
    const auto row = b / Tuning::kBarsInRow,
               in_row = std::min(Tuning::kBarsInRow, bars.size() - Tuning::kBarsInRow * row);
    const double middle = Tuning::kPictureWidth *
                          (static_cast<double>(b % Tuning::kBarsInRow) + 0.5) /
                          static_cast<double>(in_row);
    svg += picture_of(bars[b], middle - Tuning::kBar / 2,
                      top_of_bars + Tuning::kHeightOfBars * static_cast<double>(row), Tuning::kBar);
  }
  return svg + "</svg>\n";
}

}  // namespace viscontact::particles
