// The shipped cases of particles in a fluid run with FreeFEM, and show what docs/fluid.md,
// docs/viscosity.md and docs/direct-simulation.md say of them. Each is cut to a few steps.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path kCases = VISCONTACT_SOURCE_FOLDER "/data/cases/fluid";

class ShippedFluidCase : public ParticlesCommand {
 protected:
  /// The text of a shipped case that has this time step, and ends after `steps` of them. Only the
  /// first and the last frame are kept if `every` is 0.
  static std::string cut(const std::string& name, double step, int steps, double every = 0) {
    const auto line = [](const std::string& key, double value) {
      return key + " = " + std::to_string(value) + "\n";
    };
    auto text = read_file(kCases / (name + ".toml"));
    text = replaced_matches(text, "\\[output\\]\nevery = [^\n]*\n", "");
    // The numbers below do not need more edges.
    text = replaced_matches(text, "edges_per_particle = 12", "edges_per_particle = 8");
    text = replaced_matches(text, "time_step = [^\n]*\n", line("time_step", step));
    text = replaced_matches(text, "end_time = [^\n]*\n", line("end_time", step * steps));
    return text + "[output]\n" + line("every", every > 0 ? every : step * steps);
  }
  nlohmann::json last_of(const std::string& text) {
    expect_done(run(put_case(text), out()));
    EXPECT_GT(fs::file_size(out() / "flow_00000.vtu"), 10000U);
    return nlohmann::json::parse(read_file(out() / "run.json"));
  }
  /// A field of a row of a result; row 0 is the last, row 1 the one before.
  double last(const std::string& file, std::size_t field, std::size_t row = 0) const {
    const auto rows = matches_in(content(out() / file), "([^\n]+)\n", 1);
    const auto fields = matches_in(rows.at(rows.size() - 1 - row) + ",", "([^,]*),", 1);
    return std::stod(fields.at(field));
  }
  static constexpr std::size_t kApparentViscosity = 12;  // in steps.csv
};

// No other test has to name each case, so a new one must get a test here.
TEST_F(ShippedFluidCase, EachHasATest) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(kCases)) names.insert(entry.path().stem());
  EXPECT_EQ(names, (std::set<std::string>{"friction", "lecture", "one_disc", "seven_discs", "shear",
                                          "sieve", "viscosity_channel", "viscosity_contact",
                                          "viscosity_lattice_axes", "viscosity_lattice_diagonals",
                                          "viscosity_random_cell", "viscosity_random_walls"}));
}

// The nearer wall is on the left: the fluid shears the disc more there, and turns it clockwise.
TEST_F(ShippedFluidCase, ADiscSinksAndTurns) {
  last_of(cut("one_disc", 0.25, 1));
  EXPECT_LT(last("motion.csv", 6), 0);  // vy
  EXPECT_NE(last("motion.csv", 7), 0);  // angular velocity
}

TEST_F(ShippedFluidCase, SevenDiscsFallTogether) {
  const auto record = last_of(cut("seven_discs", 0.5, 1));
  EXPECT_LT(record["velocity_error_estimate"]["first_step"], 1e-3);
  for (std::size_t disc = 0; disc < 7; ++disc)
    EXPECT_LT(last("motion.csv", 6, disc), 0) << disc;  // vy
}

TEST_F(ShippedFluidCase, ShearedDiscsRubEachOther) {
  const auto record = last_of(cut("friction", 0.2, 1));
  EXPECT_EQ(record["failed_steps"], 0);
  // i,j,gap,gamma,gamma_error,normal_force,tangential_force_x,tangential_force_y
  const auto rows = matches_in(content(out() / "final_contacts.csv"), "\n(-?\\d[^\n]+)", 1);
  int rubbing = 0;
  for (const auto& row : rows) {
    const auto fields = matches_in(row + ",", "([^,]*),", 1);
    const double normal = std::stod(fields.at(5));
    const double friction = std::hypot(std::stod(fields.at(6)), std::stod(fields.at(7)));
    EXPECT_LE(friction, normal * (1 + 1e-12));  // the coefficient is 1
    if (friction > 0.1 * normal && normal > 0) ++rubbing;
  }
  EXPECT_GT(rubbing, 0);
}

