// A case of three discs that is run by `viscontact particles` in a folder of its own.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/common/regular_expressions.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {

/// The example of docs/case-file.md: three discs on a floor, two of them in a file, the last pushed
/// and pulled.
inline constexpr const char* kCase = R"(title = "Three discs on a floor"

[space]
dimension = 2
gravity = [0.0, -1.0]

[viscous_contact]
time_step = 0.05
end_time = 10.0
gamma_min = -2.0

[solver]
tolerance = 1e-6
max_iterations = 10000

[output]
every = 0.5

[[plane]]
point = [0.0, 0.0]
normal = [0.0, 1.0]

[particles]
file = "discs.csv"

[[particle]]
centre = [0.0, 2.0]
radius = 1.0
mass = 1.0
velocity = [0.0, 0.0]
force = [ { until = 5.0, value = [0.7, -0.7] }, { until = 10.0, value = [-0.7, 0.7] } ]
)";
inline constexpr const char* kDiscs = "x,y,vx,vy,radius,mass\n3,1,0,0,1,1\n6.5,4,0,-1,0.5,0.25\n";

/// The text of a case: the discs of discs.csv on a floor, with these steps and the sections `more`.
inline std::string discs_on_a_floor(const std::string& time_step, const std::string& end_time,
                                    const std::string& more) {
  return R"(title = "Discs on a floor"
[space]
dimension = 2
gravity = [0.0, -1.0]
[viscous_contact]
time_step = )" +
         time_step + "\nend_time = " + end_time + R"(
gamma_min = -2.0
[[plane]]
point = [0.0, 0.0]
normal = [0.0, 1.0]
[particles]
file = "discs.csv"
)" + more;
}

/// The table [[particle]] of a disc, followed by the lines `more`.
inline std::string disc(const std::string& centre, const std::string& radius,
                        const std::string& mass, const std::string& more = "") {
  return "[[particle]]\ncentre = [" + centre + "]\nradius = " + radius + "\nmass = " + mass + "\n" +
         more;
}

class ParticlesCommand : public ::testing::Test {
 protected:
  ParticlesCommand() { folder_.file("discs.csv", kDiscs); }
  std::filesystem::path put_case(const std::string& text,
                                 const std::string& name = "case.toml") const {
    return folder_.file(name, text);
  }
  std::filesystem::path out(const std::string& name = "out") const { return folder_.path() / name; }
  std::string path(const std::string& name) const { return out(name).string(); }
  static ProgramResult run(const std::filesystem::path& file, const std::filesystem::path& out,
                           std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"particles", file.string(), "-o", out.string()});
    return run_viscontact(more);
  }
  /// The text of a case file with other values of keys, which it must have.
  static std::string changed_case(const std::filesystem::path& file,
                                  const std::vector<std::pair<std::string, std::string>>& values) {
    auto text = read_file(file);
    for (const auto& [key, value] : values) {
      const auto changed =
          replaced_matches(text, "\n" + key + " = [^\n]*\n", "\n" + key + " = " + value + "\n");
      EXPECT_NE(changed, text) << key;
      text = changed;
    }
    return text;
  }
  /// Runs a case into out().
  void compute(const std::string& text) const { expect_done(run(put_case(text), out())); }
  /// Runs a case into out(), from the state at the end of the run that is there.
  void continue_last_run(const std::string& text) const {
    const auto copy = folder_.path() / "part.bin";
    std::filesystem::copy_file(out() / "restart.bin", copy,
                               std::filesystem::copy_options::overwrite_existing);
    expect_done(run(put_case(text), out(), {"--restart", copy.string()}));
  }
  /// All values of a column of a table of the run in out().
  std::vector<double> column(const std::string& file, const std::string& name) const {
    const auto lines = matches_in(content(out() / file), "([^\n]+)\n", 1);
    const auto names = matches_in(lines.front() + ",", "([^,]*),", 1);
    const auto place = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    std::vector<double> values;
    for (std::size_t i = 1; i < lines.size(); ++i)
      values.push_back(std::stod(matches_in(lines[i] + ",", "([^,]*),", 1).at(place)));
    return values;
  }
  /// The text of a file without its lines of comment.
  static std::string content(const std::filesystem::path& file) {
    return replaced_matches(read_file(file), "#[^\n]*\n", "");
  }
  /// The files of a run by name, without the lines and the column of steps.csv that say how, how
  /// fast and in how much memory they were made.
  static std::map<std::string, std::string> without_costs(const std::string& folder) {
    std::map<std::string, std::string> files;
    for (const auto& [file, text] : files_below(folder)) {
      std::istringstream lines(text);
      std::optional<std::ptrdiff_t> seconds;  // number of the column
      for (std::string line; std::getline(lines, line);) {
        const auto begin = line.substr(0, 100);
        const auto has = [&](const char* words) { return begin.find(words) != std::string::npos; };
        if (has("provenance") || has("# record after step ") || has("seconds\": ") ||
            has("\"peak_memory_mebibytes\": "))
          continue;
        if (const auto at = line.find(",fluid_seconds"); at != std::string::npos)
          seconds = std::count(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(at), ',');
        if (seconds) {
          std::size_t from = 0;
          for (std::ptrdiff_t comma = 0; comma < *seconds; ++comma) from = line.find(',', from) + 1;
          from = line.find(',', from);
          line.erase(from, std::min(line.find(',', from + 1), line.size()) - from);
        }
        files[std::filesystem::path(file).filename()] += line + "\n";
      }
    }
    return files;
  }
  /// Fails if the files of two runs differ but for their costs.
  static void expect_same_files(const std::string& one, const std::string& other) {
    const auto first = without_costs(one), second = without_costs(other);
    for (const auto& [name, text] : first) {
      ASSERT_TRUE(second.contains(name)) << name;
      EXPECT_TRUE(second.at(name) == text) << name << " differs";
    }
    EXPECT_EQ(first.size(), second.size());
  }

  TemporaryFolder folder_;
};

}  // namespace viscontact
