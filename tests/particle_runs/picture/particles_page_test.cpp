// The page that plays a motion of particles, in a browser (chromium) and as text.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <tuple>

#include "tests/common/regular_expressions.hpp"
#include "tests/particle_runs/picture/page_reader.hpp"
#include "tests/particle_runs/picture/playbacks.hpp"
#include "viscontact/particle_runs/picture/particles_picture.hpp"
#include "viscontact/particle_runs/picture/scene.hpp"
#include "viscontact/report/pictures/colours.hpp"

namespace viscontact::particles {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Appended to a page: looks at the canvas at both ends, plays, points, zooms, turns, and gives
/// what it saw to tell().
constexpr std::string_view kReader = R"JS(
(async () => {
  const pause = () => new Promise(done => setTimeout(done, 60));
  const player = window.viscontactPlayer, canvas = document.getElementById('stage');
  const copy = document.createElement('canvas');
  const look = () => {
    copy.width = canvas.width;
    copy.height = canvas.height;
    const pen = copy.getContext('2d', {willReadFrequently: true});
    pen.drawImage(canvas, 0, 0);
    const {data} = pen.getImageData(0, 0, copy.width, copy.height);
    const colours = new Map();
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      const colour = data[i] << 16 | data[i + 1] << 8 | data[i + 2];
      colours.set(colour, (colours.get(colour) || 0) + 1);
      sum = (sum * 31 + colour) % 4294967291;
    }
    return {colours: colours.size, paper: Math.max(...colours.values()) / (data.length / 4), sum};
  };
  const press = (key, target = document.body) => target.dispatchEvent(
    new KeyboardEvent('keydown', {key, bubbles: true, cancelable: true}));
  const send = (Kind, type, x, y, more = {}) => {
    const box = canvas.getBoundingClientRect();
    canvas.dispatchEvent(new Kind(type, {
      bubbles: true, cancelable: true, pointerId: 1, pointerType: 'mouse',
      clientX: box.left + x * box.width, clientY: box.top + y * box.height, ...more}));
  };
  const found = {width: innerWidth, bodyWidth: document.documentElement.scrollWidth,
                 heading: document.querySelector('h1').textContent,
                 words: document.querySelector('header p').textContent,
                 ticks: document.querySelectorAll('.ticks span').length};
  await pause();
  found.first = look();
  player.seek(player.last);
  await pause();
  found.last = {...look(), time: Number(canvas.dataset.time),
                contacts: Number(canvas.dataset.contacts),
                clock: document.getElementById('clock').textContent};
  document.getElementById('films').click();
  await pause();
  found.withoutContacts = {...look(), contacts: Number(canvas.dataset.contacts)};
  document.getElementById('films').click();
  press('Home');
  await pause();
  found.home = player.time;
  press('ArrowRight');
  found.second = player.time;
  press('ArrowLeft');
  found.again = player.time;
  press(' ');
  for (let i = 0; i < 500 && player.playing && player.time === 0; ++i) await pause();
  found.played = player.time;
  press(' ');
  const stopped = player.time;
  await pause();
  found.stays = player.time === stopped;
  player.seek(player.last);
  for (let y = 0.02; y < 1 && !found.readout; y += 0.02)
    for (let x = 0.02; x < 1 && !found.readout; x += 0.02) {
      send(PointerEvent, 'pointermove', x, y);
      await pause();
      found.readout = document.getElementById('readout').textContent;
    }
  send(PointerEvent, 'pointerleave', 0, 0);
  await pause();
  const before = look();
  send(PointerEvent, 'pointerdown', 0.5, 0.5);
  send(PointerEvent, 'pointermove', 0.6, 0.55);
  send(PointerEvent, 'pointerup', 0.6, 0.55);
  send(PointerEvent, 'pointerleave', 0, 0);
  await pause();
  const dragged = look();
  send(WheelEvent, 'wheel', 0.3, 0.3, {deltaY: -300});
  await pause();
  const zoomed = look();
  document.getElementById('whole').click();
  await pause();
  found.drags = dragged.sum !== before.sum;
  found.zooms = zoomed.sum !== dragged.sum;
  found.comesBack = look().sum === before.sum;
  tell(found);
})();
)JS";

