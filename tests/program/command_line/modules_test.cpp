// The modules of the program: only commands that need one load it, it is found wherever the program
// is installed, and a missing one is named.
#include <gmock/gmock.h>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/system/module.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class Modules : public ParticlesCommand {
 protected:
  Modules() { folder_.file("table.csv", exact_table_text()); }

  std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  std::vector<std::string> fit() const {
    return {"fit", file("table.csv"), "-o", file("fit.json"), "--basis", "asymptotic"};
  }
  std::vector<std::string> hdf5() const {
    return {"particles", put_case(discs_on_a_floor("0.1", "0.5", "")).string(), "-o",
            out().string(), "--hdf5"};
  }

  /// Files that the dynamic loader opens while the program runs.
  static std::string loaded_files(const std::vector<std::string>& arguments) {
    const auto result = run_viscontact(arguments, {"LD_DEBUG=files"});
    EXPECT_EQ(result.exit_status, 0);
    return result.errors;
  }

  /// Copies the program and its modules as `cmake --install` places them.
  void install() const {
    fs::create_directories(prefix() / "bin");
    fs::create_directories(prefix() / "lib");
    fs::copy(VISCONTACT_EXECUTABLE, prefix() / "bin");
    fs::copy(fs::path(VISCONTACT_EXECUTABLE).parent_path() / "lib/viscontact",
             prefix() / "lib/viscontact");
  }
  ProgramResult run_installed(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), (prefix() / "bin/viscontact").string());
    const auto result = run_process(arguments, {});
    return {result.exit_status, "", result.output};
  }
  fs::path prefix() const { return folder_.path() / "another place"; }
};

constexpr const char* kSlowLibraries =
    "lib(hdf5|curl|ceres|glog|cholmod|spqr|lapack|blas|openblas)";

TEST_F(Modules, AreNotLoadedByHelp) {
  EXPECT_THAT(loaded_files({"--help"}),
              AllOf(HasSubstr("libstdc++"), Not(HasSubstr("/viscontact/")),
                    Not(ContainsRegex(kSlowLibraries))));
}

TEST_F(Modules, AreLoadedByCommandsThatNeedThem) {
  EXPECT_THAT(loaded_files(fit()),
              AllOf(HasSubstr("lib/viscontact/least_squares-"), Not(HasSubstr("libhdf5"))));
  EXPECT_THAT(loaded_files(hdf5()),
              AllOf(HasSubstr("lib/viscontact/hdf5-"), Not(HasSubstr("lapack"))));
}

TEST_F(Modules, AreFoundWhereTheProgramIsInstalled) {
  install();
  expect_done(run_installed(fit()));
  EXPECT_TRUE(fs::exists(file("fit.json")));
  expect_done(run_installed(hdf5()));
  EXPECT_TRUE(fs::exists(out() / "particles.h5"));
}

TEST_F(Modules, ThatAreMissingAreNamed) {
  install();
  fs::remove_all(prefix() / "lib");
  const auto before = files_below(folder_.path()).size();
  expect_refusal(run_installed(fit()), ErrorKind::kExternalProgram, Names("module least_squares"));
  const auto arguments = hdf5();
  expect_refusal(run_installed(arguments), ErrorKind::kWrongUsage,
                 Names("--hdf5", "libhdf5-dev", "module hdf5"));
  EXPECT_EQ(files_below(folder_.path()).size(), before + 1);  // the case
}

TEST_F(Modules, WithoutTheFunctionAreRefused) {
  EXPECT_NE(address_in_module("least_squares", "viscontact_solve_robust_least_squares"), nullptr);
  try {
    address_in_module("least_squares", "no_such_function");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kExternalProgram);
    EXPECT_THAT(error.what(), HasSubstr("no_such_function"));
  }
}

}  // namespace
}  // namespace viscontact
