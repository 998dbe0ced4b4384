#include "common/process.hpp"

#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include "common/descriptor.hpp"
#include "common/interrupt.hpp"

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

/// Feeds `input` to the child and collects what it says, until it closes its output or the user
/// interrupts.
std::string converse(Descriptor& to_child, int from_child, std::string_view input) {
  std::string output;
  if (input.empty()) to_child.close();
  for (;;) {
    std::array<pollfd, 2> files = {pollfd{from_child, POLLIN, 0},
                                   pollfd{to_child.get(), POLLOUT, 0}};
    constexpr int kMilliseconds = 100;  // how late an interrupt may be noticed
    const int ready = ::poll(files.data(), to_child.get() >= 0 ? 2 : 1, kMilliseconds);
    if (interrupted()) return output;
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

}  // namespace

ProcessResult run_process(const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment, const std::string& input) {
  Pipe in = make_pipe();
  Pipe out = make_pipe();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.read_end.get(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.write_end.get(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.write_end.get(), STDERR_FILENO);
  // A group of its own: Ctrl-C reaches us alone, and we end the child in order.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const auto variables = merged_environment(environment);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, arguments.front().c_str(), &actions, &attributes,
                                   pointers(arguments).data(), pointers(variables).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return {false, 127, std::strerror(error), 0};

  in.read_end.close();
  out.write_end.close();
  ProcessResult result;
  result.started = true;
  result.output = converse(in.write_end, out.read_end.get(), input);
  if (interrupted()) ::kill(-child, SIGKILL);
  int status = 0;
  rusage usage = {};
  while (::wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
    if (interrupted()) ::kill(-child, SIGKILL);
  }
  throw_if_interrupted();
  result.exit_status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  result.peak_memory_kb = usage.ru_maxrss;
  return result;
}

}  // namespace viscontact