class ParticlesInBrowser : public ::testing::TestWithParam<int> {};

TEST_P(ParticlesInBrowser, MotionIsPlayedReadOffAndLookedAtFromElsewhere) {
  const auto found =
      read_page(particles_page(falling_row(GetParam(), 5, 5), "Five in a row"), kReader, 390);
  ASSERT_TRUE(found.is_object());
  // A phone: nothing sticks out.
  EXPECT_EQ(found["width"], 390);
  EXPECT_LE(found["bodyWidth"], 390);
  EXPECT_EQ(found["heading"], "Five in a row");
  EXPECT_THAT(found["words"].get<std::string>(), HasSubstr("t = 0 to 2 in 5 frames."));
  EXPECT_THAT(found["words"].get<std::string>(), Not(HasSubstr("shown")));
  EXPECT_GE(found["ticks"], 3);
  // Neither blank nor one colour; a canvas without particles has at most a few.
  EXPECT_GT(found["first"]["colours"], 10);
  EXPECT_LT(found["first"]["paper"], 0.99);
  EXPECT_NE(found["first"]["sum"], found["last"]["sum"]);
  EXPECT_EQ(found["last"]["time"], 2);
  EXPECT_EQ(found["last"]["clock"], "t = 2.00");
  EXPECT_EQ(found["last"]["contacts"], 4 + 5);
  EXPECT_EQ(found["withoutContacts"]["contacts"], 0);
  EXPECT_NE(found["withoutContacts"]["sum"], found["last"]["sum"]);
  EXPECT_EQ(found["home"], 0);
  EXPECT_EQ(found["second"], 0.5);
  EXPECT_EQ(found["again"], 0);
  EXPECT_GT(found["played"], 0);
  EXPECT_EQ(found["stays"], true);
  EXPECT_TRUE(has_match(found["readout"].get<std::string>(),
                        "^particle [0-4]: radius 1, at \\([0-9., ]*\\), "))
      << found["readout"];
  EXPECT_EQ(found["drags"], true);
  EXPECT_EQ(found["zooms"], true);
  EXPECT_EQ(found["comesBack"], true);
}

TEST_P(ParticlesInBrowser, BodiesLinksTurnsAndContactsThatSlideAreDrawn) {
  // Counts the points of some colours in the last frame, and reads off what the first particle is.
  constexpr std::string_view kColours = R"JS(
(async () => {
  const pause = () => new Promise(done => setTimeout(done, 60));
  const player = window.viscontactPlayer, canvas = document.getElementById('stage');
  player.seek(player.last);
  await pause();
  const copy = document.createElement('canvas');
  copy.width = canvas.width;
  copy.height = canvas.height;
  const pen = copy.getContext('2d', {willReadFrequently: true});
  pen.drawImage(canvas, 0, 0);
  const {data} = pen.getImageData(0, 0, copy.width, copy.height);
  const found = {spring: 0, sliding: 0, mark: 0};
  const names = {0x2b6e3f: 'spring', 0xd55e00: 'sliding', 0x4a4a44: 'mark'};
  for (let i = 0; i < data.length; i += 4) {
    const name = names[data[i] << 16 | data[i + 1] << 8 | data[i + 2]];
    if (name) ++found[name];
  }
  found.legend = document.querySelector('.legend').textContent;
  tell(found);
})();
)JS";
  const auto found = read_page(particles_page(linked_row(GetParam(), 3), "Linked"), kColours, 700);
  ASSERT_TRUE(found.is_object());
  EXPECT_GT(found["spring"], 10);
  EXPECT_GT(found["sliding"], 10);
  EXPECT_GT(found["mark"], 10);
  EXPECT_THAT(found["legend"].get<std::string>(), HasSubstr("sliding"));
}

