// Draws marks of rotation, rigid bodies and links as SVG (frame_marks.hpp). The page draws the same
// marks by report/particles/page/marks.js.
#include "viscontact/report/particles/frame_marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace viscontact::report {
namespace {

using particles::Frame;
using particles::Vector;
using particles::operator+;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators
using particles::operator-;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators
using particles::operator*;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators

constexpr const char* kMarkColour = "#4a4a44";

/// True if the panel shows a part of a circle about (x, y) of the page.
bool is_seen(const PanelSettings& panel, double x, double y, double r) {
  return x > -r && x < panel.width + r && y > -r && y < panel.height + r;
}

/// Vector from particle `first` to the nearest image of particle `second` [L].
Vector apart(const PanelSettings& panel, const Frame& frame, std::size_t first,
             std::size_t second) {
  Vector w = position(panel.playback, frame, second) - position(panel.playback, frame, first);
  for (std::size_t k = 0; k < 2; ++k)
    if (const double period = panel.playback.cell.lengths[k]; period > 0)
      w[k] -= period * std::round(w[k] / period);
  return w;
}

std::string move_to(const PanelSettings& panel, const Vector& p) {
  return fmt::format("M{:.2f} {:.2f}", panel.view.x(p), panel.view.y(p));
}
std::string line_to(const PanelSettings& panel, const Vector& p) {
  return fmt::format("L{:.2f} {:.2f}", panel.view.x(p), panel.view.y(p));
}

/// Calls line(from, to) for the line between two particles; twice if it crosses a period.
template <class Line>
std::string both_sides(const PanelSettings& panel, const Frame& frame, std::size_t first,
                       std::size_t second, const Line& line) {
  const Vector w = apart(panel, frame, first, second);
  const Vector from = position(panel.playback, frame, first);
  const Vector to = position(panel.playback, frame, second);
  const double off = particles::norm(to - (from + w));
  return line(from, from + w) + (off > 0.5 * panel.playback.radii[first] ? line(to - w, to) : "");
}

double smaller_radius(const PanelSettings& panel, std::size_t first, std::size_t second) {
  return panel.view.scale * std::min(panel.playback.radii[first], panel.playback.radii[second]);
}

std::string spring_path(const PanelSettings& panel, const Vector& from, const Vector& to,
                        double width) {
  constexpr int kTurns = 12;
  constexpr double kEnd = 0.12;  // straight part at each end, of the length
  const double x = panel.view.x(from), y = panel.view.y(from), dx = panel.view.x(to) - x,
               dy = panel.view.y(to) - y, length = std::hypot(dx, dy);
  if (!(length > 0)) return "";
  auto path = fmt::format("M{:.2f} {:.2f}", x, y);
  for (int k = 0; k <= kTurns; ++k) {
    const double share = kEnd + (1 - 2 * kEnd) * k / kTurns;
    const double side = k == 0 || k == kTurns ? 0 : (k % 2 == 0 ? width : -width);
    path += fmt::format("L{:.2f} {:.2f}", x + share * dx - side * dy / length,
                        y + share * dy + side * dx / length);
  }
  return path + fmt::format("L{:.2f} {:.2f}", x + dx, y + dy);
}

}  // namespace

std::string circle(const PanelSettings& panel, const Vector& at, double radius) {
  const double x = panel.view.x(at), y = panel.view.y(at), r = panel.view.scale * radius;
  return is_seen(panel, x, y, r)
             ? fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n", x, y, r)
             : "";
}

std::string angle_marks(const PanelSettings& panel, const Frame& frame) {
  constexpr double kFromCentre = 0.66, kRadius = 0.13;  // of the disc's radius
  constexpr double kSmallest = 0.5;                     // radius of a dot [page units]
  if (frame.angles.size() != panel.playback.radii.size()) return "";
  std::string text;
  for_each_image(panel, frame, [&](std::size_t k, const Vector& centre) {
    const double r = panel.playback.radii[k], angle = frame.angles[k];
    if (kRadius * r * panel.view.scale >= kSmallest)
      text += circle(panel, centre + kFromCentre * r * Vector{std::cos(angle), std::sin(angle), 0},
                     kRadius * r);
  });
  return fmt::format("<g fill=\"{}\">\n{}</g>\n", kMarkColour, text);
}

