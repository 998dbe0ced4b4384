// Chooses what a page shows, and encodes it; kLevels, kNothing, kNoArrow and kSteps in flow.js are
// the same as here.
#include "viscontact/particle_runs/picture/page_data.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "viscontact/common/text/base64.hpp"
#include "viscontact/particles/shapes/shape_contacts.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of what a page shows.
struct PageDataTuning {
  // The largest step, divided by the smallest radius, with which coordinates take two bytes.
  static constexpr double kSmall = 0.02;
  // The largest size of a page [bytes], and the largest number of particles that it shows.
  static constexpr std::size_t kMostBytes = 24'000'000, kMostParticles = 200'000;
  static constexpr std::size_t kRest = 200'000;  // bytes, more than script, style and words have
  // The largest numbers of characters that a hinge, and the two numbers of a spring or arm, take.
  static constexpr std::size_t kHinge = 80, kEnds = 16;
  // The page interpolates between the points of the grid. Therefore points up to three layers
  // outside the flow get the mean of their neighbours.
  static constexpr int kLayers = 3;
};

// The script reads the numbers as little-endian.
static_assert(std::endian::native == std::endian::little);

template <class Number>
void append(Bytes& bytes, Number value) {
  const auto at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// Appends a number with seven bits in each byte, the lowest first. The eighth bit of a byte is 1
/// if another byte follows, and 0 in the last byte.
void append_short(Bytes& bytes, std::uint32_t value) {
  for (; value >= 128; value >>= 7) bytes.push_back(static_cast<unsigned char>(value | 128));
  bytes.push_back(static_cast<unsigned char>(value));
}

void choose_position_bytes(PageData& data, const Playback& playback) {
  constexpr double kSteps = 65535;  // the largest 16-bit number
  const auto dimension = static_cast<std::size_t>(playback.dimension);
  for (std::size_t d = 0; d < dimension; ++d) {
    Interval reach;
    for (const auto& frame : playback.frames)
      for (std::size_t i = d; i < frame.positions.size(); i += dimension)
        reach.add(frame.positions[i], frame.positions[i]);
    if (!(reach.low <= reach.high)) reach = {0, 0};
    data.low[d] = reach.low;
    data.step[d] = (reach.high - reach.low) / kSteps;
  }
  const auto smallest = std::ranges::min_element(playback.radii);
  const double largest_step =
      *std::max_element(data.step.begin(), data.step.begin() + playback.dimension);
  // With an infinite position the step is not finite: the comparison fails, and floats are used.
  if (smallest == playback.radii.end() || largest_step <= PageDataTuning::kSmall * *smallest)
    return;
  data.position_bytes = 4;
  data.low = {0, 0, 0};
  data.step = {1, 1, 1};
}

void choose_frames(PageData& data, const Playback& playback, std::size_t every_frame) {
  assert(every_frame >= 1);
  data.every_frame = every_frame;
  data.frames.clear();
  for (std::size_t f = 0; f < playback.frames.size(); f += every_frame) data.frames.push_back(f);
  if (!data.frames.empty() && data.frames.back() + 1 != playback.frames.size())
    data.frames.push_back(playback.frames.size() - 1);
}

/// The contacts of the shown frames: a list of the pairs that are in contact in any of them, and
/// for each frame its contacts in the order of that list. The bytes of a contact are
/// - the place of its pair in the list minus that of the contact before it (append_short());
/// - a level for gamma, minus the impulse that its film has absorbed: 0 for gamma = 0, and 1 to 255
///   up to the lowest gamma of the motion;
/// - in a motion with friction: 254 times mobilised_friction(), or 255 if the contact slides;
/// - in a motion with forces: 255 times force_share().
struct Contacts {
  Bytes pairs;    ///< int32: both particles, counted among the shown ones; -1 - j: obstacle j
  Bytes images;   ///< int8: image of the second particle, as image_number() in periods.hpp
  Bytes offsets;  ///< uint32: where each frame begins in `frames`, and then the length of `frames`
  Bytes frames;   ///< the bytes of all contacts, frame by frame
};

using Pair = std::array<std::int32_t, 3>;  // first, second and image of a CurrentContact

Contacts contacts_of(const Scene& scene, const PageData& data) {
  const auto& playback = scene.playback;
  const double lowest = scene.lowest_gamma;
  Contacts contacts;
  append(contacts.offsets, std::uint32_t{0});
  const auto every = static_cast<std::int32_t>(data.every_particle);
  const auto shown = [&](const CurrentContact& c) {
    return data.contacts && c.second % every == 0 && (c.first < 0 || c.first % every == 0);
  };
  std::vector<Pair> pairs;
  for (const auto f : data.frames)
    for (const auto& c : playback.frames[f].contacts)
      if (shown(c)) pairs.push_back({c.first, c.second, c.image});
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto& [first, second, image] : pairs) {
    append(contacts.pairs, first < 0 ? first : first / every);
    append(contacts.pairs, second / every);
    append(contacts.images, static_cast<std::int8_t>(image));
  }
  struct Listed {
    std::uint32_t at;
    unsigned char level, friction, force;
  };
  std::vector<Listed> listed;
  for (const auto f : data.frames) {
    listed.clear();
    for (const auto& c : playback.frames[f].contacts) {
      if (!shown(c)) continue;
      const auto at =
          std::ranges::lower_bound(pairs, Pair{c.first, c.second, c.image}) - pairs.begin();
      const auto level =
          c.gamma < 0 ? std::max(1L, std::lround(255 * std::clamp(c.gamma / lowest, 0.0, 1.0)))
                      : 0L;
      listed.push_back(
          {static_cast<std::uint32_t>(at), static_cast<unsigned char>(level),
           static_cast<unsigned char>(c.friction == ContactFriction::kSlides
                                          ? 255
                                          : std::lround(254 * mobilised_friction(playback, c))),
           static_cast<unsigned char>(std::lround(255 * force_share(scene, c)))});
    }
    std::ranges::sort(listed, {}, &Listed::at);
    std::uint32_t before = 0;
    for (const auto& [at, level, friction, force] : listed) {
      append_short(contacts.frames, at - before);
      contacts.frames.push_back(level);
      if (playback.friction_coefficient) contacts.frames.push_back(friction);
      if (scene.top_force > 0) contacts.frames.push_back(force);
      before = at;
    }
    append(contacts.offsets, static_cast<std::uint32_t>(contacts.frames.size()));
  }
  return contacts;
}

