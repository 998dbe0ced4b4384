// Writes the line of provenance into each kind of file, and finds and reads it again.
#include "viscontact/results/provenance.hpp"

#include <ceres/version.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sundials/sundials_config.h>

#include <Eigen/Core>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <sstream>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/json.hpp"
#include "viscontact/freefem_axi/journal/freefem.hpp"

namespace viscontact::results {
namespace {

// A line is a provenance if it contains kName followed by kBegin, the beginning of a JSON object.
// foreign_files.cpp repeats both.
constexpr std::string_view kName = "provenance";
constexpr std::string_view kBegin = "{\"command\":[";

std::vector<std::string> own_command() {
  const std::string words = read_file("/proc/self/cmdline");
  std::vector<std::string> command;
  for (std::size_t begin = 0; begin < words.size();) {
    const auto end = words.find('\0', begin);
    command.push_back(words.substr(begin, end - begin));
    begin = end == std::string::npos ? words.size() : end + 1;
  }
  return command;
}

/// See Provenance::made. Throws Error(kWrongUsage) if SOURCE_DATE_EPOCH is not such a time.
std::string time_of_making() {
  std::time_t now = std::time(nullptr);
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
    // The last second of the year 9999: later years have five digits.
    constexpr std::time_t kYear9999 = 253402300799;
    const std::string_view text = epoch;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), now);
    if (error != std::errc() || end != text.data() + text.size() || now < 0 || now > kYear9999)
      throw Error(ErrorKind::kWrongUsage,
                  "SOURCE_DATE_EPOCH is '{}'; it must be a whole number of seconds from 0 to {}",
                  epoch, kYear9999);
  }
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

/// The hash is empty for a pipe, which can be read only once.
std::string hash_of(const std::filesystem::path& file) {
  return std::filesystem::exists(file) && !std::filesystem::is_regular_file(file)
             ? ""
             : sha256(read_file(file));
}

/// JSON on one line. With `is_ascii`, \uXXXX replaces the characters that are not ASCII.
std::string as_line(const Provenance& provenance, bool is_ascii = false) {
  Json json;
  json["command"] = provenance.command;
  json["folder"] = provenance.folder;
  json["inputs"] = Json::array();
  for (const auto& input : provenance.inputs) {
    json["inputs"].push_back({{"file", input.file}, {"sha256", input.sha256}});
    if (input.intermediate) json["inputs"].back()["intermediate"] = true;
  }
  if (!provenance.output.empty()) json["output"] = provenance.output;
  json["versions"] = provenance.versions;
  json["made"] = provenance.made;
  return json.dump(-1, ' ', is_ascii, Json::error_handler_t::replace);
}

/// `json` with each of the `characters`, which could end the element, script or comment around the
/// JSON, replaced by \uXXXX. The meaning of the JSON does not change.
std::string without(std::string_view characters, const std::string& json) {
  std::string text;
  for (const char c : json)
    if (characters.find(c) != std::string_view::npos)
      text += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      text += c;
  return text;
}

/// The beginning of a chunk of a PNG: its type (tEXt, a text with a keyword), then the keyword.
constexpr std::string_view kChunk{"tEXtprovenance\0", 15};

/// The text before and after the JSON in a kind of file.
struct Wrapping {
  std::string before, after;
  std::string_view forbidden;   ///< characters that must not stand between `before` and `after`
  std::string_view end = "\n";  ///< what follows `after`
};

Wrapping wrapping_of(TextKind kind) {
  switch (kind) {
    case TextKind::kHashComment:
      return {"# provenance: ", "", ""};
    case TextKind::kJson:
      return {"  \"provenance\": ", ",", ""};
    case TextKind::kSvg:
      return {"<metadata id=\"provenance\">", "</metadata>", "<>&"};
    case TextKind::kHtml:
      return {"<script type=\"application/json\" id=\"provenance\">", "</script>", "<>&"};
    case TextKind::kXml:
      return {"<!-- provenance: ", " -->", "-<>&"};
    case TextKind::kC:
      return {"/* provenance: ", " */", "*"};
    case TextKind::kFortran:
      return {"! provenance: ", "", ""};
    case TextKind::kMatlab:
    case TextKind::kPdf:
      return {"% provenance: ", "", ""};
    case TextKind::kPng:
      return {std::string(kChunk), "", ""};
    case TextKind::kXyz:
      // The last entry of the line with the properties of the first frame. ASE and OVITO look for
      // "=" and for quotes.
      return {" provenance='", "'", "'=", ""};
  }
  return {};
}

