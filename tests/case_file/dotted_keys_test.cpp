// Keys of very many parts, which overflowed the stack of toml++.
#include <gmock/gmock.h>

#include "tests/case_file/edited_case.hpp"
#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"

namespace viscontact::case_file {
namespace {

/// "a.a.a", of that many parts joined by `dot`.
std::string key_of(int parts, const std::string& part = "a", const std::string& dot = ".") {
  std::string key = part;
  for (int i = 1; i < parts; ++i) key += dot + part;
  return key;
}

constexpr int kVeryMany = 40000;  // 80 kB; toml++ overflowed 8 MiB of stack with half of them

TEST(DottedKeys, OfVeryManyPartsAreRefusedWithTheirLine) {
  const std::string deep = key_of(kVeryMany);
  for (const auto& text : {"\n\n" + deep + " = 1\n", "\n\n[" + deep + "]\n",
                           "\n\n[[" + deep + "]]\n", "\n\nb = { " + deep + " = 1 }\n"}) {
    EXPECT_THAT(bad_input([&] { (void)read_text(text); }), IsAt("case.toml:3"));
  }
}

TEST(DottedKeys, OfVeryManyPartsAreRefusedInACaseOfParticlesToo) {
  const TemporaryFolder folder;
  const auto file = folder.file("case.toml", key_of(kVeryMany) + " = 1\n");
  EXPECT_THAT(bad_input([&] { (void)particles::read_particles_case(file); }), IsAt("case.toml:1"));
}

TEST(DottedKeys, OfQuotedPartsWithSpacesBetweenCountToo) {
  for (const auto* part : {"\"b c\"", "'b.c'", "\"\\\"\""}) {
    EXPECT_NO_THROW((void)TomlSection::parse(key_of(16, part, " . ") + " = 1", "f"));
    EXPECT_THAT(bad_input([&] { (void)TomlSection::parse(key_of(17, part, " . ") + " = 1", "f"); }),
                IsAt("f:1"));
  }
}

TEST(DottedKeys, DotsInTextCommentsAndNumbersAreNoKeys) {
  const std::string dots = key_of(100);
  const std::string numbers = "x = [" + key_of(1000, "0.5", ", ") + "]\n";
  for (const auto& text : {"x = \"" + dots + "\"\n", "x = '" + dots + "'\n",
                           "x = \"\"\"\n" + dots + "\n\"\"\"\n", "x = '''\n" + dots + "'\n'''\n",
                           "x = 1  # " + dots + "\n", numbers, "x = \"a \\\" " + dots + "\"\n"})
    EXPECT_NO_THROW((void)TomlSection::parse(text, "f")) << text.substr(0, 60);
}

TEST(DottedKeys, CountLinesOfLongTexts) {
  EXPECT_THAT(bad_input([&] {
                (void)TomlSection::parse("x = \"\"\"\n\n\"\"\"\ny = '''\n'''\n" + key_of(17), "f");
              }),
              IsAt("f:6"));
}

TEST(DottedKeys, OfTheLongestLengthInNestedTablesAreRead) {
  // The deepest nesting that passes: toml++ must not overflow, whatever it then says.
  std::string text;
  constexpr int kTables = 200;
  for (int i = 0; i < kTables; ++i) text += key_of(16) + " = { ";
  text += "b = 1";
  for (int i = 0; i < kTables; ++i) text += " }";
  EXPECT_THAT(bad_input([&] { (void)read_text(text + "\n"); }), IsAt("case.toml:1", "title"));
}

}  // namespace
}  // namespace viscontact::case_file
