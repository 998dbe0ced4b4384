// The still picture of a motion of particles, and its colours.
#include "viscontact/particle_runs/picture/particles_picture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <map>
#include <regex>
#include <vector>

#include "tests/common/regular_expressions.hpp"
#include "tests/common/well_formed_xml.hpp"
#include "tests/particle_runs/picture/playbacks.hpp"
#include "tests/report/flow/flows.hpp"
#include "viscontact/particle_runs/picture/scene.hpp"

namespace viscontact::particles {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count_of(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

/// Expects closed elements, and no "&" but those of the entities that the pictures use.
void expect_well_formed_picture(const std::string& svg) {
  expect_well_formed(svg);
  EXPECT_FALSE(has_match(svg, "&(?!(amp|lt|gt|quot);)"));
}

TEST(ParticlesPicture, HoldsEveryDiscInEveryPanel) {
  for (const int dimension : {2, 3})
    for (const int panels : {1, 2, 4, 5}) {
      const auto svg =
          particles_picture(falling_row(dimension, 7, 5), "Seven <fall> & \"rest\"", panels);
      SCOPED_TRACE(svg);
      expect_well_formed_picture(svg);
      EXPECT_EQ(count_of("<circle ", svg), static_cast<std::size_t>(panels * 7));
      EXPECT_EQ(count_of(">t = ", svg), static_cast<std::size_t>(panels));
      EXPECT_THAT(svg, HasSubstr(">t = 2<"));
      EXPECT_THAT(svg, HasSubstr("Seven &lt;fall&gt; &amp; &quot;rest&quot;"));
      EXPECT_THAT(svg, HasSubstr("film has absorbed [mass × length/time]"));
      EXPECT_THAT(svg, Not(HasSubstr("nan")));
    }
}

TEST(ParticlesPicture, ShowsBodiesLinksTurnsAndContactsThatSlide) {
  for (const int dimension : {2, 3}) {
    const auto svg = particles_picture(linked_row(dimension, 2), "Linked", 2);
    SCOPED_TRACE(svg);
    expect_well_formed_picture(svg);
    EXPECT_EQ(count_of("stroke=\"#2b6e3f\"", svg), 2U);                // springs
    EXPECT_EQ(count_of("<path stroke=\"#333\"", svg), 2U);             // arms
    EXPECT_EQ(count_of("<g fill=\"#fff\" stroke=\"#111\"", svg), 2U);  // hinges
    EXPECT_EQ(count_of(fmt::format("<path stroke=\"{}\"", report::kSlidingColour), svg), 1U);
    EXPECT_THAT(svg, HasSubstr("contacts that slide are orange"));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    // Five particles and the hinge in each panel; a dot on each disc, or the axes that are seen on
    // each sphere: three in the first frame, and two after it has turned by 0.4 about z.
    EXPECT_EQ(count_of("<circle ", svg), 2 * (5U + 1U) + (dimension == 2 ? 2 * 5U : 5 * (3U + 2U)));
    EXPECT_EQ(count_of("url(#body)", svg), dimension == 3 ? 4U : 0U);
  }
  EXPECT_THAT(particles_picture(falling_row(2, 5, 2), "Free", 2), Not(HasSubstr("orange")));
}

TEST(ParticlesPicture, WidthOfAContactIsItsForceAndItsColourTheMobilisedFriction) {
  for (const int dimension : {2, 3}) {
    const auto svg = particles_picture(loaded_row(dimension), "Loaded", 1);
    SCOPED_TRACE(svg);
    expect_well_formed_picture(svg);
    // The widths are written with one digit in the plane, and the widest is at most 12.
    std::map<std::string, double> widths;
    const std::regex line("<path stroke=\"(#[0-9a-f]{6})\" stroke-width=\"([0-9.]+)\"");
    for (auto at = std::sregex_iterator(svg.begin(), svg.end(), line); at != std::sregex_iterator();
         ++at)
      widths[(*at)[1]] = std::stod((*at)[2]);
    EXPECT_EQ(widths.size(), 3U);
    EXPECT_NEAR(widths[report::friction_colour(0.5)], 12, 0.051);
    EXPECT_NEAR(widths[report::kSlidingColour], 6, 0.051);
    EXPECT_NEAR(widths[report::kTouchingColour], 3, 0.051);
    EXPECT_THAT(svg, HasSubstr("line width: normal force, widest from 4 [mass × length/time²] on"));
    EXPECT_THAT(svg, HasSubstr(kFrictionWords));
  }
  // Most forces are seen beside an impact: here the largest of 100 contacts is no measure.
  auto impact = falling_row(2, 101, 2);
  for (auto& contact : impact.frames[1].contacts) contact.normal_force = contact.first < 0 ? 0 : -1;
  impact.frames[1].contacts.front().normal_force = 1e6;
  const auto scene = scene_of(impact, {0, 1}, {}, 2);
  EXPECT_EQ(scene.top_force, 1);
  EXPECT_EQ(force_share(scene, impact.frames[1].contacts.front()), 1);
}

/// The centres and radii of all circles.
std::vector<std::array<double, 3>> circles_in(const std::string& svg) {
  std::vector<std::array<double, 3>> circles;
  const std::regex circle("<circle cx=\"([0-9.-]+)\" cy=\"([0-9.-]+)\" r=\"([0-9.]+)\"");
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), circle); at != std::sregex_iterator();
       ++at)
    circles.push_back({std::stod((*at)[1]), std::stod((*at)[2]), std::stod((*at)[3])});
  return circles;
}