TEST_P(ParticlesInBrowser, WidthsOfContactsAndColoursShowTheirQuantities) {
  auto motion = loaded_row(GetParam());
  motion.masses = {1, 2, 3, 4};
  motion.frames.at(0).speeds = {0, 0, 4, 4};
  const auto found = read_page(particles_page(motion, "Coloured"), R"JS(
(async () => {
  const pause = () => new Promise(done => setTimeout(done, 60));
  const player = window.viscontactPlayer, list = document.getElementById('colour');
  await pause();
  const contacts = player.contacts();
  const found = {choices: [...list.options].map(o => o.value),
                 widths: contacts.map(({width}) => width / contacts[0].width),
                 widest: contacts[0].width,
                 colours: contacts.map(({colour}) => colour),
                 legend: document.querySelector('.legend').textContent};
  for (const name of ['speed', 'radius', 'mass', 'force', '']) {
    list.value = name;
    list.dispatchEvent(new Event('change'));
    await pause();
    found[name || 'none'] = {...player.colouring(),
                             hidden: document.getElementById('particle-scale').hidden,
                             words: document.querySelector('#particle-scale span').textContent};
  }
  tell(found);
})();
)JS",
                               700);
  ASSERT_TRUE(found.is_object());
  // The scale is so large that the widest line has the limit of its width, which is that of the
  // still picture.
  EXPECT_EQ(found["widest"], kStyle.page_unit * kStyle.force_line.most);
  EXPECT_THAT(particles_picture(motion, "Coloured", 1),
              HasSubstr(fmt::format("stroke-width=\"{:.{}f}\"", kStyle.force_line.most,
                                    GetParam() == 2 ? 1 : 2)));
  // A byte has the force, so that shares are right to half of 1/255.
  EXPECT_EQ(found["widths"][0], 1);
  EXPECT_NEAR(found["widths"][1], 0.5, 0.002);
  EXPECT_NEAR(found["widths"][2], 0.25, 0.002);
  EXPECT_EQ(found["colours"], (nlohmann::json{report::friction_colour(0.5), report::kSlidingColour,
                                              report::kTouchingColour}));
  EXPECT_THAT(found["legend"].get<std::string>(), HasSubstr("widest from 4 [mass × length/time²]"));
  EXPECT_EQ(found["choices"], (nlohmann::json{"", "speed", "radius", "mass", "force"}));
  const auto near = [&](const char* name, std::vector<double> expected) {
    ASSERT_EQ(found[name]["values"].size(), 4U);
    // Speeds and forces have 8 bits.
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(found[name]["values"][k].get<double>(), expected[k], 0.02) << name << k;
    EXPECT_EQ(found[name]["hidden"], false);
  };
  ASSERT_NO_FATAL_FAILURE(near("speed", {0, 0, 4, 4}));
  near("radius", {1, 1, 1, 1});
  near("mass", {1, 2, 3, 4});
  near("force", {4, 6, 3, 1});
  EXPECT_EQ(found["mass"]["low"], 1);
  EXPECT_EQ(found["mass"]["high"], 4);
  EXPECT_EQ(found["speed"]["words"], "speed [length/time]");
  EXPECT_EQ(found["none"]["hidden"], true);
}

