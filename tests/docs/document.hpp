// Reads a page of the documentation, runs its commands and compares their output with the output
// that the page shows.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact {

/// A fenced block with its language and the line where it begins.
struct Block {
  std::string language;
  std::string text;
  int line = 0;
};

/// The fenced blocks of a page, in order.
std::vector<Block> blocks_of(const std::filesystem::path& page);

/// The lines of a page, where those of fenced blocks are empty.
std::vector<std::string> prose_of(const std::filesystem::path& page);

std::vector<double> numbers_in(const std::string& line);

/// The first difference, in words, between an output and the `promised` output of a page; empty if
/// there is none. Words must be equal, however many spaces are between them. Numbers may differ by
/// the relative difference `tolerance`. A promised line "..." stands for any number of lines, also
/// none; "..." within a promised line stands for any one number.
std::string difference_from(const std::string& promised, const std::string& output,
                            double tolerance);

/// Regular expressions, and what takes the place of what they match.
using Changes = std::vector<std::pair<std::string, std::string>>;

/// A text after these changes. Fails the test for an expression that changes nothing.
std::string changed(std::string text, const Changes& changes);

/// A temporary folder that has what a reader's commands need of the source folder after a build:
/// a copy of data/, and build/release/viscontact, whose folder is in PATH.
class ReadersFolder {
 public:
  explicit ReadersFolder(const std::filesystem::path& executable);

  const std::filesystem::path& path() const { return folder_.path(); }

  ProcessResult run(const std::string& commands) const;

  /// Runs the blocks of language `sh` of a page in their order. Each must succeed, and its output
  /// must be that of the block of language `text` that follows it directly, if there is one.
  /// Returns the number of outputs that were compared. `changes` make the commands shorter first.
  int run_page(const std::filesystem::path& page, const Changes& changes = {}) const;

  /// Changes a case, for example to make it shorter. `name` is its path in data/cases.
  void change_case(const std::string& name, const Changes& changes) const;

 private:
  TemporaryFolder folder_;
};

}  // namespace viscontact
