// Runs a child process to its end and collects its output (Linux).
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"

namespace viscontact {

struct ProcessResult {
  /// False if there is no such program or it cannot be run; `output` then says why.
  bool started = false;
  int exit_status = 0;  ///< 128 + N: ended by signal N; 127: not started, as in a shell
  /// Standard output and standard error, in the order in which they came. If a signal ended the
  /// process, a line "ended by signal N (NAME)" follows.
  std::string output;
  long peak_memory_kb = 0;  ///< largest resident memory [1024 bytes]; 0: not started
  bool timed_out = false;   ///< the process was killed at the time limit
};

/// Runs the program arguments[0], which is looked up on PATH, with the other arguments and with the
/// variables `environment` ("NAME=value" each) added to the environment of this process. `input`,
/// any bytes, is its standard input; it is no error if the program does not read it. `folder` is
/// its working folder; empty: that of this process. After `time_limit` its process group (the child
/// and the processes that it started) is killed. A program that cannot be run, fails or takes too
/// long is no error: the result says so.
///
/// If `stop` requests a stop before the child has ended, the child is killed within about 0.1 s and
/// Error(kInterrupted) is thrown. The child also ends when the thread or the process that started
/// it ends, even by SIGKILL. Throws std::system_error if the system has no more sockets.
ProcessResult run_process(const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment = {},
                          const std::string& input = {}, const std::string& folder = {},
                          std::optional<std::chrono::milliseconds> time_limit = {},
                          const StopToken& stop = {});

}  // namespace viscontact