TEST_P(ParticlesInBrowser, TheAddressKeepsTimeViewAndColoursAndTheMotionIsSavedAsAFilm) {
  const auto found = read_page(particles_page(falling_row(GetParam(), 5, 5), "Five in a row"), R"JS(
(async () => {
  const pause = ms => new Promise(done => setTimeout(done, ms));
  const player = window.viscontactPlayer, canvas = document.getElementById('stage');
  await pause(500);
  const found = {begin: location.hash}, entries = history.length;
  player.seek(1.25);
  canvas.dispatchEvent(new WheelEvent('wheel', {
    bubbles: true, cancelable: true, clientX: 100, clientY: 150, deltaY: -300}));
  await pause(600);
  found.changed = location.hash;
  // The address of another time and view, and back.
  const open = hash => location.replace(document.URL.split('#')[0] + hash);
  open('#t=0.5&colour=radius');
  await pause(600);
  found.time = player.time;
  found.colour = document.getElementById('colour').value;
  found.whole = player.address();
  open(found.changed);
  await pause(600);
  found.back = player.address();
  for (const name of ['u', 'mass', 'constructor']) {  // mass: the page has none
    open(`#t=nothing&zoom=-3&colour=${name}`);
    await pause(600);
    found.wrong = {time: player.time, colour: document.getElementById('colour').value};
  }
  found.history = history.length - entries;
  document.getElementById('speed').value = 4;
  const film = await player.makeFilm();
  const head = new Uint8Array(await film.slice(0, 4).arrayBuffer());
  found.film = {size: film.size, type: film.type, head: [...head], time: player.time};
  tell(found);
})();
)JS",
                               700);
  ASSERT_TRUE(found.is_object());
  EXPECT_THAT(found["begin"].get<std::string>(), ::testing::StartsWith("#t=0"));
  EXPECT_THAT(found["changed"].get<std::string>(),
              ::testing::AllOf(HasSubstr("t=1.25"), HasSubstr("zoom=")));
  EXPECT_EQ(found["time"], 0.5);
  EXPECT_EQ(found["colour"], "radius");
  EXPECT_THAT(found["whole"].get<std::string>(), Not(HasSubstr("zoom=")));
  EXPECT_EQ(found["back"], found["changed"]);
  EXPECT_EQ(found["wrong"]["time"], 1.25);
  EXPECT_EQ(found["wrong"]["colour"], "");
  EXPECT_EQ(found["history"], 0);
  const auto film = found["film"];
  EXPECT_GT(film["size"], 1000);
  EXPECT_EQ(film["type"], "video/webm");
  EXPECT_EQ(film["head"], (nlohmann::json{0x1A, 0x45, 0xDF, 0xA3}));  // of EBML, WebM's container
  EXPECT_EQ(film["time"], 2);
}

TEST(ParticlesPage, HasTheUnitsOfTheCaseBesideItsNumbers) {
  auto motion = loaded_row(3);
  motion.units = {"mm", "s", "g"};
  const auto found = read_page(particles_page(motion, "Loaded"), R"JS(
setTimeout(() => {
  tell({legend: document.querySelector('.legend').textContent,
        clock: document.getElementById('clock').textContent,
        words: document.querySelector('header p').textContent});
}, 100);
)JS",
                               700);
  ASSERT_TRUE(found.is_object());
  EXPECT_THAT(found["legend"].get<std::string>(), HasSubstr("widest from 4 [g mm/s²]"));
  EXPECT_THAT(found["clock"].get<std::string>(), ::testing::EndsWith(" s"));
  EXPECT_THAT(found["words"].get<std::string>(), HasSubstr(", t = 0 s."));
  EXPECT_THAT(particles_picture(motion, "Loaded", 2), HasSubstr(" s</text>"));
}

INSTANTIATE_TEST_SUITE_P(Dimensions, ParticlesInBrowser, ::testing::Values(2, 3));

TEST(ParticlesPage, OneParticleInOneFrameStands) {
  auto named = one_particle();
  named.ids = {1207};
  const auto found = read_page(particles_page(named, "One"), kReader, 1200);
  ASSERT_TRUE(found.is_object());
  EXPECT_GT(found["first"]["colours"], 2);
  EXPECT_EQ(found["last"]["contacts"], 0);
  EXPECT_EQ(found["played"], 0);
  EXPECT_EQ(found["ticks"], 0);
  // A particle that has an id is named by it.
  EXPECT_EQ(found["readout"], "particle 1207: radius 0.5, at (3, 4), 0 contacts");
}

