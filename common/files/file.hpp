// Reads and writes whole files; all parts of Viscontact that read or write files use it. Contents
// are any bytes of any number. A new file is written under another name and then renamed. A failure
// throws Error(kBadInput) with the path, and an old file is then unchanged, unless a function says
// otherwise. The temporary name is a free choice. A change must keep that at any time, also after a
// power cut, a reader finds the old file or the whole new one, because commands continue from such
// files.
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
/// the path, if the file or a folder cannot be written. An old file is then unchanged, unless
/// flushing the folder failed, after the new file had taken the place of the old one.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Does what write_file() does, for a file that a library writes: `write` must make a file at the
/// path that is its argument, and close it. Throws the errors of write_file(), what `write` throws,
/// and Error(kBadInput) if `write` made no file. An old file at `path` is then unchanged, and what
/// `write` has made is removed.
void write_file_by(const std::filesystem::path& path,
                   const std::function<void(const std::filesystem::path&)>& write);

/// Does what write_file() does, for one of many files. It is faster, because the file is not
/// flushed to disk; call flush_files() after the last one. Files that killed processes have left
/// are not removed; call remove_unfinished() for them, which reads the whole folder. Throws
/// Error(kBadInput), which names the path, if the file cannot be written; an old file is then
/// unchanged.
void write_unflushed(const std::filesystem::path& path, std::string_view content);
/// Flushes these files and their folder to disk. All files must lie in the folder of the first one,
/// which is the only folder that is flushed (not checked). Does nothing if there are no files.
/// Throws Error(kBadInput), which names a path, if a file is missing or the disk reports an error.
void flush_files(std::span<const std::filesystem::path> paths);
/// Removes the files NAME.viscontact-PID.tmp (with any NAME) that killed processes have left in the
/// folder. Throws nothing; a file that cannot be removed stays.
void remove_unfinished(const std::filesystem::path& folder);

/// The path of the file that write_file() would replace: `path`, or the file to which the link
/// `path` points. Throws Error(kBadInput) if something exists there that is not a regular file, or
/// if the link cannot be followed. Whether the file can be written is not checked. Call it before a
/// long computation, so that the result is not lost.
std::filesystem::path check_output_file(const std::filesystem::path& path);

/// Makes a folder and those of its parents that are missing, and flushes them to disk. Throws
/// Error(kBadInput), which names the path, if the folder cannot be made, or if the disk reports an
/// error.
void make_folder(const std::filesystem::path& path);

/// Removes a file or an empty folder if it exists. Throws Error(kBadInput), which names the path,
/// if that fails.
void remove_file(const std::filesystem::path& path);

/// Flushes the folder of `path` to disk, so that a new or renamed file is still in it after a power
/// cut. Throws Error(kBadInput), which names the path, if the disk reports an error; a folder that
/// cannot be opened, or a file system that cannot flush folders, is no error.
void sync_folder_of(const std::filesystem::path& path);

}  // namespace viscontact
