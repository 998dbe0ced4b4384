// Draws the particles of a frame with planes and contacts as SVG (frame_picture.hpp). Motions in
// space must be drawn from the back to the front, because SVG has no depth.
#include "viscontact/report/particles/frame_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "viscontact/report/particles/film_colours.hpp"
#include "viscontact/report/particles/frame_marks.hpp"

namespace viscontact::report {
namespace {

using particles::Frame;
using particles::Vector;
using particles::operator+;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators
using particles::operator-;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators
using particles::operator*;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators
using particles::cross;
using particles::dot;
using particles::norm;

std::string path_of(const Polygon& polygon, const Projection& view) {
  std::string path;
  for (const auto& p : polygon)
    path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", view.x(p), view.y(p));
  return path;
}

/// A circle as a polygon, whose sides are too short to be seen.
Polygon circle_polygon(const particles::PlanePosition& place) {
  constexpr int kSides = 240;
  Polygon polygon;
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    polygon.push_back(place.point + place.radius * Vector{std::cos(angle), std::sin(angle), 0});
  }
  return polygon;
}

/// The part of a circle that the view shows.
std::string circle_line(const PanelSettings& d, const particles::PlanePosition& place) {
  const auto polygon = circle_polygon(place);
  std::string path;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto side =
        clipped_to_view({polygon[k], polygon[(k + 1) % polygon.size()]}, d.box, {}, 0, 2);
    if (side.size() > 1) path += path_of(side, d.view);
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#333\" stroke-width=\"1.5\"/>\n", path);
}

std::string plane_2d_solids(const PanelSettings& d, const Frame& frame) {
  const auto& [low, high] = d.box;
  const Polygon all = {
      {low[0], low[1], 0}, {high[0], low[1], 0}, {high[0], high[1], 0}, {low[0], high[1], 0}};
  std::string text;
  for (const auto& plane : frame.planes) {
    if (plane.is_curved()) {
      const auto inside = clipped_to_view(circle_polygon(plane), d.box, {}, 0, 2);
      text += fmt::format("<path d=\"{}Z{}Z\" fill=\"#d8d8d4\" fill-rule=\"evenodd\"/>\n",
                          path_of(all, d.view), path_of(inside, d.view));
      continue;
    }
    if (const auto solid = clipped(all, plane.point, -1.0 * plane.normal); !solid.empty())
      text += fmt::format("<path d=\"{}Z\" fill=\"#d8d8d4\"/>\n", path_of(solid, d.view));
  }
  return text;
}

std::string plane_2d_lines(const PanelSettings& d, const Frame& frame) {
  std::string text;
  for (std::size_t j = 0; j < frame.planes.size(); ++j) {
    if (frame.planes[j].is_curved()) {
      text += circle_line(d, frame.planes[j]);
      continue;
    }
    const auto& point = frame.planes[j].point;
    const auto& normal = frame.planes[j].normal;
    const double far = norm(d.box.high - d.box.low) + norm(d.box.low - point);
    const Vector along = {-normal[1], normal[0], 0};
    const auto line =
        clipped_to_view({point - far * along, point + far * along}, d.box, frame.planes, j, 2);
    if (line.size() > 1)
      text += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#333\" stroke-width=\"1.5\"/>\n",
                          path_of(line, d.view));
  }
  return text;
}

/// The planes as polygons. A plane that is seen from its free side is filled. Of a plane that is
/// seen from the other side only the edges are drawn, because the particles are behind it.
std::string plane_3d_patches(const PanelSettings& d, const Frame& frame, bool from_free_side) {
  std::string text;
  for (std::size_t j = 0; j < frame.planes.size(); ++j) {
    const auto& point = frame.planes[j].point;
    const auto& normal = frame.planes[j].normal;
    if ((dot(normal, d.view.toward) > 0) != from_free_side) continue;
    std::size_t least = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (std::abs(normal[k]) < std::abs(normal[least])) least = k;
    Vector axis{0, 0, 0};
    axis[least] = 1;
    Vector u = cross(normal, axis);
    u = (1 / norm(u)) * u;
    const Vector v = cross(normal, u);
    const double far = norm(d.box.high - d.box.low) + norm(d.box.low - point);
    const auto patch = clipped_to_view({point - far * u - far * v, point + far * u - far * v,
                                        point + far * u + far * v, point - far * u + far * v},
                                       d.box, frame.planes, j, 3);
    if (patch.size() > 2)
      text += fmt::format(
          "<path d=\"{}Z\" fill=\"#8a8a80\" fill-opacity=\"{}\" stroke=\"#777\" "
          "stroke-width=\".8\"/>\n",
          path_of(patch, d.view), from_free_side ? ".22" : "0");
  }
  return text;
}

