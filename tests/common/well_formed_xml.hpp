// Checks the tags of an SVG file or of an XML file of VTK.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace viscontact {

/// Fails the test if an element is not closed, or if elements are closed in another order than that
/// in which they overlap. The text is scanned without std::regex, whose recursion over each
/// character of a long attribute overflows the stack.
inline void expect_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (auto at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const auto end = xml.find_first_of("<>", at + 1);
    ASSERT_TRUE(end != std::string::npos && xml[end] == '>') << xml.substr(at, 80);
    const auto tag = xml.substr(at + 1, end - at - 1);
    if (tag.starts_with('?') || tag.ends_with('/')) continue;
    if (tag.starts_with("!--") && tag.ends_with("--")) continue;  // how it was made
    if (tag.starts_with('/')) {
      ASSERT_FALSE(open.empty()) << tag;
      ASSERT_EQ(open.back(), tag.substr(1));
      open.pop_back();
    } else {
      open.push_back(tag.substr(0, tag.find_first_of(" \n\t")));
    }
  }
  EXPECT_TRUE(open.empty());
}

}  // namespace viscontact