TEST(ParticlesPicture, OfAPeriodicCellInSpaceHasItsEdgesAndTheImagesAtItsSidesInPerspective) {
  auto playback = sheared_pair();
  const auto svg = particles_picture(playback, "Sheared", 1);
  SCOPED_TRACE(svg);
  expect_well_formed_picture(svg);
  EXPECT_EQ(count_of("stroke-dasharray", svg), 1U);
  EXPECT_THAT(svg, Not(HasSubstr("fill-opacity")));
  // From the back to the front: the sphere at z = 2, then sphere 0 and its image at (7, 10.5, 8), of
  // which the one that is higher, and seen from above, is nearer.
  const auto circles = circles_in(svg);
  ASSERT_EQ(circles.size(), 3U);
  EXPECT_LT(circles[0][2], circles[1][2]);
  EXPECT_LT(circles[1][2], circles[2][2]);
  EXPECT_LT(circles[2][1], circles[0][1]);  // y is upwards
  EXPECT_LT(circles[0][1], circles[1][1]);
  EXPECT_GT(circles[2][0], circles[1][0]);
  // The same with period vectors.
  auto strained = playback;
  strained.frames[0].offset.reset();
  strained.frames[0].periods = {Vector{10, 0, 0}, Vector{3, 10, 0}, Vector{0, 0, 10}};
  const auto other = particles_picture(strained, "Strained", 1);
  expect_well_formed_picture(other);
  EXPECT_EQ(count_of("stroke-dasharray", other), 1U);
  EXPECT_EQ(circles_in(other).size(), 3U);
  // Under the lines of forces spheres are translucent.
  playback.frames[0].contacts = {{0, 1, 0, 0}};
  playback.frames[0].contacts[0].normal_force = 1;
  const auto loaded = particles_picture(playback, "Loaded", 1);
  EXPECT_EQ(count_of("fill-opacity", loaded), 1U);
  EXPECT_LT(loaded.rfind("<circle "), loaded.find("<path stroke="));
}

TEST(ParticlesPicture, HasNoMorePanelsThanFrames) {
  const auto svg = particles_picture(one_particle(), "One", 6);
  expect_well_formed_picture(svg);
  EXPECT_EQ(count_of("<circle ", svg), 1U);
  EXPECT_THAT(svg, Not(HasSubstr("film has absorbed")));
  expect_well_formed_picture(particles_picture({}, "Nothing", 3));
}

TEST(ParticlesPicture, StaysSmall) {
  EXPECT_LT(particles_picture(falling_row(2, 1000, 10), "Discs", 6).size(), 1'000'000U);
  EXPECT_LT(particles_picture(falling_row(3, 1000, 10), "Spheres", 6).size(), 1'300'000U);
}

TEST(ParticlesPicture, OneThatHasFlownAwayDoesNotShrinkTheOthers) {
  auto playback = falling_row(2, 300, 3);
  const auto room = scene_of(playback, {0, 1, 2}, {}, 2).box;
  playback.frames[2].positions[1] = 1e6F;
  const auto with_flown = scene_of(playback, {0, 1, 2}, {}, 2).box;
  EXPECT_DOUBLE_EQ(with_flown.high[1], room.high[1]);
  // The floor is next to the row, and seen.
  EXPECT_LT(room.low[1], 0);
}

