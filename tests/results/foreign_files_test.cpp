#include "viscontact/results/foreign_files.hpp"

#include <gmock/gmock.h>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/results/kinds_of_text.hpp"

namespace viscontact::results {
namespace {

TEST(ForeignFiles, AreThoseWithoutAProvenanceOfAnyKind) {
  const TemporaryFolder folder;
  for (const auto& [kind, text] : texts_of_all_kinds()) {
    const auto users = folder.file("users", text);
    EXPECT_FALSE(is_written_by_viscontact(users)) << text;
    EXPECT_THAT(bad_input([&] { refuse_other_kind(users, "", "result"); }), IsAt(users.string()));
    const auto own = folder.file("own", with_provenance(kind, text, sample_provenance()));
    EXPECT_TRUE(is_written_by_viscontact(own)) << text;
    EXPECT_NO_THROW(refuse_other_kind(own, "", "result")) << text;
  }
}

TEST(ForeignFiles, AreNotThoseThatAnotherProgramWroteAgainWithOtherSpaces) {
  const TemporaryFolder folder;
  EXPECT_TRUE(is_written_by_viscontact(folder.file(
      "fit.json", "{\r\n\t\"provenance\" : {\r\n\t\t\"command\" : [\"viscontact\"]\r\n\t}\r\n}")));
  EXPECT_FALSE(
      is_written_by_viscontact(folder.file("notes.txt", "On the provenance of a command.\n")));
}

TEST(ForeignFiles, AreNotLongPdfsThatHaveTheirProvenanceAtTheEnd) {
  const TemporaryFolder folder;
  const auto pdf_of = [](std::size_t bytes) {
    return "%PDF-1.5\n" + std::string(bytes, 'x') + "\nstartxref\n9\n%%EOF\n";
  };
  // Around one and two MiB, the lengths of the parts that are read, and longer.
  for (const std::size_t bytes : {std::size_t{1} << 20U, (std::size_t{2} << 20U) - 500,
                                  std::size_t{2} << 20U, std::size_t{5} << 20U}) {
    const auto own =
        folder.file("own.pdf", with_provenance(TextKind::kPdf, pdf_of(bytes), sample_provenance()));
    EXPECT_NO_THROW(refuse_other_kind(own, "%PDF-", "picture")) << bytes;
    const auto users = folder.file("users.pdf", pdf_of(bytes));
    EXPECT_THAT(bad_input([&] { refuse_other_kind(users, "%PDF-", "picture"); }),
                IsAt(users.string()));
  }
}

TEST(ForeignFiles, AreThoseOfAnotherKindToo) {
  const TemporaryFolder folder;
  const auto table = folder.file(
      "table.csv", with_provenance(TextKind::kHashComment, "# case: 1\n", sample_provenance()));
  EXPECT_NO_THROW(refuse_other_kind(table, "# case: ", "table"));
  EXPECT_THAT(bad_input([&] { refuse_other_kind(table, "<svg", "picture"); }), IsAt("table.csv"));
}

TEST(ForeignFiles, AreNeitherEmptyNorAbsent) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(refuse_other_kind(folder.file("empty", ""), "<svg", "picture"));
  EXPECT_NO_THROW(refuse_other_kind(folder.path() / "absent", "<svg", "picture"));
  EXPECT_NO_THROW(refuse_other_kind(folder.path(), "<svg", "picture"));
}

}  // namespace
}  // namespace viscontact::results