/// The largest number of bytes that a particle needs for its corners.
std::size_t bytes_of_corners(const Playback& playback) {
  int most = 0;
  for (const auto& shape : playback.shapes) most = std::max(most, shape.sides());
  return most > 0 ? 1 + 2 * sizeof(float) * static_cast<std::size_t>(most) : 0;
}

/// Adds the entries of a shape to the blocks semiAxes, cornerCounts and corners.
void append_shape(const Shape& shape, Bytes& semi_axes, Bytes& counts, Bytes& corners) {
  const auto core = core_of({shape});
  const bool has_sides = shape.sides() > 0;
  for (const double axis :
       has_sides ? Vector2{shape.inner_radius(), core.radius} : shape.semi_axes())
    append(semi_axes, static_cast<float>(axis));
  append(counts, static_cast<char>(shape.sides()));
  if (!has_sides) return;
  for (const auto& corner : core.corners)
    for (const double x : corner) append(corners, static_cast<float>(x));
}

/// How many numbers tell how far a particle has turned: 1 (an angle), 4 (a quaternion), or 0 if the
/// frames do not have such numbers for all particles.
std::size_t numbers_of_turn(const Playback& playback) {
  const auto all_have = [&](const std::vector<float> Frame::*member, std::size_t numbers) {
    return !playback.frames.empty() && !playback.radii.empty() &&
           std::ranges::all_of(playback.frames, [&](const Frame& frame) {
             return (frame.*member).size() == numbers * playback.radii.size();
           });
  };
  if (all_have(&Frame::angles, 1)) return 1;
  return all_have(&Frame::orientations, 4) ? 4 : 0;
}

/// Chooses the frames and particles, and whether contacts are shown, so that the page has at most
/// the allowed bytes and particles. `other_bytes` is the size of the flow in base64. If the other
/// numbers of two frames are too many, the page is larger.
Contacts choose_content(PageData& data, const Scene& scene, std::size_t other_bytes) {
  const auto& playback = scene.playback;
  data.every_particle = playback.radii.size() / (PageDataTuning::kMostParticles + 1) + 1;
  const auto particles = (playback.radii.size() + data.every_particle - 1) / data.every_particle;
  const auto planes = playback.frames.empty() ? 0 : playback.frames.front().planes.size();
  const auto positions =
      particles * static_cast<std::size_t>(playback.dimension * data.position_bytes);
  const auto angles = particles * numbers_of_turn(playback) * sizeof(float);
  // The term `particles` is for the speeds, a byte each.
  const auto bytes_of_frame =
      base64_size(positions + angles + particles + planes * 6 * sizeof(float) + sizeof(double));
  const auto four = [](bool is_there) { return is_there ? sizeof(float) : 0; };
  const bool are_added =
      !playback.frames.empty() &&
      std::ranges::any_of(playback.frames.front().positions, [](float x) { return std::isnan(x); });
  // The bytes of a particle for its radius, mass, id, body, first frame, semi-axes and plate.
  const auto of_particle = four(true) + four(!playback.masses.empty()) +
                           four(!playback.ids.empty()) + four(!playback.bodies.empty()) +
                           four(are_added) + 2 * four(!playback.shapes.empty()) +
                           bytes_of_corners(playback);
  const auto& links = playback.links;
  const auto of_links = links.hinges.size() * PageDataTuning::kHinge +
                        (links.springs.size() + links.arms.size()) * PageDataTuning::kEnds;
  for (std::size_t every = 1;; every *= 2) {
    choose_frames(data, playback, every);
    const auto others = PageDataTuning::kRest + other_bytes + data.frames.size() * bytes_of_frame +
                        base64_size(particles * of_particle) + of_links;
    const bool last = data.frames.size() <= 2;
    if (others > PageDataTuning::kMostBytes && !last) continue;
    auto contacts = contacts_of(scene, data);
    const auto size = others + base64_size(contacts.pairs.size()) +
                      base64_size(contacts.images.size()) + base64_size(contacts.offsets.size()) +
                      base64_size(contacts.frames.size());
    if (size <= PageDataTuning::kMostBytes) return contacts;
    if (!last) continue;
    data.contacts = false;
    return contacts_of(scene, data);
  }
}

