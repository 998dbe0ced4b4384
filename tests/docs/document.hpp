// A page of documentation as its reader meets it: commands, and the output that it promises.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
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

/// The lines of a page with what stands in fenced blocks left empty.
std::vector<std::string> prose_of(const std::filesystem::path& page);

/// The numbers in a line.
std::vector<double> numbers_in(const std::string& line);

/// What differs between the lines of an output and those promised; empty: nothing. Words must be
/// equal but for the spaces between them, numbers to `tolerance`; a promised line "..." stands for
/// any lines, none included; "..." within a promised line stands for one number, whatever it is.
std::string difference_from(const std::string& promised, const std::string& output,
                            double tolerance);

/// A folder that looks like the source folder after a build: data/ and build/release/viscontact,
/// which is on the PATH.
class ReadersFolder {
 public:
  explicit ReadersFolder(const std::filesystem::path& executable);

  const std::filesystem::path& path() const { return folder_.path(); }

  ProcessResult run(const std::string& commands) const;

  /// Runs the blocks of language `sh` of a page in their order. Each must succeed, and print what a
  /// block of language `text` that follows it at once promises. Returns the number of promises
  /// kept.
  int run_page(const std::filesystem::path& page) const;

 private:
  TemporaryFolder folder_;
};

}  // namespace viscontact