Playback discs_in_a_circle(double radius) {
  auto playback = falling_row(2, 3, 1);
  playback.frames[0].planes = {{.point = {2, 1, 0}, .normal = {}, .radius = radius}};
  playback.frames[0].contacts = {{-1, 0, 0, -1}};
  return playback;
}

TEST(ParticlesPicture, ShowsARoundWallAroundTheParticles) {
  const auto playback = discs_in_a_circle(4);
  const auto box = scene_of(playback, {0}, {}, 2).box;
  EXPECT_LT(box.low[0], -2);
  EXPECT_GT(box.high[0], 6);
  EXPECT_LT(box.low[1], -3);
  EXPECT_GT(box.high[1], 5);
  const auto svg = particles_picture(playback, "Circle", 1);
  expect_well_formed_picture(svg);
  EXPECT_EQ(count_of("<circle ", svg), 3U);
  EXPECT_EQ(count_of("fill-rule=\"evenodd\"", svg), 1U);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  // A wall far away does not make the particles small.
  const auto far = scene_of(discs_in_a_circle(1000), {0}, {}, 2).box;
  EXPECT_GT(far.low[0], -3);
}

TEST(ParticlesPicture, DrawsAContactAcrossAPeriodAtBothParticles) {
  auto playback = falling_row(2, 2, 1);
  playback.cell = {{-1, -10}, {4, 0}};
  playback.frames[0].planes.clear();
  // Without the image the line would go from x = 0 to x = 2.
  playback.frames[0].contacts = {{0, 1, 0, -1, 0, -1}};
  const auto across = particles_picture(playback, "Period", 1);
  playback.frames[0].contacts = {{0, 1, 0, -1, 0, 0}};
  const auto direct = particles_picture(playback, "Period", 1);
  expect_well_formed_picture(across);
  EXPECT_EQ(count_of("M", across), count_of("M", direct) + 1);
}

TEST(ParticlesPicture, ShowsTheFlowBehindTheDiscs) {
  const TemporaryFolder folder;
  auto playback = disc_in_flow(folder, 3, report::turning);
  playback.frames[1].flow.clear();
  const auto svg = particles_picture(playback, "Flow", 3);
  expect_well_formed_picture(svg);
  EXPECT_THAT(svg, HasSubstr("speed of the fluid [length/time]"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(scene_of(playback, {0}, {}, 2).film_words, HasSubstr("impulse per length"));
  // The panel without a flow has a disc with its mark, and no streamlines.
  EXPECT_EQ(count_of("stroke-opacity=\".6\"", svg), 2U);
  EXPECT_EQ(count_of("<circle ", svg), 6U);
  EXPECT_LT(svg.find("stroke-opacity=\".6\""), svg.find("<circle "));
  // The whole box is shown, although the disc stays near its middle.
  const auto box = scene_of(playback, {0, 1, 2}, {}, 2).box;
  EXPECT_LE(box.low[0], 0);
  EXPECT_GE(box.high[0], 4);
}

TEST(ParticlesPicture, MirrorsTheFlowAtTheAxis) {
  const TemporaryFolder folder;
  auto playback = disc_in_flow(folder, 1, report::turning);
  playback.dimension = 1;
  playback.frames[0].positions = {1};
  playback.frames[0].angles.clear();
  const auto svg = particles_picture(playback, "Axis", 1);
  expect_well_formed_picture(svg);
  EXPECT_THAT(scene_of(playback, {0}, {}, 2).film_words, HasSubstr("[mass × length/time]"));
  EXPECT_EQ(count_of("scale(-1 1)", svg), 1U);
  EXPECT_EQ(count_of("stroke-opacity=\".6\"", svg), 2U);
  EXPECT_EQ(count_of("<circle ", svg), 1U);
}

TEST(ParticlesPicture, ShowsTheCellWithImagesOfDiscsAtItsSides) {
  auto playback = one_particle();
  playback.cell = {{3, 0}, {10, 8}};
  const auto box = scene_of(playback, {0}, {}, 2).box;
  EXPECT_EQ(box.low[0], 3);
  EXPECT_EQ(box.high[0], 13);
  EXPECT_EQ(box.high[1], 8);
  // The disc of radius 0.5 at (3, 4) is cut by the left side.
  EXPECT_EQ(count_of("<circle ", particles_picture(playback, "Cell", 1)), 2U);
  playback.frames[0].positions = {3, 0};
  EXPECT_EQ(count_of("<circle ", particles_picture(playback, "Corner", 1)), 4U);
  playback.frames[0].positions = {8, 4};
  EXPECT_EQ(count_of("<circle ", particles_picture(playback, "Inside", 1)), 1U);
}

// In a sheared cell the image of the disc at the lower side has moved to the right by 0.5 * 8.
TEST(ParticlesPicture, ShowsImagesWhereTheShearHasMovedThem) {
  auto playback = one_particle();
  playback.cell = {{0, 0}, {10, 8}, {0, 1, 0, 0}};
  playback.frames[0].time = 0.5;
  playback.frames[0].positions = {3, 0};
  const auto svg = particles_picture(playback, "Sheared", 1);
  const std::regex circle("<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\" r=\"([0-9.]+)\"");
  std::vector<double> x, y;
  double r = 0;
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), circle); at != std::sregex_iterator();
       ++at) {
    x.push_back(std::stod((*at)[1]));
    y.push_back(std::stod((*at)[2]));
    r = std::stod((*at)[3]);
  }
  ASSERT_EQ(x.size(), 2U);
  // The radius is 0.5; numbers in the picture are rounded to 0.01.
  EXPECT_NEAR((x[1] - x[0]) / (2 * r), 4, 0.01);
  EXPECT_NEAR((y[0] - y[1]) / (2 * r), 8, 0.01);
}

