// The box that is seen, the flows in it, and the scales of colours and widths.
#include "viscontact/particle_runs/picture/scene.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "viscontact/common/vtk/flow_vtk.hpp"
#include "viscontact/membranes/membrane_shape.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of the scene.
struct SceneTuning {
  // Largest distance of a plane that is shown, over the longest side of the box.
  static constexpr double kNear = 0.5;
  // If all particles cover more than 1.5 times the interval that the central ones cover, some have
  // flown away.
  static constexpr double kFlownAway = 1.5;
  // If the domain is more than this many times as large as the box of the particles, the whole
  // domain is not shown, because the particles would be too small.
  static constexpr double kTooLarge = 16;
  // Margin, and least length of a side, over the longest side of the box.
  static constexpr double kMargin = 0.04, kFlattest = 0.15;
  // Largest number of values of each frame, enough for quantiles.
  static constexpr std::size_t kOfFrame = 4000;
  // About how many streamlines a picture has.
  static constexpr int kLines = 18;
  // Largest number of flows on the page, and of the points of each.
  static constexpr std::size_t kMostFlows = 150, kMostPoints = 60'000;
  // In an impact a few contacts have much larger forces than all others. Therefore the largest 2 %
  // of the forces are beyond the scale.
  static constexpr std::size_t kOneIn = 50;
};

/// The interval that the particles of a frame cover along an axis [L], without the `cut` outermost
/// particles at either end, and without particles at NaN, which do not exist yet. Empty if no
/// particle is left.
Interval reach_of(const Playback& playback, const Frame& frame, std::size_t axis, std::size_t cut) {
  std::vector<double> lows, highs;
  for (std::size_t k = 0; k < playback.radii.size(); ++k) {
    const double x = position(playback, frame, k)[axis], r = playback.radii[k];
    if (!std::isfinite(x)) continue;
    lows.push_back(x - r);
    highs.push_back(x + r);
  }
  Interval reach;
  if (lows.size() <= 2 * cut) return reach;
  const auto at = static_cast<std::ptrdiff_t>(cut);
  std::ranges::nth_element(lows, lows.begin() + at);
  std::ranges::nth_element(highs, highs.end() - 1 - at);
  reach.add(lows[cut], highs[highs.size() - 1 - cut]);
  return reach;
}

/// The longest side of the box [L].
double size_of(const ViewBox& box, int dimension) {
  double size = 0;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    size = std::max(size, box.high[d] - box.low[d]);
  return size;
}

/// Extends the box to a plane or circle near it, so that the reader sees what particles lie on.
void extend_to_plane(ViewBox& box, const PlanePosition& plane, int dimension) {
  const double size = size_of(box, dimension);
  if (plane.is_curved())
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
      const double low = plane.point[d] - plane.radius, high = plane.point[d] + plane.radius;
      if (box.low[d] - low <= SceneTuning::kNear * size) box.low[d] = std::min(box.low[d], low);
      if (high - box.high[d] <= SceneTuning::kNear * size)
        box.high[d] = std::max(box.high[d], high);
    }
  double distance = 0;
  for (std::size_t d = 0; d < 3; ++d)
    distance +=
        plane.normal[d] * ((plane.normal[d] > 0 ? box.low[d] : box.high[d]) - plane.point[d]);
  if (distance <= 0 || distance > SceneTuning::kNear * size) return;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
    const double shift = -plane.normal[d] * distance;
    (shift < 0 ? box.low[d] : box.high[d]) += shift;
  }
}