TEST_P(ParticlesInBrowser, ParticlesThatArePouredInAreShownFromTheirFirstFrameOn) {
  auto playback = falling_row(GetParam(), 4, 5);
  const auto dimension = static_cast<std::size_t>(GetParam());
  // The last particle comes in the fourth of five frames.
  for (std::size_t f = 0; f < 3; ++f) {
    auto& frame = playback.frames[f];
    std::fill_n(frame.positions.end() - GetParam(), dimension, std::nanf(""));
    std::erase_if(frame.contacts, [](const auto& contact) { return contact.second == 3; });
  }
  const auto svg = particles_picture(playback, "Poured", 5);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  std::size_t circles = 0;
  for (auto at = svg.find("<circle "); at != std::string::npos; at = svg.find("<circle ", at + 1))
    ++circles;
  EXPECT_EQ(circles, 3 * 3U + 2 * 4U);
  const auto found = read_page(particles_page(playback, "Poured"), R"JS(
(async () => {
  const player = window.viscontactPlayer, shown = [];
  const pen = document.getElementById('stage').getContext('2d'), lineTo = pen.lineTo.bind(pen);
  let lines = 0;
  pen.lineTo = (x, y) => { ++lines; lineTo(x, y); };
  const linesOfDrawing = async () => {
    await new Promise(done => setTimeout(done, 60));
    lines = 0;
    player.draw();
    return lines;
  };
  for (const time of [0, 1.3, 1.5, 2]) {
    player.seek(time);
    const all = await linesOfDrawing();
    document.getElementById('films').click();
    const others = await linesOfDrawing();
    document.getElementById('films').click();
    shown.push([player.particles(), player.contacts().length, all - others]);
  }
  tell(shown);
})();
)JS",
                               700);
  // The contacts of the nearer frame are drawn, at 1.3 without that of the particle that comes at
  // 1.5.
  EXPECT_EQ(found, (nlohmann::json{{3, 0, 0}, {3, 2, 2}, {4, 3, 3}, {4, 7, 7}}));
}

// Two discs or spheres that touch move along x out of the cell from 0 to 10, and come in again.
TEST_P(ParticlesInBrowser, ContactIsAsLongAsThePairIsApartWhileItCrossesAPeriod) {
  Playback playback;
  playback.dimension = GetParam();
  playback.radii = {1, 1};
  playback.cell.lengths = {10, 0, 0};
  for (const auto& [first, second, image] : {std::tuple{7.8F, 9.8F, 0}, {8.6F, 0.6F, 1}}) {
    Frame frame;
    frame.time = static_cast<double>(playback.frames.size());
    for (const float x : {first, second}) {
      frame.positions.push_back(x);
      frame.positions.resize(frame.positions.size() + static_cast<std::size_t>(GetParam()) - 1, 2);
    }
    frame.contacts = {{0, 1, 0, 0}};
    frame.contacts[0].image = image;
    playback.frames.push_back(frame);
  }
  const auto found = read_page(particles_page(playback, "Across"), R"JS(
(async () => {
  const player = window.viscontactPlayer, found = [];
  const pen = document.getElementById('stage').getContext('2d');
  const [moveTo, lineTo] = [pen.moveTo.bind(pen), pen.lineTo.bind(pen)];
  let from = 0, longest = 0;
  pen.moveTo = (x, y) => { from = x; moveTo(x, y); };
  pen.lineTo = (x, y) => { longest = Math.max(longest, Math.abs(x - from)); lineTo(x, y); };
  for (const time of [0, 0.3, 0.49, 0.51, 1]) {
    player.seek(time);
    await new Promise(done => setTimeout(done, 60));
    longest = 0;
    player.draw();
    found.push(longest);
  }
  tell(found);
})();
)JS",
                               700);
  ASSERT_EQ(found.size(), 5U);
  // By perspective, lines at both sides of the cell differ by 12 percent; the cell is 5 times as
  // long.
  for (const double length : found) EXPECT_NEAR(length / found[0].get<double>(), 1, 0.2);
}

