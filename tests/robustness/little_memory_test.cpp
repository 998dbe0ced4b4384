// Little memory, played by the shell's limit on the size of a process: the work is done, or refused
// in a line. The memory of a run of particles does not grow with its steps.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/robustness/whole_outputs.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

using ::testing::HasSubstr;

constexpr int kSmallest = 20, kLargest = 500;  // [MB]

class LittleMemory : public ::testing::Test {
 protected:
  LittleMemory() : fake_(scratch_.path()) {
    put_text(path("case.toml"), quick_case_text());
    put_text(path("table.csv"), exact_table_text());
    const std::filesystem::path data = VISCONTACT_SOURCE_FOLDER "/data";
    put_text(path("sweep.toml"), replaced(read_file(data / "cases" / "vanishing_viscosity.toml"),
                                          "../fits", data / "fits"));
  }
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  /// Runs the command, whose outputs go to the folder `out`, with more and more memory, until three
  /// limits have been enough.
  void expect_done_or_refused(const std::vector<std::string>& arguments) const {
    int done = 0, refused = 0, ended_by_library = 0;
    for (int limit = kSmallest; limit <= kLargest && done < 3; limit += limit / 4) {
      SCOPED_TRACE(fmt::format("{} MB", limit));
      std::filesystem::remove_all(path("out"));
      const auto result = run_viscontact(arguments, {"VISCONTACT_FREEFEM=" + fake_.executable()},
                                         fmt::format("ulimit -v {};", limit * 1024));
      // SUNDIALS 6 uses a matrix that it could not allocate, and toml++ allocates where nothing may
      // be thrown. Both end the process; like one that is killed, it leaves no half-written result.
      const bool is_ended_by_library =
          result.exit_status == 128 + SIGSEGV || result.exit_status == 128 + SIGABRT;
      EXPECT_TRUE(is_ended_by_library || unfinished_below(path("out")) == 0);
      if (result.exit_status == 0) {
        ++done;
      } else if (is_ended_by_library) {
        ++ended_by_library;
      } else if (("\n" + result.errors).find("\nviscontact: ") != std::string::npos) {
        ++refused;
        EXPECT_LE(result.exit_status, 5) << result.errors;
      } else {
        // Before main: the loader found no room for the libraries, or the shell none for the
        // program.
        EXPECT_THAT(result.errors, ::testing::AnyOf(HasSubstr("error while loading"),
                                                    HasSubstr("Cannot allocate memory"),
                                                    HasSubstr("Cannot fork"), HasSubstr("alloc")))
            << result.exit_status;
        EXPECT_LE(result.exit_status, 127) << result.errors;
      }
      expect_whole_files(path("out"));
    }
    EXPECT_GT(done, 0);
    EXPECT_GT(refused, 0);
    EXPECT_LE(ended_by_library, 1);  // it happens between limits that differ by a tenth at most
  }

  TemporaryFolder scratch_;
  freefem_axi::FakeFreeFem fake_;
};

TEST_F(LittleMemory, Run) {
  expect_done_or_refused({"run", path("case.toml"), "-o", path("out"), "--jobs", "2"});
}

TEST_F(LittleMemory, Fit) {
  expect_done_or_refused({"fit", path("table.csv"), "-o", path("out/fit.json")});
}

TEST_F(LittleMemory, Sweep) {
  expect_done_or_refused({"sweep", path("sweep.toml"), "-o", path("out/sweep.csv"), "--jobs", "2"});
}

TEST_F(LittleMemory, ParticlesOfManyStepsNeedNoMoreThanOfFew) {
  // The peak memory of a run of so many steps, in MiB.
  const auto peak = [&](int steps) {
    put_text(path("particles.toml"), fmt::format(R"(title = "A disc on a floor"
[space]
dimension = 2
gravity = [0.0, -1.0]
[viscous_contact]
time_step = {}
end_time = 2.0
[[plane]]
point = [0.0, 0.0]
normal = [0.0, 1.0]
[[particle]]
centre = [0.0, 2.0]
radius = 1.0
mass = 1.0
)",
                                                 2.0 / steps));
    const auto folder = path("of_" + std::to_string(steps));
    expect_done(run_viscontact({"particles", path("particles.toml"), "-o", folder}));
    return nlohmann::json::parse(read_file(folder + "/run.json"))["peak_memory_mebibytes"]
        .get<double>();
  };
  const double of_few = peak(1000), of_many = peak(400000);
  const double table =
      static_cast<double>(std::filesystem::file_size(path("of_400000/steps.csv"))) / (1 << 20);
  EXPECT_GT(table, 20);
  // A run that kept its rows would need more than the size of its table.
  EXPECT_LT(of_many - of_few, 0.1 * table);
}

}  // namespace
}  // namespace viscontact
