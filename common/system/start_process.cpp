// Starts a child process by fork and exec.
#include "viscontact/common/system/start_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

namespace viscontact {
namespace {

/// Two connected sockets.
struct Pipe {
  Descriptor read_end{}, write_end{};
};

/// The open file `end` under a number above those of the standard streams (0 to 2). If this process
/// was started without a standard stream, a new file can have the number of this stream, and dup2()
/// of this number to itself would leave the file to be closed when the child becomes the program.
/// Throws std::system_error if there is no free descriptor.
Descriptor beyond_standard_streams(Descriptor end) {
  if (end.get() > STDERR_FILENO) return end;
  const int other = ::fcntl(end.get(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (other < 0) throw std::system_error(errno, std::generic_category(), "fcntl");
  return Descriptor(other);
}

/// Sockets instead of a pipe, because send() with MSG_NOSIGNAL fails with EPIPE if the child no
/// longer reads, while a write to a pipe would raise SIGPIPE.
Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw std::system_error(errno, std::generic_category(), "socketpair");
  Descriptor first(ends[0]), second(ends[1]);
  return {beyond_standard_streams(std::move(first)), beyond_standard_streams(std::move(second))};
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

/// Pointers to the texts, followed by a null pointer, as exec demands.
std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (const auto& text : texts)
    result.push_back(const_cast<char*>(text.c_str()));  // execve does not change the texts
  result.push_back(nullptr);
  return result;
}

/// These descriptors become the standard streams of the child.
struct ChildStreams {
  int input, output, errors;
  int failure;  ///< where the child writes errno if it cannot become the program
};

/// Runs in the child between fork and exec. Becomes the program, or writes the error number to
/// `streams.failure` and ends. `arguments` and `variables` end with a null pointer; an empty
/// `folder` keeps the working folder; `parent` is the number of the process that has called fork.
///
/// Only functions may be called here that neither allocate memory nor take locks, because another
/// thread may hold a lock at the moment of the fork: those that POSIX lists as async-signal-safe,
/// prctl, which is a system call, and execvpe of glibc (>= 2.24), which works on the stack.
[[noreturn]] void become(char* const* arguments, char* const* variables, const char* folder,
                         const ChildStreams& streams, pid_t parent) {
  // In a process group of its own the child does not receive Ctrl-C. Only the parent receives
  // Ctrl-C, kills the child and throws Error(kInterrupted).
  ::setpgid(0, 0);
  // The kernel ends the child when the parent ends in any way, even by SIGKILL.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  if (::dup2(streams.input, STDIN_FILENO) >= 0 && ::dup2(streams.output, STDOUT_FILENO) >= 0 &&
      ::dup2(streams.errors, STDERR_FILENO) >= 0 && (*folder == '\0' || ::chdir(folder) == 0))
    ::execvpe(arguments[0], arguments, variables);
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(streams.failure, &error, sizeof error);
  ::_exit(127);
}

}  // namespace

StartedProcess start_process(const ProcessCommand& command, ErrorStream errors) {
  assert(!command.arguments.empty());
  const bool separate = errors == ErrorStream::kSeparate;
  Pipe in = make_pipe();
  Pipe out = make_pipe();
  Pipe err = separate ? make_pipe() : Pipe{};
  Pipe failure = make_pipe();
  const auto variables = merged_environment(command.environment);
  const auto argument_pointers = pointers(command.arguments);
  const auto variable_pointers = pointers(variables);
  const pid_t self = ::getpid();
  // posix_spawn cannot make the child end with this process (PR_SET_PDEATHSIG).
  const pid_t child = ::fork();
  if (child == 0)
    become(argument_pointers.data(), variable_pointers.data(), command.folder.c_str(),
           {in.read_end.get(), out.write_end.get(),
            separate ? err.write_end.get() : out.write_end.get(), failure.write_end.get()},
           self);
  StartedProcess started;
  if (child < 0) {
    started.failure = std::strerror(errno);
    return started;
  }
  failure.write_end.close();
  int error = 0;
  ssize_t count = 0;
  while ((count = ::read(failure.read_end.get(), &error, sizeof error)) < 0 && errno == EINTR) {
  }
  if (count > 0) {
    while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
    started.failure = std::strerror(error);
    return started;
  }
  started.id = child;
  started.to_child = std::move(in.write_end);
  started.from_child = std::move(out.read_end);
  started.errors_of_it = std::move(err.read_end);
  return started;
}

std::string end_by_signal_in_words(int signal) {
  // Real-time signals have no description.
  const char* description = sigdescr_np(signal);
  return description ? fmt::format("ended by signal {} ({})", signal, description)
                     : fmt::format("ended by signal {}", signal);
}

}  // namespace viscontact
