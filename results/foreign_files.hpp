// Protects files that Viscontact did not write, or of another kind, from being replaced.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace viscontact::results {

/// The first MiB of a file; if a PDF is longer, its last MiB follows. Every output of Viscontact
/// has its provenance, the record of how it was made, in this part. Throws Error(kBadInput) that
/// names the path if the file cannot be opened. The text of an empty file or of a folder is empty.
std::string read_head(const std::filesystem::path& path);

/// True if Viscontact wrote the file at `path`, which must exist. Only read_head() is searched,
/// because a restart file can be a gigabyte long, and throws.
bool is_written_by_viscontact(const std::filesystem::path& path);

/// Throws Error(kBadInput) if the file at `path` must not be replaced or deleted, because
/// Viscontact did not write it or because it is of another kind, and as read_head() does. `marker`
/// is a text that every file of the right kind has in its first MiB; an empty marker accepts any
/// kind. `kind` names the kind in the message, for example "picture", and is not empty. An empty
/// file may be replaced. Does nothing if there is no regular file at `path`. Call this function
/// before any work is done, so that no work is lost.
void refuse_other_kind(const std::filesystem::path& path, std::string_view marker,
                       std::string_view kind);

}  // namespace viscontact::results
