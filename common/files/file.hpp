// Whole files. At any time, also after a power cut, a reader finds the old file or the new one.
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

/// Replaces the file at `path`, or to which the link `path` points, by `content` in one step:
/// writes a new file in the same folder, flushes it to disk and renames it. Makes missing parent
/// folders. Removes files NAME.viscontact-PID.tmp that killed processes have left. Throws
/// Error(kBadInput), which names the path, if the file or a folder cannot be written. An old file
/// is then unchanged, unless only flushing the folder failed.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Does what write_file() does, for a file that a library writes: `write` must make a file at the
/// path that is its argument, and close it. Throws the errors of write_file(), what `write` throws,
/// and Error(kBadInput) if `write` made no file; what `write` has made is then removed.
void write_file_by(const std::filesystem::path& path,
                   const std::function<void(const std::filesystem::path&)>& write);

/// Does what write_file() does, for one of many files, without flushing, so that a power cut may
/// lose the file; call flush_files() after the last one. Files that killed processes have left are
/// not removed; call remove_unfinished() for them, which reads the whole folder.
void write_unflushed(const std::filesystem::path& path, std::string_view content);
/// Flushes these files, which all lie in one folder, and this folder to disk. Throws
/// Error(kBadInput), which names a path, if a file is missing or the disk reports an error.
void flush_files(std::span<const std::filesystem::path> paths);
/// Removes the files NAME.viscontact-PID.tmp (with any NAME) that killed processes have left. A
/// file that cannot be removed stays.
void remove_unfinished(const std::filesystem::path& folder);

/// The path of the file that write_file() would replace: `path`, or the file to which the link
/// `path` points. Throws Error(kBadInput) if something exists there that is not a regular file, or
/// if the link cannot be followed; the file may still be read-only. Call it before a long
/// computation, so that the result is not lost.
std::filesystem::path check_output_file(const std::filesystem::path& path);

/// Makes a folder and its missing parents, and flushes them to disk. Throws Error(kBadInput), which
/// names the path, if that fails.
void make_folder(const std::filesystem::path& path);

/// Removes a file or an empty folder, if any. Throws Error(kBadInput), with the path, if that
/// fails.
void remove_file(const std::filesystem::path& path);

/// Flushes the folder of `path` to disk, so that a new or renamed file is still in it after a power
/// cut. Throws Error(kBadInput), which names the path, if the disk reports an error; a folder that
/// cannot be opened, or a file system that cannot flush folders, is no error.
void sync_folder_of(const std::filesystem::path& path);

}  // namespace viscontact
