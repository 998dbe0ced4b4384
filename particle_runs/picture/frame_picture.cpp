// Elements of SVG. A particle whose place is NaN is not there yet.
#include "viscontact/particle_runs/picture/frame_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "viscontact/particles/shapes/shape_contacts.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of the drawing.
struct FramePictureTuning {
  // Least radius of a dot that is seen [page units].
  static constexpr double kSmallest = 0.5;
  // With 240 sides the polygon differs from the circle by less than 1e-4 of the radius.
  static constexpr int kSides = 240;
};

/// Calls visit(k, centre) for each particle k that is drawn: with its own centre [L] and with those
/// of its periodic images.
template <class Visit>
void for_each_image(const PanelSettings& d, const Frame& frame, const Visit& visit) {
  assert(d.every >= 1);
  const auto cell = cell_at(d.scene.playback, frame);
  for (std::size_t k = 0; k < d.scene.playback.radii.size(); k += d.every)
    for (std::int32_t image = -kLargestImage; image <= kLargestImage; ++image)
      if (has_image(cell, image))
        visit(k, particles::operator+(position(d.scene.playback, frame, k), shift_of(cell, image)));
}

bool is_in_body(const Playback& playback, std::size_t k) {
  return !playback.bodies.empty() && playback.bodies[k] >= 0;
}

/// True if the panel may show a part of the circle about (x, y) with the radius r [page units].
bool is_seen(const PanelSettings& panel, double x, double y, double r) {
  return x > -r && x < panel.width + r && y > -r && y < panel.height + r;
}

Vector apart(const PanelSettings& panel, const Frame& frame, std::size_t first,
             std::size_t second) {
  const auto& playback = panel.scene.playback;
  return nearest_image(cell_at(playback, frame),
                       position(playback, frame, second) - position(playback, frame, first));
}

std::string move_to(const PanelSettings& panel, const Vector& p) {
  return fmt::format("M{:.2f} {:.2f}", panel.view.x(p), panel.view.y(p));
}
std::string line_to(const PanelSettings& panel, const Vector& p) {
  return fmt::format("L{:.2f} {:.2f}", panel.view.x(p), panel.view.y(p));
}

/// Returns line(from, to) for the line from the centre of particle `first` to the nearest image of
/// particle `second` [L]. If this image is shifted by a period, the same line that ends at particle
/// `second` itself is added, so that the line is seen at both sides of the cell.
template <class Line>
std::string both_sides(const PanelSettings& panel, const Frame& frame, std::size_t first,
                       std::size_t second, const Line& line) {
  const Vector w = apart(panel, frame, first, second);
  const Vector from = position(panel.scene.playback, frame, first);
  const Vector to = position(panel.scene.playback, frame, second);
  // `off` is 0 or at least a period, apart from round-off; any limit between them works.
  const double off = norm(to - (from + w));
  return line(from, from + w) +
         (off > 0.5 * panel.scene.playback.radii[first] ? line(to - w, to) : "");
}

/// The smaller radius of two particles [page units].
double smaller_radius(const PanelSettings& panel, std::size_t first, std::size_t second) {
  return panel.view.scale *
         std::min(panel.scene.playback.radii[first], panel.scene.playback.radii[second]);
}

