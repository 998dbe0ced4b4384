// A text file to which lines are added and in which no line is changed, such as a table with a row
// for each time step. After each sync(), the caller keeps the end of the file (FileEnd) in another
// file. If the process is killed, the next process continues the file from this end. particles/run/
// uses it for the logs of runs. A file that cannot be written, or that somebody else has changed,
// throws Error(kBadInput) with its path. A change must keep that lines which sync() has written are
// never changed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {

/// The end that a growing file had at some moment.
struct FileEnd {
  std::uint64_t bytes = 0;  ///< length of the file without its last text, the foot; 0: no line
  std::string last_line;    ///< the line that ends there, without its line break; may be empty
};

/// A file to which one process adds lines. Up to 64 KiB of lines (a free choice) wait in memory,
/// because one long write is faster than many short ones. Lines that are not written when the
/// object is destroyed are lost.
class GrowingFile {
 public:
  /// A new file at `path` with the lines `head`, which may be empty. The file is made, and replaces
  /// an earlier file, when lines are written for the first time, at the latest by sync(). At any
  /// time the file ends with `foot`, such as the closing tags of XML, which may be empty. Throws
  /// the error of append() if `head` is longer than 64 KiB and the file cannot be written.
  GrowingFile(std::filesystem::path path, std::string_view head, std::string foot = "");

  /// Compares the file with `end`. Throws Error(kBadInput), which names the path, if the file
  /// cannot be read, is shorter than end.bytes, or does not have end.last_line before this place,
  /// or if end.bytes is 0.
  void check(const FileEnd& end) const;

  /// Continues the file that an earlier process has written, and removes all text behind `end`; the
  /// foot is then written again. Throws the errors of check(), and Error(kBadInput) if the file
  /// cannot be written.
  void resume(const FileEnd& end);

  /// Adds whole lines, each with its line break (not checked); an empty text adds nothing. Throws
  /// Error(kBadInput), which names the path, if the file cannot be written; it then ends with an
  /// earlier line and the foot. Lines may wait in memory until sync().
  void append(std::string_view lines);

  /// The end with all lines that have been appended.
  const FileEnd& end() const { return end_; }

  /// Writes all lines that have been appended, and flushes them to disk. Throws Error(kBadInput),
  /// which names the path, if that fails.
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
