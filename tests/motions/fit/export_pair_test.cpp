// The exported unit of a pair, compiled and run, beside the fit.
#include "viscontact/motions/fit/export_pair.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact::motions {
namespace {

constexpr std::array<double, 4> kGaps = {1e-3, 0.01, 0.3, 1};

/// The shipped fit of a plane, and for each entry that it lacks some multiple of another one.
PairFit fit_with_all_entries() {
  auto fit = read_pair_fit(std::string(VISCONTACT_SOURCE_FOLDER) + "/data/fits/pairs/plane.json");
  for (std::size_t i = fit.entries.size(); i < pair_entries().size(); ++i) {
    auto entry = fit.entries.at(PairEntry::kSqueeze);
    for (auto& term : entry.fit.terms) term.coefficient *= static_cast<double>(i);
    fit.entries[static_cast<PairEntry>(i)] = entry;
  }
  return fit;
}

std::vector<std::string> entry_names() {
  std::vector<std::string> names;
  for (const auto& entry : pair_entries()) names.emplace_back(entry.name);
  return names;
}

class ExportOfAPair : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// Runs a command and compares the numbers that it prints, one for each entry and gap.
  void expect_values(const std::vector<std::string>& command) const {
    const auto result = run_process(command);
    ASSERT_EQ(result.exit_status, 0) << result.output;
    std::istringstream numbers(result.output);
    for (const double gap : kGaps)
      for (std::size_t i = 0; i < pair_entries().size(); ++i) {
        double value = 0;
        ASSERT_TRUE(numbers >> value) << result.output;
        const double expected = entry_value(fit_, static_cast<PairEntry>(i), gap);
        // Compilers may contract products and sums, which changes the last digit of a term.
        EXPECT_NEAR(value / expected, 1, 1e-13) << i << " " << gap;
      }
  }

  PairFit fit_ = fit_with_all_entries();
  TemporaryFolder folder_;
};

TEST_F(ExportOfAPair, CHeaderHasAllFunctions) {
  put_text(path("pair.h"), export_pair(fit_, "c-header", "plane.json"));
  std::string calls;
  for (const double gap : kGaps)
    for (const auto& name : entry_names())
      calls += fmt::format("  printf(\"%.17g\\n\", viscontact_{}({:.17e}));\n", name, gap);
  put_text(path("main.c"), "#include <stdio.h>\n#include \"pair.h\"\nint main(void) {\n" + calls +
                               "  return !isnan(viscontact_roll(2.0));\n}\n");
  for (const auto& compiler : {std::vector<std::string>{"gcc", "-std=c99", "-x", "c"},
                               std::vector<std::string>{"g++", "-std=c++11", "-x", "c++"}}) {
    auto command = compiler;
    command.insert(command.end(), {"-Wall", "-Wextra", "-Wpedantic", "-Werror", path("main.c"),
                                   "-o", path("program"), "-lm"});
    ASSERT_EQ(run_process(command).exit_status, 0);
    expect_values({path("program")});
  }
}

TEST_F(ExportOfAPair, FortranModuleHasAllFunctions) {
  put_text(path("pair.f90"), export_pair(fit_, "fortran", ""));
  std::string calls;
  for (const double gap : kGaps)
    for (const auto& name : entry_names()) {
      auto text = fmt::format("{:.17e}", gap);
      text[text.find('e')] = 'd';
      calls += fmt::format("  print '(es25.16e3)', viscontact_{}({})\n", name, text);
    }
  put_text(path("main.f90"),
           "program main\n  use viscontact_pair\n  implicit none\n" + calls + "end program\n");
  const auto compiled =
      run_process({"gfortran", "-std=f2008", "-Wall", "-Werror", "-J", folder_.path().string(),
                   path("pair.f90"), path("main.f90"), "-o", path("program")});
  ASSERT_EQ(compiled.exit_status, 0) << compiled.output;
  expect_values({path("program")});
}

TEST_F(ExportOfAPair, PythonModuleHasAllFunctions) {
  put_text(path("pair.py"), export_pair(fit_, "python", ""));
  std::string calls =
      "import sys\nsys.path.insert(0, '" + folder_.path().string() + "')\nfrom pair import *\n";
  for (const double gap : kGaps)
    for (const auto& name : entry_names())
      calls += fmt::format("print(repr({}({:.17e})))\n", name, gap);
  calls += "try:\n    roll(2.0)\nexcept ValueError:\n    sys.exit(0)\nsys.exit(1)\n";
  put_text(path("main.py"), calls);
  expect_values({"python3", path("main.py")});
}

TEST_F(ExportOfAPair, PythonAndOctaveTakeArrays) {
  const std::string gaps = fmt::format("[{:.17e}]", fmt::join(kGaps, ", "));
  put_text(path("pair.py"), export_pair(fit_, "python", ""));
  put_text(path("main.py"), "import numpy, pair\ngaps = numpy.array(" + gaps +
                                ")\nfor row in zip(*[getattr(pair, name)(gaps) for name in '" +
                                fmt::format("{}", fmt::join(entry_names(), " ")) +
                                "'.split()]):\n"
                                "    print(*(repr(float(value)) for value in row))\n");
  expect_values({"/usr/bin/python3", path("main.py")});  // Debian's, which has NumPy
  put_text(path("viscontact_pair.m"), export_pair(fit_, "matlab", "plane.json"));
  put_text(path("main.m"),
           "f = viscontact_pair();\ngaps = " + gaps +
               fmt::format(";\nprintf('%.17g\\n', [f.{}(gaps)]);\nassert(isnan(f.roll(2)));\n",
                           fmt::join(entry_names(), "(gaps); f.")));
  expect_values(
      {"octave-cli", "--norc", "--no-history", "--path", folder_.path().string(), path("main.m")});
}

TEST_F(ExportOfAPair, SaysWhichFunctionsTheEntriesAre) {
  for (const auto* target : {"c-header", "fortran", "python", "matlab", "json", "csv"}) {
    const auto text = export_pair(fit_, target, "");
    EXPECT_THAT(text, ::testing::HasSubstr("X^G_11 = 3 squeeze_stress/(2 pi mu s^2)")) << target;
    EXPECT_THAT(text, ::testing::HasSubstr("Y^B_11 = -slide_roll/(pi mu s^2)")) << target;
  }
}

TEST_F(ExportOfAPair, JsonAndCsvHaveSamplesOfAllFunctions) {
  const auto json = nlohmann::json::parse(export_pair(fit_, "json", ""));
  for (const auto& entry : pair_entries()) {
    EXPECT_FALSE(json["functions"][std::string(entry.name)]["terms"].empty());
    EXPECT_EQ(json["samples"][std::string(entry.name)].size(), json["samples"]["gap"].size());
  }
  EXPECT_THAT(export_pair(fit_, "csv", ""),
              ::testing::HasSubstr("\ngap,squeeze,slide,roll,slide_roll,spin,squeeze_stress,"));
}

}  // namespace
}  // namespace viscontact::motions
