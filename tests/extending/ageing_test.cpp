// The film that ages, of docs/extending.md, against the closed forms of its chapter.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr double kStep = 0.01, kLowest = -2, kAgeingTime = 2, kPressedUntil = 2;

/// Largest rounding error of a gamma or an age of magnitude 2 and less that is the sum of 400
/// terms: each sum is rounded by at most half a unit in the last place of 2. Each term, a force
/// times a difference of two times up to 4, has an error of about the same size.
constexpr double kRounding = 400 * 4 * std::numeric_limits<double>::epsilon();

/// The case of the page with a frame for each step: a force 1 presses the disc on the plane until
/// t = 2 and then pulls it with 1.
std::string pressed_and_pulled(const std::string& end_time, const std::string& law) {
  return R"(title = "A disc pressed on a plane"
[space]
dimension = 2
[viscous_contact]
time_step = 0.01
end_time = )" +
         end_time + "\n" + law + R"(
[output]
every = 0.01
[[plane]]
point = [0.0, 0.0]
normal = [0.0, 1.0]
[[particle]]
centre = [0.0, 1.0]
radius = 1.0
mass = 1.0
force = [ { until = 2.0, value = [0.0, -1.0] }, { until = 4.0, value = [0.0, 1.0] } ]
)";
}

constexpr const char* kAgeing = "gamma_min = -2.0\nageing_time = 2.0";

class AgeingFilm : public ::testing::Test {
 protected:
  fs::path out(const std::string& name) const { return folder_.path() / name; }

  ProcessResult run(const std::string& text, const std::string& name,
                    const std::vector<std::string>& options = {}) const {
    const auto path = folder_.path() / (name + ".toml");
    put_text(path, text);
    std::vector<std::string> command = {VISCONTACT_EXTENDED, "particles", path.string(), "-o",
                                        out(name).string()};
    command.insert(command.end(), options.begin(), options.end());
    return run_process(command);
  }
  void expect_done(const ProcessResult& result) const {
    EXPECT_EQ(result.exit_status, 0) << result.output;
  }
  std::string content(const std::string& name, const std::string& file) const {
    return results::without_provenance(read_file(out(name) / file));
  }
  /// The number that the only contact of a frame has in an array; not a number without a contact.
  double in_frame(const std::string& name, int frame, const char* array) const {
    auto number = std::to_string(frame);
    number.insert(0, 5 - number.size(), '0');
    const auto path = out(name) / ("particles_" + number + ".vtp");
    const std::string text = read_file(path);
    const auto values = VtkReader(text, path.string(), "frame").array<double>("CellData", array);
    EXPECT_LE(values.size(), 1U);
    return values.empty() ? std::numeric_limits<double>::quiet_NaN() : values.front();
  }
  /// The velocity vy of the disc at the end.
  double last_velocity(const std::string& name) const {
    const auto text = content(name, "final_particles.csv");
    auto field = text.find("\n0,");
    for (int column = 0; column < 4; ++column) field = text.find(',', field + 1);
    return std::stod(text.substr(field + 1));
  }

 private:
  TemporaryFolder folder_;
};

// gamma = -F t until F t* = -gamma_min(0)/(1 + t*/T), then gamma_min(0)/(1 + t/T). With F = 1,
// gamma_min(0) = -2 and T = 2, t* = sqrt(5) - 1, which is 0.4 steps from the nearest step.
TEST_F(AgeingFilm, GivesWayWhenItsAgeSaysSo) {
  expect_done(run(pressed_and_pulled("2.0", kAgeing), "pressed"));
  const double gives_way = kAgeingTime / 2 * (std::sqrt(1 - 4 * kLowest / kAgeingTime) - 1);
  EXPECT_NEAR(gives_way, std::sqrt(5.0) - 1, 1e-15);
  for (int n = 1; n <= 200; ++n) {
    const double t = n * kStep;
    const double expected = t < gives_way ? -t : kLowest / (1 + t / kAgeingTime);
    EXPECT_NEAR(in_frame("pressed", n, "gamma"), expected, kRounding) << t;
    EXPECT_NEAR(in_frame("pressed", n, "age"), t, kRounding) << t;
    EXPECT_NEAR(in_frame("pressed", n, "force"), 1, kRounding) << t;
  }
}

TEST_F(AgeingFilm, ShowsItsAgeInTheTableOfContacts) {
  expect_done(run(pressed_and_pulled("2.0", kAgeing), "pressed"));
  const auto text = content("pressed", "final_contacts.csv");
  EXPECT_THAT(text, HasSubstr(",age,force\n0,-1,"));
  // The age, and the force with which the floor holds the disc.
  const auto last = text.rfind(','), before = text.rfind(',', last - 1);
  EXPECT_NEAR(std::stod(text.substr(before + 1)), 2, kRounding);
  EXPECT_NEAR(std::stod(text.substr(last + 1)), 1, kRounding);
}

// At t = 2 gamma is -2/(1 + 2/T) with the ageing and -2 without. A force P = 1 gives it back in the
// time -gamma/P, in which |gamma| falls faster than the bound; then it moves the free disc.
TEST_F(AgeingFilm, LetsGoEarlierThanOneThatDoesNotAge) {
  expect_done(run(pressed_and_pulled("4.0", kAgeing), "ages"));
  expect_done(run(pressed_and_pulled("4.0", "gamma_min = -2.0"), "does_not"));
  const double gamma = kLowest / (1 + kPressedUntil / kAgeingTime);
  EXPECT_NEAR(last_velocity("ages"), 4 - kPressedUntil + gamma, kRounding);
  EXPECT_NEAR(last_velocity("does_not"), 4 - kPressedUntil + kLowest, kRounding);
}

