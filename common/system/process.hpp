// A child process: started, listened to, waited for.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace viscontact {

struct ProcessResult {
  bool started = false;     ///< false: no such program, or it may not be run; `output` says why
  int exit_status = 0;      ///< 128 + signal if a signal ended it
  std::string output;       ///< standard output and error, as they came; after a signal, its name
  long peak_memory_kb = 0;  ///< largest resident set
  bool timed_out = false;   ///< the time limit ended it, with SIGKILL
};

/// Runs arguments[0], looked up on PATH, with the other arguments, no standard input, and
/// `environment` ("NAME=value") added to ours. `input`, if not empty, is its standard input;
/// `folder`, if not empty, its working folder. Ends it and throws Error(kInterrupted) when the user interrupts; the child ends when this thread or
/// process does, even by SIGKILL.
/// `time_limit`, if there is one, is the longest time that the child may take: after it the child
/// and the processes that the child has started are killed, and the result is `timed_out`.
ProcessResult run_process(const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment = {},
                          const std::string& input = {}, const std::string& folder = {},
                          std::optional<std::chrono::milliseconds> time_limit = {});

}  // namespace viscontact
