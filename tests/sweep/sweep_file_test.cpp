// The file of a sweep: whole, cut off anywhere, and of another sweep.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <stdexcept>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/sweep/sphere_study.hpp"
#include "viscontact/sweep/study.hpp"

namespace viscontact::sweep {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::uint64_t kRows = 20;

std::filesystem::path data(const std::string& name) {
  return std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data" / name;
}

class SweepFile : public ::testing::Test {
 protected:
  /// The study of the time step with a case, a force and a fit of its own, that a test may change.
  SweepFile() {
    auto text = read_file(data("cases/time_step.toml"));
    const auto place = text.find("forces/jumps.csv");
    text.replace(place, 16, "force.csv");
    put_text(path("case.toml"), text);
    put_text(path("force.csv"), read_file(data("cases/forces/jumps.csv")));
    plan_.case_path = path("case.toml");
    plan_.fit = lubrication::read_fit(data("fits/leading_term.json"));
    plan_.points.variations = {parse_variation("viscous_contact.time_step=1e-2:1e-1:log:20")};
    plan_.models = {"viscous_contact_exact", "viscous_contact"};
    plan_.reference = "viscous_contact_exact";
  }

  std::filesystem::path path(const std::string& name) const { return scratch_.path() / name; }

  std::uint64_t write(const std::string& name, int jobs = 2) {
    calls_ = 0;
    return write_sweep(sphere_study(plan_, version_), path(name), jobs, "",
                       [&](std::uint64_t done, std::uint64_t size) {
                         ++calls_;
                         EXPECT_LE(done, size);
                         EXPECT_EQ(size, plan_.points.rows());
                       });
  }

  /// The file of a sweep that nothing disturbs.
  std::string undisturbed() {
    write("undisturbed.csv");
    return read_file(path("undisturbed.csv"));
  }

