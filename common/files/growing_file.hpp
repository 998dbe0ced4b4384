// A text file to which lines are only ever added, as to a table with a row for each step. After
// each sync(), the caller keeps the end of the file (FileEnd) in another file. If the process is
// killed, the next one continues the file from this end. particles/run/ uses it for the logs of
// runs. A file that cannot be written, or that somebody else has changed, throws Error(kBadInput)
// with its path. A change must keep that what sync() has written is never changed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {

/// The end that a growing file had at some moment.
struct FileEnd {
  std::uint64_t bytes = 0;  ///< length of the file, without the foot; 0: no line
  std::string last_line;    ///< the line that ends there, without its line break; empty: none, too
};

/// Holds back up to 64 KiB of lines, because one long write is faster than many short ones. Lines
/// that sync() has not written when the object is destroyed are lost.
class GrowingFile {
 public:
  /// A new file at `path` with the lines `head`, which may be empty. It is made, and replaces an
  /// earlier file, when the first lines are written, at the latest by sync(). At any time the file
  /// ends with `foot`, which may be empty, such as the closing tags of XML. Throws the error of
  /// append() if `head` is longer than 64 KiB and the file cannot be written.
  GrowingFile(std::filesystem::path path, std::string_view head, std::string foot = "");

  /// Throws Error(kBadInput), which names the path, if the file cannot be read, is shorter than
  /// `end`, or has another line there; also if `end` is that of a file without lines.
  void check(const FileEnd& end) const;

  /// Continues the file that an earlier process has written, and removes all that follows `end`.
  /// Throws the errors of check(), and Error(kBadInput) if the file cannot be written.
  void resume(const FileEnd& end);

  /// Adds whole lines, each with its line break (not checked); an empty text adds nothing. Throws
  /// Error(kBadInput), which names the path, if the file cannot be written; it then ends with an
  /// earlier line and the foot. Without an error the lines need not be in the file yet.
  void append(std::string_view lines);

  /// The end with all lines that have been appended.
  const FileEnd& end() const { return end_; }

  /// Writes all lines that have been appended; they are then on disk. Errors are those of append().
  void sync();

 private:
  void write_waiting();
  void write_at(std::uint64_t place, std::string_view text) const;

  std::filesystem::path path_;
  std::string foot_;
  Descriptor file_;
  FileEnd end_;
  std::string waiting_;  // the last lines up to end_, which are not in the file yet
};

}  // namespace viscontact
