// Starts a child process with sockets as its standard streams (Linux). A system without free
// sockets throws std::system_error. Used by run_process() (process.cpp) and ChildProcess
// (child_process.hpp). If the program cannot be run, nothing is thrown: StartedProcess says so. A
// change must keep that the child ends with the thread that started it.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {

/// What is started: a program, its arguments, its environment and its working folder.
struct ProcessCommand {
  /// The program, which is looked up on PATH, and then its arguments. The program must be given
  /// (not checked).
  std::vector<std::string> arguments;
  /// Variables "NAME=value", which are added to the environment of this process and replace
  /// variables of the same name.
  std::vector<std::string> environment{};
  std::string folder{};  ///< working folder; empty: that of this process
};

/// Where the standard error of a child process goes: into the stream of its standard output, or
/// into a stream of its own.
enum class ErrorStream { kWithOutput, kSeparate };

/// A child process that runs. The child leads a process group of its own, whose number is `id`, so
/// that kill(-id, SIGKILL) also ends the processes that it has started. The caller of start_process
/// must wait for the end of the child (waitpid).
struct StartedProcess {
  pid_t id = -1;        ///< -1: there is no such program, or it cannot be run
  std::string failure;  ///< why it cannot be run (words for errno); empty if it runs
  /// Standard input of the child. It is a socket: send() with MSG_NOSIGNAL fails with EPIPE if the
  /// child no longer reads.
  Descriptor to_child{};
  Descriptor from_child{};    ///< its standard output, with kWithOutput also its standard error
  Descriptor errors_of_it{};  ///< its standard error; none with kWithOutput
};

/// Starts the program. The child does not receive Ctrl-C of the terminal. The kernel ends the child
/// when the thread or the process that started it ends, even by SIGKILL. Throws std::system_error
/// if the system has no more sockets or descriptors; if fork fails, the id is -1. Stop requests are
/// not checked.
StartedProcess start_process(const ProcessCommand& command, ErrorStream errors);

/// Words that say that the signal with the number `signal`, 1 to 64 (not checked), has ended a
/// process, such as "ended by signal 11 (Segmentation fault)". Real-time signals (32 to 64) have no
/// description: "ended by signal 34".
std::string end_by_signal_in_words(int signal);

}  // namespace viscontact
