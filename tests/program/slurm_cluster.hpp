// A Slurm cluster of two nodes on this machine (tests/program/tabulate/slurm_cluster). All tests of
// a program share it, because it takes seconds to start and to stop.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact {

/// A running cluster of two nodes with four processors each. The constructor throws
/// std::runtime_error with the logs if Slurm does not start. The destructor stops the cluster.
class Cluster {
 public:
  Cluster() {
    const auto started = script({"start", folder(), std::to_string(::getpid())});
    if (started.exit_status != 0) throw std::runtime_error(started.output);
  }
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;
  ~Cluster() {
    const auto stopped = script({"stop", folder()});
    if (stopped.exit_status != 0) ADD_FAILURE() << stopped.output;
  }

  /// The environment variable by which programs of Slurm find this cluster: "NAME=value".
  std::string variable() const { return "SLURM_CONF=" + folder() + "/slurm.conf"; }

  /// Kills the processes of node `number`, and all that it runs, with SIGKILL.
  void kill_node(int number) const {
    const auto killed = script({"kill-node", folder(), std::to_string(number)});
    ASSERT_EQ(killed.exit_status, 0) << killed.output;
  }

  /// The jobs that have not ended, one in a line.
  std::string jobs() const {
    return run_process({"squeue", "--noheader", "--format=%i %t %R"}, {variable()}).output;
  }

  /// Cancels all jobs, so that those of a test that failed do not hold up the next one.
  void cancel_jobs() const {
    const auto cancelled = run_process({"scancel", "--partition=all"}, {variable()});
    EXPECT_EQ(cancelled.exit_status, 0) << cancelled.output;
  }

 private:
  std::string folder() const { return folder_.path().string(); }
  static ProcessResult script(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     VISCONTACT_SOURCE_FOLDER "/tests/program/tabulate/slurm_cluster");
    return run_process(arguments);
  }

  TemporaryFolder folder_;
};

/// Starts the cluster before the first test, and stops it after the last one.
class ClusterEnvironment : public ::testing::Environment {
 public:
  void SetUp() override { instance() = std::make_unique<Cluster>(); }
  void TearDown() override { instance().reset(); }
  static std::unique_ptr<Cluster>& instance() {
    static std::unique_ptr<Cluster> cluster;
    return cluster;
  }
};

/// The cluster of this program, of which one source adds a ClusterEnvironment to GoogleTest.
inline const Cluster& cluster() { return *ClusterEnvironment::instance(); }

/// Waits until is_so() is true. Fails the test after a minute, and shows the jobs of the cluster.
inline void wait_until(const std::function<bool()>& is_so) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!is_so()) {
    if (std::chrono::steady_clock::now() > end) FAIL() << "after a minute:\n" << cluster().jobs();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

}  // namespace viscontact
