// Runs a child process by fork and exec (process.hpp). Between fork and exec only async-signal-safe
// calls are allowed.
#include "viscontact/common/system/process.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {
namespace {

struct Pipe {
  Descriptor read_end, write_end;
};

/// A pair of sockets instead of a pipe: a write to a child that no longer reads returns an error
/// code, where a pipe would cause SIGPIPE.
Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw std::system_error(errno, std::generic_category(), "socketpair");
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// The variables of this process that `added` does not set, followed by `added`.
std::vector<std::string> merged_environment(const std::vector<std::string>& added) {
  std::vector<std::string> all;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    const std::string name = text.substr(0, text.find('=') + 1);
    bool replaced = false;
    for (const auto& other : added) replaced = replaced || other.starts_with(name);
    if (!replaced) all.push_back(text);
  }
  all.insert(all.end(), added.begin(), added.end());
  return all;
}

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (const auto& text : texts)
    result.push_back(const_cast<char*>(text.c_str()));  // execve does not change the texts
  result.push_back(nullptr);
  return result;
}

using Clock = std::chrono::steady_clock;

/// Sends `input` to the child and collects its output, until the child closes its output, a stop is
/// requested, or `deadline` has passed.
std::string converse(Descriptor& to_child, int from_child, std::string_view input,
                     Clock::time_point deadline, const StopToken& stop) {
  std::string output;
  if (input.empty()) to_child.close();
  for (;;) {
    std::array<pollfd, 2> files = {pollfd{from_child, POLLIN, 0},
                                   pollfd{to_child.get(), POLLOUT, 0}};
    // The longest delay until a stop is noticed.
    constexpr int kMilliseconds = 100;
    const int ready = ::poll(files.data(), to_child.get() >= 0 ? 2 : 1, kMilliseconds);
    if (stop.stop_requested() || Clock::now() > deadline) return output;
    if (ready <= 0) continue;
    if (to_child.get() >= 0 && files[1].revents != 0) {
      const ssize_t count =
          ::send(to_child.get(), input.data(), input.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count > 0) input.remove_prefix(static_cast<std::size_t>(count));
      if (input.empty() || (count < 0 && errno != EAGAIN && errno != EINTR)) to_child.close();
    }
    if (files[0].revents != 0) {
      std::array<char, 1 << 14> buffer{};
      const ssize_t count = ::read(from_child, buffer.data(), buffer.size());
      if (count > 0) output.append(buffer.data(), static_cast<std::size_t>(count));
      if (count == 0) return output;
    }
  }
}

struct ChildEnd {
  int status = 0;  ///< status from wait4
  rusage usage{};
  /// Why the child was killed, if it was.
  bool stopped = false, timed_out = false;
};

/// Waits until the child has ended. Kills its process group first if a stop is requested or
/// `deadline` passes. Both are checked here, too, because a child can close its output and continue
/// to run.
ChildEnd wait_for_end(pid_t child, Clock::time_point deadline, const StopToken& stop) {
  constexpr int kFirstPause = 1, kLongestPause = 20;  // milliseconds between two checks
  ChildEnd end;
  for (int pause = kFirstPause;; pause = std::min(2 * pause, kLongestPause)) {
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

/// Runs in the child between fork and exec, where only async-signal-safe calls are allowed. Becomes
/// the program, or writes the error number to `failure` and ends.
[[noreturn]] void become(char* const* arguments, char* const* variables, const char* folder,
                         int input, int output, int failure, pid_t parent) {
  // In a process group of its own the child does not receive Ctrl-C. Only this process receives it;
  // it then kills the child and throws Error(kInterrupted).
  ::setpgid(0, 0);
  // The kernel ends the child if this process is killed by SIGKILL.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  if (::dup2(input, STDIN_FILENO) >= 0 && ::dup2(output, STDOUT_FILENO) >= 0 &&
      ::dup2(output, STDERR_FILENO) >= 0 && (*folder == '\0' || ::chdir(folder) == 0))
    ::execvpe(arguments[0], arguments, variables);
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(failure, &error, sizeof error);
  ::_exit(127);
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment, const std::string& input,
                          const std::string& folder,
                          std::optional<std::chrono::milliseconds> time_limit,
                          const StopToken& stop) {
  const auto deadline = time_limit ? Clock::now() + *time_limit : Clock::time_point::max();
  Pipe in = make_pipe();
  Pipe out = make_pipe();
  Pipe failure = make_pipe();
  const auto variables = merged_environment(environment);
  const auto argument_pointers = pointers(arguments);
  const auto variable_pointers = pointers(variables);
  const pid_t self = ::getpid();
  // posix_spawn cannot make the child end when this process ends (PR_SET_PDEATHSIG), so fork is
  // used.
  const pid_t child = ::fork();
  if (child == 0)
    become(argument_pointers.data(), variable_pointers.data(), folder.c_str(), in.read_end.get(),
           out.write_end.get(), failure.write_end.get(), self);
  if (child < 0) return {false, 127, std::strerror(errno), 0};
  failure.write_end.close();
  in.read_end.close();
  out.write_end.close();
  int error = 0;
  ssize_t count = 0;
  while ((count = ::read(failure.read_end.get(), &error, sizeof error)) < 0 && errno == EINTR) {
  }
  if (count > 0) {
    while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
    return {false, 127, std::strerror(error), 0};
  }
  ProcessResult result;
  result.started = true;
  result.output = converse(in.write_end, out.read_end.get(), input, deadline, stop);
  const auto [status, usage, stopped, timed_out] = wait_for_end(child, deadline, stop);
  result.timed_out = timed_out;
  // A child that was killed because of a stop has no result.
  if (stopped || WIFSIGNALED(status)) stop.throw_if_stop_requested();
  result.exit_status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  if (WIFSIGNALED(status)) {
    if (!result.output.empty() && result.output.back() != '\n') result.output += '\n';
    result.output +=
        fmt::format("ended by signal {} ({})\n", WTERMSIG(status), sigdescr_np(WTERMSIG(status)));
  }
  result.peak_memory_kb = usage.ru_maxrss;
  return result;
}

}  // namespace viscontact