/// Scene::box, where the flow, if there is one, fills `domain`.
ViewBox view_box_of(const Playback& playback, const std::vector<std::size_t>& frames,
                    const std::optional<report::Window>& domain) {
  const auto dimension = static_cast<std::size_t>(playback.dimension);
  // The particles that are left out at both ends of all axes are together 2 %.
  const auto cut = playback.radii.size() / (100 * dimension);
  ViewBox box;
  double size = 0;
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    Interval all, central;
    for (const auto f : frames) {
      const auto whole = reach_of(playback, playback.frames[f], axis, 0);
      const auto middle = reach_of(playback, playback.frames[f], axis, cut);
      all.add(whole.low, whole.high);
      central.add(middle.low, middle.high);
    }
    if (!(all.low <= all.high)) all = central = {-1, 1};
    const bool flown = all.high - all.low > SceneTuning::kFlownAway * (central.high - central.low);
    box.low[axis] = flown ? central.low : all.low;
    box.high[axis] = flown ? central.high : all.high;
    size = std::max(size, box.high[axis] - box.low[axis]);
  }
  if (!(size > 0)) size = 1;
  for (const auto f : frames)
    for (const auto& plane : playback.frames[f].planes)
      extend_to_plane(box, plane, playback.dimension);
  if (domain && std::max(domain->width(), domain->height()) <= SceneTuning::kTooLarge * size)
    box = {{domain->left, domain->bottom, 0}, {domain->right, domain->top, 0}};
  size = std::max(size, size_of(box, playback.dimension));
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    const double more =
        std::max(SceneTuning::kMargin * size,
                 0.5 * (SceneTuning::kFlattest * size - (box.high[axis] - box.low[axis])));
    box.low[axis] -= more;
    box.high[axis] += more;
  }
  bool is_strained = false;
  for (const auto f : frames) {
    const auto& periods = playback.frames[f].periods;
    if (!periods) continue;
    is_strained = true;
    // The box around the cell, whose middle does not move.
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      double half = std::ranges::max(playback.radii);
      for (const auto& period : *periods) half += std::abs(period[axis]) / 2;
      const double middle = playback.cell.from[axis] + playback.cell.lengths[axis] / 2;
      box.low[axis] = std::min(box.low[axis], middle - half);
      box.high[axis] = std::max(box.high[axis], middle + half);
    }
  }
  for (std::size_t axis = 0; axis < dimension && !is_strained; ++axis)
    if (const double period = playback.cell.lengths[axis]; period > 0) {
      // In space the images at the sides of the cell are shown, too.
      const double beyond = playback.dimension == 3 ? std::ranges::max(playback.radii) : 0;
      box.low[axis] = playback.cell.from[axis] - beyond;
      box.high[axis] = playback.cell.from[axis] + period + beyond;
    }
  return box;
}

/// For each point of the grid, row by row from the bottom, 1 if the point is in a particle or in an
/// image of a particle, otherwise 0.
std::vector<char> points_in_bodies(const report::Grid& grid, const Playback& playback,
                                   const Frame& frame) {
  std::vector<char> is_body(grid.size(), 0);
  const auto range = [](double low, double high, double from, double step, std::size_t count) {
    const auto place = [&](double x) {
      return static_cast<std::size_t>(
          std::clamp(std::ceil((x - from) / step), 0.0, static_cast<double>(count)));
    };
    return std::pair(place(low), place(high));
  };
  const auto& window = grid.window;
  const auto cell = cell_at(playback, frame);
  for (std::size_t k = 0; k < playback.radii.size(); ++k)
    for (std::int32_t image = -kLargestImage; image <= kLargestImage; ++image) {
      if (!has_image(cell, image)) continue;
      const auto shift = shift_of(cell, image);
      const auto centre = position(playback, frame, k);
      const double x = centre[0] + shift[0], y = centre[1] + shift[1], r = playback.radii[k];
      const auto [left, right] = range(x - r, x + r, window.left, grid.step_x(), grid.columns);
      const auto [bottom, top] = range(y - r, y + r, window.bottom, grid.step_y(), grid.rows);
      std::optional<PlacedShape> shape;
      if (!playback.shapes.empty())
        shape = PlacedShape::at_angle(playback.shapes[k], {x, y}, frame.angles[k]);
      for (auto row = bottom; row < top; ++row)
        for (auto column = left; column < right; ++column)
          if (shape ? shape->distance_to({grid.x(column), grid.y(row)}) <= 0
                    : std::hypot(grid.x(column) - x, grid.y(row) - y) <= r)
            is_body[row * grid.columns + column] = 1;
    }
  return is_body;
}

