// Files that are in the way of an output and that Viscontact did not write.
#pragma once

#include <filesystem>
#include <string_view>

namespace viscontact {

/// True if Viscontact wrote the file at `path`, which exists: its first MiB holds the provenance
/// that every output records there. The rest is not read; a restart file can be a gigabyte long.
/// Throws Error(kBadInput) that names the path if the file cannot be read.
bool is_written_by_viscontact(const std::filesystem::path& path);

/// Throws Error(kBadInput) if a file is at `path` that a command must not replace or delete: one
/// that Viscontact did not write, or one of another kind. `marker` is a text that files of the right
/// kind have in their first MiB; empty: any kind. `kind` names the kind in the message: "picture".
/// An empty file may be replaced, and so may a path at which there is nothing. To be called before
/// any work is done.
void refuse_other_kind(const std::filesystem::path& path, std::string_view marker,
                       std::string_view kind);

}  // namespace viscontact
