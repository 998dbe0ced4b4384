// Writes the page that plays a motion: chooses the frames, particles and contacts that fit into it,
// encodes them as blocks of base64, and writes words, controls and scales. Numbers are in the units
// of the case; a flow that cannot be read is an Error(kBadInput). The layout of the data, the keys
// of the JSON and the ids of elements must agree with the scripts in particles/picture/page.
#include "viscontact/particles/picture/particles_page.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "viscontact/particles/picture/frame_picture.hpp"
#include "viscontact/particles/picture/scene.hpp"
#include "viscontact/report/page.hpp"

namespace viscontact::particles {

// The scripts and styles in page/, which are built into the executable (report/embed_texts.cmake),
// so that pages load nothing from elsewhere. CMakeLists.txt lists the same names with the files.
std::string_view flow_script();
std::string_view particles_script();
std::string_view particles_style();

namespace {

/// The number of characters that `bytes` bytes have in base64.
constexpr std::size_t base64_size(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

using Bytes = std::vector<unsigned char>;

/// The part of a motion that the page shows, and its encoding.
struct PageData {
  std::vector<std::size_t> frames;  ///< indices of the shown frames
  std::size_t every_frame = 1, every_particle = 1;
  bool contacts = true;
  /// Positions are 16-bit multiples of `step` from `low` (position_bytes = 2) if `step` is small
  /// compared with every particle, otherwise 32-bit floats (position_bytes = 4). `low` and `step`
  /// are in [L].
  int position_bytes = 2;
  std::array<double, 3> low{}, step{1, 1, 1};
  /// For each shown particle, the first of `frames` in which it is there. Empty: all are always there.
  std::vector<std::int32_t> first_frames{};
  double top_speed = 0;  ///< largest speed of the shown frames [L/T]; 0: not known
  /// Names and contents of the blocks of numbers in the page.
  std::vector<std::pair<const char*, Bytes>> blocks{};
};

// The numbers are written as they are in memory, and the script reads them as little-endian.
static_assert(std::endian::native == std::endian::little);

template <class Number>
void append(Bytes& bytes, Number value) {
  const auto at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// Appends a number with seven bits in each byte, the lowest first. The eighth bit is set in all
/// bytes but the last.
void append_short(Bytes& bytes, std::uint32_t value) {
  for (; value >= 128; value >>= 7) bytes.push_back(static_cast<unsigned char>(value | 128));
  bytes.push_back(static_cast<unsigned char>(value));
}

/// Chooses whether positions are written as 16-bit numbers or as floats.
void choose_position_bytes(PageData& data, const Playback& playback) {
  constexpr double kSteps = 65535, kSmall = 0.02;  // largest 16-bit number; step over radius
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
  // If the step is not finite, the comparison is false, and positions are written as floats.
  if (smallest == playback.radii.end() || largest_step <= kSmall * *smallest) return;
  data.position_bytes = 4;
  data.low = {0, 0, 0};
  data.step = {1, 1, 1};
}

/// Chooses every `every_frame`-th frame and the last one.
void choose_frames(PageData& data, const Playback& playback, std::size_t every_frame) {
  data.every_frame = every_frame;
  data.frames.clear();
  for (std::size_t f = 0; f < playback.frames.size(); f += every_frame) data.frames.push_back(f);
  if (!data.frames.empty() && data.frames.back() + 1 != playback.frames.size())
    data.frames.push_back(playback.frames.size() - 1);
}

/// The contacts of all frames: a list of all pairs that are ever in contact, and for each frame the
/// contacts in it. A contact is written as its distance in the list from the contact before it, a
/// byte for gamma from 0 (gamma = 0) to 255 (the lowest gamma); in a motion with friction a byte for
/// mobilised_friction(), 255 if it slides; and, if there are forces, a byte for force_share().
struct Contacts {
  Bytes pairs;    ///< int32, int32: as in CurrentContact, by number of the drawn particle
  Bytes images;   ///< int8: CurrentContact::image of each pair
  Bytes offsets;  ///< uint32: begin of each frame in `frames`, then the end
  Bytes frames;   ///< the contacts of the frames, in the form that the comment of Contacts says
};

using Pair = std::array<std::int32_t, 3>;  // both particles and the image of the second

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

/// Numbers that say how far a particle has turned: none, an angle, or a quaternion.
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

/// Chooses frames, and whether contacts are shown, so that the page is not too large.
Contacts choose_content(PageData& data, const Scene& scene, std::size_t other_bytes) {
  const auto& playback = scene.playback;
  constexpr std::size_t kMostBytes = 24'000'000, kMostParticles = 200'000;
  constexpr std::size_t kRest = 200'000;  // bytes for script, style and words
  data.every_particle = playback.radii.size() / (kMostParticles + 1) + 1;
  const auto particles = (playback.radii.size() + data.every_particle - 1) / data.every_particle;
  const auto planes = playback.frames.empty() ? 0 : playback.frames.front().planes.size();
  const auto positions =
      particles * static_cast<std::size_t>(playback.dimension * data.position_bytes);
  const auto angles = particles * numbers_of_turn(playback) * sizeof(float);
  // Speeds take a byte.
  const auto bytes_of_frame =
      base64_size(positions + angles + particles + planes * 6 * sizeof(float) + sizeof(double));
  const auto of_particles = static_cast<std::size_t>(1 + (playback.ids.empty() ? 0 : 1) +
                                                     (playback.masses.empty() ? 0 : 1));
  const auto radii_masses_and_ids = of_particles * base64_size(particles * sizeof(float));
  for (std::size_t every = 1;; every *= 2) {
    choose_frames(data, playback, every);
    const auto others =
        kRest + other_bytes + data.frames.size() * bytes_of_frame + radii_masses_and_ids;
    const bool last = data.frames.size() <= 2;
    if (others > kMostBytes && !last) continue;
    auto contacts = contacts_of(scene, data);
    const auto size = others + base64_size(contacts.pairs.size()) +
                      base64_size(contacts.images.size()) + base64_size(contacts.offsets.size()) +
                      base64_size(contacts.frames.size());
    if (size <= kMostBytes) return contacts;
    if (!last) continue;
    data.contacts = false;
    return contacts_of(scene, data);
  }
}

/// Finds out in which frame each particle is there first.
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

/// The speeds of the shown particles in the shown frames, a byte for each from 0 to `top_speed`.
/// Empty if they are not known or all are 0.
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

/// Chooses as many frames as fit into a page of 24 MB, of which `other_bytes` are taken, and
/// encodes them. If even two frames are too large, the contacts are left out.
PageData page_data(const Scene& scene, std::size_t other_bytes) {
  const auto& playback = scene.playback;
  PageData data;
  choose_position_bytes(data, playback);
  auto contacts = choose_content(data, scene, other_bytes);
  Bytes radii, masses, semi_axes, plates, ids, bodies, times, positions, turns, planes;
  const auto turn_numbers = numbers_of_turn(playback);
  const auto dimension = static_cast<std::size_t>(playback.dimension);
  for (std::size_t k = 0; k < playback.radii.size(); k += data.every_particle) {
    append(radii, playback.radii[k]);
    if (!playback.masses.empty()) append(masses, playback.masses[k]);
    if (!playback.semi_axes.empty())
      for (const double axis : playback.semi_axes[k]) append(semi_axes, static_cast<float>(axis));
    if (!playback.plates.empty()) append(plates, playback.plates[k]);
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
      // In two dimensions, a third component of the normal is the radius of a circle.
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
  if (!plates.empty()) data.blocks.emplace_back("plates", plates);
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

/// The bytes in base64 (RFC 4648).
std::string base64(const Bytes& bytes) {
  std::string text(base64_size(bytes.size()), '\0');  // OpenSSL also writes the '\0' at its end
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(),
                  static_cast<int>(bytes.size()));
  return text;
}

constexpr int kScaleColours = 64;          // of a scale; the page interpolates between them
constexpr double kLevels = 254;            // highest level of a byte
constexpr unsigned char kNothing = 255;    // level of a point without flow
constexpr std::uint16_t kNoArrow = 65535;  // place of the arrow of a line without one
constexpr double kLineSteps = 65535;       // steps of a coordinate across the window

/// The parts of the page that show the flow; all empty if there is none.
struct FlowOfPage {
  std::string settings;  ///< a JSON object; "null" if there is no flow
  /// Names and contents of blocks of numbers: times [T] as doubles; for each flow and point a byte
  /// of the speed and of the pressure, 0 to 254 from the lower to the upper end of the scale, 255
  /// where there is no flow; streamlines as 16-bit numbers (the number of lines; for each line the
  /// number of its points, the place of its arrow or 65535, and its points as multiples of 1/65535
  /// of the window), and the begin of each flow in them, then the end.
  std::vector<std::pair<const char*, Bytes>> blocks;
  std::string controls, legend;  ///< HTML
};

/// Appends a byte for each value. `share` gives the place of a value on its scale, from 0 to 1.
template <class Share>
void append_levels(Bytes& bytes, const std::vector<float>& field, std::size_t columns,
                   const Share& share) {
  // The page interpolates between points, so that points just outside the flow need values.
  constexpr int kLayers = 3;
  std::vector<double> values(field.begin(), field.end());
  for (int layer = 0; layer < kLayers; ++layer) report::fill_next_to_known(values, columns);
  for (const double value : values)
    bytes.push_back(std::isnan(value) ? kNothing
                                      : static_cast<unsigned char>(std::lround(
                                            kLevels * std::clamp(share(value), 0.0, 1.0))));
}

void append_lines(Bytes& bytes, const FlowFrame& frame, const report::Window& window) {
  const auto write = [&](std::size_t number) { append(bytes, static_cast<std::uint16_t>(number)); };
  const auto step = [](double share) {
    return static_cast<std::size_t>(std::lround(kLineSteps * std::clamp(share, 0.0, 1.0)));
  };
  // A line with more points than a 16-bit number can count is left out, and so are lines beyond
  // that number.
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

/// HTML of a scale of colours.
std::string scale_html(const report::ColourScale& scale) {
  std::string places;
  for (const auto& [share, text] : scale.ticks)
    places += fmt::format("<span style=\"left:{:.2f}%\">{}</span>", 100 * share, text);
  return fmt::format(
      "<div class=films><span>{}</span>\n<div class=scale><div class=bar "
      "style=\"background:linear-gradient(to right,{})\"></div>\n<div class=ticks>{}</div>"
      "</div></div>\n",
      scale.words, fmt::join(scale.colours, ","), places);
}

FlowOfPage flow_of_page(const Scene& scene) {
  FlowOfPage page{.settings = "null", .blocks = {}, .controls = "", .legend = ""};
  const auto& flows = scene.flows;
  if (flows.frames.empty()) return page;
  Bytes times, speeds, pressures, lines, offsets;
  for (const auto& frame : flows.frames) {
    append(times, scene.playback.frames[frame.frame].time);
    append_levels(speeds, frame.speed, flows.grid.columns,
                  [&](double speed) { return flows.top_speed > 0 ? speed / flows.top_speed : 0; });
    append_levels(pressures, frame.pressure, flows.grid.columns,
                  [&](double value) { return flows.pressure_colours.share_of(value); });
    append(offsets, static_cast<std::uint32_t>(lines.size() / sizeof(std::uint16_t)));
    append_lines(lines, frame, flows.grid.window);
  }
  append(offsets, static_cast<std::uint32_t>(lines.size() / sizeof(std::uint16_t)));
  page.blocks = {{"flow-times", times},
                 {"flow-speed", speeds},
                 {"flow-pressure", pressures},
                 {"flow-lines", lines},
                 {"flow-offsets", offsets}};
  const auto& window = flows.grid.window;
  const auto& units = scene.playback.units;
  const auto speed =
      report::speed_scale(flows.top_speed, kScaleColours, units.unit_or_dimension(0, 1, -1));
  const auto pressure = flows.pressure_colours.scale(
      kScaleColours, units.are_said() ? units.unit_of(1, -1, -2) : "viscosity/time");
  const auto list = [](const auto& colours) {
    return fmt::format("{}", fmt::join(colours, "\",\""));
  };
  page.settings = fmt::format(
      "{{\"window\":[{},{},{},{}],\"columns\":{},\"rows\":{},\"hasAxis\":{},\"lineColour\":\"{}\","
      "\"speed\":[\"{}\"],\"pressure\":[\"{}\"]}}",
      window.left, window.right, window.bottom, window.top, flows.grid.columns, flows.grid.rows,
      flows.has_axis, report::kStreamLineColour, list(speed.colours), list(pressure.colours));
  page.controls =
      "<label>Flow <select id=flow><option value=speed selected>speed<option "
      "value=pressure>pressure<option value=none>none</select></label>\n"
      "<label><input type=checkbox id=streamlines checked> Streamlines</label>\n";
  if (flows.top_speed > 0) page.legend = "<div id=speed-scale>" + scale_html(speed) + "</div>\n";
  page.legend += "<div id=pressure-scale hidden>" + scale_html(pressure) + "</div>\n";
  return page;
}

constexpr int kPageColours = 24;

/// kStyle as JSON. A LineWidth is [share, least, most].
std::string style_of_page() {
  const auto line = [](const LineWidth& width) {
    return std::array{width.share, width.least, width.most};
  };
  return nlohmann::ordered_json{{"disc", kStyle.disc},
                                {"discInFluid", kStyle.disc_in_fluid},
                                {"discOfBody", kStyle.disc_of_body},
                                {"ball", kStyle.ball},
                                {"ballOfBody", kStyle.ball_of_body},
                                {"mark", kStyle.mark},
                                {"spring", kStyle.spring},
                                {"markDistance", kStyle.mark_distance},
                                {"markRadius", kStyle.mark_radius},
                                {"axisRadius", kStyle.axis_radius},
                                {"leastToward", kStyle.least_toward},
                                {"bodyLine", kStyle.body_line},
                                {"filmLine", line(kStyle.film_line)},
                                {"touchingLine", line(kStyle.touching_line)},
                                {"forceLine", line(kStyle.force_line)},
                                {"filmWithForce", line(kStyle.film_with_force)},
                                {"touchingWithForce", line(kStyle.touching_with_force)},
                                {"pageUnit", kStyle.page_unit},
                                {"arm", kStyle.arm},
                                {"springWidth", kStyle.spring_width},
                                {"springTurns", kStyle.spring_turns},
                                {"springEnd", kStyle.spring_end}}
      .dump();
}

/// The units of what the page shows as JSON, or their dimensions in words.
std::string units_of_page(const Scene& scene) {
  const auto& units = scene.playback.units;
  const int is_per_length = scene.is_per_length() ? 1 : 0;
  return nlohmann::ordered_json{{"areSaid", units.are_said()},
                                {"length", units.unit_or_dimension(0, 1, 0)},
                                {"time", units.unit_or_dimension(0, 0, 1)},
                                {"mass", units.unit_or_dimension(1, -is_per_length, 0)},
                                {"speed", units.unit_or_dimension(0, 1, -1)},
                                {"force", units.unit_or_dimension(1, 1 - is_per_length, -2)}}
      .dump();
}

/// The JSON and the blocks of numbers that the script reads.
std::string data_of(const Scene& scene, const PageData& data, const FlowOfPage& flow) {
  const auto& playback = scene.playback;
  const auto listed = [](const report::ColourScale& scale) {
    return fmt::format("\"{}\"", fmt::join(scale.colours, "\",\""));
  };
  auto films = report::film_scale(-1, kPageColours, "");
  std::ranges::reverse(films.colours);
  // The numbers of the ends are those of the drawn particles.
  const auto& links = data.every_particle == 1 ? playback.links : DrawnLinks{};
  const auto ends_of = [](const std::vector<DrawnLinks::Ends>& ends) {
    std::vector<std::string> texts;
    for (const auto& [first, second] : ends) texts.push_back(fmt::format("[{},{}]", first, second));
    return fmt::format("{}", fmt::join(texts, ","));
  };
  std::string hinges;
  for (const auto& at : links.hinges)
    hinges += fmt::format("{}[{}]", hinges.empty() ? "" : ",", fmt::join(at, ","));
  const auto list = [&](const auto& x) {
    return fmt::format("[{}]", fmt::join(x.begin(), x.begin() + playback.dimension, ","));
  };
  auto text = fmt::format(
      "<script type=\"application/json\" id=\"motion\">{{\"dimension\":{},\"every\":{},"
      "\"bytes\":{},\"low\":{},\"step\":{},\"roomLow\":{},\"roomHigh\":{},\"lowest\":{},"
      "\"touching\":\"{}\",\"colours\":[{}],\"cell\":[{},{}],\"hasAxis\":{},\"flow\":{},"
      "\"friction\":[{}],\"hasForces\":{},\"meanRadius\":{},\"hinges\":[{}],\"springs\":[{}],"
      "\"arms\":[{}],\"topForce\":{},\"allForces\":{},\"topSpeed\":{},\"units\":{},\"style\":{}}}"
      "</script>\n",
      playback.dimension, data.every_particle, data.position_bytes, list(data.low), list(data.step),
      list(scene.box.low), list(scene.box.high), scene.lowest_gamma, report::kTouchingColour,
      listed(films), fmt::join(playback.cell.from, ","), fmt::join(playback.cell.lengths, ","),
      scene.has_axis, flow.settings,
      playback.friction_coefficient ? listed(report::friction_scale(kFrictionColours, "")) : "",
      scene.top_force > 0, scene.mean_radius, hinges, ends_of(links.springs), ends_of(links.arms),
      scene.top_force, scene.top_force > 0 && data.contacts && data.every_particle == 1,
      data.top_speed, units_of_page(scene), style_of_page());
  for (const auto* blocks : {&data.blocks, &flow.blocks})
    for (const auto& [name, bytes] : *blocks)
      text += fmt::format("<script type=\"application/octet-stream\" id=\"{}\">{}</script>\n", name,
                          base64(bytes));
  return text;
}

std::string words_for(const Playback& playback, const PageData& data) {
  const auto count = playback.radii.size(), frames = playback.frames.size();
  std::string words = fmt::format("{} {}{}", count, playback.dimension == 2 ? "disc" : "sphere",
                                  count == 1 ? "" : "s");
  if (frames == 0) return words + ", no frames.";
  const auto unit = playback.units.are_said() ? " " + playback.units.time : "";
  words += fmt::format(", t = {:.4g}", playback.frames.front().time);
  if (frames > 1)
    words += fmt::format(" to {:.4g}{} in {} frames", playback.frames.back().time, unit, frames);
  else
    words += unit;
  words += ".";
  if (data.every_frame > 1)
    words += fmt::format(" Every {}{} frame is shown.", data.every_frame,
                         data.every_frame == 2 ? "nd" : "th");
  if (data.every_particle > 1)
    words +=
        fmt::format(" One particle in {} is shown, with the contacts between the shown particles.",
                    data.every_particle);
  if (!data.contacts) words += " There are too many contacts for this page, so none are shown.";
  return words;
}

std::string legend(const Scene& scene, const FlowOfPage& flow) {
  std::string text = flow.legend;
  if (scene.lowest_gamma < 0)
    text += scale_html(report::film_scale(scene.lowest_gamma, kPageColours, scene.film_words));
  if (scene.playback.friction_coefficient && scene.touches)
    text += scale_html(report::friction_scale(kFrictionColours, kFrictionWords));
  if (!scene.force_words.empty())
    text += fmt::format("<div class=touching>{}</div>\n", scene.force_words);
  if (scene.touches)
    text += fmt::format(
        "<div class=touching><span class=line style=\"background:{}\"></span> touching, no "
        "film</div>\n",
        report::kTouchingColour);
  if (scene.slides)
    text += fmt::format(
        "<div class=touching><span class=line style=\"background:{}\"></span> sliding</div>\n",
        report::kSlidingColour);
  return "<div class=legend>\n"
         "<div id=particle-scale class=films hidden><span></span>\n<div class=scale><div "
         "class=bar></div>\n<div class=ticks></div></div></div>\n" +
         text + "</div>\n";
}

}  // namespace

std::string particles_page(const Playback& original, const std::string& title) {
  std::vector<std::size_t> all(original.frames.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const auto shown = shown_flows(original);
  const auto scene = scene_of(original, all, shown.frames, shown.points);
  const auto flow = flow_of_page(scene);
  std::size_t bytes_of_flow = 0;
  for (const auto& [name, bytes] : flow.blocks) bytes_of_flow += base64_size(bytes.size());
  const auto data = page_data(scene, bytes_of_flow);
  const auto words = words_for(original, data);
  std::string page = report::page_head(title, particles_style(), false,
                                       "<meta name=color-scheme content=\"light dark\">\n") +
                     fmt::format("\n</head>\n<body>\n<header><h1>{}</h1>\n<p>{}</p></header>\n",
                                 report::escaped(title), words);
  page += fmt::format(
      "<main>\n<div class=stage><canvas id=stage tabindex=0 role=img aria-label=\"Motion of {} "
      "The controls below choose the time.\"></canvas><output id=readout></output>"
      "<noscript>This page plays a motion by a script, which is turned off.</noscript></div>\n"
      "<div class=controls>\n<button type=button id=play>Play</button>\n"
      "<input type=range id=time step=any aria-label=Time>\n<output id=clock for=time></output>\n"
      "<label>Speed <select id=speed><option value=.1>× 0.1<option value=.25>× 0.25<option "
      "value=.5>× 0.5<option value=1 selected>× 1<option value=2>× 2<option value=4>× 4</select>"
      "</label>\n<label><input type=checkbox id=films checked> Contacts</label>\n{}"
      "<label>Colour <select id=colour><option value=\"\" selected>none<option value=speed>speed"
      "<option value=radius>radius<option value=mass>mass<option "
      "value=force>force</select></label>\n"
      "<button type=button id=whole>Whole view</button>\n"
      "<button type=button id=film>Save film</button>\n</div>\n{}</main>\n"
      "<p class=hint>The space bar plays and pauses. The keys ← and → go back and forward "
      "by one frame; Home and End go to the first and the last frame. {} Point at a particle to "
      "see its values. The address of the page keeps time, view and colours.</p>\n",
      report::escaped(words), flow.controls, legend(scene, flow),
      scene.playback.dimension == 2
          ? "Drag to move the picture; use the wheel or pinch to zoom."
          : "Drag to turn the picture, or with Shift or two fingers to move it; use the wheel or "
            "pinch to zoom.");
  page += data_of(scene, data, flow);
  page += fmt::format("<script>\n{}</script>\n<script>\n{}</script>\n</body></html>\n",
                      flow_script(), particles_script());
  return page;
}

}  // namespace viscontact::particles