std::string orientation_marks(const PanelSettings& panel, const Frame& frame, std::size_t k) {
  constexpr double kRadius = 0.12;   // of the sphere's radius
  constexpr double kSmallest = 0.5;  // radius of a dot [page units]
  const double r = panel.playback.radii[k];
  if (frame.orientations.size() != 4 * panel.playback.radii.size() ||
      kRadius * r * panel.view.scale < kSmallest)
    return "";
  const float* q = &frame.orientations[4 * k];
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  // The columns of the rotation matrix are the axes of the sphere.
  const std::array<Vector, 3> axes = {
      Vector{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
      Vector{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
      Vector{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
  std::string dots;
  for (const auto& axis : axes)
    for (const double side : {1.0, -1.0}) {
      const double towards = side * particles::dot(axis, panel.view.toward);
      // A dot near the rim is seen from the side.
      if (towards > 0.15)
        dots += circle(panel, position(panel.playback, frame, k) + side * r * axis,
                       kRadius * r * std::sqrt(towards));
    }
  return fmt::format("<g fill=\"{}\" stroke=\"none\">{}</g>\n", kMarkColour, dots);
}

std::string body_discs(const PanelSettings& panel, const Frame& frame) {
  if (panel.playback.bodies.empty()) return "";
  std::string text = "<g fill=\"#e0cda6\" stroke=\"#8a713b\" stroke-width=\".6\">\n";
  for_each_image(panel, frame, [&](std::size_t k, const Vector& centre) {
    if (is_in_body(panel.playback, k)) text += circle(panel, centre, panel.playback.radii[k]);
  });
  text += "</g>\n<g fill=\"none\" stroke=\"#8a713b\" stroke-linecap=\"round\">\n";
  std::map<std::int32_t, std::size_t> before;  // the last member of each body
  for (std::size_t k = 0; k < panel.playback.radii.size(); k += panel.every) {
    if (!is_in_body(panel.playback, k)) continue;
    const auto [last, is_first] = before.emplace(panel.playback.bodies[k], k);
    if (is_first) continue;
    const auto path = both_sides(
        panel, frame, last->second, k,
        [&](const Vector& a, const Vector& b) { return move_to(panel, a) + line_to(panel, b); });
    text += fmt::format("<path stroke-width=\"{:.2f}\" d=\"{}\"/>\n",
                        std::clamp(0.18 * smaller_radius(panel, last->second, k), 0.5, 4.0), path);
    last->second = k;
  }
  return text + "</g>\n";
}

std::string link_marks(const PanelSettings& panel, const Frame& frame) {
  const auto& links = panel.playback.links;
  if (links.empty() || panel.every > 1) return "";
  const auto number = [](std::int32_t k) { return static_cast<std::size_t>(k); };
  std::string text = "<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
  for (const auto& [first, second] : links.arms)
    text += fmt::format(
        "<path stroke=\"#333\" stroke-width=\"{:.2f}\" d=\"{}\"/>\n",
        std::clamp(0.25 * smaller_radius(panel, number(first), number(second)), 1.2, 5.0),
        both_sides(panel, frame, number(first), number(second),
                   [&](const Vector& a, const Vector& b) {
                     return move_to(panel, a) + line_to(panel, b);
                   }));
  for (const auto& [first, second] : links.springs) {
    const double width =
        std::clamp(0.35 * smaller_radius(panel, number(first), number(second)), 1.5, 6.0);
    text += fmt::format("<path stroke=\"#2b6e3f\" stroke-width=\"1.3\" d=\"{}\"/>\n",
                        both_sides(panel, frame, number(first), number(second),
                                   [&](const Vector& a, const Vector& b) {
                                     return spring_path(panel, a, b, width);
                                   }));
  }
  text += "</g>\n<g fill=\"#fff\" stroke=\"#111\" stroke-width=\"1.6\">\n";
  for (const auto& at : links.hinges) text += circle(panel, at, 4 / panel.view.scale);
  return text + "</g>\n";
}

}  // namespace viscontact::report