// The film of a second contact is a new one: the disc is pulled off, pushed back, and meets a film
// of age 0.
TEST_F(AgeingFilm, IsNewAfterItHasLetGo) {
  auto text = pressed_and_pulled("4.0", kAgeing);
  const std::string force = text.substr(text.find("force = "));
  text.replace(
      text.find(force), force.size(),
      "force = [ { until = 1.0, value = [0.0, -1.0] }, { until = 2.5, value = [0.0, 1.0] }, "
      "{ until = 4.0, value = [0.0, -2.0] } ]\n");
  expect_done(run(text, "twice"));
  // Glued for the first time until t = 2; no contact until the disc is back.
  EXPECT_NEAR(in_frame("twice", 150, "age"), 1.5, kRounding);
  int back = 0;
  for (int n = 210; n <= 400 && back == 0; ++n)
    if (in_frame("twice", n, "gamma") < 0) back = n;
  ASSERT_GT(back, 250);
  EXPECT_NEAR(in_frame("twice", back, "age"), kStep, kRounding);
  EXPECT_NEAR(in_frame("twice", back + 10, "age"), 11 * kStep, kRounding);
}

// The interruption is at an age of 1.5, when the film has given way and gamma follows the age.
TEST_F(AgeingFilm, ContinuesFromARestartFileBitForBit) {
  expect_done(run(pressed_and_pulled("4.0", kAgeing), "whole"));
  expect_done(run(pressed_and_pulled("1.5", kAgeing), "half"));
  expect_done(run(pressed_and_pulled("4.0", kAgeing), "rest",
                  {"--restart", (out("half") / "restart.bin").string()}));
  for (const auto* file : {"final_particles.csv", "final_contacts.csv"})
    EXPECT_EQ(content("whole", file), content("rest", file)) << file;
  // The first line of restart.bin says how much each run has written; the rest has fewer frames.
  const auto state = [&](const char* run) {
    const auto text = content(run, "restart.bin");
    return text.substr(text.find('\n'));
  };
  EXPECT_EQ(state("whole"), state("rest"));
  // Frame n of the rest is frame 150 + n of the whole run.
  for (const int n : {0, 1, 50, 100}) {
    EXPECT_EQ(in_frame("rest", n, "age"), in_frame("whole", 150 + n, "age")) << n;
    EXPECT_EQ(in_frame("rest", n, "gamma"), in_frame("whole", 150 + n, "gamma")) << n;
  }
}

// In a fluid without inertia, all of the force on a disc at the wall is an impulse on the film.
TEST_F(AgeingFilm, AgesInAFluidAndShowsItsAgeInItsContacts) {
  expect_done(run(R"(title = "A disc pressed on the wall of a fluid"
[space]
dimension = 2
[fluid]
viscosity = 1.0
solver = ["python3", ")" VISCONTACT_SOURCE_FOLDER R"(/examples/stokes_drag.py"]
[domain]
disc = { radius = 8.0 }
[viscous_contact]
time_step = 0.1
end_time = 4.0
gamma_min = -2.0
ageing_time = 2.0
[output]
every = 0.1
[[particle]]
centre = [0.0, -6.8]
radius = 1.0
force = [0.0, -1.0]
)",
                  "fluid"));
  std::istringstream lines(content("fluid", "contacts.csv"));
  std::string line;
  while (std::getline(lines, line) && line.starts_with('#')) {
  }
  EXPECT_THAT(line, ::testing::EndsWith(",age,force"));
  double first_gamma = 0;
  int rows = 0;
  while (std::getline(lines, line)) {
    ++rows;
    std::istringstream fields(line);
    std::vector<double> numbers;
    for (std::string field; std::getline(fields, field, ',');) numbers.push_back(std::stod(field));
    ASSERT_EQ(numbers.size(), 10U);
    const double gamma = numbers[4], age = numbers[8];
    if (rows == 1) first_gamma = gamma;
    EXPECT_NEAR(age, 0.1 * rows, kRounding) << line;
    EXPECT_NEAR(gamma, std::max(first_gamma - (age - 0.1), kLowest / (1 + age / kAgeingTime)),
                kRounding)
        << line;
  }
  EXPECT_GT(rows, 20);
  EXPECT_LT(first_gamma, 0);
}

TEST_F(AgeingFilm, RefusesACaseWithoutEffectAndATimeOfZero) {
  const auto smooth = run(pressed_and_pulled("2.0", "ageing_time = 2.0"), "smooth");
  EXPECT_EQ(smooth.exit_status, 3);
  EXPECT_THAT(smooth.output, HasSubstr("ageing_time has no effect, because smooth particles"));
  const auto zero = run(pressed_and_pulled("2.0", "gamma_min = -2.0\nageing_time = 0.0"), "zero");
  EXPECT_EQ(zero.exit_status, 3);
  EXPECT_THAT(zero.output, HasSubstr("ageing_time"));
}

}  // namespace
}  // namespace viscontact
