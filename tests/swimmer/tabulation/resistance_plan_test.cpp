// The table of resistance matrices, with a script in FreeFEM's place.
#include <gmock/gmock.h>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/freefem_axi/journal/row_record.hpp"
#include "viscontact/freefem_axi/journal/tabulate.hpp"
#include "viscontact/swimmer/tabulation/collinear_spheres.hpp"

namespace viscontact::swimmer {
namespace {

using ::testing::UnorderedElementsAre;

class ResistancePlan : public ::testing::Test {
 protected:
  std::filesystem::path path() const { return scratch_.path() / "table.csv"; }
  void compute(const freefem_axi::TablePlan& plan, const freefem_axi::FakeFreeFem& fake) const {
    freefem_axi::compute_rows({fake.freefem(), 2, ""}, plan, plan.points, path(),
                              [](const auto&) {});
  }
  ResistanceTable table(const freefem_axi::TablePlan& plan) const {
    const auto copy = scratch_.path() / "copy.csv";
    write_file(copy, plan.write(freefem_axi::read_row_record(path(), plan), {}));
    return read_resistance_table(copy);
  }

  TemporaryFolder scratch_;
  CollinearSpheres spheres_{2, {1, 1, 1}, {}, 1e-5};
  std::vector<std::vector<double>> grid_ = {{0.25, 0.5}, {0.25, 0.5}};
};

TEST_F(ResistancePlan, OfEqualSpheresComputesOneOfEachTwoMirroredRows) {
  const freefem_axi::FakeFreeFem fake(scratch_.path());
  const auto plan = resistance_table_plan(spheres_, grid_);
  compute(plan, fake);
  EXPECT_THAT(fake.answered(), UnorderedElementsAre("0.25 0.25", "0.25 0.5", "0.5 0.5"));
  const auto rows = table(plan).rows;
  ASSERT_EQ(rows.size(), 4U);
  // R at gaps 1/4, 1/2 and at 1/2, 1/4; the viscosity is 2.
  EXPECT_THAT(rows[1].entries, ::testing::ElementsAre(46, -8, -1, 50, -4, 42));
  EXPECT_THAT(rows[2].gaps, ::testing::ElementsAre(0.5, 0.25));
  EXPECT_THAT(rows[2].entries, ::testing::ElementsAre(42, -4, -1, 50, -8, 46));
}

TEST_F(ResistancePlan, OfUnequalSpheresOrGridsComputesAllRows) {
  spheres_.radii = {1, 1, 2};
  EXPECT_EQ(resistance_table_plan(spheres_, grid_).points.size(), 4U);
  spheres_.radii = {1, 1, 1};
  grid_[1] = {0.25, 0.75};
  EXPECT_EQ(resistance_table_plan(spheres_, grid_).points.size(), 4U);
}

TEST_F(ResistancePlan, FinishedRowsAreNotComputedAgainNorIsAFinishedTable) {
  const auto plan = resistance_table_plan(spheres_, grid_);
  const freefem_axi::FakeFreeFem failing(
      scratch_.path(),
      "[ ! -e \"$folder/mended\" ] && [ $gap2 = 0.5 ] && { echo no luck; exit 4; }\n");
  compute(plan, failing);
  EXPECT_TRUE(plan.needs_all_rows);
  EXPECT_THAT(freefem_axi::failures_of(freefem_axi::read_row_record(path(), plan), plan.points),
              ::testing::ElementsAre(Names("0.25", "0.5", "no luck"), Names("0.5")));
  put_text(scratch_.path() / "mended", "");
  compute(plan, failing);
  EXPECT_EQ(failing.answered().size(), 3U);
  write_file(path(), plan.write(freefem_axi::read_row_record(path(), plan), {{"Viscontact", "0"}}));
  freefem_axi::remove_journals(path(), plan.hash);
  compute(plan, failing);
  EXPECT_EQ(failing.answered().size(), 3U);
  EXPECT_EQ(read_resistance_table(path()).versions.at("FreeFEM"), "0-fake");
}

TEST_F(ResistancePlan, TheTableOfAnotherNumberOfSpheresIsNotRead) {
  const auto plan = resistance_table_plan(spheres_, grid_);
  for (const std::size_t spheres : {2U, 4U}) {
    ResistanceTable other;
    other.case_hash = plan.hash;
    other.viscosity = 2;
    other.radii.assign(spheres, 1);
    ResistanceRow row;
    prepare(other, row);
    std::ranges::fill(row.gaps, 0.25);
    for (std::size_t i = 0; i < spheres; ++i) row.entries[entry_position(i, i, spheres)] = 1;
    other.rows = {row};
    write_file(path(), write_resistance_table(other));
    ASSERT_EQ(read_resistance_table(path()).radii.size(), spheres);
    EXPECT_TRUE(plan.read(path()).finished.empty()) << spheres;
  }
}

TEST_F(ResistancePlan, HashChangesWithEverythingThatTheMatricesDependOn) {
  const auto base = resistance_table_plan(spheres_, grid_).hash;
  const auto changed = [&](auto change) {
    auto spheres = spheres_;
    auto grid = grid_;
    change(spheres, grid);
    return resistance_table_plan(spheres, grid).hash;
  };
  const std::vector<std::string> hashes = {
      base,
      changed([](auto& s, auto&) { s.viscosity = 3; }),
      changed([](auto& s, auto&) { s.radii[1] = 2; }),
      changed([](auto& s, auto&) {
        s.tube = Tube{5, {}};
      }),
      changed([](auto& s, auto&) {
        s.tube = Tube{5, 50};
      }),
      changed([](auto& s, auto&) { s.relative_accuracy = 1e-4; }),
      changed([](auto&, auto& g) { g[0][0] = 0.3; })};
  for (std::size_t i = 0; i < hashes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(hashes[i], hashes[j]) << i << " and " << j;
}

TEST_F(ResistancePlan, AnswerWithoutAllEntriesIsAFailure) {
  const freefem_axi::FakeFreeFem fake(scratch_.path(),
                                      "echo viscontact-result 1e-6 1000 4; exit 0\n");
  EXPECT_THAT(failure(ErrorKind::kExternalProgram,
                      [&] {
                        (void)solve_resistance(fake.freefem(), spheres_, {1, 1});
                      }),
              Names("gaps 1, 1"));
}

}  // namespace
}  // namespace viscontact::swimmer
