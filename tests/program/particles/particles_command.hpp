// A case of three discs that is run by `viscontact particles` in a folder of its own.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
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
  /// The text of a file without its lines of comment.
  static std::string content(const std::filesystem::path& file) {
    return replaced_matches(read_file(file), "#[^\n]*\n", "");
  }
  TemporaryFolder folder_;
};

}  // namespace viscontact
