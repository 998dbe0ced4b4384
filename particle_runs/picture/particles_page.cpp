// The page that plays a motion of particles. The scripts in particle_runs/picture/page read the
// keys of its JSON and find elements by their ids.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/common/text/base64.hpp"
#include "viscontact/particle_runs/picture/frame_picture.hpp"
#include "viscontact/particle_runs/picture/page_data.hpp"
#include "viscontact/particle_runs/picture/particles_picture.hpp"
#include "viscontact/particle_runs/picture/scene.hpp"
#include "viscontact/report/page.hpp"

namespace viscontact::particles {

// The texts of the files in page/, made by CMakeLists.txt, so that a page needs no other file.
std::string_view flow_script();
std::string_view particles_script();
std::string_view particles_style();

namespace {

constexpr int kScaleColours = 64;

struct FlowOfPage {
  std::string settings;          ///< a JSON object for flow.js; "null" if there is no flow
  Blocks blocks;                 ///< flow_blocks()
  std::string controls, legend;  ///< HTML; empty if there is no flow
};

/// A scale of colours: its words, a bar of its colours, and its numbers below. Words and numbers
/// are plain text without the characters <, > and &, because they are not escaped.
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

/// The scale of speeds is missing if all speeds are 0. If a case does not say its units, the scale
/// of pressures has the unit viscosity/time.
FlowOfPage flow_of_page(const Scene& scene) {
  FlowOfPage page{.settings = "null", .blocks = {}, .controls = "", .legend = ""};
  const auto& flows = scene.flows;
  if (flows.frames.empty()) return page;
  page.blocks = flow_blocks(scene);
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

// Number of colours of gamma, at least 2. Together with kFrictionColours there may be at most 256
// colours, because drawContacts() of picture.js numbers the colours of contacts by a byte.
constexpr int kPageColours = 24;

/// kStyle (scene.hpp) as a JSON object. A LineWidth is the list [share, least, most].
std::string style_of_page() {
  const auto line = [](const LineWidth& width) {
    return std::array{width.share, width.least, width.most};
  };
  return nlohmann::ordered_json{{"disc", kStyle.disc},
                                {"discInFluid", kStyle.disc_in_fluid},
                                {"discOfBody", kStyle.disc_of_body},
                                {"ball", kStyle.ball},
                                {"ballOfBody", kStyle.ball_of_body},
                                {"clearBall", kStyle.clear_ball},
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

/// The units of the case for the quantities on the page, or their dimensions in words if the case
/// does not say units, as a JSON object.
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

/// The elements of the page that the scripts read: the JSON object "motion", and the blocks of
/// motion and flow in base64. In the object, `low`, `step` and `bytes` encode positions (PageData);
/// `roomLow`, `roomHigh`, `cell` (place and periods), `meanRadius` and `hinges` are lengths [L];
/// `offsets` has Frame::offset of each frame, or nothing; `periods` has the nine numbers of
/// Frame::periods of each frame, or nothing; `gradient` is the mean velocity gradient of the cell
/// [1/T]; `lowest` is the lowest gamma [M L/T]; `topForce` is the force of the widest lines [M
/// L/T^2]. `springs` and `arms` are pairs of particles, numbered from 0. `allForces` is true if the
/// page has the forces of all contacts.
std::string data_of(const Scene& scene, const PageData& data, const FlowOfPage& flow) {
  const auto& playback = scene.playback;
  const auto listed = [](const report::ColourScale& scale) {
    return fmt::format("\"{}\"", fmt::join(scale.colours, "\",\""));
  };
  auto films = report::film_scale(-1, kPageColours, "");
  std::ranges::reverse(films.colours);
  // The ends of links are indices of particles. They are right only if all particles are shown.
  const auto& links = data.every_particle == 1 ? playback.links : DrawnLinks{};
  const auto ends_of = [](const std::vector<DrawnLinks::Ends>& ends) {
    std::vector<std::string> texts;
    for (const auto& [first, second] : ends) texts.push_back(fmt::format("[{},{}]", first, second));
    return fmt::format("{}", fmt::join(texts, ","));
  };
  std::string hinges;
  for (const auto& at : links.hinges)
    hinges += fmt::format("{}[{}]", hinges.empty() ? "" : ",", fmt::join(at, ","));
  std::vector<float> offsets;
  for (const auto f : data.frames)
    if (const auto offset = playback.frames[f].offset)
      offsets.push_back(static_cast<float>(*offset));
  std::vector<float> periods;
  for (const auto f : data.frames)
    if (const auto& vectors = playback.frames[f].periods)
      for (const auto& vector : *vectors)
        for (const double x : vector) periods.push_back(static_cast<float>(x));
  const auto list = [&](const auto& x) {
    return fmt::format("[{}]", fmt::join(x.begin(), x.begin() + playback.dimension, ","));
  };
  auto text = fmt::format(
      "<script type=\"application/json\" id=\"motion\">{{\"dimension\":{},\"up\":{},\"every\":{},"
      "\"bytes\":{},\"low\":{},\"step\":{},\"roomLow\":{},\"roomHigh\":{},\"lowest\":{},"
      "\"touching\":\"{}\",\"colours\":[{}],\"cell\":[{},{}],\"gradient\":[{}],\"hasAxis\":{},"
      "\"flow\":{},"
      "\"friction\":[{}],\"hasForces\":{},\"meanRadius\":{},\"hinges\":[{}],\"springs\":[{}],"
      "\"arms\":[{}],\"offsets\":[{}],\"periods\":[{}],\"topForce\":{},\"allForces\":{},"
      "\"topSpeed\":{},\"units\":{}"
      ",\"style\":{}}}"
      "</script>\n",
      playback.dimension, playback.up, data.every_particle, data.position_bytes, list(data.low),
      list(data.step), list(scene.box.low), list(scene.box.high), scene.lowest_gamma,
      report::kTouchingColour, listed(films), fmt::join(playback.cell.from, ","),
      fmt::join(playback.cell.lengths, ","), fmt::join(playback.cell.gradient, ","), scene.has_axis,
      flow.settings,
      playback.friction_coefficient ? listed(report::friction_scale(kFrictionColours, "")) : "",
      scene.top_force > 0, scene.mean_radius, hinges, ends_of(links.springs), ends_of(links.arms),
      fmt::join(offsets, ","), fmt::join(periods, ","), scene.top_force,
      scene.top_force > 0 && data.contacts && data.every_particle == 1, data.top_speed,
      units_of_page(scene), style_of_page());
  for (const auto* blocks : {&data.blocks, &flow.blocks})
    for (const auto& [name, bytes] : *blocks)
      text += fmt::format("<script type=\"application/octet-stream\" id=\"{}\">{}</script>\n", name,
                          to_base64(std::as_bytes(std::span(bytes))));
  return text;
}

/// Such as "3 discs, 1 ellipse", in the order in which the shapes come first.
std::string counts_of_shapes(const Playback& playback) {
  std::vector<std::pair<std::string_view, std::size_t>> counts;
  for (const auto& shape : playback.shapes) {
    auto found = std::ranges::find(counts, shape.name(), &decltype(counts)::value_type::first);
    if (found == counts.end()) found = counts.insert(found, {shape.name(), 0});
    ++found->second;
  }
  if (counts.empty())
    counts.emplace_back(playback.dimension == 2 ? "disc" : "sphere", playback.radii.size());
  std::string words;
  for (const auto& [name, count] : counts)
    words +=
        fmt::format("{}{} {}{}", words.empty() ? "" : ", ", count, name, count == 1 ? "" : "s");
  return words;
}

/// The numbers of particles and frames, the times, and what the page leaves out.
std::string words_for(const Playback& playback, const PageData& data) {
  const auto frames = playback.frames.size();
  std::string words = counts_of_shapes(playback);
  if (frames == 0) return words + ", no frames.";
  const auto unit = playback.units.are_said() ? " " + playback.units.time : "";
  words += fmt::format(", t = {:.4g}", playback.frames.front().time);
  if (frames > 1)
    words += fmt::format(" to {:.4g}{} in {} frames", playback.frames.back().time, unit, frames);
  else
    words += unit;
  words += ".";
  if (data.every_frame > 1) words += fmt::format(" One frame in {} is shown.", data.every_frame);
  if (data.every_particle > 1)
    words +=
        fmt::format(" One particle in {} is shown, with the contacts between the shown particles.",
                    data.every_particle);
  if (!data.contacts) words += " There are too many contacts for this page, so none are shown.";
  return words;
}

/// Scales of colours and the words that explain lines. What the scene does not show is left out.
/// The scale of the colours of particles is empty; a script fills it.
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

std::string particles_page(const Playback& original, const std::string& title, FlowFrames* flows) {
  std::vector<std::size_t> all(original.frames.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const auto shown = shown_flows(original);
  const auto scene = scene_of(original, all, shown.frames, shown.points);
  if (flows != nullptr) *flows = scene.flows;
  const auto flow = flow_of_page(scene);
  const auto data = page_data(scene, flow.blocks);
  const auto words = words_for(original, data);
  std::string page =
      report::page_head(title, particles_style(), false,
                        "<meta name=color-scheme content=\"light dark\">\n") +
      fmt::format("\n</head>\n<body>\n<header><h1>{}</h1>\n<p>{}</p>{}</header>\n",
                  report::escaped(title), words,
                  original.note.empty() ? "" : "<p>" + report::escaped(original.note) + "</p>");
  page += fmt::format(
      "<main>\n<div class=stage><canvas id=stage tabindex=0 role=img aria-label=\"Motion of {} The "
      "controls below choose the time.\"></canvas><output id=readout></output>"
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
      "<button type=button id=film>Save film</button>\n</div>\n{}</main>\n{}"
      "<p class=hint>The space bar plays and pauses. The keys ← and → go back and forward by one "
      "frame; Home and End go to the first and the last frame. {} Point at a particle to see its "
      "values. The address of the page keeps time, view and colours.</p>\n",
      report::escaped(words), flow.controls, legend(scene, flow),
      original.charts.empty() ? "" : "<div class=charts>" + original.charts + "</div>\n",
      scene.playback.dimension == 2 ? "Drag to move the picture; use the wheel or pinch to zoom."
                                    : "Drag to turn the picture, or with Shift or two fingers to "
                                      "move it; use the wheel or pinch to zoom.");
  page += data_of(scene, data, flow);
  page += fmt::format("<script>\n{}</script>\n<script>\n{}</script>\n</body></html>\n",
                      flow_script(), particles_script());
  return page;
}

}  // namespace viscontact::particles
