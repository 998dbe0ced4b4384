// A file is replaced in the order write, fsync, rename, fsync of the folder, because only then a
// power cut leaves either the old or the new file.
#include "viscontact/common/files/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <system_error>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {
namespace {

/// "PATH cannot be ACTION (REASON)". `code` is a value of errno.
[[noreturn]] void throw_system_error(const std::filesystem::path& path, const char* action,
                                     int code) {
  throw_bad_input({path.string()}, "cannot be {} ({})", action, std::strerror(code));
}

// While a process PID writes the file NAME, the file is called NAME.viscontact-PID.tmp.
constexpr std::string_view kUnfinishedOf = ".viscontact-", kUnfinished = ".tmp";

/// Removes the files NAME.viscontact-PID.tmp that killed processes have left, where NAME is `of`,
/// or any name if `of` is empty.
void remove_left_behind(const std::filesystem::path& folder, const std::string& of) {
  std::error_code ignored;  // a folder that cannot be read is left as it is
  // A range-based for would call the operator ++, which throws.
  for (std::filesystem::directory_iterator entry(folder, ignored), end; entry != end;
       entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    const auto after = name.rfind(kUnfinishedOf);
    if (after == std::string::npos || !name.ends_with(kUnfinished) ||
        (!of.empty() && name.compare(0, after, of) != 0))
      continue;
    const char* const begin = name.data() + after + kUnfinishedOf.size();
    const char* const end_of_number = name.data() + name.size() - kUnfinished.size();
    pid_t process = 0;
    const auto number = std::from_chars(begin, std::max(begin, end_of_number), process);
    if (number.ec != std::errc() || number.ptr != end_of_number || process <= 0) continue;
    if (::kill(process, 0) == 0 || errno != ESRCH) continue;
    // On a shared disk the file may belong to a process on another machine, which has locked it.
    const Descriptor file(::open(entry->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW));
    if (file.get() >= 0 && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0)
      ::unlink(entry->path().c_str());
  }
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

/// Opens `beside`, a new file that will take the place of `path`, and locks it. The lock tells
/// remove_left_behind() that it is in use; not every file system has locks.
Descriptor open_locked(const std::filesystem::path& path, const std::filesystem::path& beside,
                       int flags) {
  Descriptor file(::open(beside.c_str(), flags | O_CLOEXEC, 0666));
  if (file.get() < 0) throw_system_error(path, "written", errno);
  (void)::flock(file.get(), LOCK_EX | LOCK_NB);
  return file;
}

/// Makes a new file beside `path` by write(beside), which returns its descriptor, flushes it to
/// disk if `is_flushed`, and renames it to `path`, or to the file to which `path` is a link, whose
/// path it returns. Throws what `write` throws, or Error(kBadInput), and then removes the new file.
template <class Write>
std::filesystem::path put_in_place(const std::filesystem::path& path, bool is_flushed,
                                   const Write& write) {
  std::filesystem::path place = check_output_file(path);
  if (place.has_parent_path()) make_folder(place.parent_path());
  // The process number in the name keeps the files of two processes that write to `path` apart.
  const std::filesystem::path beside =
      place.string() + fmt::format("{}{}{}", kUnfinishedOf, ::getpid(), kUnfinished);
  try {
    const Descriptor file = write(beside);
    if (is_flushed && ::fsync(file.get()) != 0) throw_system_error(path, "written", errno);
    if (::rename(beside.c_str(), place.c_str()) != 0) throw_system_error(path, "written", errno);
    return place;
  } catch (...) {
    ::unlink(beside.c_str());
    throw;
  }
}

std::filesystem::path put_content(const std::filesystem::path& path, std::string_view content,
                                  bool is_flushed) {
  return put_in_place(path, is_flushed, [&](const std::filesystem::path& beside) {
    auto file = open_locked(path, beside, O_WRONLY | O_CREAT | O_TRUNC);
    if (!write_all(file, content)) throw_system_error(path, "written", errno);
    return file;
  });
}

/// Flushes the folder of the file at `place`, which was replaced, and removes files that killed
/// processes have left.
void finish_replacement(const std::filesystem::path& place) {
  sync_folder_of(place);
  remove_left_behind(folder_of(place), place.filename().string());
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  // A signal ends open() and read() only while they wait for a pipe. In the program such a signal
  // asks for a stop, because other signals have no handler or a handler with SA_RESTART, after
  // which the calls continue. In the Python module it may also be a signal whose handler the user
  // has set; Python can run this handler only after the wait.
  const auto fail = [&] {
    if (errno == EINTR)
      throw Error(ErrorKind::kInterrupted, "interrupted while {} was read", path.string());
    throw_system_error(path, "read", errno);
  };
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail();
  // A device, such as /dev/zero, may have no end.
  struct stat status = {};
  if (::fstat(file.get(), &status) == 0 && (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)))
    throw_bad_input({path.string()}, "cannot be read (a device, not a file)");
  std::string content;
  std::array<char, 1 << 16> buffer{};  // bytes
  for (;;) {
    const ssize_t count = ::read(file.get(), buffer.data(), buffer.size());
    if (count < 0) fail();
    if (count == 0) return content;
    content.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::vector<std::filesystem::path> missing;
  for (auto folder = path; !folder.empty() && !std::filesystem::exists(folder, error);
       folder = folder.parent_path())
    missing.push_back(folder);
  std::filesystem::create_directories(path, error);
  if (error) throw_system_error(path, "made", error.value());
  for (const auto& folder : missing) sync_folder_of(folder);
}

void remove_file(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove(path, error);
  if (error) throw_system_error(path, "removed", error.value());
}

void sync_folder_of(const std::filesystem::path& path) {
  const Descriptor file(::open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // EINVAL: the file system cannot flush folders.
  if (file.get() >= 0 && ::fsync(file.get()) != 0 && errno != EINVAL)
    throw_system_error(path, "written", errno);
}

std::filesystem::path check_output_file(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  // The system follows links here, because the text of the link /dev/stdout to a pipe is no path.
  const auto status = fs::status(path, error);
  if (fs::is_directory(status)) throw_system_error(path, "written", EISDIR);
  // Renaming over a device or a pipe would remove it for all processes.
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw_bad_input({path.string()}, "cannot be written (not a regular file)");
  // A symbolic link is kept; the file that it points to is replaced.
  fs::path place = path;
  if (fs::is_symlink(fs::symlink_status(path, error))) {
    place = fs::weakly_canonical(path, error);
    // weakly_canonical does not follow a link to a file that does not exist yet.
    if (!error && fs::is_symlink(fs::symlink_status(place, error)))
      place = place.parent_path() / fs::read_symlink(place, error);
    if (error) throw_system_error(path, "written", error.value());
  }
  return place;
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  finish_replacement(put_content(path, content, true));
}

void write_file_by(const std::filesystem::path& path,
                   const std::function<void(const std::filesystem::path&)>& write) {
  finish_replacement(put_in_place(path, true, [&](const std::filesystem::path& beside) {
    write(beside);
    return open_locked(path, beside, O_RDWR);
  }));
}

void write_unflushed(const std::filesystem::path& path, std::string_view content) {
  (void)put_content(path, content, false);
}

void flush_files(std::span<const std::filesystem::path> paths) {
  assert(std::ranges::all_of(
      paths, [&](const auto& path) { return path.parent_path() == paths.front().parent_path(); }));
  for (const auto& path : paths) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0 || ::fsync(file.get()) != 0) throw_system_error(path, "written", errno);
  }
  if (!paths.empty()) sync_folder_of(paths.front());
}

void remove_unfinished(const std::filesystem::path& folder) { remove_left_behind(folder, ""); }

}  // namespace viscontact
