// A folder of a test's own, gone after it.
#pragma once

#include <filesystem>
#include <string>

namespace viscontact {

class ScratchFolder {
 public:
  ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Writes (or replaces) a file as it is, without the care of write_file(), which is under test.
void put_text(const std::filesystem::path& path, const std::string& text);

/// Makes a file a program.
void make_executable(const std::filesystem::path& path);

}  // namespace viscontact
