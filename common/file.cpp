#include "common/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "common/descriptor.hpp"
#include "common/error.hpp"

namespace viscontact {
namespace {

[[noreturn]] void throw_system_error(const std::filesystem::path& path, const char* action,
                                     int code) {
  throw_bad_input({path.string()}, fmt::format("cannot be {} ({})", action, std::strerror(code)));
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) throw_system_error(path, "read", errno);
  std::string content;
  char buffer[1 << 16];
  for (;;) {
    const ssize_t count = ::read(file.get(), buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw_system_error(path, "read", errno);
    if (count == 0) return content;
    content.append(buffer, static_cast<std::size_t>(count));
  }
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw_system_error(path, "made", error.value());
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  if (std::filesystem::is_directory(path)) throw_system_error(path, "written", EISDIR);
  if (path.has_parent_path()) make_folder(path.parent_path());
  // The process number keeps two runs that write the same file apart.
  const std::filesystem::path beside = path.string() + fmt::format(".{}.tmp", ::getpid());
  try {
    const Descriptor file(::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.get() < 0) throw_system_error(path, "written", errno);
    while (!content.empty()) {
      const ssize_t count = ::write(file.get(), content.data(), content.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) throw_system_error(path, "written", errno);
      content.remove_prefix(static_cast<std::size_t>(count));
    }
    if (::fsync(file.get()) != 0) throw_system_error(path, "written", errno);
    if (::rename(beside.c_str(), path.c_str()) != 0) throw_system_error(path, "written", errno);
  } catch (...) {
    ::unlink(beside.c_str());
    throw;
  }
}

std::string sha256(std::string_view bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int length = 0;
  [[maybe_unused]] const int done =
      EVP_Digest(bytes.data(), bytes.size(), digest, &length, EVP_sha256(), nullptr);
  assert(done == 1 && length == 32);
  std::string text;
  for (unsigned int i = 0; i < length; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

}  // namespace viscontact