// The wall of a shear flow drags a disc that is pressed on it. In the fluid alone, the force and
// the torque of Coulomb's friction move it in the same way.
TEST_F(ShippedFluidCase, FrictionIsAForceAndATorque) {
  const auto text = [](const std::string& friction, const std::string& force) {
    return "title = \"A disc at a wall\"\n[space]\ndimension = 2\n"
           "[fluid]\nviscosity = 1.0\nthreshold_gap = 0.05\n"
           "velocity = { left = [0.0, 2.0] }\n"
           "[domain]\nbox = { from = [0.0, 0.0], to = [8.0, 8.0] }\n"
           "[viscous_contact]\ngamma_min = 0.0\ntime_step = 0.01\nend_time = 0.01\n" +
           friction + "[[particle]]\ncentre = [1.05, 4.0]\nradius = 1.0\n" + force;
  };
  last_of(text("[friction]\ncoefficient = 0.3\n", "force = [-20.0, 0.0]\n"));
  const double v = last("motion.csv", 5), omega = last("motion.csv", 6);
  const double load = last("final_contacts.csv", 5), friction = last("final_contacts.csv", 7);
  // By the symmetry of the box only the force presses the disc; the mesh is not symmetric.
  EXPECT_NEAR(load, 20, 0.1);
  EXPECT_NEAR(friction, 0.3 * load, 1e-8);
  // Friction acts at the leftmost point, and turns the disc clockwise.
  last_of(text("", fmt::format("force = [-20.0, {0}]\ntorque = {1}\n", friction, -friction)));
  EXPECT_NEAR(v, last("motion.csv", 5), 1e-7);
  EXPECT_NEAR(omega, last("motion.csv", 6), 1e-7);
}

TEST_F(ShippedFluidCase, ShearedDiscsRaiseTheViscosity) {
  last_of(cut("shear", 0.2, 1));
  // 20 discs are a third of the area: 1 + 2 phi = 1.65 is less than the suspension has.
  EXPECT_GT(last("steps.csv", kApparentViscosity), 1.65);
  EXPECT_LT(last("steps.csv", kApparentViscosity), 5);
}

TEST_F(ShippedFluidCase, TheFlowCarriesDiscsToTheSieve) {
  last_of(cut("sieve", 0.1, 1));
  EXPECT_GT(last("motion.csv", 5), 0);  // vx of the last particle, which is free
  EXPECT_THAT(content(out() / "final_particles.csv"), HasSubstr("0,6,0.9,0,0,0.4,"));
}

// The whole impulse of the push is in momentum and Gamma, so that the floor has it at last.
TEST_F(ShippedFluidCase, TheLectureIsPushedToTheFloor) {
  auto text = cut("lecture", 0.05, 40);
  text = replaced_matches(text, "edges_per_particle = 24", "edges_per_particle = 12");
  last_of(text);
  EXPECT_NEAR(last("motion.csv", 2), 1.1, 1e-6);  // the centre: D_c and the radius
  EXPECT_NEAR(last("contacts.csv", 4), -203.5, 2);
}

// docs/physics.md (6.8): the film of 3.2e-3 that the smooth sphere has at t = 2 is thinner than
// twice the roughness, so that the solids touch, and the sphere comes off before t = 3.
TEST_F(ShippedFluidCase, TheLecturesSphereTouchesTheFloorIfItIsRough) {
  auto text = cut("lecture", 0.05, 54, 0.3);
  text = replaced_matches(text, "edges_per_particle = 24", "edges_per_particle = 12");
  text = replaced_matches(text, "time_step = ", "roughness = 0.005\ntime_step = ");
  last_of(text);
  // time,i,j,gap,gamma,normal_force
  const auto gammas = matches_in(content(out() / "contacts.csv"), ",(-[^,\n]+),[^,\n]+\n", 1);
  std::vector<double> of_film;
  for (const auto& gamma : gammas) of_film.push_back(std::stod(gamma));
  // The integral of Brenner's drag, of which 18 pi ln 10 is 94 %.
  EXPECT_NEAR(*std::ranges::min_element(of_film), -138.3357122, 1e-6);
  EXPECT_GT(last("motion.csv", 2), 1.1);
  // The film has pulled in the last step, in which it let go.
  EXPECT_THAT(content(out() / "final_contacts.csv"),
              ::testing::MatchesRegex("[^\n]*\n0,-2,0\\.101[^,]*,0,0,-[^,]*\n"));
}

