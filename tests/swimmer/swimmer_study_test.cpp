// The head of the file of a sweep of a swimmer, by which rows of an earlier sweep are kept or not.
#include "viscontact/swimmer/case/swimmer_study.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/case_file/edited_case.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/swimmer/fit/fit_resistance.hpp"

namespace viscontact::swimmer {
namespace {

const std::string kData = std::string(VISCONTACT_SOURCE_FOLDER) + "/data/";

TEST(SwimmerStudy, HeadChangesWithTheFilesThatTheCaseNames) {
  const TemporaryFolder folder;
  const std::string table = kData + "tables/three_spheres.csv";
  const auto fit = fit_resistance(read_resistance_table(table));
  auto case_path = std::filesystem::path(kData + "cases/swimmer/three_spheres.toml");
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"arms = { from = 2.2, to = 12.0, count = 12 }", "table = \"table.csv\""},
           {"relative_accuracy = 1e-5", ""},
           {"period = 1.0", ""},
           {"corners = [[6.0, 6.0], [10.0, 6.0], [10.0, 10.0], [6.0, 10.0]]",
            "file = \"loop.csv\""}})
    case_path = folder.file("case.toml", case_file::text_with(case_path, from, to));
  const auto head_with = [&](const std::string& stroke, const std::string& end_of_table) {
    folder.file("loop.csv", stroke);
    folder.file("table.csv", read_file(table) + end_of_table);
    sweep::Points points;
    points.variations = {sweep::parse_variation("fluid.viscosity=1,4")};
    return swimmer_study(case_path, points, fit, "").comments;
  };
  const std::string stroke = "time,x1,x2\n0,6,6\n1,8,6\n3,8,8\n4,6,6\n";
  const auto head = head_with(stroke, "");
  EXPECT_EQ(head_with(stroke, ""), head);
  EXPECT_NE(head_with("time,x1,x2\n0,6,6\n1,8,6\n3,8,9\n4,6,6\n", ""), head);
  EXPECT_NE(head_with(stroke, "\n"), head);
}

}  // namespace
}  // namespace viscontact::swimmer
