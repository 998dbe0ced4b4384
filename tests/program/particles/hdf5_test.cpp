// The HDF5 file that `viscontact particles --hdf5` writes has, in h5py, the numbers of the other
// results of the run, and no failure leaves a part of it.
#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

class Hdf5File : public ParticlesCommand {
 protected:
  /// Runs a script of this folder with Debian's python3, for which python3-h5py and python3-vtk9
  /// are.
  static void expect_script_done(const std::string& words) {
    const TemporaryFolder scratch;
    const auto log = scratch.path() / "log.txt";
    const std::string command = "/usr/bin/python3 " VISCONTACT_SOURCE_FOLDER
                                "/tests/program/particles/" +
                                words + " > '" + log.string() + "' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << read_file(log);
  }
  /// The shipped case of spheres that are poured in, shortened to 16 spheres in a small box, with
  /// friction and tables.
  static std::string poured_spheres() {
    return changed_case(
               VISCONTACT_SOURCE_FOLDER "/data/cases/particles/poured_spheres.toml",
               {{"box", "{ from = [0, 0, 0], to = [6, 6, 10], periodic = [true, true, false] }"},
                {"region", "{ from = [0, 0, 3], to = [6, 6, 7] }"},
                {"rate", "8.0"},
                {"end", "2.0"},
                {"end_time", "4.0"},
                {"every", "0.2\ntables = [\"motion\", \"contacts\"]"}}) +
           "\n[friction]\ncoefficient = 0.3\n";
  }
};

TEST_F(Hdf5File, SaysTheSameNumbersAsVtkTablesAndPage) {
  expect_done(run(put_case(kCase), out()));
  EXPECT_FALSE(fs::exists(out() / "particles.h5"));
  const auto frames = content(out() / "particles.pvd");
  const auto done = run(put_case(kCase), out(), {"--hdf5"});
  expect_done(done);
  // The run was finished, so that only the file is new.
  EXPECT_THAT(done.output + done.errors, IsUpToDate(""));
  EXPECT_EQ(content(out() / "particles.pvd"), frames);
  expect_script_done("same_numbers.py " + out().string());
}

TEST_F(Hdf5File, SaysTheSameNumbersOfSpheresThatArePouredInWithFriction) {
  expect_done(run(put_case(poured_spheres()), out(), {"--hdf5"}));
  expect_script_done("same_numbers.py " + out().string() + " 0.3");
}

TEST_F(Hdf5File, IsMadeAgainByRerun) {
  const auto file = put_case(poured_spheres());
  expect_done(run(file, out(), {"--hdf5"}));
  for (const std::string name : {"particles.h5", "run.json"}) {
    const auto again = path("again_by_" + name.substr(0, 3));
    expect_done(run_viscontact({"rerun", (out() / name).string(), "-o", again}));
    expect_script_done("same_hdf5.py " + (out() / "particles.h5").string() + " " + again +
                       "/particles.h5");
  }
  // In its old place, a lost file is made again from the frames.
  const auto first = read_file(out() / "particles.h5");
  fs::remove(out() / "particles.h5");
  const auto again = run_viscontact({"rerun", (out() / "run.json").string()});
  expect_done(again);
  EXPECT_THAT(again.output + again.errors, IsUpToDate(""));
  EXPECT_EQ(read_file(out() / "particles.h5").size(), first.size());
}

TEST_F(Hdf5File, ThatFindsNoRoomLeavesTheEarlierOneAndNoPart) {
  expect_done(run(put_case(poured_spheres()), out(), {"--hdf5"}));
  const auto before = files_below(out());
  // In units of 512 bytes: enough for messages, less than the file has.
  const auto full = run_viscontact({"particles", path("case.toml"), "-o", out().string(), "--hdf5"},
                                   {}, "ulimit -f 20;");
  expect_refusal(full, ErrorKind::kBadInput, Names("particles.h5"));
  EXPECT_EQ(files_below(out()), before);
}

TEST_F(Hdf5File, InTheWayOfWhichIsAFolderIsRefused) {
  expect_done(run(put_case(kCase), out()));
  fs::create_directory(out() / "particles.h5");
  expect_refusal(run(put_case(kCase), out(), {"--hdf5"}), ErrorKind::kBadInput,
                 Names("particles.h5"));
}

}  // namespace
}  // namespace viscontact