/// Values at points outside the particles, from which quantiles are computed.
struct Samples {
  std::vector<double> values;

  /// Adds the finite values of every n-th point. `is_body` is that of points_in_bodies().
  void add(const std::vector<float>& field, const std::vector<char>& is_body) {
    assert(is_body.size() == field.size());
    const auto every = field.size() / SceneTuning::kOfFrame + 1;
    for (std::size_t i = 0; i < field.size(); i += every)
      if (is_body[i] == 0 && std::isfinite(field[i])) values.push_back(field[i]);
  }

  /// The value that the fraction `share` of the samples does not exceed; 0 if there is no sample.
  double quantile(double share) {
    assert(share >= 0 && share <= 1);
    if (values.empty()) return 0;
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
  }
};

/// The mean at the points outside the particles where the field is finite; 0 if there is no such
/// point. `is_body` is that of points_in_bodies().
double mean_outside(const std::vector<double>& field, const std::vector<char>& is_body) {
  assert(is_body.size() == field.size());
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < field.size(); ++i)
    if (is_body[i] == 0 && std::isfinite(field[i])) {
      sum += field[i];
      ++count;
    }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

/// A wall of a cylinder as a line in the plane (x, z), in which the axis is x = 0. The components
/// of `plane` are z and the distance from the axis. `side` is the sign of x on the line.
PlanePosition in_half_plane(const PlanePosition& plane, double side) {
  return {{side * plane.point[1], plane.point[0], 0},
          {side * plane.normal[1], plane.normal[0], 0},
          plane.radius};
}

/// The motion as it is drawn. Spheres on an axis become discs on the line x = 0 of the plane (x,
/// z), and the side of their cylinder becomes two lines.
Playback in_plane(const Playback& playback) {
  if (playback.dimension != 1) return playback;
  auto plane = playback;
  plane.dimension = 2;
  for (auto& frame : plane.frames) {
    std::vector<float> positions;
    for (const float z : frame.positions) positions.insert(positions.end(), {0, z});
    frame.positions = std::move(positions);
    // A contact names a plane by its number. Mirror images come last, so that no number changes.
    std::vector<PlanePosition> planes, images;
    for (const auto& wall : frame.planes) {
      planes.push_back(in_half_plane(wall, 1));
      if (wall.normal[1] != 0) images.push_back(in_half_plane(wall, -1));
    }
    planes.insert(planes.end(), images.begin(), images.end());
    frame.planes = std::move(planes);
  }
  return plane;
}

/// The flow of a frame, with the places of the playback. Throws the error of read_flow().
FlowField flow_of(const Playback& in_plane, const Frame& frame) {
  auto flow = read_flow(frame.flow);
  for (std::size_t d = 0; d < 2; ++d)
    if (in_plane.origin[d] != 0)
      for (auto& x : d == 0 ? flow.x : flow.y) x -= in_plane.origin[d];
  return flow;
}

/// The rectangle that the flow fills, in the first frame that has a flow; no value if there is
/// none. If there is an axis, the rectangle includes the mirror image of the flow. Along a
/// direction with a period it is as long as the cell. Throws Error(kBadInput) if the flow cannot be
/// read.
std::optional<report::Window> flow_extent(const Playback& in_plane, bool has_axis) {
  for (const auto& frame : in_plane.frames) {
    if (frame.flow.empty()) continue;
    const auto flow = flow_of(in_plane, frame);
    if (flow.triangles.empty()) continue;
    const auto [left, right] = std::ranges::minmax(flow.x);
    const auto [bottom, top] = std::ranges::minmax(flow.y);
    report::Window window{has_axis ? -right : left, right, bottom, top};
    const auto& cell = in_plane.cell;
    if (cell.lengths[0] > 0) {
      window.left = cell.from[0];
      window.right = cell.from[0] + cell.lengths[0];
    }
    if (cell.lengths[1] > 0) {
      window.bottom = cell.from[1];
      window.top = cell.from[1] + cell.lengths[1];
    }
    return window;
  }
  return {};
}

