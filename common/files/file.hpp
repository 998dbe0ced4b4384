// Whole files: read at once, written beside and renamed, so that a reader never sees half of one.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace viscontact {

/// The bytes of a file. Throws Error(kBadInput) naming the path when it is missing, a folder, a device or not
/// readable.
std::string read_file(const std::filesystem::path& path);

/// Replaces `path` by `content` in one step: written to a new file in the same folder, flushed to
/// disk, renamed. Missing parent folders are made. What a killed process left of a file NAME.viscontact-PID.tmp is taken away. Throws Error(kBadInput) naming the path; then
/// the old file, if any, is untouched.
void write_file(const std::filesystem::path& path, std::string_view content);

/// The file that write_file would replace: `path`, or what it links to. Throws Error(kBadInput) if that is there and no
/// regular file; to be asked before a long computation.
std::filesystem::path check_output_file(const std::filesystem::path& path);

/// Makes a folder and its parents. Throws Error(kBadInput) where that cannot be.
void make_folder(const std::filesystem::path& path);

/// Takes a file away, if it is there. Throws Error(kBadInput) naming the path if it cannot be.
void remove_file(const std::filesystem::path& path);

/// Has the disk remember that `path` is in its folder (a new or renamed file), so that a power cut
/// does not take it away. Throws Error(kBadInput) naming the path if the disk refuses.
void sync_folder_of(const std::filesystem::path& path);

}  // namespace viscontact
