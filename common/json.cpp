// JSON with lines: a check of the syntax, a scan for lines and repeated keys, then the library's
// own parser (json.hpp).
#include "viscontact/common/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"

namespace viscontact {
namespace {

constexpr std::string_view kJsonByteOrderMark = "\xEF\xBB\xBF";  // the parser skips it

/// Accepts all events of the parser and records where and why it stopped. The exceptions of the
/// parser do not say where a number is that is too large for a double.
struct SyntaxCheck {
  std::size_t position = 0;  // number of bytes read when the parser stopped
  std::string cause;

  bool null() { return true; }
  bool boolean(bool) { return true; }
  bool number_integer(Json::number_integer_t) { return true; }
  bool number_unsigned(Json::number_unsigned_t) { return true; }
  bool number_float(Json::number_float_t, const std::string&) { return true; }
  bool string(std::string&) { return true; }
  bool binary(Json::binary_t&) { return true; }
  bool start_object(std::size_t) { return true; }
  bool key(std::string&) { return true; }
  bool end_object() { return true; }
  bool start_array(std::size_t) { return true; }
  bool end_array() { return true; }
  bool parse_error(std::size_t at, const std::string&, const Json::exception& error) {
    position = at;
    cause = cause_in_words(error);
    return false;
  }
};

void check_syntax(const std::string& text, const std::string& file) {
  SyntaxCheck check;
  if (Json::sax_parse(text, &check)) {
    // The parser takes a NUL character for the end of the text and ignores what follows.
    const auto nul = text.find('\0');
    if (nul == std::string::npos) return;
    check.position = nul + 1;
    check.cause = "a NUL character";
  }
  // The last byte that was read caused the error.
  const auto at = std::min(check.position > 0 ? check.position - 1 : 0, text.size());
  const auto before = std::string_view(text).substr(0, at);
  const auto newline = before.rfind('\n');
  const auto column = newline == std::string_view::npos ? at + 1 : at - newline;
  throw_bad_input({file, static_cast<int>(1 + std::ranges::count(before, '\n'))},
                  fmt::format("is not valid JSON at column {} ({})", column, check.cause));
}

/// Goes through a valid text, records the line of each value, and throws Error(kBadInput) if a key
/// occurs twice in an object. It uses no recursion, because deep nesting could overflow the stack.
class LineScan {
 public:
  LineScan(std::string_view text, std::string file, std::map<std::string, int>& lines)
      : text_(text), file_(std::move(file)), lines_(lines) {}

  void run() {
    if (text_.starts_with(kJsonByteOrderMark)) at_ = kJsonByteOrderMark.size();
    while (at_ < text_.size()) step();
  }

 private:
  struct Level {
    bool is_object = false;
    bool key_is_next = false;
    std::size_t index = 0;  // number of the element, in an array
    // Path of the array or object, and key of its present member.
    std::string path, key;
    std::set<std::string> keys;  // of an object, so far
  };

  void step() {
    const char c = text_[at_];
    if (c == '{' || c == '[') {
      const std::string path = begin_value();
      levels_.push_back({c == '{', c == '{', 0, path, {}, {}});
    } else if (c == '}' || c == ']') {
      levels_.pop_back();
    } else if (c == ',') {
      ++levels_.back().index;
      levels_.back().key_is_next = levels_.back().is_object;
    } else if (c == '\n') {
      ++line_;
    } else if (c == '"') {
      const auto word = read_string();
      if (!levels_.empty() && levels_.back().key_is_next)
        take_key(word);
      else
        begin_value();
      return;
    } else if (std::string_view(" \t\r:").find(c) == std::string_view::npos) {
      begin_value();
      at_ = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
      return;
    }
    ++at_;
  }

  /// Returns the string that begins here, with its quotes, and moves to its end.
  std::string_view read_string() {
    const auto begin = at_++;
    while (text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    return text_.substr(begin, ++at_ - begin);
  }

  void take_key(std::string_view word) {
    auto& level = levels_.back();
    level.key_is_next = false;
    level.key = Json::parse(word).get<std::string>();
    if (!level.keys.insert(level.key).second)
      throw_bad_input({file_, line_},
                      fmt::format("{}{}{} stands twice; a key must stand once in its object",
                                  level.path, level.path.empty() ? "" : ".", level.key));
  }

  /// Records the line of the value that begins here, and returns its path.
  std::string begin_value() {
    constexpr std::size_t kDeepest = 8;  // more levels would cost too much memory
    if (levels_.size() > kDeepest) return {};
    std::string path;
    if (!levels_.empty()) {
      const auto& level = levels_.back();
      path = level.is_object
                 ? fmt::format("{}{}{}", level.path, level.path.empty() ? "" : ".", level.key)
                 : fmt::format("{}[{}]", level.path, level.index);
    }
    lines_.emplace(path, line_);
    return path;
  }

  std::string_view text_;
  std::string file_;
  std::map<std::string, int>& lines_;
  std::vector<Level> levels_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

std::string cause_in_words(const Json::exception& error) {
  // The text of an error has this form:
  // "[json.exception.parse_error.101] parse error at line 1, column 2: what is wrong"
  constexpr std::size_t kLongest = 200;
  const std::string what = error.what();
  std::string cause = what.substr(std::min(what.size(), what.find("] ") + 2));
  if (const auto column = cause.find(", column "); column != std::string::npos)
    cause = cause.substr(std::min(cause.size(), cause.find(": ", column) + 2));
  return cause.size() <= kLongest ? cause : cause.substr(0, kLongest) + "...";
}

JsonDocument JsonDocument::parse(const std::string& text, std::string file) {
  check_syntax(text, file);
  JsonDocument document;
  LineScan(text, file, document.lines_).run();
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

}  // namespace viscontact
