// Exchanges messages with a child process by poll on its three streams at once.
#include "viscontact/common/system/child_process.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <fstream>

#include "viscontact/common/error.hpp"

namespace viscontact {
namespace {

constexpr std::string_view kWhiteSpace = " \t\r\n\v\f";

/// Free choices of the exchange with a child.
struct ChildTuning {
  // The longest delay until a stop is noticed [ms]; child_process.hpp promises this time.
  static constexpr int kLongestWait = 100;
  // Bytes of a buffer; any size from some kB on works.
  static constexpr std::size_t kBufferSize = 1 << 16;
  // Time between two checks for the end of a child [ms]; any short time works.
  static constexpr int kPause = 10;
  // Buffers that are read after the end, 4 MB; any number works that empties the sockets.
  static constexpr int kLastBuffers = 64;
};

/// The bytes that have arrived, in `buffer`; does not wait. Closes the descriptor at its end.
std::string_view receive_from(Descriptor& from,
                              std::array<char, ChildTuning::kBufferSize>& buffer) {
  const ssize_t count = ::recv(from.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (count > 0) return {buffer.data(), static_cast<std::size_t>(count)};
  if (count == 0 || (errno != EAGAIN && errno != EINTR)) from.close();
  return {};
}

}  // namespace

void LastLines::add(Stream stream, std::string_view text) {
  std::string& line = incomplete_[stream];
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    line += text.substr(0, std::min(end, kLongest - std::min(kLongest, line.size())));
    if (end == text.size()) return;
    complete(line);
    text.remove_prefix(end + 1);
  }
}

void LastLines::complete(std::string& line) {
  const auto first = line.find_first_not_of(kWhiteSpace);
  if (first != std::string::npos)
    lines_.push_back(line.substr(first, line.find_last_not_of(kWhiteSpace) + 1 - first));
  line.clear();
  if (lines_.size() > kLines) lines_.pop_front();
}

std::deque<std::string> LastLines::lines() const {
  LastLines all = *this;
  for (auto& line : all.incomplete_) all.complete(line);
  return all.lines_;
}

ChildProcess::ChildProcess(const ProcessCommand& command, const StopToken& stop)
    : stop_(stop), child_(start_process(command, ErrorStream::kSeparate)) {
  if (child_.id < 0)
    throw Error(ErrorKind::kExternalProgram, "{} cannot be run ({})", command.arguments.front(),
                child_.failure);
}

ChildProcess::~ChildProcess() {
  if (child_.id < 0) return;
  // finish() was not called, so the end of the child has not been waited for, and no other process
  // group can have its number yet.
  ::kill(-child_.id, SIGKILL);
  while (::waitpid(child_.id, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void ChildProcess::send(std::string_view text) {
  to_send_.erase(0, sent_);
  sent_ = 0;
  to_send_ += text;
}

void ChildProcess::send_some() {
  const ssize_t count = ::send(child_.to_child.get(), to_send_.data() + sent_,
                               to_send_.size() - sent_, MSG_NOSIGNAL | MSG_DONTWAIT);
  if (count > 0) sent_ += static_cast<std::size_t>(count);
  // A child that no longer reads may still answer. Otherwise reading ends with kClosed or
  // kTimedOut.
  if (count < 0 && errno != EAGAIN && errno != EINTR) child_.to_child.close();
}

void ChildProcess::receive() {
  std::array<char, ChildTuning::kBufferSize> buffer{};
  const auto text = receive_from(child_.from_child, buffer);
  // Removes what was read before, except for the last word, because put_word_back() may need it.
  const std::size_t done = std::min(word_start_, at_);
  output_.erase(0, done);
  at_ -= done;
  word_start_ -= done;
  output_ += text;
}

void ChildProcess::receive_errors() {
  std::array<char, ChildTuning::kBufferSize> buffer{};
  last_lines_.add(LastLines::kErrors, receive_from(child_.errors_of_it, buffer));
}

void ChildProcess::exchange(int milliseconds) {
  // poll ignores a file whose descriptor is -1.
  const bool to_write = sent_ < to_send_.size();
  std::array<pollfd, 3> files = {pollfd{child_.from_child.get(), POLLIN, 0},
                                 pollfd{child_.errors_of_it.get(), POLLIN, 0},
                                 pollfd{to_write ? child_.to_child.get() : -1, POLLOUT, 0}};
  if (::poll(files.data(), files.size(), milliseconds) <= 0) return;
  if (files[2].revents != 0) send_some();
  if (files[1].revents != 0) receive_errors();
  if (files[0].revents != 0) receive();
}

ChildProcess::Reading ChildProcess::more_or(Clock::time_point deadline, std::size_t length) {
  if (length > kLongestText)
    return {State::kTooLong, std::string_view(output_).substr(at_, kLongestText)};
  if (child_.from_child.get() < 0) return {State::kClosed, {}};
  stop_.throw_if_stop_requested();
  const auto now = Clock::now();
  if (now >= deadline) return {State::kTimedOut, {}};
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - now).count();
  exchange(left < ChildTuning::kLongestWait ? static_cast<int>(left) : ChildTuning::kLongestWait);
  return {};
}

ChildProcess::Reading ChildProcess::read_word(Clock::time_point deadline) {
  assert(child_.id >= 0);
  std::size_t searched = 0;  // bytes of the word that are known not to be white space
  for (;;) {
    if (searched == 0) {
      at_ = std::min(output_.find_first_not_of(kWhiteSpace, at_), output_.size());
      word_start_ = at_;
    }
    const auto end = output_.find_first_of(kWhiteSpace, at_ + searched);
    if (end != std::string::npos && end - at_ <= kLongestText) {
      const Reading word = {State::kRead, std::string_view(output_).substr(at_, end - at_)};
      at_ = end;
      return word;
    }
    searched = std::min(end, output_.size()) - at_;
    if (const auto stopped = more_or(deadline, searched); stopped.state != State::kRead)
      return stopped;
  }
}

ChildProcess::Reading ChildProcess::read_line(Clock::time_point deadline) {
  assert(child_.id >= 0);
  word_start_ = at_;
  for (;;) {
    const auto end = output_.find('\n', at_);
    if (end != std::string::npos && end - at_ <= kLongestText) {
      const Reading line = {State::kRead, std::string_view(output_).substr(at_, end - at_)};
      at_ = end + 1;
      word_start_ = at_;
      return line;
    }
    auto stopped = more_or(deadline, std::min(end, output_.size()) - at_);
    if (stopped.state == State::kRead) continue;
    if (stopped.state == State::kClosed) {
      stopped.text = std::string_view(output_).substr(at_);
      at_ = word_start_ = output_.size();
    }
    return stopped;
  }
}

bool ChildProcess::has_unread_output() {
  assert(child_.id >= 0);
  const auto unread = [&] {
    return output_.find_first_not_of(kWhiteSpace, at_) != std::string::npos;
  };
  if (!unread() && child_.from_child.get() >= 0) exchange(0);
  return unread();
}

void ChildProcess::keep(std::string_view line) {
  last_lines_.add(LastLines::kOutput, line);
  last_lines_.add(LastLines::kOutput, "\n");
}

long ChildProcess::peak_memory_kb() const {
  std::ifstream status(fmt::format("/proc/{}/status", child_.id));
  const std::string key = "VmHWM:";
  for (std::string word; status >> word;) {
    long kilobytes = 0;
    if (word == key && status >> kilobytes) return kilobytes;
  }
  return 0;
}

bool ChildProcess::has_ended() const {
  siginfo_t info{};
  // With WNOWAIT the child stays a zombie, so that its group keeps its number and can be killed.
  return ::waitid(P_PID, static_cast<id_t>(child_.id), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == child_.id;
}

std::string ChildProcess::finish(std::chrono::milliseconds grace) {
  assert(child_.id >= 0);
  const auto deadline = Clock::now() + grace;
  const auto collect = [&](int milliseconds) {
    exchange(milliseconds);
    last_lines_.add(LastLines::kOutput, std::string_view(output_).substr(at_));
    at_ = word_start_ = output_.size();
  };
  bool ended = has_ended();
  while (!ended && Clock::now() < deadline && !stop_.stop_requested()) {
    if (sent_ == to_send_.size()) child_.to_child.close();
    collect(ChildTuning::kPause);  // pauses, too, if the child has closed its streams
    ended = has_ended();
  }
  // What the child wrote before its end is in the sockets. Processes that the child has started may
  // write for ever; therefore the number of buffers that are read is limited.
  for (int i = 0; i < ChildTuning::kLastBuffers &&
                  (child_.from_child.get() >= 0 || child_.errors_of_it.get() >= 0);
       ++i)
    collect(0);
  ::kill(-child_.id, SIGKILL);
  int status = 0;
  while (::waitpid(child_.id, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = {};
  if (!ended) return "had to be stopped";
  return WIFSIGNALED(status) ? end_by_signal_in_words(WTERMSIG(status))
                             : fmt::format("ended with status {}", WEXITSTATUS(status));
}

}  // namespace viscontact
