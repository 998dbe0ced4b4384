// Runs a child process to its end: sends its input while it collects its output.
#include "viscontact/common/system/process.hpp"

#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <string_view>

#include "viscontact/common/system/start_process.hpp"

namespace viscontact {
namespace {

using Clock = std::chrono::steady_clock;

/// Free choices of run_process().
struct ProcessTuning {
  // The longest delay until a stop is noticed [ms]; process.hpp promises this time.
  static constexpr int kLongestWait = 100;
  // Bytes that are read at once; any size works.
  static constexpr std::size_t kBufferSize = 1 << 14;
  // First and longest time between two checks for the end of the child [ms].
  static constexpr int kFirstPause = 1, kLongestPause = 20;
};

/// Sends `input` to the child and returns its output. Returns when the child closes its output, a
/// stop is requested, or `deadline` has passed.
std::string converse(Descriptor& to_child, int from_child, std::string_view input,
                     Clock::time_point deadline, const StopToken& stop) {
  std::string output;
  if (input.empty()) to_child.close();
  for (;;) {
    std::array<pollfd, 2> files = {pollfd{from_child, POLLIN, 0},
                                   pollfd{to_child.get(), POLLOUT, 0}};
    const int ready =
        ::poll(files.data(), to_child.get() >= 0 ? 2 : 1, ProcessTuning::kLongestWait);
    if (stop.stop_requested() || Clock::now() > deadline) return output;
    if (ready <= 0) continue;
    if (to_child.get() >= 0 && files[1].revents != 0) {
      const ssize_t count =
          ::send(to_child.get(), input.data(), input.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count > 0) input.remove_prefix(static_cast<std::size_t>(count));
      if (input.empty() || (count < 0 && errno != EAGAIN && errno != EINTR)) to_child.close();
    }
    if (files[0].revents != 0) {
      std::array<char, ProcessTuning::kBufferSize> buffer{};
      const ssize_t count = ::read(from_child, buffer.data(), buffer.size());
      if (count > 0) output.append(buffer.data(), static_cast<std::size_t>(count));
      if (count == 0) return output;
    }
  }
}

struct ChildEnd {
  int status = 0;  ///< status from wait4
  rusage usage{};
  bool stopped = false,   ///< killed because of a stop request
      timed_out = false;  ///< killed at the deadline
};

/// Kills the process group of the child if a stop is requested or `deadline` passes, because a
/// child can close its output and continue to run.
ChildEnd wait_for_end(pid_t child, Clock::time_point deadline, const StopToken& stop) {
  ChildEnd end;
  for (int pause = ProcessTuning::kFirstPause;;
       pause = std::min(2 * pause, ProcessTuning::kLongestPause)) {
    const bool to_kill = !end.stopped && !end.timed_out;
    if (to_kill && stop.stop_requested())
      end.stopped = true;
    else if (to_kill && Clock::now() > deadline)
      end.timed_out = true;
    if (to_kill && (end.stopped || end.timed_out)) ::kill(-child, SIGKILL);
    const pid_t ended = ::wait4(child, &end.status, WNOHANG, &end.usage);
    if (ended == child || (ended < 0 && errno != EINTR)) return end;
    ::poll(nullptr, 0, pause);
  }
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment, const std::string& input,
                          const std::string& folder,
                          std::optional<std::chrono::milliseconds> time_limit,
                          const StopToken& stop) {
  const auto deadline = time_limit ? Clock::now() + *time_limit : Clock::time_point::max();
  StartedProcess child = start_process({arguments, environment, folder}, ErrorStream::kWithOutput);
  if (child.id < 0) return {false, 127, child.failure, 0};
  ProcessResult result;
  result.started = true;
  result.output = converse(child.to_child, child.from_child.get(), input, deadline, stop);
  const auto [status, usage, stopped, timed_out] = wait_for_end(child.id, deadline, stop);
  result.timed_out = timed_out;
  // A child that was killed because of a stop has no result.
  if (stopped || WIFSIGNALED(status)) stop.throw_if_stop_requested();
  result.exit_status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  if (WIFSIGNALED(status)) {
    if (!result.output.empty() && result.output.back() != '\n') result.output += '\n';
    result.output += end_by_signal_in_words(WTERMSIG(status)) + '\n';
  }
  result.peak_memory_kb = usage.ru_maxrss;
  return result;
}

}  // namespace viscontact
