// scripts/check_comments: what it finds in sources that break its rules, and nothing in ours.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"
#

namespace viscontact {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Checked {
  int exit_status = 0;
  std::string text;
};

Checked check(const std::filesystem::path& folder, const std::filesystem::path& output) {
  const auto command = std::string(VISCONTACT_SOURCE_FOLDER) + "/scripts/check_comments '" +
                       folder.string() + "' >'" + output.string() + "'";
  const int status = std::system(command.c_str());
  return {status, read_file(output)};
}

TEST(Comments, StandAtDeclarations) {
  const TemporaryFolder folder;
  const auto checked = check(VISCONTACT_SOURCE_FOLDER, folder.path() / "said");
  EXPECT_EQ(checked.exit_status, 0);
  EXPECT_EQ(checked.text, "");
}

TEST(Comments, AtOtherPlacesAreReported) {
  const TemporaryFolder folder, said;
  put_text(folder.path() / "wheel.hpp",
           "// A wheel.\n#pragma once\n/// Length of the rim [L].\ndouble rim(double r);\n"
           "class Wheel {\n public:\n  void turn();  ///< the number is not"
           " checked\n};\n");
  put_text(folder.path() / "wheel.cpp",
           "// One.\n// Two.\n// Three.\n#include \"wheel.hpp\"\n"
           "namespace {\n/// A helper may have one.\ndouble twice(double x) { return 2 * x; }\n"
           "}  // namespace\n/// The rim again.\ndouble rim(double r) {\n  return twice(r);\n}\n\n"
           "// The turn again.\nvoid Wheel::turn() {}\n");
  const auto checked = check(folder.path(), said.path() / "said");
  EXPECT_NE(checked.exit_status, 0);
  EXPECT_THAT(checked.text, HasSubstr("wheel.cpp:1:"));
  EXPECT_THAT(checked.text, HasSubstr("wheel.cpp:10:"));
  EXPECT_THAT(checked.text, HasSubstr("wheel.cpp:15:"));
  EXPECT_THAT(checked.text, HasSubstr("wheel.hpp:7:"));
  EXPECT_THAT(checked.text, Not(HasSubstr("twice")));
}

}  // namespace
}  // namespace viscontact