void find_first_frames(PageData& data, const Playback& playback) {
  const auto dimension = static_cast<std::size_t>(playback.dimension);
  bool any = false;
  for (std::size_t k = 0; k < playback.radii.size(); k += data.every_particle) {
    std::size_t first = 0;
    while (first + 1 < data.frames.size() &&
           std::isnan(playback.frames[data.frames[first]].positions[k * dimension]))
      ++first;
    any = any || first > 0;
    data.first_frames.push_back(static_cast<std::int32_t>(first));
  }
  if (!any) data.first_frames.clear();
}

/// Sets PageData::top_speed, and returns the block `speeds`; empty if speeds are not known or are
/// all 0.
Bytes speeds_of(PageData& data, const Playback& playback) {
  data.top_speed = 0;
  for (const auto f : data.frames) {
    const auto& speeds = playback.frames[f].speeds;
    if (speeds.size() != playback.radii.size()) return {};
    for (const float speed : speeds)
      data.top_speed = std::max(data.top_speed, static_cast<double>(speed));
  }
  Bytes bytes;
  if (!(data.top_speed > 0) || !std::isfinite(data.top_speed)) return bytes;
  for (const auto f : data.frames)
    for (std::size_t k = 0; k < playback.radii.size(); k += data.every_particle)
      bytes.push_back(static_cast<unsigned char>(
          std::lround(255 * playback.frames[f].speeds[k] / data.top_speed)));
  return bytes;
}

constexpr double kLevels = 254;            // byte of the upper end of a scale; the lower end has 0
constexpr unsigned char kNothing = 255;    // byte of a point without flow
constexpr std::uint16_t kNoArrow = 65535;  // stands for the point of the arrow: there is no arrow
constexpr double kLineSteps = 65535;       // a coordinate at the right or upper side of the grid

/// Appends a byte for each point of the field, which has rows of `columns` points. share(value) is
/// the place of a value on its scale, limited to 0 (the lower end) to 1 (the upper end).
template <class Share>
void append_levels(Bytes& bytes, const std::vector<float>& field, std::size_t columns,
                   const Share& share) {
  assert(columns > 0);
  std::vector<double> values(field.begin(), field.end());
  for (int layer = 0; layer < PageDataTuning::kLayers; ++layer)
    report::fill_next_to_known(values, columns);
  for (const double value : values)
    bytes.push_back(std::isnan(value) ? kNothing
                                      : static_cast<unsigned char>(std::lround(
                                            kLevels * std::clamp(share(value), 0.0, 1.0))));
}

/// Appends the streamlines in the form of the block flow-lines.
void append_lines(Bytes& bytes, const FlowFrame& frame, const report::Window& window) {
  const auto write = [&](std::size_t number) { append(bytes, static_cast<std::uint16_t>(number)); };
  const auto step = [](double share) {
    return static_cast<std::size_t>(std::lround(kLineSteps * std::clamp(share, 0.0, 1.0)));
  };
  // A line with kMost points or more, and lines after the first kMost, are left out, because 16-bit
  // numbers count them.
  constexpr std::size_t kMost = 65000;
  const auto is_short = [&](const report::StreamLine& line) { return line.points.size() < kMost; };
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

}  // namespace

