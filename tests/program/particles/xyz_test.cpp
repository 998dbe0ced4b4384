// The extended XYZ file that `viscontact particles --xyz` writes has the numbers of the frames.
#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

class XyzFile : public ParticlesCommand {
 protected:
  /// Compares particles.xyz with the frames. `lattice` is that of the last frame.
  void expect_same_numbers(const std::string& pbc, const std::string& lattice,
                           const std::string& origin) const {
    const auto log = path("log.txt");
    // Debian's python3, for which python3-vtk9 is.
    const std::string command =
        "/usr/bin/python3 " VISCONTACT_SOURCE_FOLDER "/tests/program/particles/same_xyz.py " +
        out().string() + " '" + pbc + "' '" + lattice + "' '" + origin + "' > " + log + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << read_file(log);
  }
  static std::string xyz_in(const fs::path& folder) {
    return results::without_provenance(read_file(folder / "particles.xyz"));
  }
  /// A case without a fluid, in the plane or in space.
  static std::string dry(int dimension, const std::string& sections) {
    return "title = \"A case\"\n[space]\ndimension = " + std::to_string(dimension) +
           "\n[viscous_contact]\ntime_step = 0.05\nend_time = 0.5\ngamma_min = -1.0\n"
           "[output]\nevery = 0.1\n" +
           sections;
  }
};

TEST_F(XyzFile, OfDiscsOnAFloorHasNoCell) {
  expect_done(run(put_case(kCase), out()));
  EXPECT_FALSE(fs::exists(out() / "particles.xyz"));
  expect_done(run(put_case(kCase), out(), {"--xyz"}));
  expect_same_numbers("F F F", "", "");
}

TEST_F(XyzFile, OfTurningDiscsInAPeriodicBoxHasAFlatCell) {
  expect_done(run(put_case(dry(2,
                               "[friction]\ncoefficient = 0.5\n[domain]\n"
                               "box = { from = [-1.0, 0.0], to = [7.0, 6.0], periodic = [true, "
                               "false] }\n") +
                           disc("1.0, 1.0", "1.0", "1.0", "velocity = [1.0, -1.0]\n") +
                           disc("3.1, 1.0", "1.0", "2.0") + disc("6.5, 0.5", "0.5", "1.0")),
                  out(), {"--xyz"}));
  // As thick as the largest disc.
  expect_same_numbers("T F F", "8 0 0 0 6 0 0 0 2", "-1 0 -1");
}

// The sources begin after the first frame, which has no particle, and so no masses.
TEST_F(XyzFile, OfSpheresThatArePouredInHasTheSameColumnsInAllFrames) {
  const auto text = dry(3, R"([domain]
box = { from = [0.0, 0.0, -1.0], to = [6.0, 6.0, 9.0], periodic = [true, true, false] }
[friction]
coefficient = 0.3
[[source]]
radius = { uniform = [0.5, 1.0] }
density = 1.0
region = { from = [0.0, 0.0, 2.0], to = [6.0, 6.0, 5.0] }
velocity = [0.0, 0.0, -2.0]
rate = 40.0
begin = 0.15
)");
  expect_done(run(put_case(text), out(), {"--xyz"}));
  expect_same_numbers("T T F", "6 0 0 0 6 0 0 0 10", "0 0 -1");
}

TEST_F(XyzFile, OfASphereOnAnAxisHasItOnZ) {
  expect_done(run(put_case(R"(title = "A sphere that falls on the axis of a cylinder"
[space]
dimension = "axisymmetric"
gravity = -1.0
[fluid]
viscosity = 1.0
edges_per_particle = 12
[domain]
cylinder = { radius = 4.0, height = 9.0 }
[viscous_contact]
time_step = 0.1
end_time = 0.1
[[particle]]
centre = 4.0
radius = 1.0
mass = 1.0
)"),
                  out(), {"--xyz"}));
  expect_same_numbers("F F F", "8 0 0 0 8 0 0 0 9", "-4 -4 0");
}

// A shear flow of rate 1.3 in a cell of 6 x 6, which has one step: after 1.5 its second edge has
// moved by 11.7, and so by -0.3 from two periods.
TEST_F(XyzFile, OfAShearedCellHasItsShortestEdges) {
  expect_done(run(put_case(R"(title = "A disc in a sheared cell"
[space]
dimension = 2
[fluid]
viscosity = 1.0
edges_per_particle = 12
velocity = { shear_rate = 1.3 }
[domain]
box = { from = [0.0, 0.0], to = [6.0, 6.0], periodic = [true, true] }
[viscous_contact]
time_step = 1.5
end_time = 1.5
)" + disc("1.0, 1.0", "1.0", "0.0")),
                  out(), {"--xyz"}));
  expect_same_numbers("T T F", "6 0 0 -0.3 6 0 0 0 2", "0 0 -1");
}