/// The position for a new line: behind the first `mark` that begins at the position `from` or
/// later, and behind the newline if `mark` is followed by one; npos if there is no such `mark`.
std::size_t line_after(const std::string& text, std::string_view mark, std::size_t from = 0) {
  const auto at = text.find(mark, from);
  if (at == std::string::npos) return at;
  const auto end = at + mark.size();
  return end < text.size() && text[end] == '\n' ? end + 1 : end;
}

/// The position at which with_provenance() inserts the line; npos if the text lacks its mark.
std::size_t place_in(TextKind kind, const std::string& text) {
  switch (kind) {
    case TextKind::kHashComment:
    case TextKind::kC:
    case TextKind::kFortran:
    case TextKind::kMatlab:
    case TextKind::kPng:
      return 0;
    case TextKind::kJson:
      return line_after(text, "{");
    case TextKind::kSvg:
      return line_after(text, ">", text.find("<svg"));
    case TextKind::kHtml:
      return text.find("</head>");
    case TextKind::kXml:
      return line_after(text, "?>");
    case TextKind::kPdf:
      // The line stands behind all objects of the file, so that the table of their offsets stays
      // right.
      return text.rfind("startxref");
    case TextKind::kXyz:
      return text.find('\n', text.find('\n') + 1);
  }
  return 0;
}

// A PNG begins with these 8 bytes and a header of 25, and consists of chunks: 4 bytes length, 4
// bytes type, data, 4 bytes CRC (ISO/IEC 15948).
constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t kPngHeader = 8 + 25;

/// The most significant byte is the first of the 4.
std::string as_bytes(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes += static_cast<char>(static_cast<unsigned char>(number >> static_cast<unsigned>(shift)));
  return bytes;
}

/// The CRC-32 of a chunk of a PNG, over its type and data.
std::uint32_t crc_of(std::string_view bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xedb88320 : 0U);
  }
  return ~crc;
}

/// The chunk of a PNG with the provenance. Its text is ASCII and ends with a newline, where the
/// line of the provenance ends (find_line()).
std::string png_chunk(const Provenance& provenance) {
  const auto content = std::string(kChunk) + as_line(provenance, true) + "\n";
  constexpr std::size_t kType = 4;  // bytes of the type, which the length does not count
  return as_bytes(static_cast<std::uint32_t>(content.size() - kType)) + content +
         as_bytes(crc_of(content));
}

/// The positions at which the JSON of the provenance begins and its line ends.
struct Line {
  std::size_t json = 0, end = 0;
};

std::optional<Line> find_line(const std::string& text) {
  for (auto at = text.find(kBegin); at != std::string::npos; at = text.find(kBegin, at + 1)) {
    // In every Wrapping, at most three characters are between the name and the object ("\": ").
    constexpr std::size_t kLongest = kName.size() + 3;
    const auto before =
        std::string_view(text).substr(at - std::min(at, kLongest), std::min(at, kLongest));
    if (before.find(kName) != std::string_view::npos)
      return Line{at, std::min(text.find('\n', at), text.size())};
  }
  return {};
}

/// `made`, a time in UTC to the second, becomes the date of creation, so that SOURCE_DATE_EPOCH
/// replaces this date, too. The length of the file does not change, because a table in the file has
/// the positions of its objects. A date that is compressed, as the library cairo 1.18 may write it,
/// stays as it is.
std::string with_creation_date(std::string pdf, const std::string& made) {
  constexpr std::string_view kDate = "/CreationDate (D:";
  const auto begin = pdf.find(kDate);
  if (begin == std::string::npos) return pdf;
  std::string digits = made;
  std::erase_if(digits, [](char c) { return c < '0' || c > '9'; });
  // After the 14 digits of the time, those of its distance from UTC follow, unless they are left
  // out.
  for (std::size_t at = begin + kDate.size(), i = 0; at < pdf.size() && pdf[at] != ')'; ++at)
    if (pdf[at] >= '0' && pdf[at] <= '9') pdf[at] = i < digits.size() ? digits[i++] : '0';
  return pdf;
}

/// The folder from which the relative path `output` leads to `file`; nothing if there is none.
std::optional<std::filesystem::path> folder_around(const std::filesystem::path& file,
                                                   const std::string& output) {
  const auto path = std::filesystem::weakly_canonical(file);
  auto folder = path;
  const std::filesystem::path path_of_output = output;
  for ([[maybe_unused]] const auto& part : path_of_output) folder = folder.parent_path();
  if (output.empty() || path_of_output.is_absolute() || folder / path_of_output != path) return {};
  return folder;
}

/// True if `file`, a path in a provenance, is relative or below the folder of the command.
bool moves_with_command(const std::string& file, const Provenance& provenance) {
  return std::filesystem::path(file).is_relative() ||
         (!provenance.folder.empty() && file.starts_with(provenance.folder + "/"));
}