report::Window common_part(const report::Window& extent, const ViewBox& view) {
  return {std::max(extent.left, view.low[0]), std::min(extent.right, view.high[0]),
          std::max(extent.bottom, view.low[1]), std::min(extent.top, view.high[1])};
}

/// Reads the flow of frame `f`, interpolates it on the grid of `flows`, and computes its
/// streamlines. `is_body` is that of points_in_bodies(). If the file has no flow, the speeds of the
/// result are empty.
FlowFrame read_flow_frame(const Playback& in_plane, std::size_t f, const FlowFrames& flows,
                          const std::vector<char>& is_body, report::StreamLines& stream_lines) {
  FlowFrame found;
  found.frame = f;
  const auto field = flow_of(in_plane, in_plane.frames[f]);
  if (field.triangles.empty()) return found;
  const auto flow = report::flow_on_grid(
      field, flows.grid,
      {{in_plane.cell.lengths[0], in_plane.cell.lengths[1]}, in_plane.cell.gradient});
  for (std::size_t i = 0; i < flows.grid.size(); ++i)
    found.speed.push_back(static_cast<float>(std::hypot(flow.velocity_x[i], flow.velocity_y[i])));
  const double mean = mean_outside(flow.pressure, is_body);
  for (const double pressure : flow.pressure)
    found.pressure.push_back(static_cast<float>(pressure - mean));
  found.lines =
      stream_lines
          .of(flow, is_body, flows.has_axis ? SceneTuning::kLines * 2 / 3 : SceneTuning::kLines)
          .lines;
  return found;
}

/// Reads the flows of these frames one after the other, because all of them may be larger than the
/// memory, and keeps their values on a grid of about `points` points in `window`. A flow that
/// `known` has on the same grid is copied from there.
FlowFrames read_flows(const Playback& in_plane, bool has_axis, const report::Window& window,
                      const std::vector<std::size_t>& frames, std::size_t points,
                      const FlowFrames& known) {
  FlowFrames flows;
  flows.has_axis = has_axis;
  flows.grid = report::grid_of(
      {has_axis ? 0 : window.left, window.right, window.bottom, window.top}, points);
  report::StreamLines stream_lines(flows.grid, has_axis);
  Samples speeds, pressures;
  for (const auto f : frames) {
    if (in_plane.frames[f].flow.empty()) continue;
    const auto is_body = points_in_bodies(flows.grid, in_plane, in_plane.frames[f]);
    const auto known_frame = std::ranges::find(known.frames, f, &FlowFrame::frame);
    auto found = known.grid == flows.grid && known_frame != known.frames.end()
                     ? *known_frame
                     : read_flow_frame(in_plane, f, flows, is_body, stream_lines);
    if (found.speed.empty()) continue;
    speeds.add(found.speed, is_body);
    pressures.add(found.pressure, is_body);
    flows.frames.push_back(std::move(found));
  }
  flows.top_speed = speeds.quantile(0.999);
  auto sizes = pressures;
  for (double& value : sizes.values) value = std::abs(value);
  flows.pressure_colours = report::robust_colours(pressures.values, sizes.quantile(0.5));
  return flows;
}

}  // namespace

ShownFlows shown_flows(const Playback& playback) {
  std::vector<std::size_t> with_flow;
  for (std::size_t f = 0; f < playback.frames.size(); ++f)
    if (!playback.frames[f].flow.empty()) with_flow.push_back(f);
  ShownFlows shown;
  const auto count = std::min(with_flow.size(), SceneTuning::kMostFlows);
  for (std::size_t i = 0; i < count; ++i)
    shown.frames.push_back(with_flow[count < 2 ? 0 : i * (with_flow.size() - 1) / (count - 1)]);
  if (count > 0) shown.points = std::min(SceneTuning::kMostPoints, kFlowBytesOfPage / 2 / count);
  return shown;
}

