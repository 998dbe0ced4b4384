// Reads and writes whole files; all parts with files use it. A file is written under another name
// and then renamed. A failure throws Error(kBadInput) with the path, and an old file is then as it
// was, unless a function says otherwise. A change must keep that at any time, also after a power
// cut, a reader finds the old file or the whole new one, because commands continue from such files.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace viscontact {

/// The bytes of a file or a pipe. Throws Error(kBadInput), which names the path, if the file does
/// not exist, is a folder or a device, or cannot be read, and Error(kInterrupted) if a signal comes
/// while the function waits for a pipe.
std::string read_file(const std::filesystem::path& path);

/// Replaces the file at `path` by `content` in one step: writes a new file in the same folder,
/// flushes it to disk and renames it. Makes missing parent folders. Removes files
/// NAME.viscontact-PID.tmp that killed processes have left. Throws Error(kBadInput), which names
/// the path. An old file is then unchanged, unless the error came from flushing the folder, after
/// the new file had taken its place.
void write_file(const std::filesystem::path& path, std::string_view content);

/// As write_file, for a file that a library writes: `write` must make a file at the path that it is
/// given, and close it. Throws what `write` throws, too, and Error(kBadInput) if it made no file.
/// An old file at `path` is then unchanged, and what `write` has made is removed.
void write_file_by(const std::filesystem::path& path,
                   const std::function<void(const std::filesystem::path&)>& write);

/// As write_file() for one of many files, but faster, because the file is not flushed to disk; call
/// flush_files() after the last one. Files that killed processes have left are not removed; call
/// remove_unfinished() for them, which reads the whole folder. Throws Error(kBadInput), which names
/// the path, if the file cannot be written; an old file is then unchanged.
void write_unflushed(const std::filesystem::path& path, std::string_view content);
/// Returns when these files, which lie in one folder (not checked: only that of the first is
/// flushed), are on disk; at once if there are none. Throws Error(kBadInput), which names a path,
/// if a file is missing or the disk reports an error.
void flush_files(std::span<const std::filesystem::path> paths);
/// Removes the files NAME.viscontact-PID.tmp in the folder that killed processes have left. Throws
/// nothing; what cannot be read or removed stays.
void remove_unfinished(const std::filesystem::path& folder);

/// The file that write_file would replace: `path`, or what it links to. Throws Error(kBadInput) if
/// this exists and is not a regular file, or if the link cannot be followed. Whether the file can
/// be written is not checked. Call it before a long computation, so that the result is not lost.
std::filesystem::path check_output_file(const std::filesystem::path& path);

/// Makes a folder and its parents, as far as they are missing, and flushes them to disk. Throws
/// Error(kBadInput), which names the path, if it cannot be made, or if the disk reports an error.
void make_folder(const std::filesystem::path& path);

/// Removes a file or an empty folder if it exists. Throws Error(kBadInput), which names the path,
/// if that fails.
void remove_file(const std::filesystem::path& path);

/// Flushes the folder of `path` to disk, so that a new or renamed file is still in it after a power
/// cut. Throws Error(kBadInput), which names the path, if the disk reports an error; a folder that
/// cannot be opened, or a file system that cannot flush folders, is no error.
void sync_folder_of(const std::filesystem::path& path);

}  // namespace viscontact