/// A cell with these images has an offset, or period vectors.
class ParticlesPageOfACell : public ::testing::TestWithParam<bool> {};

TEST_P(ParticlesPageOfACell, DrawsImagesAndClearSpheresInACellThatIsPeriodicInSpace) {
  auto playback = sheared_pair();
  if (GetParam()) {
    playback.frames[0].offset.reset();
    playback.frames[0].periods = {Vector{10, 0, 0}, Vector{3, 10, 0}, Vector{0, 0, 10}};
  }
  playback.frames[0].contacts = {{0, 1, 0, 0}};
  playback.frames[0].contacts[0].normal_force = 1;
  const auto found = read_page(particles_page(playback, "Sheared in space"), R"JS(
(async () => {
  const found = [], pen = document.getElementById('stage').getContext('2d');
  const drawImage = pen.drawImage.bind(pen);
  pen.drawImage = (sprite, x, y, w, h) => {
    found.push([x + w / 2, y + h / 2, w, pen.globalAlpha]);
    drawImage(sprite, x, y, w, h);
  };
  window.viscontactPlayer.draw();
  tell(found);
})();
)JS",
                               700);
  // As in the still picture: the sphere at z = 2, then sphere 0 at the bottom, and its image at the
  // top.
  ASSERT_EQ(found.size(), 3U);
  const auto at = [&](std::size_t k, std::size_t n) { return found[k][n].get<double>(); };
  EXPECT_LT(at(0, 2), at(1, 2));
  EXPECT_LT(at(1, 2), at(2, 2));
  EXPECT_LT(at(2, 1), at(0, 1));
  EXPECT_LT(at(0, 1), at(1, 1));
  EXPECT_GT(at(2, 0), at(1, 0));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(at(k, 3), kStyle.clear_ball, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(OffsetOrVectors, ParticlesPageOfACell, ::testing::Bool());

// Disc 0 at (5, 0.3) touches the image of disc 1, which the shear brings to (5, -0.7) at the time
// 0.5; both discs have images at the opposite side.
TEST(ParticlesPage, DrawsImagesWhereTheShearHasMovedThem) {
  Playback playback;
  playback.radii = {0.5, 0.5};
  playback.cell = {{0, 0, 0}, {10, 10, 0}, {0, 1, 0, 0}};
  for (const double time : {0.0, 0.5}) {
    auto& frame = playback.frames.emplace_back();
    frame.time = time;
    frame.positions = {5, 0.3F, 9.8F, 9.3F};
    frame.contacts = {{0, 1, 0, 0, 0, image_number(0, -1)}};
  }
  playback.frames[1].positions[2] = 10;
  playback.links.arms = {{0, 1}};
  const auto found = read_page(particles_page(playback, "Sheared"), R"JS(
(async () => {
  const player = window.viscontactPlayer, found = {lines: [], discs: []};
  const pen = document.getElementById('stage').getContext('2d');
  const [moveTo, lineTo] = [pen.moveTo.bind(pen), pen.lineTo.bind(pen)];
  const drawImage = pen.drawImage.bind(pen);
  player.seek(0.5);
  await new Promise(done => setTimeout(done, 60));
  let from = [];
  pen.moveTo = (x, y) => { from = [x, y]; moveTo(x, y); };
  pen.lineTo = (x, y) => { found.lines.push([x - from[0], y - from[1]]); lineTo(x, y); };
  pen.drawImage = (sprite, x, y, w, h) => {
    found.discs.push([(x + w / 2) / w, (y + h / 2) / h]);
    drawImage(sprite, x, y, w, h);
  };
  player.draw();
  tell(found);
})();
)JS",
                               700);
  ASSERT_TRUE(found.is_object());
  // A contact and an arm, at both sides of the cell, are vertical; then the sides of the cell.
  int upright = 0;
  for (const auto& line : found["lines"])
    if (std::abs(line[0].get<double>()) < 1 && std::abs(line[1].get<double>()) < 100) ++upright;
  EXPECT_EQ(upright, 4);
  // In units of a diameter, which is 1: the first disc, then its image above.
  const auto& discs = found["discs"];
  ASSERT_GE(discs.size(), 4U);
  bool has_image = false;
  for (const auto& disc : discs)
    has_image =
        has_image || (std::abs(disc[0].get<double>() - discs[0][0].get<double>() - 5) < 0.01 &&
                      std::abs(discs[0][1].get<double>() - disc[1].get<double>() - 10) < 0.01);
  EXPECT_TRUE(has_image) << discs;
}