TEST(ParticlesPicture, WordsOfScalesNeitherOverlapNorLeaveThePicture) {
  const TemporaryFolder folder;
  auto in_fluid = disc_in_flow(folder, 1, report::turning);
  in_fluid.friction_coefficient = 0.5;
  in_fluid.frames[0].planes = {{.point = {0, 0, 0}, .normal = {0, 1, 0}}};
  in_fluid.frames[0].contacts = {{-1, 0, 0, -1.0}, {-1, 0, 0, 0}};
  auto without_friction = linked_row(2, 3);
  without_friction.friction_coefficient.reset();
  std::size_t scales = 0;
  for (const auto& playback : {linked_row(2, 3), without_friction, in_fluid}) {
    const auto svg = particles_picture(playback, "Scales", 1);
    std::map<double, double> ends;  // the right end of the words before, by height
    for (const auto& match :
         matches_in(svg, "<text x=\"([0-9.]+)\" y=\"([0-9.]+)\">([^<]+)</text></g>")) {
      // A character of size 12 is about 6.2 wide on average; one of "×" has two bytes.
      const double middle = std::stod(match[1]), half = 3.1 * static_cast<double>(match[3].size());
      EXPECT_GE(middle - half, ends[std::stod(match[2])]) << match[3];
      EXPECT_LE(middle + half, 1000) << match[3];
      ends[std::stod(match[2])] = middle + half;
      ++scales;
    }
  }
  EXPECT_EQ(scales, 2U + 1 + 3);
}

TEST(ParticlesPicture, FilmsDarkenWithWhatTheyRemember) {
  const auto lightness = [](const std::string& colour) {
    double sum = 0;
    for (const std::size_t at : {1U, 3U, 5U}) sum += std::stoi(colour.substr(at, 2), nullptr, 16);
    return sum;
  };
  EXPECT_EQ(report::film_colour(0), "#fde725");
  EXPECT_EQ(report::film_colour(1), "#440154");
  EXPECT_GT(lightness(report::film_colour(0)), lightness(report::film_colour(0.5)));
  EXPECT_GT(lightness(report::film_colour(0.5)), lightness(report::film_colour(1)));
  const auto texts = [](double lowest) {
    std::string text;
    for (const auto& [share, number] : report::film_scale(lowest, 2, "").ticks)
      text += number + " ";
    return text;
  };
  EXPECT_EQ(texts(-8.9), "0 −2 −4 −6 −8 ");
  EXPECT_EQ(texts(-2), "0 −0.5 −1 −1.5 −2 ");
}

}  // namespace
}  // namespace viscontact::particles