/// The present path of `file` if the files of the command are now in `folder`.
std::filesystem::path place_of(const std::string& file, const Provenance& provenance,
                               const std::filesystem::path& folder) {
  const bool is_below = !file.empty() && file[0] == '/' && moves_with_command(file, provenance);
  return folder / (is_below ? file.substr(provenance.folder.size() + 1) : file);
}

/// True if all inputs that the user gave exist when the files of the command are in `folder`. At
/// least one of them must have a path in the command's folder, because others tell nothing about
/// `folder`, unless the user gave no inputs.
bool has_inputs(const std::filesystem::path& folder, const Provenance& provenance) {
  bool has_given = false, has_moved = false;
  for (const auto& input : provenance.inputs) {
    if (input.intermediate) continue;
    if (!std::filesystem::exists(place_of(input.file, provenance, folder))) return false;
    has_given = true;
    has_moved = has_moved || moves_with_command(input.file, provenance);
  }
  return has_moved || !has_given;
}

}  // namespace

Provenance provenance_of(const Inputs& inputs) {
  Provenance provenance;
  provenance.command = own_command();
  provenance.folder = std::filesystem::current_path().string();
  for (const auto& file : inputs.given)
    provenance.inputs.push_back({file.string(), hash_of(file), false});
  for (const auto& file : inputs.intermediate)
    provenance.inputs.push_back({file.string(), hash_of(file), true});
  provenance.versions = library_versions();
  return provenance;
}

Provenance without_folders(Provenance provenance) {
  namespace fs = std::filesystem;
  const fs::path folder = provenance.folder;
  const auto shorten = [&](std::string& word, std::size_t begin) {
    const fs::path path = word.substr(begin);
    if (!path.is_absolute()) return;
    const auto normal = path.lexically_normal(), relative = normal.lexically_relative(folder);
    const bool below = !relative.empty() && *relative.begin() != "..";
    // A path that ends with "/" has an empty file name, so its last folder is used. The path "/"
    // stays as it is.
    const auto last = normal.has_filename() ? normal : normal.parent_path();
    const auto name = last.has_filename() ? last.filename() : last;
    word.replace(begin, std::string::npos, (below ? relative : name).string());
  };
  for (auto& word : provenance.command) shorten(word, path_in_word(word));
  if (!provenance.command.empty())
    provenance.command[0] = fs::path(provenance.command[0]).filename();
  for (auto& input : provenance.inputs) shorten(input.file, 0);
  shorten(provenance.output, 0);
  provenance.folder.clear();
  return provenance;
}

std::size_t path_in_word(const std::string& word) {
  const auto value = word.find("=/");  // --output=/...
  return value != std::string::npos && word.starts_with("--") ? value + 1
         : word.starts_with("-o/")                            ? 2
                                                              : 0;
}

std::string with_provenance(TextKind kind, const std::string& text, const Provenance& provenance) {
  if (kind == TextKind::kPng)
    return text.substr(0, kPngHeader) + png_chunk(provenance) + text.substr(kPngHeader);
  const auto place = place_in(kind, text);
  const auto [before, after, forbidden, end] = wrapping_of(kind);
  return text.substr(0, place) + before + without(forbidden, as_line(provenance)) + after +
         std::string(end) + text.substr(place);
}

std::string without_provenance(const std::string& text) {
  using enum TextKind;
  const auto line = find_line(text);
  if (!line) return text;
  // The chunk of a PNG begins with 4 bytes for its length, and ends with 4 for its CRC after the
  // line.
  const std::size_t more = text.starts_with(kPngSignature) ? 4 : 0;
  const auto before = std::string_view(text).substr(0, line->json);
  for (const auto kind :
       {kHashComment, kJson, kSvg, kHtml, kXml, kC, kFortran, kMatlab, kPng, kXyz})
    if (const auto wrapping = wrapping_of(kind); before.ends_with(wrapping.before))
      return text.substr(0, line->json - wrapping.before.size() - more) +
             text.substr(std::min(line->end + wrapping.end.size() + more, text.size()));
  return text;
}

bool has_content(const std::filesystem::path& path, const std::string& text) {
  try {
    return std::filesystem::is_regular_file(path) && without_provenance(read_file(path)) == text;
  } catch (const Error&) {
    return false;
  }
}

std::string content_sha256(const std::string& text) { return sha256(without_provenance(text)); }

