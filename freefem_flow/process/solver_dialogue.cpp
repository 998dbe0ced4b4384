// Asks a fluid solver and checks its answers. docs/troubleshooting.md quotes the messages.
#include "viscontact/freefem_flow/process/solver_dialogue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>
#include <charconv>
#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/common/text/shell_words.hpp"

namespace viscontact::freefem_flow {
namespace {

using namespace std::chrono_literals;

/// Free choices of the dialogue.
struct DialogueTuning {
  // How long a solver that has failed may take to write its last lines and to end.
  static constexpr auto kGraceOfFailed = 1000ms;
  // How long a solver may take to end after the request `end`, docs/fluid-solver.md.
  static constexpr auto kGraceAtEnd = 2000ms;
  // Lines that are skipped before an awaited word; docs/fluid-solver.md promises this number.
  static constexpr int kMostLines = 1000;
  // Bytes of each of the last lines in a message.
  static constexpr std::size_t kLongestLine = 200;
};

/// As a user would type it.
std::string command_in_words(const std::vector<std::string>& arguments) {
  std::string text;
  for (const auto& argument : arguments) text += (text.empty() ? "" : " ") + shell_word(argument);
  return text;
}

/// The first `longest` bytes, with dots if there are more.
std::string shortened(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  return std::string(text.substr(0, longest)) + "...";
}

/// A word of the solver for a message. A byte that is no printable ASCII character becomes a
/// question mark, because it could end the message or disturb a terminal.
std::string in_quotes(std::string_view word) {
  auto text = shortened(word, 40);  // bytes
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return "'" + text + "'";
}

double in_seconds(ChildProcess::Clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

SolverDialogue::SolverDialogue(const SolverCommand& command, std::chrono::milliseconds time_limit,
                               std::chrono::milliseconds first_limit, const StopToken& stop)
    : name_(command_in_words(command.arguments)),
      remedy_if_silent_(command.remedy_if_silent),
      time_limit_(time_limit),
      first_limit_(first_limit) {
  assert(time_limit.count() > 0 && first_limit.count() > 0);
  try {
    process_.emplace(ProcessCommand{command.arguments, command.environment, command.folder}, stop);
  } catch (const Error& error) {
    const auto& remedy = command.remedy_if_missing;
    throw Error(error.kind(), "the fluid solver {}{}{}", error.what(), remedy.empty() ? "" : "; ",
                remedy);
  }
}

SolverDialogue::~SolverDialogue() {
  if (!process_) return;
  process_->send("end\n");
  process_->finish(DialogueTuning::kGraceAtEnd);
}

void SolverDialogue::ask(std::string_view name, std::string_view text) {
  if (!process_)
    throw Error(ErrorKind::kExternalProgram,
                "the fluid solver ({}) has ended after an earlier error", name_);
  // A solver may write before the first request; expect("ready") skips these lines.
  if (requests_ > 0 && process_->has_unread_output())
    fail("it wrote more than the answer", DialogueTuning::kGraceOfFailed);
  request_ = name;
  ++requests_;
  asked_at_ = ChildProcess::Clock::now();
  process_->send(text);
}

SolverDialogue::Reading SolverDialogue::read(
    Reading (ChildProcess::*what)(ChildProcess::Clock::time_point)) {
  assert(process_);
  try {
    return ((*process_).*what)(asked_at_ + limit());
  } catch (const Error&) {
    process_.reset();
    throw;
  }
}

std::string_view SolverDialogue::next_word() {
  const auto reading = read(&ChildProcess::read_word);
  if (reading.state == ChildProcess::State::kRead) {
    if (reading.text == "error") fail_as_solver_says();
    return reading.text;
  }
  fail_without_answer(reading.state);
}

void SolverDialogue::expect(std::string_view word, bool skip_lines) {
  awaited_ = in_quotes(word);
  for (int i = 0; i < DialogueTuning::kMostLines; ++i) {
    if (next_word() == word) return;
    if (!skip_lines) refuse(in_quotes(word));
    process_->put_word_back();
    const auto line = read(&ChildProcess::read_line);
    process_->keep(line.text);
    if (line.state != ChildProcess::State::kRead) fail_without_answer(line.state);
  }
  fail(fmt::format("it wrote {} other lines and not {}", DialogueTuning::kMostLines,
                   in_quotes(word)),
       DialogueTuning::kGraceOfFailed);
}

std::string SolverDialogue::word() { return std::string(next_word()); }

double SolverDialogue::number() {
  const auto value = parse_number(next_word());
  if (!value) refuse("a finite number");
  return *value;
}

double SolverDialogue::number_from_zero() {
  const double value = number();
  if (value < 0) refuse("a number >= 0");
  return value;
}

std::vector<double> SolverDialogue::numbers(std::size_t count) {
  std::vector<double> values(count);
  numbers_asked_ = count;
  for (numbers_read_ = 0; numbers_read_ < count; ++numbers_read_) values[numbers_read_] = number();
  numbers_asked_ = 0;
  return values;
}

std::int64_t SolverDialogue::whole_number(std::int64_t largest) {
  assert(largest >= 0);
  const auto word = next_word();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < 0 || value > largest)
    refuse(fmt::format("a whole number from 0 to {}", largest));
  return value;
}

void SolverDialogue::refuse(std::string_view needed) {
  assert(process_);
  process_->put_word_back();
  const std::string word(process_->read_word(ChildProcess::Clock::now()).text);
  process_->put_word_back();  // so that the message shows the whole line
  fail(fmt::format("it answered {} in place of {}", in_quotes(word), needed),
       DialogueTuning::kGraceOfFailed);
}

void SolverDialogue::fail_as_solver_says() {
  const auto line = read(&ChildProcess::read_line);
  const auto start = line.text.find_first_not_of(" \t\r");
  fail(fmt::format("it says: {}", start == std::string_view::npos ? "an error without a text"
                                                                  : line.text.substr(start)),
       DialogueTuning::kGraceOfFailed);
}

void SolverDialogue::fail_without_answer(ChildProcess::State state) {
  switch (state) {
    case ChildProcess::State::kTimedOut:
      fail(fmt::format("it had not answered after {:g} s ({} was awaited){}{}{}",
                       in_seconds(limit()), awaited_,
                       numbers_asked_ > 0 ? fmt::format(", but for {} of {} numbers", numbers_read_,
                                                        numbers_asked_)
                                          : "",
                       remedy_if_silent_.empty() ? "" : "; ", remedy_if_silent_),
           0ms);
    case ChildProcess::State::kTooLong:
      fail(fmt::format("it wrote a word or a line of more than {} bytes",
                       ChildProcess::kLongestText),
           0ms);
    default:
      fail("it closed its output before the answer was complete", DialogueTuning::kGraceOfFailed);
  }
}

std::string SolverDialogue::asked_in_words() const {
  return fmt::format("request {}, '{}', {:.3g} s after it was sent", requests_, request_,
                     in_seconds(ChildProcess::Clock::now() - asked_at_));
}

void SolverDialogue::fail(const std::string& reason, std::chrono::milliseconds grace) {
  const std::string asked = asked_in_words();
  const std::string end = process_->finish(grace);
  std::vector<std::string> lines;
  for (const auto& line : process_->last_lines())
    lines.push_back(shortened(line, DialogueTuning::kLongestLine));
  process_.reset();
  throw Error(ErrorKind::kExternalProgram, "the fluid solver ({}) failed at {}: {}; it {}; {}",
              name_, asked, reason, end,
              lines.empty() ? "it wrote nothing else"
                            : fmt::format("its last lines: {}", fmt::join(lines, " | ")));
}

void append(std::string& text, std::span<const double> values, const char* what) {
  for (const double value : values) {
    if (!std::isfinite(value))
      throw Error(ErrorKind::kNotConverged,
                  "{} of the particles in the fluid left the range of a double ({})", what, value);
    text += ' ';
    text += format_number(value);
  }
}

std::string words_of(const MeshBoundary& boundary) {
  std::string text =
      fmt::format("boundary {} {}\n", boundary.points.size(), boundary.curves.size());
  for (const auto& point : boundary.points) {
    append(text, point, "a point of the mesh around one");
    text += '\n';
  }
  for (const auto& curve : boundary.curves)
    text += fmt::format("{} {} {}\n", curve.first, curve.edges, curve.label);
  return text;
}

}  // namespace viscontact::freefem_flow