/// A zigzag line between two points [L] with corners that are `width` page units away from the
/// straight line; empty if both points have the same place on the page.
std::string spring_path(const PanelSettings& panel, const Vector& from, const Vector& to,
                        double width) {
  constexpr int kTurns = kStyle.spring_turns;
  constexpr double kEnd = kStyle.spring_end;
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

/// The text is empty if the panel does not show the circle.
std::string circle(const PanelSettings& panel, const Vector& at, double radius) {
  const double x = panel.view.x(at), y = panel.view.y(at),
               r = panel.view.scale * panel.view.nearness(at) * radius;
  return is_seen(panel, x, y, r)
             ? fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n", x, y, r)
             : "";
}

/// A shape with sides, turned by `degrees` on the page: arcs at its corners, which lines join.
std::string rounded_polygon(const Shape& shape, double scale, double x, double y, double degrees) {
  const auto core = core_of({shape});
  std::string path;
  for (int k = 0; k < shape.sides(); ++k) {
    const auto [from, to] = std::pair(shape.side(k).from, shape.side(k).to);
    if (k > 0)
      path += fmt::format("A{0:.2f} {0:.2f} 0 0 0 {1:.2f} {2:.2f}", scale * core.radius,
                          scale * from[0], -scale * from[1]);
    else
      path += fmt::format("M{:.2f} {:.2f}", scale * from[0], -scale * from[1]);
    path += fmt::format("L{:.2f} {:.2f}", scale * to[0], -scale * to[1]);
  }
  const auto start = shape.side(0).from;
  path += fmt::format("A{0:.2f} {0:.2f} 0 0 0 {1:.2f} {2:.2f}Z", scale * core.radius,
                      scale * start[0], -scale * start[1]);
  return fmt::format("<path transform=\"translate({:.2f} {:.2f}) rotate({:.2f})\" d=\"{}\"/>\n", x,
                     y, degrees, path);
}

/// Particle k with the centre `at` [L]; empty if it is not seen.
std::string disc(const PanelSettings& panel, const Frame& frame, std::size_t k, const Vector& at) {
  const auto& playback = panel.scene.playback;
  if (playback.shapes.empty()) return circle(panel, at, playback.radii[k]);
  const double x = panel.view.x(at), y = panel.view.y(at), scale = panel.view.scale;
  if (!is_seen(panel, x, y, scale * playback.radii[k])) return "";
  const auto& shape = playback.shapes[k];
  const double degrees = -frame.angles[k] * 180 / std::numbers::pi;
  if (shape.sides() > 0) return rounded_polygon(shape, scale, x, y, degrees);
  const auto [a, b] = shape.semi_axes();
  return fmt::format(
      "<ellipse rx=\"{:.2f}\" ry=\"{:.2f}\" transform=\"translate({:.2f} {:.2f}) "
      "rotate({:.2f})\"/>\n",
      scale * a, scale * b, x, y, degrees);
}

/// Draws dots that show how far discs and ellipses have turned, in the direction of the particle's
/// angle. Very small particles have none. Empty if the frame has no angles.
std::string angle_marks(const PanelSettings& panel, const Frame& frame) {
  if (frame.angles.size() != panel.scene.playback.radii.size()) return "";
  std::string text;
  for_each_image(panel, frame, [&](std::size_t k, const Vector& centre) {
    const auto& shapes = panel.scene.playback.shapes;
    if (!shapes.empty() && shapes[k].sides() > 0) return;  // the sides show the direction
    const double r = shapes.empty() ? panel.scene.playback.radii[k] : shapes[k].semi_axes()[0];
    const double angle = frame.angles[k];
    if (kStyle.mark_radius * r * panel.view.scale >= FramePictureTuning::kSmallest)
      text += circle(
          panel, centre + kStyle.mark_distance * r * Vector{std::cos(angle), std::sin(angle), 0},
          kStyle.mark_radius * r);
  });
  return fmt::format("<g fill=\"{}\">\n{}</g>\n", kStyle.mark, text);
}

/// Dots at the ends of the three axes that turn with sphere k, whose centre is `at` [L], on the
/// side that the reader sees. The text is empty if the frame has no orientations or if the sphere
/// is too small.
std::string orientation_marks(const PanelSettings& panel, const Frame& frame, std::size_t k,
                              const Vector& at) {
  const double r = panel.scene.playback.radii[k];
  if (frame.orientations.size() != 4 * panel.scene.playback.radii.size() ||
      kStyle.axis_radius * r * panel.view.scale < FramePictureTuning::kSmallest)
    return "";
  const float* q = &frame.orientations[4 * k];
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  // The columns of the rotation matrix of the unit quaternion (w, x, y, z) are these axes.
  const std::array<Vector, 3> axes = {
      Vector{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
      Vector{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
      Vector{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
  std::string dots;
  for (const auto& axis : axes)
    for (const double side : {1.0, -1.0}) {
      const double towards = side * dot(axis, panel.view.toward);
      if (towards > kStyle.least_toward)
        dots += circle(panel, at + side * r * axis, kStyle.axis_radius * r * std::sqrt(towards));
    }
  return fmt::format("<g fill=\"{}\" stroke=\"none\">{}</g>\n", kStyle.mark, dots);
}

/// Discs of rigid bodies have colours of their own, and lines join them.
std::string body_discs(const PanelSettings& panel, const Frame& frame) {
  if (panel.scene.playback.bodies.empty()) return "";
  const auto [fill, edge] = kStyle.disc_of_body;
  auto text = fmt::format("<g fill=\"{}\" stroke=\"{}\" stroke-width=\".6\">\n", fill, edge);
  for_each_image(panel, frame, [&](std::size_t k, const Vector& centre) {
    if (is_in_body(panel.scene.playback, k))
      text += circle(panel, centre, panel.scene.playback.radii[k]);
  });
  text += fmt::format("</g>\n<g fill=\"none\" stroke=\"{}\" stroke-linecap=\"round\">\n", edge);
  std::map<std::int32_t, std::size_t> before;  // for each body its last disc so far
  for (std::size_t k = 0; k < panel.scene.playback.radii.size(); k += panel.every) {
    if (!is_in_body(panel.scene.playback, k)) continue;
    const auto [last, is_first] = before.emplace(panel.scene.playback.bodies[k], k);
    if (is_first) continue;
    const auto path = both_sides(
        panel, frame, last->second, k,
        [&](const Vector& a, const Vector& b) { return move_to(panel, a) + line_to(panel, b); });
    text += fmt::format(
        "<path stroke-width=\"{:.2f}\" d=\"{}\"/>\n",
        std::clamp(kStyle.body_line * smaller_radius(panel, last->second, k), 0.5, 4.0), path);
    last->second = k;
  }
  return text + "</g>\n";
}

/// The text is empty if only some of the particles are drawn.
std::string link_marks(const PanelSettings& panel, const Frame& frame) {
  const auto& links = panel.scene.playback.links;
  if (links.empty() || panel.every > 1) return "";
  const auto number = [](std::int32_t k) { return static_cast<std::size_t>(k); };
  std::string text = "<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
  for (const auto& [first, second] : links.arms)
    text += fmt::format(
        "<path stroke=\"#333\" stroke-width=\"{:.2f}\" d=\"{}\"/>\n",
        std::clamp(kStyle.arm * smaller_radius(panel, number(first), number(second)), 1.2, 5.0),
        both_sides(panel, frame, number(first), number(second),
                   [&](const Vector& a, const Vector& b) {
                     return move_to(panel, a) + line_to(panel, b);
                   }));
  for (const auto& [first, second] : links.springs) {
    const double width = std::clamp(
        kStyle.spring_width * smaller_radius(panel, number(first), number(second)), 1.5, 6.0);
    text += fmt::format("<path stroke=\"{}\" stroke-width=\"1.3\" d=\"{}\"/>\n", kStyle.spring,
                        both_sides(panel, frame, number(first), number(second),
                                   [&](const Vector& a, const Vector& b) {
                                     return spring_path(panel, a, b, width);
                                   }));
  }
  text += "</g>\n<g fill=\"#fff\" stroke=\"#111\" stroke-width=\"1.6\">\n";
  for (const auto& at : links.hinges) text += circle(panel, at, 4 / panel.view.scale);
  return text + "</g>\n";
}

/// The polygon as an SVG path that is not closed.
std::string path_of(const Polygon& polygon, const Projection& view) {
  std::string path;
  for (const auto& p : polygon)
    path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", view.x(p), view.y(p));
  return path;
}

Polygon circle_polygon(const PlanePosition& place) {
  Polygon polygon;
  for (int k = 0; k < FramePictureTuning::kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / FramePictureTuning::kSides;
    polygon.push_back(place.point + place.radius * Vector{std::cos(angle), std::sin(angle), 0});
  }
  return polygon;
}

/// The outline of a circle, as far as it is in the box of the scene.
std::string circle_line(const PanelSettings& d, const PlanePosition& place) {
  const auto polygon = circle_polygon(place);
  std::string path;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto side =
        clipped_to_view({polygon[k], polygon[(k + 1) % polygon.size()]}, d.scene.box, {}, 0, 2);
    if (side.size() > 1) path += path_of(side, d.view);
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#333\" stroke-width=\"1.5\"/>\n", path);
}

/// Draws the parts of the box behind planes and outside circles as grey areas.
std::string plane_2d_solids(const PanelSettings& d, const Frame& frame) {
  const auto& [low, high] = d.scene.box;
  const Polygon all = {
      {low[0], low[1], 0}, {high[0], low[1], 0}, {high[0], high[1], 0}, {low[0], high[1], 0}};
  std::string text;
  for (const auto& plane : frame.planes) {
    if (plane.is_curved()) {
      const auto inside = clipped_to_view(circle_polygon(plane), d.scene.box, {}, 0, 2);
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
    const double far = norm(d.scene.box.high - d.scene.box.low) + norm(d.scene.box.low - point);
    const Vector along = {-normal[1], normal[0], 0};
    const auto line = clipped_to_view({point - far * along, point + far * along}, d.scene.box,
                                      frame.planes, j, 2);
    if (line.size() > 1)
      text += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#333\" stroke-width=\"1.5\"/>\n",
                          path_of(line, d.view));
  }
  return text;
}

/// Draws, for motions in space, the parts of planes in the box. With `from_free_side`, the planes
/// that are seen from their free side are drawn, and filled. Otherwise the other planes are drawn,
/// only by their edges, because particles are behind them.
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
    const double far = norm(d.scene.box.high - d.scene.box.low) + norm(d.scene.box.low - point);
    const auto patch = clipped_to_view({point - far * u - far * v, point + far * u - far * v,
                                        point + far * u + far * v, point - far * u + far * v},
                                       d.scene.box, frame.planes, j, 3);
    if (patch.size() > 2)
      text += fmt::format(
          "<path d=\"{}Z\" fill=\"#8a8a80\" fill-opacity=\"{}\" stroke=\"#777\" "
          "stroke-width=\".8\"/>\n",
          path_of(patch, d.view), from_free_side ? ".22" : "0");
  }
  return text;
}

/// Colour "#rrggbb" of the line of a contact: one colour if the contact slides; otherwise that of
/// gamma if gamma < 0, and that of its friction if gamma = 0. The scales have few colours, so that
/// many contacts of one colour make one path.
std::string colour_of(const Scene& scene, const CurrentContact& contact) {
  const auto rounded = [](double share, int colours) {
    return static_cast<double>(std::lround(share * (colours - 1))) / (colours - 1);
  };
  if (contact.friction == ContactFriction::kSlides) return report::kSlidingColour;
  if (contact.gamma < 0 && scene.lowest_gamma < 0)
    return report::film_colour(
        rounded(std::clamp(contact.gamma / scene.lowest_gamma, 0.0, 1.0), kContactColours));
  return report::friction_colour(
      rounded(mobilised_friction(scene.playback, contact), kFrictionColours));
}

/// Width of the line of a contact [page units]. `radius` [page units] is the smaller one of its
/// particles; of a plate it is half of the thickness. `scale` is that of the view there.
double width_of(const PanelSettings& d, const CurrentContact& contact, double radius,
                double scale) {
  const auto width = [](const LineWidth& line, double r) {
    return std::clamp(line.share * r, line.least, line.most);
  };
  const auto& scene = d.scene;
  const bool is_film = contact.gamma < 0;
  if (scene.top_force > 0)
    return std::max(
        width(is_film ? kStyle.film_with_force : kStyle.touching_with_force, radius),
        width(kStyle.force_line, scale * scene.mean_radius) * force_share(scene, contact));
  const bool is_wide = is_film || contact.friction == ContactFriction::kSlides;
  return width(is_wide ? kStyle.film_line : kStyle.touching_line, radius);
}

struct ContactLine {
  std::string colour;
  double width = 0;
  std::string path;
};

/// Particle k with its centre at `centre` [L].
PlacedShape placed(const Playback& playback, const Frame& frame, std::size_t k,
                   const Vector& centre) {
  return PlacedShape::at_angle(playback.shapes[k], {centre[0], centre[1]}, frame.angles[k]);
}

/// The line between the centres, or the nearest points of the cores, or to the nearest point of an
/// obstacle.
ContactLine line_of(const PanelSettings& d, const Frame& frame, const CurrentContact& contact) {
  const auto second = static_cast<std::size_t>(contact.second);
  Vector to = position(d.scene.playback, frame, second);
  const auto half_thickness = [&](std::size_t k) -> double {
    const auto& playback = d.scene.playback;
    return playback.shapes.empty() ? playback.radii[k] : playback.shapes[k].inner_radius();
  };
  double radius = half_thickness(second);
  Vector from{};
  const Vector shift = shift_of(cell_at(d.scene.playback, frame), contact.image);
  if (contact.first < 0) {
    const auto plane =
        tangent_at(frame.planes.at(static_cast<std::size_t>(-1 - contact.first)), to);
    from = to - dot(plane.normal, to - plane.point) * plane.normal;
  } else {
    const auto first = static_cast<std::size_t>(contact.first);
    from = position(d.scene.playback, frame, first);
    radius = std::min(radius, half_thickness(first));
    if (const auto& playback = d.scene.playback; !playback.shapes.empty()) {
      const auto one = placed(playback, frame, first, from),
                 other = placed(playback, frame, second, to + shift);
      if (!core_of(one).corners.empty() && !core_of(other).corners.empty()) {
        const ShapeContacts contacts(one, other);
        const auto arms = contacts.at(contacts.places().front(), one, other).arms;
        from = from + Vector{arms[0][0], arms[0][1], 0};
        to = to + Vector{arms[1][0], arms[1][1], 0};
      }
    }
  }
  ContactLine line;
  line.colour = colour_of(d.scene, contact);
  const double scale = d.view.scale * d.view.nearness(to);
  line.width = width_of(d, contact, scale * radius, scale);
  // The line to a shifted image is drawn at both sides of the cell.
  line.path = path_of({from, to + shift}, d.view);
  if (contact.image != 0) line.path += path_of({from - shift, to}, d.view);
  return line;
}

bool drawn(const PanelSettings& d, const CurrentContact& contact) {
  const auto shown = [&](std::int32_t k) { return static_cast<std::size_t>(k) % d.every == 0; };
  return shown(contact.second) && (contact.first < 0 || shown(contact.first));
}

/// The panel of a motion in the plane; `behind` is SVG that is drawn first.
std::string discs(const PanelSettings& d, const Frame& frame, const std::string& behind) {
  std::string text = behind + plane_2d_solids(d, frame);
  const bool is_in_fluid = d.scene.is_in_fluid;
  const auto [fill, edge] = is_in_fluid ? kStyle.disc_in_fluid : kStyle.disc;
  text += fmt::format("<g fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\">\n", fill, edge,
                      is_in_fluid ? ".8" : ".6");
  for_each_image(d, frame, [&](std::size_t k, const Vector& centre) {
    if (!is_in_body(d.scene.playback, k)) text += disc(d, frame, k, centre);
  });
  text += "</g>\n" + body_discs(d, frame) + angle_marks(d, frame) + plane_2d_lines(d, frame);
  // All contacts with one width, rounded to tenths of a page unit, and one colour make one path.
  // The map is ordered by width, so that wide lines are drawn over thin ones.
  std::map<std::pair<long, std::string>, std::string> paths;
  for (const auto& contact : frame.contacts) {
    if (!drawn(d, contact)) continue;
    const auto line = line_of(d, frame, contact);
    paths[{std::lround(10 * line.width), line.colour}] += line.path;
  }
  text += "<g fill=\"none\" stroke-linecap=\"round\">\n";
  for (const auto& [kind, path] : paths)
    text += fmt::format("<path stroke=\"{}\" stroke-width=\"{:.1f}\" d=\"{}\"/>\n", kind.second,
                        static_cast<double>(kind.first) / 10, path);
  return text + "</g>\n" + link_marks(d, frame);
}

bool is_periodic_in_space(const PeriodicCell& cell) {
  return std::ranges::all_of(cell.lengths, [](double length) { return length > 0; });
}

/// A sphere that is drawn, or its image.
struct DrawnSphere {
  double depth = 0;  ///< towards the reader [L]
  std::size_t particle = 0;
  Vector centre{};  ///< [L]
};

/// From the back to the front, because SVG has no depth: the spheres, and those images of which a
/// part is in the cell.
std::vector<DrawnSphere> drawn_spheres(const PanelSettings& d, const Frame& frame) {
  std::vector<DrawnSphere> spheres;
  const auto cell = cell_at(d.scene.playback, frame);
  for_each_image(d, frame, [&](std::size_t k, const Vector& centre) {
    const double depth = dot(d.view.toward, centre), r = d.scene.playback.radii[k];
    if (std::isnan(depth)) return;  // the particle is not there yet
    if (!is_near_cell(cell, centre, r)) return;
    spheres.push_back({depth, k, centre});
  });
  std::ranges::stable_sort(spheres, {}, &DrawnSphere::depth);
  return spheres;
}

/// The edges of the cell: the three that meet in the farthest corner, or the others.
std::string cell_edges(const PanelSettings& d, const Frame& frame, bool behind) {
  const auto cell = cell_at(d.scene.playback, frame);
  std::array<Vector, 3> edges{};
  for (std::size_t axis = 0; axis < 3; ++axis) edges[axis][axis] = cell.lengths[axis];
  Vector from = cell.from;
  if (cell.vectors) {
    edges = *cell.vectors;
    from = from + 0.5 * cell.lengths;
    for (const auto& edge : edges) from = from - 0.5 * edge;
  }
  const auto corner = [&](int number) {
    Vector p = from;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if ((number >> axis & 1) != 0) p = p + edges[axis];
    return p;
  };
  int farthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (dot(d.view.toward, edges[axis]) < 0) farthest |= 1 << axis;
  std::string path;
  for (int number = 0; number < 8; ++number)
    for (int bit = 1; bit < 8; bit *= 2) {
      const int other = number | bit;
      if (other == number || behind != (number == farthest || other == farthest)) continue;
      path += path_of({corner(number), corner(other)}, d.view);
    }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#333\" stroke-width=\".8\"{}/>\n", path,
                     behind ? " stroke-dasharray=\"4 3\"" : "");
}

/// The panel of a motion in space. A contact is drawn just after the nearer of its two particles:
/// over this particle and those behind it, and under those in front of it. Over translucent spheres
/// all contacts are drawn.
std::string spheres(const PanelSettings& d, const Frame& frame) {
  const auto& playback = d.scene.playback;
  const bool is_bulk = is_periodic_in_space(playback.cell);
  const bool is_clear = is_bulk && d.scene.top_force > 0;
  const auto order = drawn_spheres(d, frame);
  std::vector<std::size_t> last(playback.radii.size());  // in `order`, of each particle
  for (std::size_t i = 0; i < order.size(); ++i) last[order[i].particle] = i;
  std::vector<std::string> with(order.size());
  std::string over;
  for (const auto& contact : frame.contacts) {
    if (!drawn(d, contact)) continue;
    const auto line = line_of(d, frame, contact);
    auto at = last[static_cast<std::size_t>(contact.second)];
    if (contact.first >= 0) at = std::max(at, last[static_cast<std::size_t>(contact.first)]);
    (is_clear ? over : with[at]) +=
        fmt::format("<path stroke=\"{}\" stroke-width=\"{:.2f}\" d=\"{}\"/>\n", line.colour,
                    line.width, line.path);
  }
  std::string text = plane_3d_patches(d, frame, true);
  if (is_bulk) text += cell_edges(d, frame, true);
  text += fmt::format(
      "<g fill=\"url(#ball)\" stroke=\"{}\" stroke-width=\".5\" stroke-linecap=\"round\"{}>\n",
      kStyle.ball.back(),
      is_clear ? fmt::format(" fill-opacity=\"{0}\" stroke-opacity=\"{0}\"", kStyle.clear_ball)
               : "");
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto k = order[i].particle;
    const auto sphere = circle(d, order[i].centre, playback.radii[k]);
    text += is_in_body(playback, k) ? "<g fill=\"url(#body)\">" + sphere + "</g>\n" : sphere;
    if (!is_clear) text += orientation_marks(d, frame, k, order[i].centre);
    text += with[i];
  }
  text += "</g>\n";
  if (!over.empty()) text += "<g stroke-linecap=\"round\">\n" + over + "</g>\n";
  if (is_bulk) text += cell_edges(d, frame, false);
  return text + link_marks(d, frame) + plane_3d_patches(d, frame, false);
}

}  // namespace

Projection view_of(int dimension, std::size_t up) {
  assert((dimension == 2 || dimension == 3) && (up == 1 || up == 2));
  Projection view;
  if (dimension == 2) return view;
  const double turn = 30 * std::numbers::pi / 180, from_above = 20 * std::numbers::pi / 180;
  const double c = std::cos(turn), s = std::sin(turn), ca = std::cos(from_above),
               sa = std::sin(from_above);
  // With the second axis upwards the third one takes the place of minus the second.
  const auto turned = [&](const Vector& v) { return up == 2 ? v : Vector{v[0], v[2], -v[1]}; };
  view.right = turned({c, s, 0});
  view.up = turned({-s * sa, c * sa, ca});
  view.toward = turned({s * ca, -c * ca, sa});
  return view;
}

std::string frame_picture(const PanelSettings& panel, const Frame& frame,
                          const std::string& behind) {
  return panel.scene.playback.dimension == 2 ? discs(panel, frame, behind) : spheres(panel, frame);
}

}  // namespace viscontact::particles
