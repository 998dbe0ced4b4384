// The flow in the page that plays a motion of particles, in a browser (chromium) and as text.
#include <gmock/gmock.h>

#include "tests/particle_runs/picture/page_reader.hpp"
#include "tests/particle_runs/picture/playbacks.hpp"
#include "tests/report/flow/flows.hpp"
#include "viscontact/particle_runs/picture/particles_picture.hpp"

namespace viscontact::particles {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Appended to a page with a flow: chooses what is drawn of it, and gives a sum of the pixels for
/// each choice to tell().
constexpr std::string_view kReader = R"JS(
(async () => {
  const pause = () => new Promise(done => setTimeout(done, 60));
  const player = window.viscontactPlayer, canvas = document.getElementById('stage');
  const choice = document.getElementById('flow'), lines = document.getElementById('streamlines');
  const copy = document.createElement('canvas');
  const pixels = () => {
    copy.width = canvas.width;
    copy.height = canvas.height;
    const pen = copy.getContext('2d', {willReadFrequently: true});
    pen.drawImage(canvas, 0, 0);
    return pen.getImageData(0, 0, copy.width, copy.height).data;
  };
  const look = () => {
    let sum = 0;
    for (const value of pixels()) sum = (sum * 31 + value) % 4294967291;
    return sum;
  };
  const colour = (x, y) => {
    const place = Math.round(y * canvas.height) * canvas.width + Math.round(x * canvas.width);
    return [...pixels().slice(4 * place, 4 * place + 3)];
  };
  const choose = async (field, withLines) => {
    choice.value = field;
    choice.dispatchEvent(new Event('change'));
    if (lines.checked !== withLines) lines.click();
    await pause();
    return look();
  };
  const found = {};
  found.speedAndLines = await choose('speed', true);
  found.speed = await choose('speed', false);
  const isHidden = id => document.getElementById(id).hidden;
  found.speedScale = !isHidden('speed-scale') && isHidden('pressure-scale');
  found.pressure = await choose('pressure', false);
  found.left = colour(0.1, 0.5);
  found.right = colour(0.9, 0.5);
  found.pressureScale = isHidden('speed-scale') && !isHidden('pressure-scale');
  found.none = await choose('none', false);
  found.noneWithLines = await choose('none', true);
  found.again = await choose('speed', true);
  player.seek(player.last);
  await pause();
  found.last = look();
  tell(found);
})();
)JS";

TEST(FlowPage, ShowsWhatIsChosenOfTheFlow) {
  const TemporaryFolder folder;
  const auto found =
      read_page(particles_page(disc_in_flow(folder, 3, report::turning), "Flow"), kReader, 900);
  ASSERT_TRUE(found.is_object());
  EXPECT_NE(found["speedAndLines"], found["speed"]);
  EXPECT_NE(found["speed"], found["pressure"]);
  EXPECT_NE(found["pressure"], found["none"]);
  EXPECT_NE(found["none"], found["noneWithLines"]);
  EXPECT_EQ(found["again"], found["speedAndLines"]);
  EXPECT_NE(found["last"], found["again"]);
  EXPECT_EQ(found["speedScale"], true);
  EXPECT_EQ(found["pressureScale"], true);
  // The pressure rises along x: blue is at the left, and red at the right.
  EXPECT_GT(found["left"][2], found["left"][0]);
  EXPECT_GT(found["right"][0], found["right"][2]);
}

TEST(FlowPage, ShowsAPeriodicFlowAndOneAroundAnAxis) {
  const TemporaryFolder folder;
  auto periodic = disc_in_flow(folder, 3, report::turning);
  periodic.cell = {{1, 0}, {4, 2}};
  periodic.radii = {0.5F, 0.5F};
  for (auto& frame : periodic.frames) {
    frame.positions = {1.2F, 0.6F, 4.7F, 1.8F};
    frame.angles = {0, 0};
    frame.contacts = {{0, 1, 0, -1, 0, image_number(-1, -1)}};
  }
  EXPECT_TRUE(read_page(particles_page(periodic, "Periodic"), kReader, 900).is_object());

  auto axis = disc_in_flow(folder, 3, report::turning);
  axis.dimension = 1;
  for (auto& frame : axis.frames) {
    frame.positions = {static_cast<float>(0.5 + 0.3 * frame.time)};
    frame.angles.clear();
    frame.planes = {{.point = {0, -4, 0}, .normal = {0, 1, 0}},
                    {.point = {0, 0, 0}, .normal = {1, 0, 0}},
                    {.point = {2, 0, 0}, .normal = {-1, 0, 0}}};
    frame.contacts = {{-2, 0, 0, -1}};
  }
  const auto page = particles_page(axis, "Axis");
  EXPECT_THAT(page, HasSubstr("1 sphere, "));
  EXPECT_TRUE(read_page(page, kReader, 900).is_object());
}

TEST(FlowPage, WithManyFlowsStaysSmall) {
  const TemporaryFolder folder;
  const auto page = particles_page(disc_in_flow(folder, 400, report::turning), "Many flows");
  EXPECT_LT(page.size(), 20'000'000U);
  EXPECT_GT(page.size(), 5'000'000U);
  EXPECT_THAT(page, HasSubstr("t = 0 to 399 in 400 frames."));
}

TEST(FlowPage, WithoutAFlowHasNoChoiceOfOne) {
  EXPECT_THAT(particles_page(falling_row(2, 3, 3), "Dry"), Not(HasSubstr("id=streamlines")));
}

}  // namespace
}  // namespace viscontact::particles
