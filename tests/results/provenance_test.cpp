#include "viscontact/results/provenance.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/results/kinds_of_text.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/json.hpp"

namespace viscontact::results {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Provenance, IsReadAsItWasWrittenIntoEachKindOfText) {
  const auto written = sample_provenance();
  for (const auto& [kind, text] : texts_of_all_kinds()) {
    const auto read = provenance_in(with_provenance(kind, text, written), "file");
    ASSERT_TRUE(read.has_value()) << text;
    EXPECT_EQ(read->command, written.command) << text;
    EXPECT_EQ(read->folder, written.folder) << text;
    ASSERT_EQ(read->inputs.size(), written.inputs.size()) << text;
    for (std::size_t i = 0; i < read->inputs.size(); ++i) {
      EXPECT_EQ(read->inputs[i].file, written.inputs[i].file) << text;
      EXPECT_EQ(read->inputs[i].sha256, written.inputs[i].sha256) << text;
      EXPECT_EQ(read->inputs[i].intermediate, written.inputs[i].intermediate) << text;
    }
    EXPECT_EQ(read->versions, written.versions) << text;
    EXPECT_EQ(read->output, written.output) << text;
    EXPECT_EQ(read->made, written.made) << text;
  }
}

TEST(Provenance, IsALineThatHashesLeaveOut) {
  auto later = sample_provenance();
  later.made = "2002-09-09T01:46:40Z";
  for (const auto& [kind, text] : texts_of_all_kinds()) {
    const auto first = with_provenance(kind, text, sample_provenance());
    const auto second = with_provenance(kind, text, later);
    EXPECT_NE(first, second);
    EXPECT_EQ(without_provenance(first), text);
    EXPECT_EQ(content_sha256(first), content_sha256(second)) << text;
    EXPECT_EQ(content_sha256(first), sha256(text)) << text;
  }
}

TEST(Provenance, OfTextsWithoutLineEndsIsReadAndLeftOut) {
  for (const auto& [kind, text] : {TextOfKind{TextKind::kJson, "{\"gap\": 0.1}"},
                                   TextOfKind{TextKind::kSvg, "<svg width=\"9\"></svg>"},
                                   TextOfKind{TextKind::kHtml, "<html><head></head></html>"},
                                   TextOfKind{TextKind::kXml, "<?xml version=\"1.0\"?><a></a>"},
                                   TextOfKind{TextKind::kPdf, "%PDF-1.5 startxref 9 %%EOF"}}) {
    const auto with = with_provenance(kind, text, sample_provenance());
    EXPECT_EQ(without_provenance(with), text);
    EXPECT_EQ(provenance_in(with, "file")->made, sample_provenance().made) << text;
  }
}

TEST(Provenance, NeedsTheMarkOfItsKind) {
  for (const auto kind : {TextKind::kJson, TextKind::kSvg, TextKind::kHtml, TextKind::kXml,
                          TextKind::kPdf, TextKind::kPng})
    EXPECT_THROW(with_provenance(kind, "no mark\n", sample_provenance()), std::out_of_range);
}

// `jq -c` and others write JSON without spaces and line ends.
TEST(Provenance, IsReadFromJsonThatAnotherProgramPutOnOneLine) {
  const auto text =
      with_provenance(TextKind::kJson, "{\n  \"gap\": {\"of\": 0.1}\n}\n", sample_provenance());
  const auto compact = Json::parse(text).dump();
  const auto read = provenance_in(compact + "\n", "fit.json");
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->command, sample_provenance().command);
  EXPECT_EQ(read->made, sample_provenance().made);
  EXPECT_EQ(without_provenance(compact), compact);
  EXPECT_EQ(provenance_in(Json::parse(text).dump(2), "fit.json")->made, read->made);
}

TEST(Provenance, OfAPngIsAChunkWithItsLengthAndCrc) {
  const auto png = texts_of_all_kinds().back().text;
  const auto with = with_provenance(TextKind::kPng, png, sample_provenance());
  const auto number_at = [&](std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i)
      number = number << 8U | static_cast<unsigned char>(with[at + i]);
    return number;
  };
  // zlib's CRC of "tEXtprovenance\0{...}\n" by another implementation: a table of 256 numbers.
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    table[n] = n;
    for (int bit = 0; bit < 8; ++bit)
      table[n] = table[n] & 1U ? 0xedb88320U ^ (table[n] >> 1U) : table[n] >> 1U;
  }
  std::vector<std::string> types;
  for (std::size_t at = 8; at < with.size();) {
    const std::size_t length = number_at(at);
    ASSERT_LE(at + 12 + length, with.size());
    std::uint32_t crc = 0xffffffff;
    for (std::size_t i = at + 4; i < at + 8 + length; ++i)
      crc = table[(crc ^ static_cast<unsigned char>(with[i])) & 0xffU] ^ (crc >> 8U);
    types.push_back(with.substr(at + 4, 4));
    EXPECT_EQ(number_at(at + 8 + length), ~crc) << types.back();
    at += 12 + length;
  }
  EXPECT_THAT(types, ElementsAre("IHDR", "tEXt", "IDAT", "IEND"));
}

