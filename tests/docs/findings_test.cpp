// The scripts in findings/ have the form that findings/README.md promises. They are not run,
// because they need the network.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Findings, AreListedAndHaveTheirForm) {
  const fs::path folder = VISCONTACT_SOURCE_FOLDER "/findings";
  const auto page = read_file(folder / "README.md");
  int scripts = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto file = entry.path().filename().string();
    if (!file.ends_with(".sh")) continue;
    ++scripts;
    const auto text = read_file(entry.path());
    EXPECT_THAT(page, HasSubstr("](" + file + ")"));
    EXPECT_NE(entry.status().permissions() & fs::perms::owner_exec, fs::perms::none) << file;
    EXPECT_TRUE(text.starts_with("#!/bin/sh\n# ")) << file;
    EXPECT_THAT(text, HasSubstr("\n# Packages: ")) << file;
    EXPECT_THAT(text, HasSubstr("\nverdict \"")) << file;
    for (const char* foreign : {"http", "/work/", "/home/", "viscontact"})
      EXPECT_THAT(text, Not(HasSubstr(foreign))) << file;
  }
  EXPECT_GE(scripts, 5);
}

}  // namespace
}  // namespace viscontact
