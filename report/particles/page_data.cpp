// Chooses the frames, particles and contacts that fit into the page, and encodes them. The format
// must agree with report/particles/page/motion.js, which reads it.
#include "viscontact/report/particles/page_data.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "viscontact/report/particles/view_box.hpp"

namespace viscontact::report {
namespace {

using particles::Playback;

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
/// byte for gamma from 0 (gamma = 0) to 255 (the lowest gamma) and, in a motion with friction, a
/// byte with its ContactFriction.
struct Contacts {
  Bytes pairs;    ///< int32, int32: as in CurrentContact, by number of the drawn particle
  Bytes images;   ///< int8: CurrentContact::image of each pair
  Bytes offsets;  ///< uint32: begin of each frame in `frames`, then the end
  Bytes frames;   ///< as said above
};

using Pair = std::array<std::int32_t, 3>;  // both particles and the image of the second

Contacts contacts_of(const Playback& playback, const PageData& data, double lowest) {
  Contacts contacts;
  append(contacts.offsets, std::uint32_t{0});
  const auto every = static_cast<std::int32_t>(data.every_particle);
  const auto shown = [&](const particles::CurrentContact& c) {
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
    unsigned char level, friction;
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
      listed.push_back({static_cast<std::uint32_t>(at), static_cast<unsigned char>(level),
                        static_cast<unsigned char>(c.friction)});
    }
    std::ranges::sort(listed, {}, &Listed::at);
    std::uint32_t before = 0;
    for (const auto& [at, level, friction] : listed) {
      append_short(contacts.frames, at - before);
      contacts.frames.push_back(level);
      if (playback.has_friction) contacts.frames.push_back(friction);
      before = at;
    }
    append(contacts.offsets, static_cast<std::uint32_t>(contacts.frames.size()));
  }
  return contacts;
}

/// Numbers that say how far a particle has turned: none, an angle, or a quaternion.
std::size_t numbers_of_turn(const Playback& playback) {
  const auto all_have = [&](const std::vector<float> particles::Frame::*member,
                            std::size_t numbers) {
    return !playback.frames.empty() && !playback.radii.empty() &&
           std::ranges::all_of(playback.frames, [&](const particles::Frame& frame) {
             return (frame.*member).size() == numbers * playback.radii.size();
           });
  };
  if (all_have(&particles::Frame::angles, 1)) return 1;
  return all_have(&particles::Frame::orientations, 4) ? 4 : 0;
}

/// Chooses frames, and whether contacts are shown, so that the page is not too large.
Contacts choose_content(PageData& data, const Playback& playback, double lowest,
                        std::size_t other_bytes) {
  constexpr std::size_t kMostBytes = 24'000'000, kMostParticles = 200'000;
  constexpr std::size_t kRest = 200'000;  // bytes for script, style and words
  data.every_particle = playback.radii.size() / (kMostParticles + 1) + 1;
  const auto particles = (playback.radii.size() + data.every_particle - 1) / data.every_particle;
  const auto planes = playback.frames.empty() ? 0 : playback.frames.front().planes.size();
  const auto positions =
      particles * static_cast<std::size_t>(playback.dimension * data.position_bytes);
  const auto angles = particles * numbers_of_turn(playback) * sizeof(float);
  const auto bytes_of_frame =
      base64_size(positions + angles + planes * 6 * sizeof(float) + sizeof(double));
  const auto radii_and_ids =
      base64_size(particles * sizeof(float)) * (playback.ids.empty() ? 1 : 2);
  for (std::size_t every = 1;; every *= 2) {
    choose_frames(data, playback, every);
    const auto others = kRest + other_bytes + data.frames.size() * bytes_of_frame + radii_and_ids;
    const bool last = data.frames.size() <= 2;
    if (others > kMostBytes && !last) continue;
    auto contacts = contacts_of(playback, data, lowest);
    const auto size = others + base64_size(contacts.pairs.size()) +
                      base64_size(contacts.images.size()) + base64_size(contacts.offsets.size()) +
                      base64_size(contacts.frames.size());
    if (size <= kMostBytes) return contacts;
    if (!last) continue;
    data.contacts = false;
    return contacts_of(playback, data, lowest);
  }
}

}  // namespace

PageData page_data(const Playback& playback, double lowest_gamma, std::size_t other_bytes) {
  PageData data;
  choose_position_bytes(data, playback);
  auto contacts = choose_content(data, playback, lowest_gamma, other_bytes);
  Bytes radii, ids, bodies, times, positions, turns, planes;
  const auto turn_numbers = numbers_of_turn(playback);
  const auto dimension = static_cast<std::size_t>(playback.dimension);
  for (std::size_t k = 0; k < playback.radii.size(); k += data.every_particle) {
    append(radii, playback.radii[k]);
    if (!playback.ids.empty()) append(ids, playback.ids[k]);
    if (!playback.bodies.empty()) append(bodies, playback.bodies[k]);
  }
  for (const auto f : data.frames) {
    const auto& frame = playback.frames[f];
    append(times, frame.time);
    for (std::size_t k = 0; k < playback.radii.size(); k += data.every_particle)
      for (std::size_t d = 0; d < dimension; ++d) {
        const float x = frame.positions[k * dimension + d];
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
      const auto normal = plane.is_curved() ? particles::Vector{0, 0, plane.radius} : plane.normal;
      for (const auto* vector : {&plane.point, &normal})
        for (const double x : *vector) append(planes, static_cast<float>(x));
    }
  }
  data.blocks = {{"radii", radii}};
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

std::string base64(const Bytes& bytes) {
  std::string text(base64_size(bytes.size()), '\0');  // OpenSSL also writes the '\0' at its end
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(),
                  static_cast<int>(bytes.size()));
  return text;
}

}  // namespace viscontact::report
