// Writes the HTML of the page: words, controls, scale of gamma, and the data in blocks of base64.
// The keys of the JSON and the ids of elements must agree with the scripts in
// report/particles/page.
#include "viscontact/report/particles/particles_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "viscontact/report/html/page.hpp"
#include "viscontact/report/page_texts.hpp"
#include "viscontact/report/particles/film_colours.hpp"
#include "viscontact/report/particles/flow/flow_frames.hpp"
#include "viscontact/report/particles/flow/flow_page.hpp"
#include "viscontact/report/particles/page_data.hpp"
#include "viscontact/report/particles/view_box.hpp"

namespace viscontact::report {
namespace {

using particles::Playback;

constexpr int kPageColours = 24;

/// The JSON and the blocks of numbers that the script reads. `box` is the part that is seen at
/// first.
std::string data_of(const Playback& playback, const PageData& data, double lowest,
                    const ViewBox& box, const FlowOfPage& flow, bool has_axis) {
  std::string colours;
  for (int c = 0; c < kPageColours; ++c)
    colours += fmt::format("{}\"{}\"", c == 0 ? "" : ",", film_colour(c, kPageColours));
  // The numbers of the ends are those of the drawn particles.
  const auto& links = data.every_particle == 1 ? playback.links : particles::DrawnLinks{};
  const auto ends_of = [](const std::vector<particles::DrawnLinks::Ends>& ends) {
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
      "\"touching\":\"{}\",\"colours\":[{}],\"cell\":[{},{},{},{}],\"hasAxis\":{},\"flow\":{},"
      "\"sliding\":{},\"hinges\":[{}],\"springs\":[{}],\"arms\":[{}]}}"
      "</script>\n",
      playback.dimension, data.every_particle, data.position_bytes, list(data.low), list(data.step),
      list(box.low), list(box.high), lowest, kTouchingColour, colours, playback.cell.from[0],
      playback.cell.from[1], playback.cell.lengths[0], playback.cell.lengths[1], has_axis,
      flow.settings, playback.has_friction ? fmt::format("\"{}\"", kSlidingColour) : "null", hinges,
      ends_of(links.springs), ends_of(links.arms));
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
  words += fmt::format(", t = {:.4g}", playback.frames.front().time);
  if (frames > 1)
    words += fmt::format(" to {:.4g} in {} frames", playback.frames.back().time, frames);
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

std::string legend(double lowest, const char* words, bool touching, bool sliding,
                   const FlowOfPage& flow) {
  std::string text = flow.legend;
  if (lowest < 0) {
    std::vector<std::string> colours;
    for (int c = kPageColours; c-- > 0;) colours.push_back(film_colour(c, kPageColours));
    std::vector<std::pair<double, std::string>> ticks;
    for (const double tick : film_ticks(lowest))
      ticks.emplace_back(1 - tick / lowest, film_tick_text(tick));
    text += scale_html(words, colours, ticks);
  }
  if (touching)
    text += fmt::format(
        "<div class=touching><span class=line style=\"background:{}\"></span> touching, no "
        "film</div>\n",
        kTouchingColour);
  if (sliding)
    text += fmt::format(
        "<div class=touching><span class=line style=\"background:{}\"></span> sliding</div>\n",
        kSlidingColour);
  return text.empty() ? "" : "<div class=legend>\n" + text + "</div>\n";
}

}  // namespace

std::string particles_page(const Playback& original, const std::string& title) {
  const auto playback = in_plane(original);
  const bool has_axis = original.dimension == 1;
  const double lowest = lowest_gamma(playback);
  const auto extent = flow_extent(playback, has_axis);
  ViewBox box;
  FlowOfPage flow{.settings = "null", .blocks = {}, .controls = "", .legend = ""};
  if (extent) {
    std::vector<std::size_t> all(playback.frames.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    box = view_box_of(playback, all, box_of(extent));
    const auto shown = shown_flows(playback);
    flow = flow_of_page(
        read_flows(playback, has_axis, common_part(*extent, box), shown.frames, shown.points),
        playback);
  }
  std::size_t bytes_of_flow = 0;
  for (const auto& [name, bytes] : flow.blocks) bytes_of_flow += base64_size(bytes.size());
  const auto data = page_data(playback, lowest, bytes_of_flow);
  if (!extent) box = view_box_of(playback, data.frames);
  const bool touching = std::ranges::any_of(playback.frames, has_contact_without_film);
  const bool sliding = std::ranges::any_of(playback.frames, has_sliding_contact);
  const bool flat = playback.dimension == 2;
  const auto words = words_for(original, data);
  std::string page = page_head(title, particles_style(), false,
                               "<meta name=color-scheme content=\"light dark\">\n") +
                     fmt::format("\n</head>\n<body>\n<header><h1>{}</h1>\n<p>{}</p></header>\n",
                                 escaped(title), words);
  page += fmt::format(
      "<main>\n<div class=stage><canvas id=stage tabindex=0 role=img aria-label=\"Motion of {} "
      "The controls below choose the time.\"></canvas><output id=readout></output>"
      "<noscript>This page plays a motion by a script, which is turned off.</noscript></div>\n"
      "<div class=controls>\n<button type=button id=play>Play</button>\n"
      "<input type=range id=time step=any aria-label=Time>\n<output id=clock for=time></output>\n"
      "<label>Speed <select id=speed><option value=.1>× 0.1<option value=.25>× 0.25<option "
      "value=.5>× 0.5<option value=1 selected>× 1<option value=2>× 2<option value=4>× 4</select>"
      "</label>\n<label><input type=checkbox id=films checked> Contacts</label>\n{}"
      "<button type=button id=whole>Whole view</button>\n</div>\n{}</main>\n"
      "<p class=hint>The space bar plays and pauses. The keys ← and → go back and forward "
      "by one frame; Home and End go to the first and the last frame. {} Point at a particle to "
      "see "
      "its values.</p>\n",
      escaped(words), flow.controls, legend(lowest, film_words(original), touching, sliding, flow),
      flat ? "Drag to move the picture; use the wheel or pinch to zoom."
           : "Drag to turn the picture, or with Shift or two fingers to move it; use the wheel or "
             "pinch to zoom.");
  page += data_of(playback, data, lowest, box, flow, has_axis);
  page += fmt::format("<script>\n{}</script>\n<script>\n{}</script>\n</body></html>\n",
                      flow_script(), particles_script());
  return page;
}

}  // namespace viscontact::report