// A shear along y that changes along x: after the strain 0.5 the first edge is (8, 4, 0), and the
// cell stays around its middle.
TEST_F(XyzFile, OfAStrainedCellHasItsPeriodVectors) {
  expect_done(run(put_case(R"(title = "A sphere in a strained cell"
[space]
dimension = 3
[domain]
box = { from = [0.0, 0.0, 0.0], to = [8.0, 8.0, 8.0], periodic = [true, true, true] }
[lubrication]
viscosity = 1.0
velocity = { gradient = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]] }
[viscous_contact]
time_step = 0.25
end_time = 0.5
[[particle]]
centre = [1.0, 1.0, 1.0]
radius = 1.0
)"),
                  out(), {"--xyz"}));
  expect_same_numbers("T T T", "8 4 0 0 8 0 0 0 8", "0 -2 0");
}

// After the strain 0.75 the image across y has moved by 6, and so by -2 from a period. The cell stays
// around its middle.
TEST_F(XyzFile, OfAShearedSuspensionHasItsPresentPeriods) {
  const auto of = [&](const std::string& periodic, const std::string& keys) {
    expect_done(
        run(put_case("title = \"A sphere\"\n[space]\ndimension = 3\n[domain]\n"
                     "box = { from = [1.0, 2.0, 3.0], to = [9.0, 10.0, 11.0], periodic = [" +
                     periodic + "] }\n[lubrication]\nviscosity = 1.0\n" + keys +
                     "[viscous_contact]\ntime_step = 0.25\nend_time = 0.75\n"
                     "[[particle]]\ncentre = [5.0, 6.0, 7.0]\nradius = 1.0\n"),
            out(), {"--xyz"}));
  };
  of("true, true, true", "velocity = { shear_rate = 1.0 }\n");
  expect_same_numbers("T T T", "8 0 0 -2 8 0 0 0 8", "2 2 3");
  // Between walls across z, at rest, but displaced.
  of("true, true, false", "offset = 3.0\n");
  expect_same_numbers("T T F", "8 0 0 3 8 0 0 0 8", "-0.5 2 3");
}

TEST_F(XyzFile, OfAnInterruptedRunIsThatOfTheWholeRun) {
  const auto parts = path("parts");
  const std::string interrupt =
      "(while [ ! -e '" + parts + "/particles_00004.vtp' ]; do sleep 0.01; done; kill -INT $$) &";
  const auto file = put_case(replaced(kCase, "time_step = 0.05", "time_step = 0.0002")).string();
  (void)run_viscontact({"particles", file, "-o", parts, "--xyz"}, {}, interrupt);
  // The file that the interrupted run has written lacks frames.
  const auto part = read_file(fs::path(parts) / "particles.xyz");
  const auto again = run_viscontact({"particles", file, "-o", parts});
  expect_done(again);
  EXPECT_THAT(again.errors, Continues());
  EXPECT_FALSE(fs::exists(fs::path(parts) / "particles.xyz"));
  expect_done(run_viscontact({"particles", file, "-o", parts, "--xyz"}));
  const auto joined = xyz_in(parts);
  EXPECT_GT(joined.size(), part.size());
  expect_done(run(file, path("whole"), {"--xyz"}));
  EXPECT_EQ(joined, xyz_in(path("whole")));
}

TEST_F(XyzFile, IsMadeAgainByRerun) {
  expect_done(run(put_case(kCase), out(), {"--xyz"}));
  const auto first = xyz_in(out());
  const auto again = path("again");
  expect_done(run_viscontact({"rerun", (out() / "particles.xyz").string(), "-o", again}));
  EXPECT_EQ(xyz_in(again), first);
}

TEST_F(XyzFile, ThatFindsNoRoomLeavesTheEarlierOneAndNoPart) {
  expect_done(run(put_case(kCase), out(), {"--xyz"}));
  const auto before = files_below(out());
  // In units of 512 bytes: enough for messages, less than the file has.
  const auto full = run_viscontact({"particles", path("case.toml"), "-o", out().string(), "--xyz"},
                                   {}, "ulimit -f 4;");
  expect_refusal(full, ErrorKind::kBadInput, Names("particles.xyz"));
  EXPECT_EQ(files_below(out()), before);
}

}  // namespace
}  // namespace viscontact
