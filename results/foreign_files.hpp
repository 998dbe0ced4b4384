// Protects files that Viscontact did not write, or that are of another kind, from being replaced by
// an output. All commands that write files, and python/, call it before their work. A file that
// must not be replaced, or cannot be opened, throws Error(kBadInput) with its path. A change must
// keep that it recognises the outputs of earlier versions.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace viscontact::results {

/// The first MiB of a file, and of a longer PDF also the last MiB, behind the first. Every output
/// of Viscontact has its provenance there, the record of how it was made. Throws Error(kBadInput)
/// that names the path if the file cannot be opened; of an empty file or a folder the text is
/// empty.
std::string read_head(const std::filesystem::path& path);

/// True if Viscontact wrote the file at `path`, which must exist. Only read_head() is searched,
/// because a restart file can be a gigabyte long. Throws the error of read_head().
bool is_written_by_viscontact(const std::filesystem::path& path);

/// Throws Error(kBadInput) if the file at `path` must not be replaced or deleted, because
/// Viscontact did not write it or because it is of another kind. `marker` is a text that every file
/// of the right kind has in its first MiB; an empty marker accepts any kind. `kind` names the kind
/// in the message, for example "picture". An empty file may be replaced. Does nothing if there is
/// no regular file at `path`. Throws the error of read_head(), too. `kind` must not be empty. Call
/// it before any work is done, so that no work is lost.
void refuse_other_kind(const std::filesystem::path& path, std::string_view marker,
                       std::string_view kind);

}  // namespace viscontact::results
