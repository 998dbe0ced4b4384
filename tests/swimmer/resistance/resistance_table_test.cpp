#include "viscontact/swimmer/resistance/resistance_table.hpp"

#include <gmock/gmock.h>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact::swimmer {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;

/// Two rows of three spheres, with numbers that have no short decimal form.
ResistanceTable sample() {
  ResistanceTable table;
  table.viscosity = 1. / 3;
  table.radii = {1, 2. / 3, 0.5};
  table.container = "tube of radius 3";
  table.case_hash = "some-hash";
  table.versions["FreeFEM"] = "4.9";
  for (const double gap : {1. / 7, 2. / 7})
    table.rows.push_back({{gap, 1. / 9},
                          {20. / 3, -1. / 3, -0.1, 30. / 7, -1, 10},
                          {1e-6, 2e-6, 3e-6, 4e-6, 5e-6, 6e-6 / 7},
                          12345,
                          0.1,
                          35. / 9});
  return table;
}

std::vector<std::string> names_of_columns(std::size_t spheres) {
  ResistanceTable table;
  table.radii.assign(spheres, 1.0);
  ResistanceRow row;
  prepare(table, row);
  std::vector<std::string> names;
  for (const auto& column : columns_of(table, row)) names.push_back(column.name);
  return names;
}

class ResistanceTableFile : public ::testing::Test {
 protected:
  Error refusal(const std::string& from, const std::string& to) const {
    auto text = write_resistance_table(sample());
    const auto at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the text has no '" + from + "'");
    put_text(path(), text.replace(at, from.size(), to));
    return bad_input([&] { (void)read_resistance_table(path()); });
  }
  std::filesystem::path path() const { return scratch_.path() / "table.csv"; }
  TemporaryFolder scratch_;
};

TEST(ScaledResistanceTable, HasMatricesThatGrowWithRadiusAndViscosity) {
  const auto table = sample();
  const auto scaled = scaled_to(table, 2 / 3., {0.25, 1. / 6, 0.125});
  EXPECT_EQ(scaled.container, "tube of radius 0.75");
  EXPECT_EQ(scaled.case_hash, "");  // the table is not that of a case
  for (std::size_t r = 0; r < 2; ++r) {
    EXPECT_EQ(scaled.rows[r].gaps[0], table.rows[r].gaps[0] / 4);
    for (std::size_t k = 0; k < 6; ++k) {  // twice the viscosity, a quarter of the length
      EXPECT_DOUBLE_EQ(scaled.rows[r].entries[k], table.rows[r].entries[k] / 2);
      EXPECT_EQ(scaled.rows[r].relative_error_estimates[k],
                table.rows[r].relative_error_estimates[k]);
    }
  }
}

TEST(ResistanceColumns, NameGapsAndEntriesByTheirSpheres) {
  const auto columns = names_of_columns(3);
  EXPECT_THAT(std::vector(columns.begin(), columns.begin() + 8),
              ElementsAre("gap12", "gap23", "R11", "R12", "R13", "R22", "R23", "R33"));
  EXPECT_EQ(columns[8], "R11_relative_error_estimate");
  EXPECT_EQ(columns[14], "relative_error_estimate");
  EXPECT_THAT(names_of_columns(10), ::testing::IsSupersetOf({"gap9_10", "R1_10", "R10_10"}));
}

TEST_F(ResistanceTableFile, ReadsBackWhatWasWrittenBitForBit) {
  const auto table = sample();
  put_text(path(), write_resistance_table(table));
  const auto again = read_resistance_table(path());
  EXPECT_EQ(write_resistance_table(again), read_file(path()));
  EXPECT_EQ(again.viscosity, table.viscosity);
  EXPECT_EQ(again.radii, table.radii);
  EXPECT_EQ(again.container, table.container);
  EXPECT_EQ(again.case_hash, table.case_hash);
  EXPECT_EQ(again.versions, table.versions);
  ASSERT_EQ(again.rows.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again.rows[i].gaps, table.rows[i].gaps);
    EXPECT_EQ(again.rows[i].entries, table.rows[i].entries);
    EXPECT_EQ(again.rows[i].relative_error_estimates, table.rows[i].relative_error_estimates);
    EXPECT_EQ(again.rows[i].degrees_of_freedom, table.rows[i].degrees_of_freedom);
    EXPECT_EQ(again.rows[i].seconds, table.rows[i].seconds);
    EXPECT_EQ(again.rows[i].observed_order, table.rows[i].observed_order);
  }
}

TEST_F(ResistanceTableFile, ThatIsShippedIsWrittenAsItWasRead) {
  const std::string file = std::string(VISCONTACT_SOURCE_FOLDER) + "/data/tables/three_spheres.csv";
  const auto text = read_file(file);
  // The first line is the provenance, which the command adds.
  EXPECT_EQ(write_resistance_table(read_resistance_table(file)), text.substr(text.find('\n') + 1));
}

TEST_F(ResistanceTableFile, OfTenSpheresHasMoreColumnsThanTheReaderTakesAtOnce) {
  ResistanceTable table;
  table.viscosity = 1;
  table.radii.assign(10, 1.0);
  ResistanceRow row;
  row.gaps.assign(9, 0.5);
  for (std::size_t i = 0; i < 10; ++i)
    for (std::size_t j = i; j < 10; ++j)
      row.entries.push_back(i == j ? 20 + static_cast<double>(i)
                                   : -1. / static_cast<double>(j + 1));
  row.relative_error_estimates.assign(row.entries.size(), 1e-6);
  table.rows = {row};
  put_text(path(), write_resistance_table(table));
  EXPECT_EQ(read_resistance_table(path()).rows.at(0).entries, row.entries);
}

TEST_F(ResistanceTableFile, ErrorsNameFileLineAndWhatIsAllowed) {
  EXPECT_THAT(refusal("# radii: 1 0.", "# radii: 1 -0."),
              AllOf(IsAt("table.csv", "radii"), Names("-0.6666666666666666")));
  EXPECT_THAT(refusal("gap12", "gap"), IsAt("table.csv", "gap12"));
  EXPECT_THAT(refusal("\n0.14285714285714285,", "\n-1,"), IsAt("table.csv:9", "gap12"));
  EXPECT_THAT(refusal(",6.666666666666667,", ",-6.666666666666667,"), IsAt("table.csv:9"));
  EXPECT_THAT(refusal(",6.666666666666667,", ",,"), IsAt("table.csv:9"));
}

}  // namespace
}  // namespace viscontact::swimmer
