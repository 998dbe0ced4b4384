// A text file to which lines are added and in which no line is changed, such as a table with a row
// for each time step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {

/// The end that a growing file had at some moment. A process keeps it elsewhere after each sync();
/// if it is killed, the next process continues the file from there.
struct FileEnd {
  std::uint64_t bytes = 0;  ///< length of the file without its last text, the foot; 0: no line
  std::string last_line;    ///< the line that ends there, without its line break
};

/// A file to which one process adds lines. Up to 64 KiB of lines wait in memory, because one long
/// write is faster than many short ones; they are lost when the object is destroyed without sync().
/// Lines that sync() has written are never changed.
class GrowingFile {
 public:
  /// A new file with the lines `head`. The file is made, and replaces an earlier file, when lines
  /// are written for the first time, at the latest by sync(). At any time the file ends with
  /// `foot`, such as the closing tags of XML. Throws the error of append() if `head` is longer than
  /// 64 KiB and the file cannot be written.
  GrowingFile(std::filesystem::path path, std::string_view head, std::string foot = "");

  /// Throws Error(kBadInput), which names the path, if the file cannot be read, is shorter than
  /// end.bytes, or does not have end.last_line before this place, or if end.bytes is 0.
  void check(const FileEnd& end) const;

  /// Continues the file that an earlier process has written: replaces all text behind `end` by the
  /// foot. Throws the errors of check(), and Error(kBadInput) if the file cannot be written.
  void resume(const FileEnd& end);

  /// Adds whole lines, each with its line break. Throws Error(kBadInput), which names the path, if
  /// the file cannot be written; it then ends with an earlier line and the foot.
  void append(std::string_view lines);

  /// The end with all lines that have been appended.
  const FileEnd& end() const { return end_; }

  /// Writes all lines that have been appended, and flushes them to disk. Throws Error(kBadInput),
  /// which names the path, if that fails.
  void sync();

 private:
  // Both throw Error(kBadInput) if the file cannot be written.
  void write_waiting();
  // `place` is a byte, from 0.
  void write_at(std::uint64_t place, std::string_view text) const;

  std::filesystem::path path_;
  std::string foot_;
  Descriptor file_;
  FileEnd end_;
  std::string waiting_;  // the last lines up to end_, which are not in the file yet
};

}  // namespace viscontact
