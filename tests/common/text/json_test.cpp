#include "viscontact/common/text/json.hpp"

#include <gmock/gmock.h>

#include "tests/common/failure.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;

TEST(JsonDocument, KnowsTheLineOfEveryValue) {
  const auto document = JsonDocument::parse(
      "\xEF\xBB\xBF{\n"
      "  \"a\": [1,\n"
      "         {\"b\": \"two\\n \\\" ] lines\"}],\n"
      "  \"c\": {\"d\": null, \"e\":\n"
      "       true}\n"
      "}",
      "f.json");
  EXPECT_EQ(document.line_of(""), 1);
  EXPECT_EQ(document.line_of("a"), 2);
  EXPECT_EQ(document.line_of("a[0]"), 2);
  EXPECT_EQ(document.line_of("a[1].b"), 3);
  EXPECT_EQ(document.line_of("c.d"), 4);
  EXPECT_EQ(document.line_of("c.e"), 5);
  // What is not there would stand in what is there.
  EXPECT_EQ(document.line_of("c.f"), 4);
  EXPECT_EQ(document.line_of("a[7].b[2]"), 2);
  EXPECT_EQ(document.line_of("x"), 1);
  EXPECT_EQ(document.root().at("a").at(1).at("b"), "two\n \" ] lines");
}

TEST(JsonDocument, NamesUtf16) {
  const std::string wide("\xFE\xFF\0{\0}", 6);
  EXPECT_THAT(bad_input([&] { JsonDocument::parse(wide, "f.json"); }), IsAt("f.json"));
}

TEST(JsonDocument, IsReadHoweverDeepItIs) {
  // Deeper than the stack of a recursive reader.
  const std::size_t depth = 1'000'000;
  const std::string text = std::string(depth, '[') + "\n1" + std::string(depth, ']');
  EXPECT_EQ(JsonDocument::parse(text, "f.json").line_of("[0][0]"), 1);
}

Error refusal(const std::string& text) {
  return bad_input([&] { JsonDocument::parse(text, "f.json"); });
}

TEST(JsonDocument, RefusesWhatIsNoJsonWithLineColumnAndCause) {
  EXPECT_THAT(refusal("{\"a\": 1,\n \"b\" 2}"), AllOf(IsAt("f.json:2"), Names("6")));
  EXPECT_THAT(refusal(""), IsAt("f.json:1"));
  EXPECT_THAT(refusal("[1,\n2,\n  -1e999]"), AllOf(IsAt("f.json:3"), Names("-1e999")));
}

TEST(JsonDocument, RefusesANulCharacterAndWhatFollows) {
  const std::string text("{\n}\0}}]", 8);
  EXPECT_THAT(refusal(text), IsAt("f.json:2"));
}

TEST(JsonDocument, RefusesAKeyThatStandsTwiceInItsObject) {
  EXPECT_THAT(refusal("{\"a\": 1,\n \"b\": {\"c\": 1,\n  \"c\": 2}}"), IsAt("f.json:3", "b.c"));
  EXPECT_NO_THROW(
      JsonDocument::parse("{\"a\": {\"a\": 1}, \"b\": [{\"a\": 1}, {\"a\": 1}]}", "f.json"));
}

}  // namespace
}  // namespace viscontact