TEST(ParticlesPage, FetchesNothingAndTakesItsTitleAsText) {
  const auto page =
      particles_page(falling_row(2, 3, 3), "</title><script>alert(1)</script> & \"so\"");
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;so&quot;"));
  EXPECT_FALSE(has_match(page, "(src|href|action|data)=[\"']?(https?:)?//"));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
}

// results/provenance.cpp writes a line of its own there, and takes the line away again.
TEST(ParticlesPage, HasAPlaceForTheLineThatSaysHowItWasMade) {
  const auto playback = falling_row(2, 3, 3);
  const auto page = particles_page(playback, "</head>");
  EXPECT_EQ(page.find("</head>"), page.find("\n</head>") + 1);
  EXPECT_LT(page.find("</head>"), page.find("<body>"));
  const auto svg = particles_picture(playback, "<svg>", 2);
  EXPECT_EQ(svg.find(">", svg.find("<svg")), svg.find(">\n<title>"));
}

TEST(ParticlesPage, NeverOutgrowsABrowser) {
  // A row so long takes floats: 213 kB of text in a frame, and 53 kB for its contacts.
  const auto page = particles_page(falling_row(2, 20000, 300), "Many");
  EXPECT_LT(page.size(), 24'000'000U);
  EXPECT_GT(page.size(), 12'000'000U);
  EXPECT_THAT(page.substr(0, 20'000),
              HasSubstr("t = 0 to 149.5 in 300 frames. One frame in 4 is shown."));
}

// In nine frames positions, turns and speeds of 200000 plates take 22 MB, and what each plate has
// once takes 6 MB.
TEST(ParticlesPage, CountsWhatEachParticleHasOnce) {
  constexpr std::size_t kCount = 200000;
  Playback playback;
  playback.radii.assign(kCount, 1);
  playback.shapes.assign(kCount, Shape::plate(1, 0.1));
  playback.bodies.assign(kCount, -1);
  playback.ids.assign(kCount, 7);
  playback.frames.resize(9);
  for (auto& frame : playback.frames) {
    frame.time = static_cast<double>(&frame - playback.frames.data());
    frame.positions.assign(2 * kCount, 1);
    frame.angles.assign(kCount, 0);
  }
  EXPECT_LT(particles_page(playback, "Plates").size(), 24'000'000U);
  playback.shapes.clear();
  playback.bodies.clear();
  playback.links.springs.assign(200000, {100000, 100001});
  EXPECT_LT(particles_page(playback, "Links").size(), 24'000'000U);
}

TEST(ParticlesPage, DrawsSomeOfVeryMany) {
  const auto page = particles_page(falling_row(3, 450000, 2), "Very many");
  EXPECT_LT(page.size(), 24'000'000U);
  EXPECT_THAT(page, HasSubstr("One particle in 3 is shown"));
}

TEST(ParticlesPage, WithoutFramesSaysSo) {
  EXPECT_THAT(particles_page({}, "Nothing"), HasSubstr("0 discs, no frames."));
}

}  // namespace
}  // namespace viscontact::particles
