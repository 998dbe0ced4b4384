// Encodes positions, planes and contacts of the frames as binary numbers in base64.
#include "viscontact/report/particles/particles_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/report/html.hpp"
#include "viscontact/report/particles/film_colours.hpp"
#include "viscontact/report/particles/particles_page_texts.hpp"
#include "viscontact/report/particles/view_box.hpp"

namespace viscontact {
namespace {

using particles::Frame;
using particles::Playback;
using Bytes = std::vector<unsigned char>;

// The numbers are written as they are in memory, and the script reads them as little-endian.
static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kMostBytes = 24'000'000;  // of the page
constexpr std::size_t kMostInPage = 200'000;
constexpr int kPageColours = 24;

template <class Number>
void append(Bytes& bytes, Number value) {
  const auto at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

constexpr std::size_t base64_size(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

/// The bytes in base64 (RFC 4648).
std::string base64(const Bytes& bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(base64_size(bytes.size()));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t j = 0; j < 3; ++j) word = word << 8 | (j < left ? bytes[i + j] : 0U);
    for (std::size_t j = 0; j < 4; ++j)
      text += j <= left ? kDigits[word >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

/// Appends a number with seven bits in each byte, the lowest first. The eighth bit is set in all
/// bytes but the last.
void append_short(Bytes& bytes, std::uint32_t value) {
  for (; value >= 128; value >>= 7) bytes.push_back(static_cast<unsigned char>(value | 128));
  bytes.push_back(static_cast<unsigned char>(value));
}

/// How positions are written: as 16-bit multiples of `step` from `low` (bytes = 2) if `step` is
/// small compared with every particle, otherwise as 32-bit floats (bytes = 4). `low` and `step` are
/// in [L].
struct Grid {
  int bytes = 2;
  particles::Vector low{}, step{1, 1, 1};
};

Grid grid_of(const Playback& playback) {
  constexpr double kSteps = 65535, kSmall = 0.02;  // largest 16-bit number; step over radius
  const auto dimension = static_cast<std::size_t>(playback.dimension);
  Grid grid;
  for (std::size_t d = 0; d < dimension; ++d) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& frame : playback.frames)
      for (std::size_t i = d; i < frame.positions.size(); i += dimension) {
        low = std::min(low, static_cast<double>(frame.positions[i]));
        high = std::max(high, static_cast<double>(frame.positions[i]));
      }
    if (!(low <= high)) low = high = 0;
    grid.low[d] = low;
    grid.step[d] = (high - low) / kSteps;
  }
  const auto smallest = std::ranges::min_element(playback.radii);
  const double largest_step = *std::ranges::max_element(std::span(grid.step).first(dimension));
  // The comparison is negated so that a step that is not finite also leads to floats.
  if (smallest != playback.radii.end() && !(largest_step <= kSmall * *smallest))
    grid = {4, {0, 0, 0}, {1, 1, 1}};
  return grid;
}

/// The frames and particles that the page shows.
struct PageContent {
  std::vector<std::size_t> frames;
  std::size_t every_frame = 1, every_particle = 1;
  bool contacts = true;
};

PageContent choice_of(const Playback& playback, std::size_t every_frame) {
  PageContent choice;
  choice.every_frame = every_frame;
  choice.every_particle = playback.radii.size() / (kMostInPage + 1) + 1;
  for (std::size_t f = 0; f < playback.frames.size(); f += every_frame) choice.frames.push_back(f);
  if (!choice.frames.empty() && choice.frames.back() + 1 != playback.frames.size())
    choice.frames.push_back(playback.frames.size() - 1);
  return choice;
}

/// The contacts of all frames: a list of all pairs that are ever in contact, and for each frame the
/// contacts in it. A contact is written as its distance in the list from the contact before it, and
/// a byte for gamma from 0 (gamma = 0) to 255 (the lowest gamma).
struct Contacts {
  Bytes pairs;    ///< int32, int32: as in CurrentContact, by number of the drawn particle
  Bytes offsets;  ///< uint32: begin of each frame in `frames`, then the end
  Bytes frames;
};

using Pair = std::pair<std::int32_t, std::int32_t>;

Contacts contacts_of(const Playback& playback, const PageContent& choice, double lowest) {
  Contacts contacts;
  append(contacts.offsets, std::uint32_t{0});
  const auto every = static_cast<std::int32_t>(choice.every_particle);
  const auto shown = [&](const particles::CurrentContact& c) {
    return choice.contacts && c.second % every == 0 && (c.first < 0 || c.first % every == 0);
  };
  std::vector<Pair> pairs;
  for (const auto f : choice.frames)
    for (const auto& c : playback.frames[f].contacts)
      if (shown(c)) pairs.emplace_back(c.first, c.second);
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto& [first, second] : pairs) {
    append(contacts.pairs, first < 0 ? first : first / every);
    append(contacts.pairs, second / every);
  }
  std::vector<std::pair<std::uint32_t, unsigned char>> listed;
  for (const auto f : choice.frames) {
    listed.clear();
    for (const auto& c : playback.frames[f].contacts) {
      if (!shown(c)) continue;
      const auto at = std::ranges::lower_bound(pairs, Pair{c.first, c.second}) - pairs.begin();
      const double share = c.gamma < 0 ? std::clamp(c.gamma / lowest, 0.0, 1.0) : 0;
      const auto level = c.gamma < 0 ? std::max(1L, std::lround(255 * share)) : 0L;
      listed.emplace_back(static_cast<std::uint32_t>(at), static_cast<unsigned char>(level));
    }
    std::ranges::sort(listed);
    std::uint32_t before = 0;
    for (const auto& [at, level] : listed) {
      append_short(contacts.frames, at - before);
      contacts.frames.push_back(level);
      before = at;
    }
    append(contacts.offsets, static_cast<std::uint32_t>(contacts.frames.size()));
  }
  return contacts;
}

std::size_t shown_particles(const Playback& playback, const PageContent& choice) {
  return (playback.radii.size() + choice.every_particle - 1) / choice.every_particle;
}

/// The bytes in the page of the data that each frame has: positions, planes and time.
std::size_t frame_bytes(const Playback& playback, const PageContent& choice, const Grid& grid) {
  const auto planes = playback.frames.empty() ? 0 : playback.frames.front().planes.size();
  return base64_size(shown_particles(playback, choice) *
                         static_cast<std::size_t>(playback.dimension * grid.bytes) +
                     planes * 6 * sizeof(float) + sizeof(double));
}

/// Chooses as many frames as fit into kMostBytes, and encodes their contacts.
std::pair<PageContent, Contacts> fitting(const Playback& playback, const Grid& grid,
                                         double lowest) {
  constexpr std::size_t kRest = 200'000;  // bytes for script, style and words
  for (std::size_t every = 1;; every *= 2) {
    auto choice = choice_of(playback, every);
    const auto others = kRest + choice.frames.size() * frame_bytes(playback, choice, grid) +
                        base64_size(shown_particles(playback, choice) * sizeof(float)) *
                            (playback.ids.empty() ? 1 : 2);
    const bool last = choice.frames.size() <= 2;
    if (others > kMostBytes && !last) continue;
    auto contacts = contacts_of(playback, choice, lowest);
    const auto size = others + base64_size(contacts.pairs.size()) +
                      base64_size(contacts.offsets.size()) + base64_size(contacts.frames.size());
    if (size <= kMostBytes) return {std::move(choice), std::move(contacts)};
    if (last) {
      choice.contacts = false;
      contacts = contacts_of(playback, choice, lowest);
      return {std::move(choice), std::move(contacts)};
    }
  }
}

Bytes positions_of(const Playback& playback, const PageContent& choice, const Grid& grid) {
  const auto dimension = static_cast<std::size_t>(playback.dimension);
  Bytes bytes;
  bytes.reserve(choice.frames.size() * shown_particles(playback, choice) * dimension *
                static_cast<std::size_t>(grid.bytes));
  for (const auto f : choice.frames)
    for (std::size_t k = 0; k < playback.radii.size(); k += choice.every_particle)
      for (std::size_t d = 0; d < dimension; ++d) {
        const float x = playback.frames[f].positions[k * dimension + d];
        if (grid.bytes == 4)
          append(bytes, x);
        else
          append(bytes,
                 static_cast<std::uint16_t>(std::lround(
                     grid.step[d] > 0 ? std::clamp((x - grid.low[d]) / grid.step[d], 0.0, 65535.0)
                                      : 0.0)));
      }
  return bytes;
}

std::string block(std::string_view name, const Bytes& bytes) {
  return fmt::format("<script type=\"application/octet-stream\" id=\"{}\">{}</script>\n", name,
                     base64(bytes));
}

std::string list_of(const particles::Vector& x, int dimension) {
  return fmt::format("[{}]", fmt::join(x.begin(), x.begin() + dimension, ","));
}

std::string data_of(const Playback& playback, const PageContent& choice, const Contacts& contacts,
                    const Grid& grid, double lowest) {
  const auto room = view_box_of(playback, choice.frames);
  std::string colours;
  for (int c = 0; c < kPageColours; ++c)
    colours += fmt::format("{}\"{}\"", c == 0 ? "" : ",",
                           film_colour(static_cast<double>(c) / (kPageColours - 1)));
  Bytes radii, ids, times, planes;
  for (std::size_t k = 0; k < playback.radii.size(); k += choice.every_particle)
    append(radii, playback.radii[k]);
  for (std::size_t k = 0; k < playback.ids.size(); k += choice.every_particle)
    append(ids, playback.ids[k]);
  for (const auto f : choice.frames) {
    append(times, playback.frames[f].time);
    for (const auto& plane : playback.frames[f].planes) {
      for (const double x : plane.point) append(planes, static_cast<float>(x));
      for (const double x : plane.normal) append(planes, static_cast<float>(x));
    }
  }
  return fmt::format(
             "<script type=\"application/json\" id=\"motion\">{{\"dimension\":{},\"every\":{},"
             "\"bytes\":{},\"low\":{},\"step\":{},\"roomLow\":{},\"roomHigh\":{},\"lowest\":{},"
             "\"touching\":\"{}\",\"colours\":[{}]}}</script>\n",
             playback.dimension, choice.every_particle, grid.bytes,
             list_of(grid.low, playback.dimension), list_of(grid.step, playback.dimension),
             list_of(room.low, playback.dimension), list_of(room.high, playback.dimension), lowest,
             kTouchingColour, colours) +
         block("radii", radii) + (ids.empty() ? "" : block("ids", ids)) + block("times", times) +
         block("positions", positions_of(playback, choice, grid)) + block("planes", planes) +
         block("pairs", contacts.pairs) + block("offsets", contacts.offsets) +
         block("contacts", contacts.frames);
}

std::string words_for(const Playback& playback, const PageContent& choice) {
  const auto count = playback.radii.size(), frames = playback.frames.size();
  std::string words = fmt::format("{} {}{}", count, playback.dimension == 2 ? "disc" : "sphere",
                                  count == 1 ? "" : "s");
  if (frames == 0) return words + ", no frames.";
  words += fmt::format(", t = {:.4g}", playback.frames.front().time);
  if (frames > 1)
    words += fmt::format(" to {:.4g} in {} frames", playback.frames.back().time, frames);
  words += ".";
  if (choice.every_frame > 1)
    words += fmt::format(" Every {}{} frame is shown.", choice.every_frame,
                         choice.every_frame == 2 ? "nd" : "th");
  if (choice.every_particle > 1)
    words += fmt::format(" One particle in {} is shown, and contacts between those.",
                         choice.every_particle);
  if (!choice.contacts) words += " The contacts are too many for this page.";
  return words;
}

std::string legend(double lowest, bool touching) {
  std::string text;
  if (lowest < 0) {
    std::string colours;
    for (int c = kPageColours - 1; c >= 0; --c)
      colours += "," + film_colour(static_cast<double>(c) / (kPageColours - 1));
    std::string ticks;
    for (const double tick : film_ticks(lowest))
      ticks += fmt::format("<span style=\"left:{:.2f}%\">{}</span>", 100 * (1 - tick / lowest),
                           film_tick_text(tick));
    text += fmt::format(
        "<div class=films><span>{}</span>\n<div class=scale><div class=bar "
        "style=\"background:linear-gradient(to right{})\"></div>\n<div class=ticks>{}</div>"
        "</div></div>\n",
        kFilmWords, colours, ticks);
  }
  if (touching)
    text += fmt::format(
        "<div class=touching><span class=line style=\"background:{}\"></span> touching, no "
        "film</div>\n",
        kTouchingColour);
  return text.empty() ? "" : "<div class=legend>\n" + text + "</div>\n";
}

}  // namespace

std::string particles_page(const Playback& playback, const std::string& title) {
  const auto grid = grid_of(playback);
  const double lowest = lowest_gamma(playback);
  const auto [choice, contacts] = fitting(playback, grid, lowest);
  const bool touching = std::ranges::any_of(playback.frames, [](const Frame& frame) {
    return std::ranges::any_of(frame.contacts, [](const auto& c) { return !(c.gamma < 0); });
  });
  const bool flat = playback.dimension == 2;
  const auto words = words_for(playback, choice);
  // The Content-Security-Policy forbids the browser to load anything from elsewhere.
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n"
      "<meta name=viewport content=\"width=device-width,initial-scale=1\">\n"
      "<meta http-equiv=Content-Security-Policy content=\"default-src 'none'; style-src "
      "'unsafe-inline'; script-src 'unsafe-inline'\">\n"
      "<meta name=color-scheme content=\"light dark\">\n"
      "<title>{0}</title>\n<style>\n{1}</style>\n</head>\n<body>\n"
      "<header><h1>{0}</h1>\n<p>{2}</p></header>\n",
      escaped(title), particles_style(), words);
  page += fmt::format(
      "<main>\n<div class=stage><canvas id=stage tabindex=0 role=img aria-label=\"Motion of {} "
      "The controls below choose the time.\"></canvas><output id=readout></output>"
      "<noscript>This page plays a motion by a script, which is turned off.</noscript></div>\n"
      "<div class=controls>\n<button type=button id=play>Play</button>\n"
      "<input type=range id=time step=any aria-label=Time>\n<output id=clock for=time></output>\n"
      "<label>Speed <select id=speed><option value=.1>× 0.1<option value=.25>× 0.25<option "
      "value=.5>× 0.5<option value=1 selected>× 1<option value=2>× 2<option value=4>× 4</select>"
      "</label>\n<label><input type=checkbox id=films checked> Contacts</label>\n"
      "<button type=button id=whole>Whole view</button>\n</div>\n{}</main>\n"
      "<p class=hint>Space plays and pauses, ← and → go one frame, Home and End to the ends. {} "
      "Point at a particle to read it off.</p>\n",
      escaped(words), legend(lowest, touching),
      flat ? "Drag moves the picture, wheel or pinch zooms."
           : "Drag turns the picture, with Shift or two fingers moves it; wheel or pinch zooms.");
  page += data_of(playback, choice, contacts, grid, lowest);
  page += fmt::format("<script>\n{}</script>\n</body></html>\n", particles_script());
  return page;
}

}  // namespace viscontact
