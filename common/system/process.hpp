// Runs a child process to its end and collects its output (Linux), such as FreeFEM for a row of a
// table, gnuplot or sbatch. If a program cannot be run, fails or takes too long, nothing is thrown:
// the result says so. A stop request throws Error(kInterrupted). A change must keep that no child
// outlives this process. Used by app/, freefem/, freefem_axi/, pipeline/ and report/.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"

namespace viscontact {

/// How a child process ended, and what it wrote.
struct ProcessResult {
  /// False if there is no such program or it cannot be run; `output` then says why.
  bool started = false;
  int exit_status = 0;  ///< 0 to 255; 128 + N: ended by signal N; 127: not started
  /// Standard output and standard error, in the order in which they came. If a signal ended the
  /// process, a line "ended by signal N (NAME)" follows.
  std::string output;
  long peak_memory_kb = 0;  ///< largest resident memory [1024 bytes], >= 0; 0: not started
  bool timed_out = false;   ///< true: the process was killed at the time limit
};

/// Runs the program arguments[0] (there must be one; not checked), which is looked up on PATH, with
/// the other arguments and with the variables `environment` ("NAME=value" each) added to the
/// environment of this process. `input`, any bytes, is its standard input. `folder` is its working
/// folder; empty: that of this process. `time_limit` [ms] is the longest time that the child may
/// take; without a value there is no limit. If the child takes longer, its process group (the child
/// and the processes that it started) is killed, and `timed_out` of the result is true.
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