// Exactly 1 + 2.0392276 phi in a cell of 2 H (data/reference/discs.csv, "sheared, 2a/H = 0.1").
TEST_F(ShippedFluidCase, ADiscInAChannel) {
  auto text = cut("viscosity_channel", 0.01, 1);
  text = replaced_matches(text, "from = \\[-10.0", "from = [-20.0");
  text = replaced_matches(text, "to = \\[10.0", "to = [20.0");
  last_of(text);
  const double phi = std::acos(-1.0) / 800;
  EXPECT_NEAR((last("steps.csv", kApparentViscosity) - 1) / phi, 2.0392276, 1e-3);
}

// Square lattices of the area fraction 0.1, exact values 1.263338 and 1.192224
// (data/reference/discs.csv).
TEST_F(ShippedFluidCase, Lattices) {
  last_of(cut("viscosity_lattice_axes", 0.01, 1));
  EXPECT_NEAR(last("steps.csv", kApparentViscosity), 1.263338, 1e-4);
  // At the end the images have moved, and the fluid solver knows the cell at the start only.
  EXPECT_FALSE(fs::exists(out() / "flow_00001.vtu"));
  last_of(cut("viscosity_lattice_diagonals", 0.01, 1));
  EXPECT_NEAR(last("steps.csv", kApparentViscosity), 1.192224, 1e-4);
}

TEST_F(ShippedFluidCase, RandomDiscs) {
  for (const auto* name : {"viscosity_random_cell", "viscosity_random_walls"}) {
    last_of(cut(name, 1e-3, 1));
    EXPECT_GT(last("steps.csv", kApparentViscosity), 1.6) << name;
    EXPECT_LT(last("steps.csv", kApparentViscosity), 4) << name;
  }
}

// Two discs that the shear pushes together within the cell, and half a period further, where they
// meet across its side: an image moves with the mean flow.
TEST_F(ShippedFluidCase, ContactIsTheSameAcrossTheSideOfAShearedCell) {
  const auto gamma = [&](const std::string& first, const std::string& second) {
    last_of(R"(title = "A pair in a sheared cell"
[space]
dimension = 2
[fluid]
viscosity = 1.0
constraint = "rigid"
edges_per_particle = 12
threshold_gap = 0.05
velocity = { shear_rate = 1.0 }
[domain]
box = { from = [0.0, 0.0], to = [6.0, 6.0], periodic = [true, true] }
[viscous_contact]
time_step = 0.02
end_time = 0.02
[[particle]]
centre = )" +
            first + "\nradius = 1.0\n[[particle]]\ncentre = " + second + "\nradius = 1.0\n");
    return last("contacts.csv", 4);
  };
  const double inside = gamma("[2.5, 4.0]", "[3.4815, 2.2]");
  EXPECT_LT(inside, -0.01);
  // With 12 edges the two meshes of the film differ by 1.4 %.
  EXPECT_NEAR(gamma("[2.5, 1.0]", "[3.4815, 5.2]"), inside, 0.05 * -inside);
}

TEST_F(ShippedFluidCase, ContactOfShearedDiscs) {
  last_of(cut("viscosity_contact", 0.1, 1));
  EXPECT_GT(last("steps.csv", kApparentViscosity), 1.6);
  EXPECT_THAT(content(out() / "contacts.csv"), ::testing::HasSubstr(",normal_force"));
}

}  // namespace
}  // namespace viscontact
