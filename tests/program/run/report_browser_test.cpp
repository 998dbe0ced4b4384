// report.html in a browser (chromium): no error, no network, the curves are there, the pointer
// reads them off, drags zoom.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/program/browser.hpp"
#include "tests/program/run/report.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Plays the reader.
constexpr std::string_view kReader = R"JS(
(async () => {
  const pause = () => new Promise(done => setTimeout(done, 60));
  const found = {width: innerWidth, bodyWidth: document.documentElement.scrollWidth, panels: []};
  for (const figure of document.querySelectorAll('figure[data-plot]')) {
    const plot = JSON.parse(figure.querySelector('script').textContent);
    const places = [...figure.querySelectorAll('.panel')];
    for (const [k, place] of places.entries()) {
      const u = place.uplot, described = plot.panels[k];
      const {left, top, width, height} = u.bbox;
      const pixels = u.ctx.getImageData(left, top, width, height).data;
      const painted = colour => {
        const rgb = [1, 3, 5].map(i => parseInt(colour.slice(i, i + 2), 16));
        let count = 0;
        for (let i = 0; i < pixels.length; i += 4)
          if (pixels[i + 3] > 128 && Math.abs(pixels[i] - rgb[0]) +
              Math.abs(pixels[i + 1] - rgb[1]) + Math.abs(pixels[i + 2] - rgb[2]) < 60) ++count;
        return count;
      };
      const box = u.over.getBoundingClientRect();
      const send = (type, x, y, target = u.over) => target.dispatchEvent(new MouseEvent(type, {
        bubbles: true, button: 0, movementX: 1, movementY: 1,  // uPlot passes over moves by nothing
        clientX: box.left + x * box.width, clientY: box.top + y * box.height}));
      const rows = [...place.querySelectorAll('.legend tr')];
      const values = () => rows.map(row => row.lastChild.textContent);
      const scales = () => ['x', 'y'].map(name => [u.scales[name].min, u.scales[name].max]);
      const seen = {plot: plot.name, values: [],
                    painted: described.curves.map(c => painted(c.colour)),
                    legend: rows.map(row => row.children[1].textContent)};
      // Abscissae of other curves within an interval where a curve is interrupted: uPlot draws
      // through those that are undefined.
      seen.undefined = 0;
      seen.interrupted = 0;
      place.curves.forEach((curve, i) => {
        const ys = u.data[i + 1], at = curve.inner.x.map(x => u.data[0].indexOf(x));
        for (let k = 1; k < at.length; ++k)
          if (curve.y[k - 1] === null || curve.y[k] === null) {
            const between = ys.slice(at[k - 1] + 1, at[k]);
            seen.interrupted += between.length;
            seen.undefined += between.filter(y => y === undefined).length;
          }
      });
      send('mouseenter', 0.3, 0.5);
      for (const x of [0.25, 0.5, 0.8]) {
        send('mousemove', x, 0.5);
        await pause();
        seen.values.push(values());
      }
      seen.before = scales();
      send('mousemove', 0.3, 0.3); send('mousedown', 0.3, 0.3); await pause();
      send('mousemove', 0.6, 0.7); await pause();
      send('mouseup', 0.6, 0.7); await pause();
      seen.zoomed = scales();
      send('dblclick', 0.5, 0.5); await pause();
      seen.after = scales();
      found.panels.push(seen);
    }
  }
  tell(found);
})();
)JS";

/// Expects of each panel that its curves are drawn, that the pointer reads them, and that it zooms.
void expect_readable_panels(const Json& found) {
  std::set<std::string> plots;
  for (const auto& panel : found["panels"]) {
    const std::string name = panel["plot"];
    SCOPED_TRACE(name);
    plots.insert(name);
    for (const int painted : panel["painted"]) EXPECT_GT(painted, 10);
    EXPECT_EQ(panel["undefined"], 0);
    if (name == "gap_logarithmic") {
      EXPECT_GT(panel["interrupted"], 100);
    }
    EXPECT_NE(panel["values"][0], panel["values"][1]);
    EXPECT_NE(panel["values"][1], panel["values"][2]);
    // Drawn from 0.3 to 0.6 of the width and from 0.3 to 0.7 of the height; a pixel is 0.2 % of
    // them.
    for (const auto& [axis, share] : {std::pair(0, 0.3), std::pair(1, 0.4)}) {
      const auto length = [axis = axis](const Json& scales) {
        return scales[static_cast<std::size_t>(axis)][1].get<double>() -
               scales[static_cast<std::size_t>(axis)][0].get<double>();
      };
      EXPECT_NEAR(length(panel["zoomed"]) / length(panel["before"]), share, 0.01);
    }
    EXPECT_EQ(panel["after"], panel["before"]);
  }
  EXPECT_THAT(plots, ::testing::IsSupersetOf({"thinnest_film", "gap", "gap_logarithmic",
                                              "external_force", "gamma", "fit", "uncertainty"}));
}

/// Expects that the pointer in the panel of the gap reads the value of the trajectory.
void expect_value_of_trajectory(const Json& found, const fs::path& file) {
  const auto& panels = found["panels"];
  const auto gap = std::ranges::find_if(panels, [](const auto& p) { return p["plot"] == "gap"; });
  ASSERT_NE(gap, panels.end());
  const std::vector<std::string> legend = (*gap)["legend"];
  const auto row = std::ranges::find(legend, "with inertia, CVODE") - legend.begin();
  ASSERT_LT(row, std::ssize(legend));
  const auto trajectory = reduced_model::read_trajectory(file).rows;
  const std::vector<std::string> values = (*gap)["values"][0];
  const double time = std::stod(values[0]);
  const double shown = std::stod(values[static_cast<std::size_t>(row)]);
  EXPECT_GT(time, 0.5);
  EXPECT_LT(time, 1.5);
  const auto after =
      std::ranges::lower_bound(trajectory, time, {}, &reduced_model::TrajectoryRow::time);
  ASSERT_NE(after, trajectory.end());
  // The page holds every tenth row or so and draws lines between them.
  EXPECT_NEAR(shown / after->gap, 1, 0.02);
}

// One test, because each runs in a process of its own and would make the report again.
TEST_F(Report, InABrowserHasCurvesThatAreReadOffAndZoomed) {
  run_lecture();
  for (const int width : {1200, 360}) {
    const auto found = read_in_browser(page(), kReader, width);
    ASSERT_TRUE(found.is_object());
    // Nothing sticks out, on a phone either.
    EXPECT_EQ(found["width"], width);
    EXPECT_LE(found["bodyWidth"], width);
    if (width == 1200) expect_readable_panels(found);
    expect_value_of_trajectory(found, folder() / "trajectories" / "inertial.csv");
  }
}

}  // namespace
}  // namespace viscontact
