// Provenance, the record of how a file was made: one line of JSON in every output.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/common/text/text_kind.hpp"

namespace viscontact::results {

struct InputFile {
  std::string file;           ///< path; a relative path begins at Provenance::folder
  std::string sha256;         ///< of the file's bytes; empty if it is a pipe
  bool intermediate = false;  ///< the same command made the file, as `run` makes its table
};

/// How a file was made: command, inputs and versions.
struct Provenance {
  /// The command as it was typed: program, then arguments.
  std::vector<std::string> command;
  /// Absolute path of the folder in which the command ran; empty if left out (without_folders()).
  std::string folder;
  /// The inputs in the order in which they are used.
  std::vector<InputFile> inputs;
  /// The version of each program and library, by its name.
  std::map<std::string, std::string> versions;
  /// The file that was written, as the command names it.
  std::string output;
  /// The time in UTC, ISO 8601 to the second. If the environment variable SOURCE_DATE_EPOCH is set,
  /// it is the time in this variable (reproducible-builds.org).
  std::string made;
};

struct Inputs {
  std::vector<std::filesystem::path> given;         ///< files that the user gave
  std::vector<std::filesystem::path> intermediate;  ///< files that the same command made
};

/// The provenance of an output that this process makes from these files, without `output` and
/// `made`. Call this function before a long computation, because a user may edit the files
/// meanwhile. Throws Error(kBadInput) if a file cannot be read. Here and below, functions with
/// paths throw std::filesystem::filesystem_error, too, if the system refuses a path.
Provenance provenance_of(const Inputs& inputs);

/// The position in a word of a command at which an absolute path begins: after "--output=" (or
/// another option with "=") or after "-o", otherwise 0.
std::size_t path_in_word(const std::string& word);

/// The provenance for a file that users pass on to others. `folder` becomes empty, and an absolute
/// path below it becomes relative to it. All other absolute paths, and the path of the program, are
/// replaced by their file names.
Provenance without_folders(Provenance provenance);

/// `text` with the provenance as one line in it. The line is the first key of a kJson file, an
/// element `metadata` of a kSvg file, a data script in the head of a kHtml file, a comment before
/// the last lines of a kPdf file, a chunk of text after the header of a kPng file, an entry of the
/// second line of a kXyz file, and a comment at the head of any other file. `text` must be a
/// complete file of this kind, for kJson an object with at least one key. Throws std::out_of_range
/// if `text` lacks the mark at which the line is inserted: "{" of kJson, "<svg" and ">" of kSvg,
/// "</head>" of kHtml, "?>" of kXml, "startxref" of kPdf, the header (33 bytes) of kPng, or the
/// second line of kXyz.
std::string with_provenance(TextKind kind, const std::string& text, const Provenance& provenance);

/// `text` without the line that with_provenance() inserted; unchanged if it has none, or if another
/// program has written the provenance in another form. Two files that were made in the same way at
/// different times are equal without their provenance, except that a PDF also has a date of
/// creation.
std::string without_provenance(const std::string& text);

/// True if the file at `path` has `text` besides its provenance. False if it cannot be read.
bool has_content(const std::filesystem::path& path, const std::string& text);

/// SHA-256 (64 hexadecimal digits) of the text without its provenance. An output that is made from
/// another output records this hash of the other.
std::string content_sha256(const std::string& text);

/// The provenance in a text of any kind, or nothing. Throws Error(kBadInput) that names `file` if
/// the provenance is damaged.
std::optional<Provenance> provenance_in(const std::string& text, const std::string& file);

/// Throws as provenance_in() does, and Error(kBadInput) if the file cannot be read.
std::optional<Provenance> read_provenance(const std::filesystem::path& path);

/// A sentence that says that an input no longer exists, was a pipe or has changed since the output
/// was made; empty if the input has not changed. `folder` is the folder in which the command ran.
/// Throws Error(kBadInput) if the input exists but cannot be read.
std::string change_of(const InputFile& input, const std::filesystem::path& folder);

/// The folder from which the relative paths in the provenance of `file` lead to files. It is the
/// folder in which the command ran, or another folder below which `file` and the inputs lie in the
/// same places, as in a copy or a clone of the project. If Provenance::folder is empty, it is the
/// folder from which the path Provenance::output leads to `file`, or else the folder that contains
/// `file`.
std::filesystem::path folder_to_run_in(const std::filesystem::path& file,
                                       const Provenance& provenance);

/// The present paths of the files that the user gave to the command that made the file at `path`,
/// in the order of the provenance. Throws Error(kBadInput) that names `path` if the file at `path`
/// cannot be read or has no provenance or a damaged one, or if one of the user's files is missing,
/// was a pipe or has changed since.
std::vector<std::filesystem::path> given_inputs(const std::filesystem::path& path);

/// `text` with the provenance, whose `output` is `path` and whose `made` is the current time or
/// that of SOURCE_DATE_EPOCH. Throws Error(kWrongUsage) if the environment variable
/// SOURCE_DATE_EPOCH is set but is not a whole number of seconds from 0 (1970) to the end of the
/// year 9999, and std::out_of_range as with_provenance() does.
std::string output_text(const std::filesystem::path& path, TextKind kind, const std::string& text,
                        Provenance provenance);

/// Writes output_text(). Throws Error(kBadInput) if the file cannot be written, and as
/// output_text().
void write_output(const std::filesystem::path& path, TextKind kind, const std::string& text,
                  Provenance provenance);

/// Does what write_output() does, with its errors, and returns true. But if the file already has
/// this text and was made in the same folder from the same inputs, even by another version or
/// command, the file and its time `made` stay as they are, and the result is false.
bool write_if_changed(const std::filesystem::path& path, TextKind kind, const std::string& text,
                      const Provenance& provenance);

/// The versions of Viscontact and of the libraries that it was built with, by name.
std::map<std::string, std::string> library_versions();

/// The version that FreeFEM reports, or "not found" if FreeFEM cannot be run or fails. Throws
/// Error(kInterrupted) if `stop` requests a stop.
std::string freefem_version_or_not_found(const StopToken& stop = {});

}  // namespace viscontact::results
