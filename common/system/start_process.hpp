// Starts a child process with sockets as its standard streams (Linux).
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {

struct ProcessCommand {
  /// The program, which is looked up on PATH, and then its arguments.
  std::vector<std::string> arguments;
  /// "NAME=value" each; added to the environment of this process, or replaced there.
  std::vector<std::string> environment{};
  std::string folder{};  ///< working folder; empty: that of this process
};

/// Where the standard error of a child goes: to its standard output, or into a stream of its own.
enum class ErrorStream { kWithOutput, kSeparate };

/// A child process that runs. It leads a process group of its own, whose number is `id`, so that
/// kill(-id, SIGKILL) also ends the processes that it has started. The caller of start_process()
/// must wait for its end (waitpid).
struct StartedProcess {
  pid_t id = -1;        ///< -1: there is no such program, or it cannot be run
  std::string failure;  ///< words for errno; empty if it runs
  /// Standard input of the child, a socket.
  Descriptor to_child{};
  Descriptor from_child{};    ///< its standard output, with kWithOutput also its standard error
  Descriptor errors_of_it{};  ///< its standard error; none with kWithOutput
};

/// Returns when the child has become the program or could not. The child does not receive Ctrl-C of
/// the terminal. The kernel ends the child when the thread or the process that started it ends,
/// even by SIGKILL. Throws std::system_error if the system has no more sockets or descriptors; if
/// fork fails, the id is -1.
StartedProcess start_process(const ProcessCommand& command, ErrorStream errors);

/// Such as "ended by signal 11 (Segmentation fault)". Real-time signals (32 to 64) have no
/// description: "ended by signal 34".
std::string end_by_signal_in_words(int signal);

}  // namespace viscontact
