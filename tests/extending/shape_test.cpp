// The square with round corners of docs/extending.md, by runs of particles.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

/// The rows of a table after the line with the names of its columns.
std::vector<std::vector<double>> rows_of(const fs::path& file) {
  std::istringstream text(results::without_provenance(read_file(file)));
  std::vector<std::vector<double>> rows;
  bool has_names = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with('#')) continue;
    if (!has_names) {
      has_names = true;
      continue;
    }
    auto& row = rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');)
      row.push_back(field.empty() ? 0 : std::stod(field));
  }
  return rows;
}

class RoundedSquare : public ::testing::Test {
 protected:
  fs::path run(const std::string& text, const std::string& name) const {
    put_text(folder_.path() / (name + ".toml"), text);
    const auto result =
        run_process({VISCONTACT_EXTENDED, "particles", (folder_.path() / (name + ".toml")).string(),
                     "-o", (folder_.path() / name).string()});
    EXPECT_EQ(result.exit_status, 0) << result.output;
    return folder_.path() / name;
  }

 private:
  TemporaryFolder folder_;
};

/// The case of the page.
std::string falling(double angle) {
  return R"(title = "A square falls onto its corner"
[space]
dimension = 2
gravity = [0.0, -10.0]
[viscous_contact]
time_step = 0.002
end_time = 3.0
gamma_min = 0.0
[friction]
coefficient = 0.5
[[plane]]
point = [0.0, 0.0]
normal = [0.0, 1.0]
[[particle]]
centre = [0.0, 1.5]
width = 2.0
radius = 0.2
mass = 1.0
angle = )" +
         std::to_string(angle) + "\n";
}

// The gap of both corners is closed to 1e-6 mean radii at the end, and the load is shared.
TEST_F(RoundedSquare, ComesToLieOnASide) {
  const auto folder = run(falling(0.3), "square");
  const auto particle = rows_of(folder / "final_particles.csv").at(0);
  EXPECT_NEAR(particle.at(2), 1, 1e-5);
  const auto contacts = rows_of(folder / "final_contacts.csv");
  ASSERT_EQ(contacts.size(), 2U);
  for (const auto& contact : contacts) EXPECT_NEAR(contact.at(5), 5, 1e-4);
}

// With the semi-axes s the density 1 gives the mass 4 s_1^2 - (4 - pi) s_2^2.
TEST_F(RoundedSquare, HasTheAreaOfThePage) {
  auto text = falling(0.3);
  text.replace(text.find("mass = 1.0"), 10, "density = 1");
  const auto particle = rows_of(run(text, "dense") / "final_particles.csv").at(0);
  EXPECT_NEAR(particle.at(6), 4 - (4 - M_PI) * 0.04, 1e-12);
}

// In the middle of a round wall the velocity of a square does not depend on its angle. The mesh
// makes an error of 1e-3.
TEST_F(RoundedSquare, MovesInAFluidAlikeAtAllAngles) {
  const auto velocity = [&](const std::string& angle) {
    const auto folder = run(R"(title = "A square in a round wall"
[space]
dimension = 2
[fluid]
viscosity = 1.0
constraint = "rigid"
edges_per_particle = 40
[domain]
disc = { centre = [0.0, 0.0], radius = 4.0 }
[viscous_contact]
time_step = 1e-6
end_time = 1e-6
gamma_min = 0.0
[[particle]]
centre = [0.0, 0.0]
width = 1.0
radius = 0.2
mass = 0.0
force = [1.0, 0.0]
angle = )" + angle + "\n",
                            "flow" + angle);
    const auto particle = rows_of(folder / "final_particles.csv").at(0);
    return std::array{particle.at(3), particle.at(4)};
  };
  const auto flat = velocity("0.0"), turned = velocity("0.5");
  EXPECT_NEAR(turned[0], flat[0], 2e-3 * flat[0]);
  EXPECT_NEAR(turned[1], 0, 2e-3 * flat[0]);
}

}  // namespace
}  // namespace viscontact
