// Draws particles, planes, contacts and the scale of gamma as SVG.
#include "viscontact/report/particles/particles_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "viscontact/report/html.hpp"
#include "viscontact/report/particles/film_colours.hpp"
#include "viscontact/report/particles/view_box.hpp"

namespace viscontact {
namespace {

using particles::Frame;
using particles::PlanePosition;
using particles::Playback;
using particles::Vector;
using particles::operator+;
using particles::operator-;
using particles::operator*;
using particles::cross;
using particles::dot;
using particles::norm;

/// Projects points to page coordinates (y downwards) of a panel whose upper left corner is the
/// origin.
struct Projection {
  /// Unit vectors; `toward` points to the reader.
  Vector right{1, 0, 0}, up{0, 1, 0}, toward{0, 0, 1};
  double scale = 1;          ///< page units per length
  double left = 0, top = 0;  ///< coordinates of the panel's corner along `right` and `up` [L]

  double x(const Vector& p) const { return scale * (dot(right, p) - left); }
  double y(const Vector& p) const { return scale * (top - dot(up, p)); }
};

Projection view_of(int dimension) {
  Projection view;
  if (dimension == 2) return view;
  const double turn = 30 * std::numbers::pi / 180, from_above = 20 * std::numbers::pi / 180;
  const double c = std::cos(turn), s = std::sin(turn), ca = std::cos(from_above),
               sa = std::sin(from_above);
  view.right = {c, s, 0};
  view.up = {-s * sa, c * sa, ca};
  view.toward = {s * ca, -c * ca, sa};
  return view;
}

struct Drawing {
  const Playback& playback;
  ViewBox room;
  Projection view;
  double width = 0, height = 0;  ///< size of a panel in page units
  double lowest = 0;             ///< lowest gamma of the motion [M L/T]
  std::size_t every = 1;         ///< every such particle is drawn
};

constexpr int kContactColours = 20;  // for gamma < 0
// More than 20000 particles in a panel could not be told apart.
constexpr std::size_t kMostInPanel = 20000;

std::string path_of(const Polygon& polygon, const Projection& view) {
  std::string path;
  for (const auto& p : polygon)
    path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", view.x(p), view.y(p));
  return path;
}

std::string plane_2d_solids(const Drawing& d, const Frame& frame) {
  const auto& [low, high] = d.room;
  const Polygon all = {
      {low[0], low[1], 0}, {high[0], low[1], 0}, {high[0], high[1], 0}, {low[0], high[1], 0}};
  std::string text;
  for (const auto& plane : frame.planes)
    if (const auto solid = clipped(all, plane.point, -1.0 * plane.normal); !solid.empty())
      text += fmt::format("<path d=\"{}Z\" fill=\"#d8d8d4\"/>\n", path_of(solid, d.view));
  return text;
}

std::string plane_2d_lines(const Drawing& d, const Frame& frame) {
  std::string text;
  for (std::size_t j = 0; j < frame.planes.size(); ++j) {
    const auto& [point, normal] = frame.planes[j];
    const double far = norm(d.room.high - d.room.low) + norm(d.room.low - point);
    const Vector along = {-normal[1], normal[0], 0};
    const auto line =
        clipped_to_view({point - far * along, point + far * along}, d.room, frame.planes, j, 2);
    if (line.size() > 1)
      text += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#333\" stroke-width=\"1.5\"/>\n",
                          path_of(line, d.view));
  }
  return text;
}

/// The planes as patches. A plane that is seen from its free side is filled; of a plane that is
/// seen from behind, only the edges are drawn, because the particles are behind it.
std::string plane_3d_patches(const Drawing& d, const Frame& frame, bool from_free_side) {
  std::string text;
  for (std::size_t j = 0; j < frame.planes.size(); ++j) {
    const auto& [point, normal] = frame.planes[j];
    if ((dot(normal, d.view.toward) > 0) != from_free_side) continue;
    std::size_t least = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (std::abs(normal[k]) < std::abs(normal[least])) least = k;
    Vector axis{};
    axis[least] = 1;
    Vector u = cross(normal, axis);
    u = (1 / norm(u)) * u;
    const Vector v = cross(normal, u);
    const double far = norm(d.room.high - d.room.low) + norm(d.room.low - point);
    const auto patch = clipped_to_view({point - far * u - far * v, point + far * u - far * v,
                                        point + far * u + far * v, point - far * u + far * v},
                                       d.room, frame.planes, j, 3);
    if (patch.size() > 2)
      text += fmt::format(
          "<path d=\"{}Z\" fill=\"#8a8a80\" fill-opacity=\"{}\" stroke=\"#777\" "
          "stroke-width=\".8\"/>\n",
          path_of(patch, d.view), from_free_side ? ".22" : "0");
  }
  return text;
}

/// The class of a contact's colour: 0 for gamma = 0; 1 to kColours, from light to dark, for gamma <
/// 0 down to `lowest`.
std::size_t colour_class(double gamma, double lowest) {
  if (!(gamma < 0) || !(lowest < 0)) return 0;
  return 1 + static_cast<std::size_t>(
                 std::lround(std::clamp(gamma / lowest, 0.0, 1.0) * (kContactColours - 1)));
}

std::string class_colour(std::size_t colour) {
  return colour == 0 ? kTouchingColour
                     : film_colour(static_cast<double>(colour - 1) / (kContactColours - 1));
}

/// The contacts of a particle in one colour. They are drawn together with the particle: over it and
/// over what is behind it, and under what is in front of it.
struct ContactLine {
  std::size_t colour = 0;
  double width = 0;
  std::string path;
};

ContactLine line_of(const Drawing& d, const Frame& frame,
                    const particles::CurrentContact& contact) {
  const auto second = static_cast<std::size_t>(contact.second);
  const Vector to = position(d.playback, frame, second);
  double radius = d.playback.radii[second];
  Vector from{};
  if (contact.first < 0) {
    const auto& plane = frame.planes.at(static_cast<std::size_t>(-1 - contact.first));
    from = to - dot(plane.normal, to - plane.point) * plane.normal;
  } else {
    const auto first = static_cast<std::size_t>(contact.first);
    from = position(d.playback, frame, first);
    radius = std::min(radius, static_cast<double>(d.playback.radii[first]));
  }
  ContactLine line;
  line.colour = colour_class(contact.gamma, d.lowest);
  line.width = line.colour == 0 ? std::clamp(0.06 * d.view.scale * radius, 0.3, 1.0)
                                : std::clamp(0.3 * d.view.scale * radius, 0.8, 5.0);
  line.path = path_of({from, to}, d.view);
  return line;
}

bool drawn(const Drawing& d, const particles::CurrentContact& contact) {
  const auto shown = [&](std::int32_t k) { return static_cast<std::size_t>(k) % d.every == 0; };
  return shown(contact.second) && (contact.first < 0 || shown(contact.first));
}

std::string circle(const Drawing& d, const Frame& frame, std::size_t k) {
  const Vector at = position(d.playback, frame, k);
  const double x = d.view.x(at), y = d.view.y(at), r = d.view.scale * d.playback.radii[k];
  const bool seen = x > -r && x < d.width + r && y > -r && y < d.height + r;
  return seen ? fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n", x, y, r) : "";
}

std::string discs(const Drawing& d, const Frame& frame) {
  std::string text = plane_2d_solids(d, frame);
  text += "<g fill=\"#a9c3da\" stroke=\"#4f728f\" stroke-width=\".6\">\n";
  for (std::size_t k = 0; k < d.playback.radii.size(); k += d.every) text += circle(d, frame, k);
  text += "</g>\n" + plane_2d_lines(d, frame);
  // There is one path for each colour; its width is proportional to the mean radius of the
  // contacts.
  std::array<ContactLine, kContactColours + 1> lines;
  std::array<int, kContactColours + 1> counts{};
  for (const auto& contact : frame.contacts) {
    if (!drawn(d, contact)) continue;
    const auto line = line_of(d, frame, contact);
    lines[line.colour].path += line.path;
    lines[line.colour].width += line.width;
    ++counts[line.colour];
  }
  text += "<g fill=\"none\" stroke-linecap=\"round\">\n";
  for (std::size_t c = 0; c < lines.size(); ++c)
    if (counts[c] > 0)
      text += fmt::format("<path stroke=\"{}\" stroke-width=\"{:.2f}\" d=\"{}\"/>\n",
                          class_colour(c), lines[c].width / counts[c], lines[c].path);
  return text + "</g>\n";
}

std::string spheres(const Drawing& d, const Frame& frame) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < d.playback.radii.size(); k += d.every)
    order.emplace_back(dot(d.view.toward, position(d.playback, frame, k)), k);
  std::ranges::sort(order);
  std::vector<std::size_t> rank(d.playback.radii.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i].second] = i;
  std::vector<std::string> with(order.size());
  for (const auto& contact : frame.contacts) {
    if (!drawn(d, contact)) continue;
    const auto line = line_of(d, frame, contact);
    auto at = rank[static_cast<std::size_t>(contact.second)];
    if (contact.first >= 0) at = std::max(at, rank[static_cast<std::size_t>(contact.first)]);
    with[at] += fmt::format("<path stroke=\"{}\" stroke-width=\"{:.2f}\" d=\"{}\"/>\n",
                            class_colour(line.colour), line.width, line.path);
  }
  std::string text = plane_3d_patches(d, frame, true);
  text +=
      "<g fill=\"url(#ball)\" stroke=\"#34536e\" stroke-width=\".5\" stroke-linecap=\"round\">\n";
  for (std::size_t i = 0; i < order.size(); ++i)
    text += circle(d, frame, order[i].second) + with[i];
  return text + "</g>\n" + plane_3d_patches(d, frame, false);
}

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