/// The class of a contact's colour: 0 for gamma = 0; 1 to kContactColours, from light to dark, for
/// gamma < 0 down to `lowest`.
std::size_t colour_class(double gamma, double lowest) {
  if (!(gamma < 0) || !(lowest < 0)) return 0;
  return 1 + static_cast<std::size_t>(
                 std::lround(std::clamp(gamma / lowest, 0.0, 1.0) * (kContactColours - 1)));
}

// The class of contacts that slide, after those of gamma.
constexpr std::size_t kSlidingClass = kContactColours + 1;

std::string class_colour(std::size_t colour) {
  if (colour == kSlidingClass) return kSlidingColour;
  return colour == 0 ? kTouchingColour : film_colour(static_cast<int>(colour) - 1, kContactColours);
}

/// The line of a contact. In space it is drawn just after the nearer of its two particles: over
/// this particle and those behind it, and under those in front of it.
struct ContactLine {
  std::size_t colour = 0;
  double width = 0;
  std::string path;
};

ContactLine line_of(const PanelSettings& d, const Frame& frame,
                    const particles::CurrentContact& contact) {
  const auto second = static_cast<std::size_t>(contact.second);
  const Vector to = position(d.playback, frame, second);
  double radius = d.playback.radii[second];
  Vector from{};
  if (contact.first < 0) {
    const auto plane =
        tangent_at(frame.planes.at(static_cast<std::size_t>(-1 - contact.first)), to);
    from = to - dot(plane.normal, to - plane.point) * plane.normal;
  } else {
    const auto first = static_cast<std::size_t>(contact.first);
    from = position(d.playback, frame, first);
    radius = std::min(radius, static_cast<double>(d.playback.radii[first]));
  }
  ContactLine line;
  line.colour = contact.friction == particles::ContactFriction::kSlides
                    ? kSlidingClass
                    : colour_class(contact.gamma, d.lowest);
  line.width = line.colour == 0 ? std::clamp(0.06 * d.view.scale * radius, 0.3, 1.0)
                                : std::clamp(0.3 * d.view.scale * radius, 0.8, 5.0);
  // The line to an image is drawn at both sides of the period.
  const Vector shift = shift_of(d.playback.cell, contact.image);
  line.path = path_of({from, to + shift}, d.view);
  if (contact.image != 0) line.path += path_of({from - shift, to}, d.view);
  return line;
}

bool drawn(const PanelSettings& d, const particles::CurrentContact& contact) {
  const auto shown = [&](std::int32_t k) { return static_cast<std::size_t>(k) % d.every == 0; };
  return shown(contact.second) && (contact.first < 0 || shown(contact.first));
}

std::string discs(const PanelSettings& d, const Frame& frame, const std::string& behind) {
  std::string text = behind + plane_2d_solids(d, frame);
  text += d.is_in_fluid ? "<g fill=\"#f1ece0\" stroke=\"#3c3a34\" stroke-width=\".8\">\n"
                        : "<g fill=\"#a9c3da\" stroke=\"#4f728f\" stroke-width=\".6\">\n";
  for_each_image(d, frame, [&](std::size_t k, const Vector& centre) {
    if (!is_in_body(d.playback, k)) text += circle(d, centre, d.playback.radii[k]);
  });
  text += "</g>\n" + body_discs(d, frame) + angle_marks(d, frame) + plane_2d_lines(d, frame);
  // All contacts of one colour make one path. Its width is the mean of the widths of these
  // contacts.
  std::array<ContactLine, kSlidingClass + 1> lines;
  std::array<int, kSlidingClass + 1> counts{};
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
  return text + "</g>\n" + link_marks(d, frame);
}

std::string spheres(const PanelSettings& d, const Frame& frame) {
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
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto k = order[i].second;
    const auto sphere = circle(d, position(d.playback, frame, k), d.playback.radii[k]);
    text += is_in_body(d.playback, k) ? "<g fill=\"url(#body)\">" + sphere + "</g>\n" : sphere;
    text += orientation_marks(d, frame, k) + with[i];
  }
  return text + "</g>\n" + link_marks(d, frame) + plane_3d_patches(d, frame, false);
}

}  // namespace

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

std::string frame_picture(const PanelSettings& panel, const Frame& frame,
                          const std::string& behind) {
  return panel.playback.dimension == 2 ? discs(panel, frame, behind) : spheres(panel, frame);
}

}  // namespace viscontact::report
