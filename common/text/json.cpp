// A text is read twice: once for errors, lines and repeated keys, and once for the values.
#include "viscontact/common/text/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/utf16.hpp"

namespace viscontact {
namespace {

/// Follows the events of the parser. Records the line of each value, the first key that stands
/// twice in its object, and where and why the parser stopped. The exception of the parser is not
/// enough: if a number is too large for a double, it does not say where.
class LineRecorder {
 public:
  /// `text` and `lines`, the line of each value by its path, must outlive the object.
  LineRecorder(const std::string& text, std::map<std::string, int>& lines)
      : text_(text), stream_(text), lines_(lines) {}

  /// Messages call the text `file`. Throws Error(kBadInput) with the line if the text is not valid
  /// JSON or if a key stands twice in its object.
  void run(const std::string& file) {
    bool is_valid = Json::sax_parse(stream_, this);
    // The parser ends at a NUL character and ignores what follows.
    if (const auto nul = text_.find('\0'); is_valid && nul != std::string::npos) {
      is_valid = false;
      stopped_at_ = nul + 1;
      cause_ = "a NUL character";
    }
    if (!is_valid) {
      // The last byte that was read caused the error.
      const auto at = std::min(stopped_at_ > 0 ? stopped_at_ - 1 : 0, text_.size());
      const auto before = std::string_view(text_).substr(0, at);
      const auto newline = before.rfind('\n');
      const auto column = newline == std::string_view::npos ? at + 1 : at - newline;
      throw_bad_input({file, static_cast<int>(1 + std::ranges::count(before, '\n'))},
                      "is not valid JSON at column {} ({})", column, cause_);
    }
    if (repeated_key_line_ > 0)
      throw_bad_input({file, repeated_key_line_, repeated_key_},
                      repeated_key_ + " stands twice; a key must stand once in its object");
  }

  // The events of Json::sax_parse. They return true to continue.
  bool null() { return begin_value(); }
  bool boolean(bool) { return begin_value(); }
  bool number_integer(Json::number_integer_t) { return begin_value(); }
  bool number_unsigned(Json::number_unsigned_t) { return begin_value(); }
  bool number_float(Json::number_float_t, const std::string&) { return begin_value(); }
  bool string(std::string&) { return begin_value(); }
  bool binary(Json::binary_t&) { return begin_value(); }
  bool start_object(std::size_t) { return begin_level(true); }
  bool start_array(std::size_t) { return begin_level(false); }
  bool end_object() { return end_level(); }
  bool end_array() { return end_level(); }
  bool key(std::string& word) {
    auto& level = levels_.back();
    level.key = word;
    if (!level.keys.insert(word).second && repeated_key_line_ == 0) {
      repeated_key_line_ = line();
      repeated_key_ = path_of_member();
    }
    return true;
  }
  bool parse_error(std::size_t at, const std::string&, const Json::exception& error) {
    stopped_at_ = at;
    cause_ = cause_in_words(error);
    return false;
  }

 private:
  /// An array or object that the parser has not yet left.
  struct Level {
    bool is_object = false;
    std::string path;            // of the array or object
    std::size_t index = 0;       // number of the current element, in an array
    std::string key;             // of the current member
    std::set<std::string> keys;  // of an object, found so far
  };

  std::string path_of_member() const {
    if (levels_.empty()) return {};
    const auto& level = levels_.back();
    if (!level.is_object) return fmt::format("{}[{}]", level.path, level.index);
    return fmt::format("{}{}{}", level.path, level.path.empty() ? "" : ".", level.key);
  }

  /// Empty deeper than eight levels, because paths of deeply nested texts would take much memory.
  std::string recorded_path() const {
    constexpr std::size_t kDeepest = 8;
    return levels_.size() > kDeepest ? std::string() : path_of_member();
  }

  /// The line of the token that the parser has just read. After a number the parser has read one
  /// character more, so that the last character must not be counted. This is correct for other
  /// tokens, too, because none of them ends with a line end.
  int line() {
    const std::streamoff read = stream_.rdbuf()->pubseekoff(0, std::ios::cur, std::ios::in);
    const auto end = static_cast<std::size_t>(read - 1);
    line_ += static_cast<int>(
        std::ranges::count(std::string_view(text_).substr(counted_, end - counted_), '\n'));
    counted_ = end;
    return line_;
  }

  bool begin_value() {
    lines_.emplace(recorded_path(), line());
    if (!levels_.empty()) ++levels_.back().index;
    return true;
  }

  bool begin_level(bool is_object) {
    const std::string path = recorded_path();
    begin_value();
    levels_.push_back({is_object, path, 0, {}, {}});
    return true;
  }

  bool end_level() {
    levels_.pop_back();
    return true;
  }

  const std::string& text_;
  std::istringstream stream_;
  std::map<std::string, int>& lines_;
  std::vector<Level> levels_;
  int line_ = 1;
  std::size_t counted_ = 0;    // number of bytes up to which line_ counts the line ends
  int repeated_key_line_ = 0;  // 0: no key stands twice
  std::string repeated_key_;
  std::size_t stopped_at_ = 0;  // number of bytes read when the parser stopped
  std::string cause_;
};

}  // namespace

std::string cause_in_words(const Json::exception& error) {
  // The text of an error has this form:
  // "[json.exception.parse_error.101] parse error at line 1, column 2: what is wrong"
  constexpr std::size_t kLongest = 200;  // bytes
  const std::string what = error.what();
  std::string cause = what.substr(std::min(what.size(), what.find("] ") + 2));
  if (const auto column = cause.find(", column "); column != std::string::npos)
    cause = cause.substr(std::min(cause.size(), cause.find(": ", column) + 2));
  return cause.size() <= kLongest ? cause : cause.substr(0, kLongest) + "...";
}

JsonDocument JsonDocument::parse(const std::string& text, std::string file) {
  refuse_utf16(text, file);
  JsonDocument document;
  LineRecorder(text, document.lines_).run(file);
  document.root_ = Json::parse(text);
  document.file_ = std::move(file);
  return document;
}

int JsonDocument::line_of(std::string path) const {
  for (;;) {
    if (const auto found = lines_.find(path); found != lines_.end()) return found->second;
    const auto last = path.find_last_of(".[");
    path.erase(last == std::string::npos ? 0 : last);
  }
}

void read_json(const std::filesystem::path& path, const std::function<void(const Json&)>& read) {
  const auto document = JsonDocument::parse(read_file(path), path.string());
  try {
    read(document.root());
  } catch (const Json::exception& error) {
    throw_bad_input({path.string()}, "is not complete ({})", cause_in_words(error));
  }
}

}  // namespace viscontact
