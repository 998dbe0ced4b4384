#include "tests/robustness/fuzz/fuzz_target.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    const fs::path memory = "/dev/shm";
    std::string pattern =
        ((::access(memory.c_str(), W_OK) == 0 ? memory : fs::temp_directory_path()) /
         "viscontact_fuzz_XXXXXX")
            .string();
    if (::mkdtemp(pattern.data()) == nullptr)
      throw std::runtime_error("no temporary folder: " + pattern);
    path_ = pattern;
    const fs::path data = VISCONTACT_SOURCE_FOLDER "/data";
    fs::copy(data / "cases" / "forces", path_ / "forces");
    fs::copy(data / "fits", path_ / "fits");
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;  // a destructor must not throw
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

fs::path file_of_bytes(const std::uint8_t* data, std::size_t size, std::string_view name) {
  static const Folder folder;
  const fs::path path = folder.path() / name;
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  if (file.get() < 0 || ::write(file.get(), data, size) != static_cast<ssize_t>(size))
    throw std::runtime_error("cannot write " + path.string());
  return path;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

}  // namespace viscontact