TEST(Provenance, IsAbsentFromAUsersText) {
  for (const auto& [kind, text] : texts_of_all_kinds()) {
    EXPECT_FALSE(provenance_in(text, "file").has_value()) << text;
    EXPECT_EQ(without_provenance(text), text);
  }
}

TEST(Provenance, ThatIsDamagedIsAnErrorThatNamesTheFile) {
  EXPECT_THAT(bad_input([] { provenance_in("# provenance: {\"command\":[1\n", "table.csv"); }),
              IsAt("table.csv"));
}

TEST(Provenance, DoesNotCountWhenContentsAreCompared) {
  const TemporaryFolder folder;
  const std::string text = "gap,force\n0.1,2\n";
  const auto file =
      folder.file("table.csv", with_provenance(TextKind::kHashComment, text, sample_provenance()));
  EXPECT_TRUE(has_content(file, text));
  EXPECT_FALSE(has_content(file, "gap,force\n0.1,3\n"));
  EXPECT_FALSE(has_content(folder.path() / "absent.csv", text));
}

TEST(WriteIfChanged, LeavesAFileAloneThatIsUpToDateAndWritesADamagedOneAgain) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "table.csv";
  const std::string text = "gap,force\n0.1,2\n";
  auto provenance = sample_provenance();
  const auto writes = [&] {
    return write_if_changed(file, TextKind::kHashComment, text, provenance);
  };
  EXPECT_TRUE(writes());
  EXPECT_FALSE(writes());
  provenance.versions["Viscontact"] = "another";
  provenance.command.emplace_back("--json");
  EXPECT_FALSE(writes());
  provenance.inputs[0].sha256 = std::string(64, '1');
  EXPECT_TRUE(writes());
  provenance.folder = "another folder";
  EXPECT_TRUE(writes());
  // A provenance that is damaged, and none, beside the same text.
  for (const std::string line : {"# provenance: {\"command\":[1\n", ""}) {
    (void)folder.file("table.csv", line + text);
    ASSERT_TRUE(has_content(file, text));
    EXPECT_TRUE(writes());
    EXPECT_FALSE(writes());
  }
}

TEST(Provenance, WithoutFoldersNamesNoFolderOfTheMachine) {
  auto provenance = sample_provenance();
  provenance.command = {"/opt/bin/viscontact",
                        "fit",
                        "/home/someone/data/table.csv",
                        "--output=/tmp/fit.json",
                        "-o/home/someone/fit.json",
                        "/tmp/out/",
                        "/"};
  provenance.inputs = {{"/home/someone/data/table.csv", "", false}, {"/etc/force.csv", "", false}};
  const auto shared = without_folders(provenance);
  EXPECT_EQ(shared.folder, "");
  EXPECT_THAT(shared.command, ElementsAre("viscontact", "fit", "data/table.csv",
                                          "--output=fit.json", "-ofit.json", "out", "/"));
  EXPECT_EQ(shared.inputs[0].file, "data/table.csv");
  EXPECT_EQ(shared.inputs[1].file, "force.csv");
}

TEST(Provenance, WithAnAbsoluteOutputRunsInItsFolderOrThatOfTheFile) {
  const TemporaryFolder folder;
  const auto file = std::filesystem::canonical(folder.file("fit.json", "{}"));
  Provenance provenance;
  provenance.output = file.string();
  EXPECT_EQ(folder_to_run_in(file, provenance).string(), file.parent_path().string());
  provenance.folder = "/home/someone";
  EXPECT_EQ(folder_to_run_in(file, provenance).string(), "/home/someone");
  provenance.output = "fit.json";
  EXPECT_EQ(folder_to_run_in(file, provenance).string(), file.parent_path().string());
}

TEST(Provenance, SaysHowAnInputHasChanged) {
  const TemporaryFolder folder;
  const auto path = folder.file("table.csv", "a\n").string();
  EXPECT_EQ(change_of({"table.csv", sha256("a\n")}, folder.path()), "");
  EXPECT_EQ(change_of({"table.csv", sha256("b\n")}, folder.path()), path + " has changed");
  EXPECT_EQ(change_of({"table.csv", ""}, folder.path()), path + " was a pipe and not a file");
  EXPECT_THAT(change_of({"absent.csv", ""}, folder.path()), HasSubstr("no longer exists"));
}

}  // namespace
}  // namespace viscontact::results