/// The number of columns of panels, for a picture of about the proportions of a slide with few
/// empty places.
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

std::string colour_bar(double lowest, bool touching, double left, double top, double width) {
  constexpr int kHeight = 12;  // [page units]
  std::string text;
  const double step = width / kContactColours;
  for (int c = 0; c < kContactColours; ++c)
    text += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{}\" fill=\"{}\"/>\n",
        left + width - (c + 1) * step, top, step + 0.3, kHeight,
        film_colour(static_cast<double>(c) / (kContactColours - 1)));
  text += "<g font-size=\"12\" text-anchor=\"middle\">\n";
  for (const double tick : film_ticks(lowest)) {
    const double x = left + width * (1 - tick / lowest);
    text += fmt::format(
        "<path d=\"M{0:.2f} {1:.2f}v4\" stroke=\"#333\"/>"
        "<text x=\"{0:.2f}\" y=\"{2:.2f}\">{3}</text>\n",
        x, top + kHeight, top + kHeight + 16, film_tick_text(tick));
  }
  return text + fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}{}</text></g>\n", left + width / 2,
                            top + kHeight + 34, kFilmWords,
                            touching ? "; thin and grey: touching, no film" : "");
}

}  // namespace

std::string particles_picture(const Playback& playback, const std::string& title, int panels) {
  // Sizes of the picture and of its margins, title and captions [page units].
  constexpr double kWidth = 1000, kMostHeight = 900, kEdge = 16, kTitle = 44, kCaption = 30;
  const auto chosen = chosen_frames(playback, panels);
  const int count = static_cast<int>(chosen.size());
  Drawing d{playback,
            view_box_of(playback, chosen),
            view_of(playback.dimension),
            0,
            0,
            lowest_gamma(playback),
            playback.radii.size() / (kMostInPanel + 1) + 1};
  double wide = 0, high = 0;  // of a panel [L]
  {
    Interval x, y;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector p = {(corner & 1 ? d.room.high : d.room.low)[0],
                        (corner & 2 ? d.room.high : d.room.low)[1],
                        (corner & 4 ? d.room.high : d.room.low)[2]};
      x.add(dot(d.view.right, p), dot(d.view.right, p));
      y.add(dot(d.view.up, p), dot(d.view.up, p));
    }
    d.view.left = x.low;
    d.view.top = y.high;
    wide = x.high - x.low;
    high = y.high - y.low;
  }
  const int columns = columns_for(std::max(count, 1), wide / high);
  const int rows = (count + columns - 1) / columns;
  d.view.scale = (kWidth - (columns + 1) * kEdge) / (columns * wide);
  if (rows > 0) d.view.scale = std::min(d.view.scale, (kMostHeight / rows - kCaption) / high);
  d.width = d.view.scale * wide;
  d.height = d.view.scale * high;
  const bool films = d.lowest < 0;
  const bool touching = std::ranges::any_of(chosen, [&](std::size_t f) {
    return std::ranges::any_of(playback.frames[f].contacts,
                               [](const auto& c) { return !(c.gamma < 0); });
  });
  const double bottom = kTitle + rows * (d.height + kCaption) + 6;
  const double height = bottom + (films ? 60 : 0);

  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" fill=\"#1a1a1a\">\n"
      "<title>{2}</title>\n"
      "<defs><radialGradient id=\"ball\" cx=\".36\" cy=\".32\" r=\".72\">"
      "<stop offset=\"0\" stop-color=\"#e3eef7\"/><stop offset=\".5\" stop-color=\"#a3bfd8\"/>"
      "<stop offset=\"1\" stop-color=\"#5b7f9f\"/></radialGradient></defs>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "<text x=\"{3:.0f}\" y=\"29\" font-size=\"{4:.1f}\" text-anchor=\"middle\">{2}</text>\n",
      kWidth, height, escaped(title), kWidth / 2,
      // A character is on average about half as wide as high.
      std::min(20.0, 2 * (kWidth - 2 * kEdge) / static_cast<double>(title.size() + 1)));
  // If the height limits the scale, the panels are spread over the width.
  const double place = kWidth / columns;
  for (int i = 0; i < count; ++i) {
    const auto& frame = playback.frames[chosen[static_cast<std::size_t>(i)]];
    const double left = place * (i % columns) + (place - d.width) / 2;
    const double top = kTitle + (i / columns) * (d.height + kCaption);
    svg += fmt::format(
        "<svg x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\">\n{}"
        "<rect width=\"100%\" height=\"100%\" fill=\"none\" stroke=\"#ccc\"/>\n</svg>\n"
        "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"14\" text-anchor=\"middle\">t = "
        "{:.4g}</text>\n",
        left, top, d.width, d.height, playback.dimension == 2 ? discs(d, frame) : spheres(d, frame),
        left + d.width / 2, top + d.height + 20, frame.time);
  }
  if (d.every > 1)
    svg += fmt::format(
        "<text x=\"{:.0f}\" y=\"{:.2f}\" font-size=\"11\" text-anchor=\"end\">one particle in {} "
        "is "
        "drawn</text>\n",
        kWidth - kEdge, bottom + 4, d.every);
  if (films) svg += colour_bar(d.lowest, touching, kWidth / 2 - 180, bottom, 360);
  return svg + "</svg>\n";
}

}  // namespace viscontact
