// How a file was made: written into every output, read back by `viscontact rerun` and by the report.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/common/text_kind.hpp"

namespace viscontact {

/// A file that went into an output. An intermediate one was made by the same command, as a run's table.
struct InputFile {
  std::string file;    ///< path, relative to the folder of the command
  std::string sha256;  ///< of its bytes; empty for what is no file, as a pipe
  bool intermediate = false;
};

struct Provenance {
  std::vector<std::string> command;  ///< as it was typed: program, arguments
  std::string folder;  ///< in which it was typed, absolute; empty: not told (without_folders)
  std::vector<InputFile> inputs;                ///< in the order in which they are used
  std::map<std::string, std::string> versions;  ///< program: version
  std::string output;  ///< the file that was written, as named by the command
  std::string made;    ///< UTC, ISO 8601 to the second; that of SOURCE_DATE_EPOCH if it is set
};

/// The files that an output is made from.
struct Inputs {
  std::vector<std::filesystem::path> given;         ///< by the user
  std::vector<std::filesystem::path> intermediate;  ///< made by the same command
};

/// Of what this process makes from these files, which are read for their hashes: to be asked for before a long computation, in which a user may edit
/// them. `output` and `made` are empty. Throws Error(kBadInput) if one cannot be read.
Provenance provenance_of(const Inputs& inputs);

/// Where in a word of a command an absolute path would begin: behind "--output=" or "-o", else at 0.
std::size_t path_in_word(const std::string& word);

/// The same for a file that is made to be handed on: it names its source, and not where on a machine
/// it lies. `folder` is empty; a path below it is relative to it, any other absolute path and the
/// program are their file names only.
Provenance without_folders(Provenance provenance);

/// `text` with the provenance in it, as one line: a comment at its head, for kJson the first key, for kSvg metadata, for kHtml a data script in <head>.
/// `text` is whole and of that kind; an object with keys, for kJson.
std::string with_provenance(TextKind kind, const std::string& text, const Provenance& provenance);

/// `text` as it was before with_provenance: what two makings of the same have in common.
std::string without_provenance(const std::string& text);

/// The SHA-256 by which files of ours name each other: of what two makings have in common.
std::string content_sha256(const std::string& text);

/// The provenance in a text of any kind; nothing if it has none. Throws Error(kBadInput) naming `file` if it is damaged.
std::optional<Provenance> provenance_in(const std::string& text, const std::string& file);

/// The same of a file. Throws Error(kBadInput) if it cannot be read, too.
std::optional<Provenance> read_provenance(const std::filesystem::path& path);

/// What has become of an input since; empty if it is as it was. `folder`: where the command ran. Throws Error(kBadInput) if it cannot be read.
std::string change_of(const InputFile& input, const std::filesystem::path& folder);

/// "# provenance: {...}\n", made now, for the CSV file `path`, which is written row by row.
std::string provenance_line(Provenance provenance, const std::filesystem::path& path);

/// What write_output writes: the text with the provenance, made now.
std::string output_text(const std::filesystem::path& path, TextKind kind, const std::string& text,
                        Provenance provenance);

/// write_file with the provenance, made now.
void write_output(const std::filesystem::path& path, TextKind kind, const std::string& text,
                  Provenance provenance);

}  // namespace viscontact
