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
#include "viscontact/common/system/interrupt.hpp"

namespace viscontact {
namespace {

struct Pipe {
  Descriptor read_end, write_end;
};

/// A pair of sockets and no pipe: a write to a child that reads no more is an error code there, and SIGPIPE in a pipe.
Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw std::system_error(errno, std::generic_category(), "socketpair");
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// The variables of ours that `added` does not set, then `added`.
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
    result.push_back(const_cast<char*>(text.c_str()));  // what execve's signature asks for
  result.push_back(nullptr);
  return result;
}

using Clock = std::chrono::steady_clock;

/// Feeds `input` to the child and collects what it says, until it closes its output, the user
/// interrupts, or `deadline` has passed.
std::string converse(Descriptor& to_child, int from_child, std::string_view input,
                     Clock::time_point deadline) {
  std::string output;
  if (input.empty()) to_child.close();
  for (;;) {
    std::array<pollfd, 2> files = {pollfd{from_child, POLLIN, 0},
                                   pollfd{to_child.get(), POLLOUT, 0}};
    constexpr int kMilliseconds = 100;  // how late an interrupt may be noticed
    const int ready = ::poll(files.data(), to_child.get() >= 0 ? 2 : 1, kMilliseconds);
    if (interrupted() || Clock::now() > deadline) return output;
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
  int status = 0;  ///< as wait4 gives it
  rusage usage{};
  bool interrupted = false, timed_out = false;  ///< why the child was killed, if it was
};

/// Waits until the child has ended. Kills the child's process group first if the user interrupts
/// or `deadline` passes. A child can close its output and go on, so that both must be looked at
/// here too.
ChildEnd wait_for_end(pid_t child, Clock::time_point deadline) {
  constexpr int kFirstPause = 1, kLongestPause = 20;  // milliseconds between two looks
  ChildEnd end;
  for (int pause = kFirstPause;; pause = std::min(2 * pause, kLongestPause)) {
    const bool to_kill = !end.interrupted && !end.timed_out;
    if (to_kill && interrupted())
      end.interrupted = true;
    else if (to_kill && Clock::now() > deadline)
      end.timed_out = true;
    if (to_kill && (end.interrupted || end.timed_out)) ::kill(-child, SIGKILL);
    const pid_t ended = ::wait4(child, &end.status, WNOHANG, &end.usage);
    if (ended == child || (ended < 0 && errno != EINTR)) return end;
    ::poll(nullptr, 0, pause);
  }
}

/// In the child, between fork and exec, where only calls that a signal handler may make are allowed:
/// becomes the program, or writes the error number to `failure` and ends.
[[noreturn]] void become(char* const* arguments, char* const* variables, const char* folder,
                         int input, int output, int failure, pid_t parent) {
  // A group of its own: Ctrl-C reaches us alone, and we end the child in order.
  ::setpgid(0, 0);
  // kill -9 gives us no time to end it: then the kernel does.
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
                          std::optional<std::chrono::milliseconds> time_limit) {
  const auto deadline = time_limit ? Clock::now() + *time_limit : Clock::time_point::max();
  Pipe in = make_pipe();
  Pipe out = make_pipe();
  Pipe failure = make_pipe();
  const auto variables = merged_environment(environment);
  const auto argument_pointers = pointers(arguments);
  const auto variable_pointers = pointers(variables);
  const pid_t self = ::getpid();
  // fork and no posix_spawn, which cannot ask that the child die with us.
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
  result.output = converse(in.write_end, out.read_end.get(), input, deadline);
  const auto [status, usage, cut_short, timed_out] = wait_for_end(child, deadline);
  result.timed_out = timed_out;
  // A child that the user's interrupt has ended has no result.
  if (cut_short || WIFSIGNALED(status)) throw_if_interrupted();
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