PageData page_data(const Scene& scene, const Blocks& others) {
  const auto& playback = scene.playback;
  assert(playback.dimension == 2 || playback.dimension == 3);
  PageData data;
  choose_position_bytes(data, playback);
  std::size_t other_bytes = 0;
  for (const auto& [name, bytes] : others) other_bytes += base64_size(bytes.size());
  auto contacts = choose_content(data, scene, other_bytes);
  Bytes radii, masses, semi_axes, counts, corners, ids, bodies, times, positions, turns, planes;
  const auto turn_numbers = numbers_of_turn(playback);
  const auto dimension = static_cast<std::size_t>(playback.dimension);
  for (std::size_t k = 0; k < playback.radii.size(); k += data.every_particle) {
    append(radii, playback.radii[k]);
    if (!playback.masses.empty()) append(masses, playback.masses[k]);
    if (!playback.shapes.empty()) append_shape(playback.shapes[k], semi_axes, counts, corners);
    if (!playback.ids.empty()) append(ids, playback.ids[k]);
    if (!playback.bodies.empty()) append(bodies, playback.bodies[k]);
  }
  for (const auto f : data.frames) {
    const auto& frame = playback.frames[f];
    append(times, frame.time);
    for (std::size_t k = 0; k < playback.radii.size(); k += data.every_particle)
      for (std::size_t d = 0; d < dimension; ++d) {
        const float at = frame.positions[k * dimension + d];
        const float x = std::isnan(at) ? static_cast<float>(data.low[d]) : at;
        const double step = data.step[d];
        if (data.position_bytes == 4)
          append(positions, x);
        else
          append(positions,
                 static_cast<std::uint16_t>(std::lround(
                     step > 0 ? std::clamp((x - data.low[d]) / step, 0.0, 65535.0) : 0.0)));
      }
    const auto& written = turn_numbers == 1 ? frame.angles : frame.orientations;
    for (std::size_t k = 0; turn_numbers > 0 && k < playback.radii.size(); k += data.every_particle)
      for (std::size_t i = 0; i < turn_numbers; ++i) append(turns, written[k * turn_numbers + i]);
    for (const auto& plane : frame.planes) {
      // In two dimensions a circle has its radius in place of the third component of a normal, and
      // zeros in place of the other components.
      const auto normal = plane.is_curved() ? Vector{0, 0, plane.radius} : plane.normal;
      for (const auto* vector : {&plane.point, &normal})
        for (const double x : *vector) append(planes, static_cast<float>(x));
    }
  }
  data.blocks = {{"radii", radii}};
  if (find_first_frames(data, playback); !data.first_frames.empty()) {
    Bytes first_frames;
    for (const auto frame : data.first_frames) append(first_frames, frame);
    data.blocks.emplace_back("firstFrames", first_frames);
  }
  if (!masses.empty()) data.blocks.emplace_back("masses", masses);
  if (auto speeds = speeds_of(data, playback); !speeds.empty())
    data.blocks.emplace_back("speeds", std::move(speeds));
  if (!semi_axes.empty()) data.blocks.emplace_back("semiAxes", semi_axes);
  if (!corners.empty()) {
    data.blocks.emplace_back("cornerCounts", counts);
    data.blocks.emplace_back("corners", corners);
  }
  if (!ids.empty()) data.blocks.emplace_back("ids", ids);
  if (!bodies.empty()) data.blocks.emplace_back("bodies", bodies);
  if (turn_numbers > 0)
    data.blocks.emplace_back(turn_numbers == 1 ? "angles" : "orientations", turns);
  if (playback.cell.is_periodic()) data.blocks.emplace_back("images", contacts.images);
  data.blocks.insert(data.blocks.end(), {{"times", times},
                                         {"positions", positions},
                                         {"planes", planes},
                                         {"pairs", contacts.pairs},
                                         {"offsets", contacts.offsets},
                                         {"contacts", contacts.frames}});
  return data;
}

Blocks flow_blocks(const Scene& scene) {
  const auto& flows = scene.flows;
  if (flows.frames.empty()) return {};
  Bytes times, speeds, pressures, lines, offsets;
  for (const auto& frame : flows.frames) {
    assert(frame.frame < scene.playback.frames.size());
    append(times, scene.playback.frames[frame.frame].time);
    append_levels(speeds, frame.speed, flows.grid.columns,
                  [&](double speed) { return flows.top_speed > 0 ? speed / flows.top_speed : 0; });
    append_levels(pressures, frame.pressure, flows.grid.columns,
                  [&](double value) { return flows.pressure_colours.share_of(value); });
    append(offsets, static_cast<std::uint32_t>(lines.size() / sizeof(std::uint16_t)));
    append_lines(lines, frame, flows.grid.window);
  }
  append(offsets, static_cast<std::uint32_t>(lines.size() / sizeof(std::uint16_t)));
  return {{"flow-times", times},
          {"flow-speed", speeds},
          {"flow-pressure", pressures},
          {"flow-lines", lines},
          {"flow-offsets", offsets}};
}

}  // namespace viscontact::particles