std::optional<Provenance> provenance_in(const std::string& text, const std::string& file) {
  try {
    Json json;
    if (const auto line = find_line(text)) {
      // The operator >> reads one object. Another program may have put a whole file on one line.
      std::istringstream(text.substr(line->json, line->end - line->json)) >> json;
    } else {
      // Without a line, the file may be JSON that another program has read and written again.
      const auto whole = Json::parse(text, nullptr, false);
      if (!whole.is_object() || !whole.contains("provenance")) return {};
      json = whole.at("provenance");
    }
    Provenance provenance;
    provenance.command = json.at("command").get<std::vector<std::string>>();
    provenance.folder = json.at("folder").get<std::string>();
    for (const auto& input : json.at("inputs"))
      provenance.inputs.push_back({input.at("file").get<std::string>(),
                                   input.at("sha256").get<std::string>(),
                                   input.value("intermediate", false)});
    provenance.versions = json.at("versions").get<std::map<std::string, std::string>>();
    provenance.output = json.value("output", "");
    provenance.made = json.at("made").get<std::string>();
    return provenance;
  } catch (const Json::exception& error) {
    throw_bad_input({file}, "its line 'provenance' is damaged ({})", cause_in_words(error));
  }
}

std::optional<Provenance> read_provenance(const std::filesystem::path& path) {
  return provenance_in(read_file(path), path.string());
}

std::string change_of(const InputFile& input, const std::filesystem::path& folder) {
  const auto path = folder / input.file;
  if (!std::filesystem::exists(path)) return fmt::format("{} no longer exists", path.string());
  if (input.sha256.empty()) return fmt::format("{} was a pipe and not a file", path.string());
  if (sha256(read_file(path)) != input.sha256) return fmt::format("{} has changed", path.string());
  return "";
}

std::filesystem::path folder_to_run_in(const std::filesystem::path& file,
                                       const Provenance& provenance) {
  const auto around = folder_around(file, provenance.output);
  if (provenance.folder.empty())
    return around.value_or(std::filesystem::weakly_canonical(file).parent_path());
  return around && has_inputs(*around, provenance) ? *around
                                                   : std::filesystem::path(provenance.folder);
}

std::vector<std::filesystem::path> given_inputs(const std::filesystem::path& path) {
  const auto provenance = read_provenance(path);
  if (!provenance)
    throw_bad_input({path.string()}, "does not say how it was made; it has no line 'provenance'");
  const auto folder = folder_to_run_in(path, *provenance);
  const bool is_here = folder == std::filesystem::current_path();
  std::vector<std::filesystem::path> files;
  for (const auto& input : provenance->inputs) {
    if (input.intermediate) continue;
    const auto place = place_of(input.file, *provenance, folder);
    if (const auto change = change_of({place.string(), input.sha256}, folder); !change.empty())
      throw_bad_input({path.string()}, "was made from other inputs: {}", change);
    const std::filesystem::path file = input.file;
    files.push_back(is_here && file.is_relative() ? file : place);
  }
  return files;
}

std::string output_text(const std::filesystem::path& path, TextKind kind, const std::string& text,
                        Provenance provenance) {
  provenance.output = path.string();
  provenance.made = time_of_making();
  // A provenance without folders (without_folders()) must not contain the output's folder either.
  if (provenance.folder.empty()) {
    provenance.folder = std::filesystem::current_path().string();
    provenance = without_folders(provenance);
  }
  return with_provenance(
      kind, kind == TextKind::kPdf ? with_creation_date(text, provenance.made) : text, provenance);
}

void write_output(const std::filesystem::path& path, TextKind kind, const std::string& text,
                  Provenance provenance) {
  write_file(path, output_text(path, kind, text, std::move(provenance)));
}

bool write_if_changed(const std::filesystem::path& path, TextKind kind, const std::string& text,
                      const Provenance& provenance) {
  const auto origin_of = [](const Provenance& p) {
    std::vector<std::string> words = {p.folder};
    for (const auto& input : p.inputs) words.insert(words.end(), {input.file, input.sha256});
    return words;
  };
  const auto is_current = [&] {
    try {
      const auto before = has_content(path, text) ? read_provenance(path) : std::nullopt;
      return before && origin_of(*before) == origin_of(provenance);
    } catch (const Error&) {
      return false;  // a file whose provenance is damaged is written again
    }
  };
  if (is_current()) return false;
  write_output(path, kind, text, provenance);
  return true;
}

std::map<std::string, std::string> library_versions() {
  return {{"Viscontact", VISCONTACT_VERSION},
          {"Ceres", CERES_VERSION_STRING},
          {"SUNDIALS", SUNDIALS_VERSION},
          {"Eigen",
           fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}};
}

std::string freefem_version_or_not_found(const StopToken& stop) {
  try {
    return freefem_axi::freefem_version(freefem_axi::default_freefem(stop));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kExternalProgram) throw;
    return "not found";
  }
}

}  // namespace viscontact::results
