// Provenance: how a file was made. Every output contains its provenance as one line, which
// `viscontact rerun`, the report and foreign_files.hpp read. It names the versions of the programs
// and libraries that made the file. All parts that write results use it. Functions with paths throw
// std::filesystem::filesystem_error, too, if the system refuses to look at them. A change must keep
// files of earlier versions readable.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/common/text/text_kind.hpp"

namespace viscontact::results {

/// A file that an output was made from.
struct InputFile {
  std::string file;           ///< path; a relative one begins at the command's folder
  std::string sha256;         ///< SHA-256 of the file's bytes; empty if it is a pipe
  bool intermediate = false;  ///< true: the same command made the file, as `run` makes its table
};

/// How a file was made: command, inputs and versions.
struct Provenance {
  /// The command as it was typed: program, then arguments.
  std::vector<std::string> command;
  /// Absolute path of the folder in which the command ran; empty if left out (without_folders).
  std::string folder;
  /// The files that the output was made from, in the order in which they are used.
  std::vector<InputFile> inputs;
  /// Version of each program and library, by its name.
  std::map<std::string, std::string> versions;
  /// The file that was written, as the command names it.
  std::string output;
  /// Time at which the file was made: UTC, ISO 8601 to the second. SOURCE_DATE_EPOCH replaces it.
  std::string made;
};

/// The files that an output is made from.
struct Inputs {
  std::vector<std::filesystem::path> given;         ///< files that the user gave
  std::vector<std::filesystem::path> intermediate;  ///< files that the same command made
};

/// The provenance of an output that this process makes from these files; `output` and `made` are
/// empty. The files are read to compute their hashes. Call it before a long computation, because a
/// user may edit the files during the computation. Throws Error(kBadInput) if a file cannot be
/// read.
Provenance provenance_of(const Inputs& inputs);

/// The position (bytes from 0) in a word of a command at which an absolute path begins: after
/// "--output=" (or another option with "=") or after "-o", otherwise 0.
std::size_t path_in_word(const std::string& word);

/// The provenance for a file that users pass on to others. It names the inputs, but no folders of
/// the machine. `folder` becomes empty. An absolute path below `folder` becomes relative
/// to `folder`; of any other absolute path, and of the program, only the file name stays.
Provenance without_folders(Provenance provenance);

/// `text` with the provenance as one line in it. The line is the first key of a kJson file, an
/// element `metadata` of a kSvg file, a data script in the head of a kHtml file, a comment before
/// the last lines of a kPdf file, a chunk of text after the header of a kPng file, and a comment at
/// the head of any other file. `text` must be a complete file of this kind, for kJson an object
/// with at least one key (not checked). Throws std::out_of_range if it lacks the mark at which the
/// line is inserted: "{" of kJson, "<svg" and ">" of kSvg, "</head>" of kHtml, "?>" of kXml,
/// "startxref" of kPdf, or the header of kPng.
std::string with_provenance(TextKind kind, const std::string& text, const Provenance& provenance);

/// `text` as it was before with_provenance, unchanged if it has no provenance, or if another
/// program has written the provenance in another form. Two files that were made in the same way at
/// different times are equal without their provenance.
std::string without_provenance(const std::string& text);

/// True if there is a file at `path` whose text without its provenance is `text`. Such a file is
/// not written again, so that it keeps its time of making. False if the file cannot be read.
bool has_content(const std::filesystem::path& path, const std::string& text);

/// SHA-256 (64 hexadecimal digits) of the text without its provenance. Outputs of Viscontact record
/// by this hash from which other output they were made.
std::string content_sha256(const std::string& text);

/// The provenance in a text of any kind, or nothing if the text has none. Throws Error(kBadInput)
/// that names `file` if the provenance is damaged.
std::optional<Provenance> provenance_in(const std::string& text, const std::string& file);

/// The provenance in the file at `path`, or nothing if the file has none. Throws Error(kBadInput)
/// if the file cannot be read or its provenance is damaged.
std::optional<Provenance> read_provenance(const std::filesystem::path& path);

/// Says in words how an input has changed since the output was made, is missing or was a pipe;
/// empty if it has not changed. `folder` is the folder in which the command ran. Throws
/// Error(kBadInput) if the input is there but cannot be read.
std::string change_of(const InputFile& input, const std::filesystem::path& folder);

/// The folder in which the relative paths of the provenance of `file` lead to files: the folder in
/// which the command ran, unless `file` and the inputs lie in the same places below another folder,
/// as in a copy or a clone of the project. If the provenance has no folder, it is the folder from
/// which the output leads to `file`, or that of `file`.
std::filesystem::path folder_to_run_in(const std::filesystem::path& file,
                                       const Provenance& provenance);

/// The files that the user gave to the command that made the file at `path`, where they are now, in
/// the order of the provenance. Throws Error(kBadInput) that names `path` if it cannot be read or
/// has no provenance, or if one of these files has changed since or is missing.
std::vector<std::filesystem::path> given_inputs(const std::filesystem::path& path);

/// The text that write_output writes: `text` with the provenance and the current time. Throws
/// Error(kWrongUsage) if the variable SOURCE_DATE_EPOCH is set, but no whole number of seconds from
/// 0 (1970) to the end of the year 9999, and as with_provenance().
std::string output_text(const std::filesystem::path& path, TextKind kind, const std::string& text,
                        Provenance provenance);

/// Writes `text` with the provenance and the current time to `path`. Throws the errors of
/// output_text() and write_file().
void write_output(const std::filesystem::path& path, TextKind kind, const std::string& text,
                  Provenance provenance);

/// As write_output(), but leaves a file alone that has this text and was made in the same folder
/// from the same inputs, even if by another version or command. Returns true if it wrote. Throws
/// the errors of write_output().
bool write_if_changed(const std::filesystem::path& path, TextKind kind, const std::string& text,
                      const Provenance& provenance);

/// The versions of Viscontact and of the libraries it was built with, by name.
std::map<std::string, std::string> library_versions();

/// The version that FreeFEM reports, or "not found" if FreeFEM cannot be run or fails. Throws
/// Error(kInterrupted) if `stop` requests a stop.
std::string freefem_version_or_not_found(const StopToken& stop = {});

}  // namespace viscontact::results