  TemporaryFolder scratch_;
  SpherePlan plan_;
  std::string version_ = "1.2.3";
  int calls_ = 0;  // of progress
};

TEST_F(SweepFile, IsTheSameForAnyNumberOfThreads) {
  EXPECT_EQ(write("one.csv", 1), kRows);
  EXPECT_GT(calls_, 0);
  EXPECT_EQ(write("two.csv", 2), kRows);
  EXPECT_EQ(read_file(path("one.csv")), read_file(path("two.csv")));
  EXPECT_THAT(scratch_.names(), Not(::testing::Contains(HasSubstr(".part"))));
}

TEST_F(SweepFile, HasItsHeaderAndItsRows) {
  const auto text = undisturbed();
  const auto comments = read_csv_comments(text);
  EXPECT_EQ(comments.at("viscontact"), "sweep");
  EXPECT_EQ(comments.at("case"), sha256(read_file(path("case.toml"))));
  EXPECT_EQ(comments.at("fit"), sha256(lubrication::write_fit(plan_.fit)));
  EXPECT_EQ(comments.at("reference"), "viscous_contact_exact");
  EXPECT_EQ(comments.at("version of Viscontact"), "1.2.3");
  const auto csv =
      read_csv<2>(path("undisturbed.csv"),
                  {"viscous_contact.time_step", "viscous_contact.sup_gap_distance"}, 2);
  ASSERT_EQ(csv.rows.size(), kRows);
  const auto sweep = sphere_study(plan_, version_);
  std::string rows;
  for (std::uint64_t i = 0; i < kRows; ++i) {
    EXPECT_EQ(*csv.rows[i].fields[0], plan_.points.variations[0].value(i));
    rows += sweep.row(i);
  }
  EXPECT_TRUE(text.ends_with("failure\n" + rows));
}

TEST_F(SweepFile, GoesOnWhereItWasCutOff) {
  const auto whole = undisturbed();
  // Where each row begins, and where the last one ends.
  std::vector<std::size_t> begins = {whole.find("failure\n") + 8};
  while (begins.back() < whole.size()) begins.push_back(whole.find('\n', begins.back()) + 1);
  ASSERT_EQ(begins.size(), kRows + 1);
  for (std::uint64_t row : {0U, 1U, 7U, 19U}) {
    const auto middle = (begins[row] + begins[row + 1]) / 2;
    for (const auto cut : {begins[row], begins[row] + 1, middle, begins[row + 1] - 1}) {
      put_text(path("cut.csv.part"), whole.substr(0, cut));
      EXPECT_EQ(write("cut.csv"), kRows - row) << row << " at " << cut;
      EXPECT_EQ(read_file(path("cut.csv")), whole) << row << " at " << cut;
      EXPECT_FALSE(std::filesystem::exists(path("cut.csv.part")));
      std::filesystem::remove(path("cut.csv"));
    }
  }
  // Killed after the last row and before the file had its name.
  put_text(path("cut.csv.part"), whole);
  EXPECT_EQ(write("cut.csv"), 0U);
  EXPECT_EQ(read_file(path("cut.csv")), whole);
  EXPECT_FALSE(std::filesystem::exists(path("cut.csv.part")));
}

TEST_F(SweepFile, KeepsItsRowsWhenSomethingElseEndsIt) {
  const auto whole = undisturbed();
  const auto stop = [](std::uint64_t done, std::uint64_t) {
    if (done == 13) throw std::domain_error("the end");
  };
  EXPECT_THROW(write_sweep(sphere_study(plan_, version_), path("table.csv"), 2, "", stop),
               std::domain_error);
  EXPECT_FALSE(std::filesystem::exists(path("table.csv")));
  EXPECT_EQ(write("table.csv"), kRows - 13);
  EXPECT_EQ(read_file(path("table.csv")), whole);
}

TEST_F(SweepFile, PartThatIsNoBeginningOfItIsThrownAway) {
  const auto whole = undisturbed();
  const auto header = whole.substr(0, whole.find("failure\n") + 8);
  auto other = whole;
  other[other.find("# sweep: ") + 9] ^= 1;  // of another plan
  for (const auto& part :
       {other, header.substr(0, header.size() / 2), header.substr(0, header.size() - 1),
        std::string(), std::string("time,gap\n1,2\n")}) {
    put_text(path("table.csv.part"), part);
    EXPECT_EQ(write("table.csv"), kRows) << part.substr(0, 80);
    EXPECT_EQ(read_file(path("table.csv")), whole);
    std::filesystem::remove(path("table.csv"));
  }
}

TEST_F(SweepFile, PartOfTheSweepWithOtherValuesIsThrownAway) {
  const auto whole = undisturbed();
  plan_.points.variations = {parse_variation("viscous_contact.time_step=2e-2:1e-1:log:20")};
  put_text(path("table.csv.part"), whole);
  EXPECT_EQ(write("table.csv"), kRows);
  EXPECT_NE(read_file(path("table.csv")), whole);
}

TEST_F(SweepFile, FinishedFileIsNotTouched) {
  const auto whole = undisturbed();
  using std::chrono::hours;
  const auto long_ago = std::filesystem::last_write_time(path("undisturbed.csv")) - hours(1);
  std::filesystem::last_write_time(path("undisturbed.csv"), long_ago);
  EXPECT_EQ(write("undisturbed.csv"), 0U);
  EXPECT_EQ(calls_, 0);
  EXPECT_EQ(std::filesystem::last_write_time(path("undisturbed.csv")), long_ago);
  EXPECT_EQ(read_file(path("undisturbed.csv")), whole);
  EXPECT_FALSE(std::filesystem::exists(path("undisturbed.csv.part")));
}

TEST_F(SweepFile, FileThatLacksRowsIsMadeAgain) {
  const auto whole = undisturbed();
  put_text(path("table.csv"), whole.substr(0, whole.size() - 1));
  EXPECT_EQ(write("table.csv"), kRows);
  EXPECT_EQ(read_file(path("table.csv")), whole);
}

TEST_F(SweepFile, IsMadeAgainForWhateverDecidesItsRows) {
  const auto original = plan_;
  write("table.csv");
  const auto expect_made_again = [&](const char* what, const std::function<void()>& change) {
    change();
    EXPECT_EQ(write("table.csv"), plan_.points.rows()) << what;
    EXPECT_EQ(write("table.csv"), 0U) << what;
  };
  expect_made_again("case", [&] {
    auto text = read_file(path("case.toml"));
    text.replace(text.find("viscosity = 0.1"), 15, "viscosity = 0.2");
    put_text(path("case.toml"), text);
  });
  expect_made_again("force",
                    [&] { put_text(path("force.csv"), "time,force\n0,-2\n2,-2\n2,2\n6,2\n"); });
  expect_made_again("fit", [&] { plan_.fit.gap_interval[0] = 1e-200; });
  expect_made_again("limit below",
                    [&] { plan_.outside.below = lubrication::BelowInterval::kLubricationLimit; });
  expect_made_again("limit above",
                    [&] { plan_.outside.above = lubrication::AboveInterval::kStokesLimit; });
  expect_made_again("reference", [&] { plan_.reference = "viscous_contact"; });
  expect_made_again("models", [&] { plan_.models.emplace_back("inelastic_contact"); });
  expect_made_again("version", [&] { version_ = "1.2.4"; });
  expect_made_again("spacing", [&] { plan_.points.variations[0].logarithmic = false; });
  expect_made_again("end", [&] { plan_.points.variations[0].last = 0.09; });
  expect_made_again("list", [&] {
    plan_.points.variations = {parse_variation("viscous_contact.time_step=0.1,0.05")};
  });
  expect_made_again("its order", [&] { std::ranges::reverse(plan_.points.variations[0].values); });
  expect_made_again("samples", [&] { plan_.points.samples = 2; });
  expect_made_again("seed", [&] { plan_.points.seed = 2; });
}

TEST_F(SweepFile, MakesItsFolderAndSaysWhereItCannotWrite) {
  EXPECT_EQ(write("new/folder/table.csv"), kRows);
  put_text(path("file"), "");
  EXPECT_THAT(bad_input([&] { write("file/table.csv"); }), IsAt(path("file")));
  std::filesystem::create_directory(path("folder.csv"));
  EXPECT_THAT(bad_input([&] { write("folder.csv"); }), IsAt("folder.csv"));
  EXPECT_TRUE(std::filesystem::is_empty(path("folder.csv")));
}

}  // namespace
}  // namespace viscontact::sweep