Scene scene_of(const Playback& motion, const std::vector<std::size_t>& frames,
               const std::vector<std::size_t>& flow_frames, std::size_t points,
               const FlowFrames& known) {
  assert(std::ranges::all_of(frames, [&](auto f) { return f < motion.frames.size(); }));
  assert(std::ranges::all_of(flow_frames, [&](auto f) { return f < motion.frames.size(); }));
  Scene scene;
  scene.playback = in_plane(motion);
  scene.has_axis = motion.dimension == 1;
  const auto& playback = scene.playback;
  const auto extent = flow_extent(playback, scene.has_axis);
  scene.is_in_fluid = extent.has_value();
  scene.box = view_box_of(playback, frames, extent);
  if (extent)
    scene.flows = read_flows(playback, scene.has_axis, common_part(*extent, scene.box), flow_frames,
                             points, known);
  for (const auto& frame : playback.frames)
    for (const auto& contact : frame.contacts)
      if (std::isfinite(contact.gamma))
        scene.lowest_gamma = std::min(scene.lowest_gamma, contact.gamma);
  const int is_per_length = scene.is_per_length() ? 1 : 0;
  scene.film_words = fmt::format("gamma: minus the impulse{} that the film has absorbed [{}]",
                                 is_per_length > 0 ? " per length" : "",
                                 motion.units.unit_or_dimension(1, 1 - is_per_length, -1));
  std::vector<double> forces;
  for (const auto f : frames)
    for (const auto& contact : playback.frames[f].contacts) {
      if (contact.normal_force != 0) forces.push_back(std::abs(contact.normal_force));
      scene.touches = scene.touches || !(contact.gamma < 0);
      scene.slides = scene.slides || contact.friction == ContactFriction::kSlides;
    }
  const auto& radii = playback.radii;
  if (!radii.empty())
    scene.mean_radius =
        std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
  if (forces.empty()) return scene;
  const auto top =
      forces.end() - 1 - static_cast<std::ptrdiff_t>(forces.size() / SceneTuning::kOneIn);
  std::ranges::nth_element(forces, top);
  scene.top_force = *top;
  scene.force_words = fmt::format("line width: normal force, widest from {:.3g} [{}] on", *top,
                                  motion.units.unit_or_dimension(1, 1 - is_per_length, -2));
  return scene;
}

double force_share(const Scene& scene, const CurrentContact& contact) {
  return scene.top_force > 0 ? std::min(1.0, std::abs(contact.normal_force) / scene.top_force) : 0;
}

double mobilised_friction(const Playback& playback, const CurrentContact& contact) {
  if (contact.friction == ContactFriction::kSlides) return 1;
  const double bound = playback.friction_coefficient.value_or(0) * contact.normal_force;
  return bound > 0 ? std::min(1.0, norm(contact.tangential_force) / bound) : 0;
}

Polygon clipped(const Polygon& polygon, const Vector& point, const Vector& normal) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double u = dot(normal, a - point), v = dot(normal, b - point);
    if (u >= 0) kept.push_back(a);
    if ((u >= 0) != (v >= 0)) kept.push_back(a + (u / (u - v)) * (b - a));
  }
  return kept;
}

Polygon clipped_to_view(Polygon polygon, const ViewBox& box,
                        const std::vector<PlanePosition>& planes, std::size_t own, int dimension) {
  assert(dimension == 2 || dimension == 3);
  const double slack = 1e-4 * size_of(box, dimension);
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
    Vector axis{0, 0, 0};
    axis[d] = 1;
    polygon = clipped(clipped(polygon, box.low, axis), box.high, -1.0 * axis);
  }
  for (std::size_t j = 0; j < planes.size(); ++j)
    if (j != own)
      polygon = clipped(polygon, planes[j].point - slack * planes[j].normal, planes[j].normal);
  return polygon;
}

}  // namespace viscontact::particles
