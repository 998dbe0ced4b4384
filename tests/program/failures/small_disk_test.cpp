// Tabulations and runs of particles on a disk that is full; the disk is a small tmpfs, which root
// may mount.
#include <gmock/gmock.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/tabulate/disturbed_tabulation.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

using ::testing::SizeIs;

/// A file system in memory.
class SmallDisk {
 public:
  /// `size` is a number with a unit, as mount(8) takes it.
  SmallDisk(std::filesystem::path place, const std::string& size) : place_(std::move(place)) {
    std::filesystem::create_directory(place_);
    mounted_ = ::mount("tmpfs", place_.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
    if (!mounted_) reason_ = std::strerror(errno);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (mounted_) ::umount2(place_.c_str(), MNT_DETACH);
  }
  /// Skips a test, or fails if root runs it, where the disk could not be made. Root may mount, and
  /// the tests of a clone that scripts/setup made run as root: there nothing is skipped. To another
  /// user a full disk is shown by the limit on file sizes alone (disk_full_test.cpp).
  void skip_if_there_is_none() const {
    if (::geteuid() == 0) {
      ASSERT_TRUE(mounted_) << reason_;
    }
    if (!mounted_) GTEST_SKIP() << "mounting a tmpfs is not permitted: " << reason_;
  }

  /// Leaves so many bytes free.
  void fill_but(std::size_t bytes) const {
    const auto space = std::filesystem::space(place_).available;
    if (space > bytes) put_text(place_ / "filler", std::string(space - bytes, 'x'));
  }
  void make_room() const { std::filesystem::remove(place_ / "filler"); }

 private:
  std::filesystem::path place_;
  bool mounted_ = false;
  std::string reason_;
};

class FullDisk : public DisturbedTabulation {
 protected:
  void SetUp() override { disk_.skip_if_there_is_none(); }
  static constexpr std::size_t kPage = 4096;
  SmallDisk disk_{scratch_.path() / "disk", "16k"};  // four pages
};

TEST_F(FullDisk, JournalThatFindsNoRoomStopsTheRunAndTheSameCommandGoesOn) {
  const freefem_axi::FakeFreeFem fake(scratch_.path());
  put_text(path("case.toml"), case_of_24_rows());
  expect_done(tabulate(path("undisturbed.csv"), fake.executable()));
  const auto answers_before = fake.answered().size();
  disk_.fill_but(kPage);  // about 20 rows
  const auto full = tabulate(path("disk/table.csv"), fake.executable());
  expect_refusal(full, ErrorKind::kBadInput, Names("table.csv.rows"));
  const auto kept = finished(path("disk/table.csv")).size();
  EXPECT_GT(kept, 10U);
  const auto answers_full = fake.answered().size();
  // Two processes: at most two rows found no room.
  EXPECT_LE(answers_full - answers_before, kept + 2);
  disk_.make_room();
  expect_done(tabulate(path("disk/table.csv"), fake.executable()));
  EXPECT_EQ(fake.answered().size(), answers_full + 24 - kept);
  EXPECT_EQ(without_seconds(path("disk/table.csv")), without_seconds(path("undisturbed.csv")));
}

TEST_F(FullDisk, TableThatFindsNoRoomIsWrittenLaterWithoutComputing) {
  const freefem_axi::FakeFreeFem fake(scratch_.path());
  put_text(path("case.toml"), gentle_case_text());
  disk_.fill_but(kPage);  // enough for six rows' journal
  const auto full = tabulate(path("disk/table.csv"), fake.executable());
  expect_refusal(full, ErrorKind::kBadInput, Names("table.csv"));
  EXPECT_FALSE(std::filesystem::exists(path("disk/table.csv")));
  EXPECT_THAT(finished(path("disk/table.csv")), SizeIs(6));
  disk_.make_room();
  expect_done(tabulate(path("disk/table.csv"), "no-such-freefem"));
  EXPECT_THAT(fake.answered(), SizeIs(6));
  EXPECT_FALSE(std::filesystem::exists(path("disk/table.csv.rows")));
}

class FullDiskOfParticles : public ParticlesCommand {
 protected:
  void SetUp() override { disk_.skip_if_there_is_none(); }
  SmallDisk disk_{folder_.path() / "disk", "16m"};
};

TEST_F(FullDiskOfParticles, StopsTheRunAndTheSameCommandGoesOnToTheSameFiles) {
  // 40 000 rows of steps.csv, about 3 MB.
  const auto file = put_case(replaced(kCase, "time_step = 0.05", "time_step = 2.5e-4"));
  const auto folder = out("disk/run");
  expect_done(run(file, out("whole")));
  const auto interrupted =
      run_viscontact({"particles", file.string(), "-o", folder.string()}, {},
                     "(while [ ! -e '" + (folder / "particles_00002.vtp").string() +
                         "' ]; do sleep 0.01; done; kill -INT $$) &");
  ASSERT_EQ(interrupted.exit_status, results::exit_code_of(ErrorKind::kInterrupted))
      << interrupted.errors;
  disk_.fill_but(200000);
  expect_refusal(run(file, folder), ErrorKind::kBadInput, Says("No space left on device"));
  for (const auto* name : {"steps.csv", "particles.pvd"})
    EXPECT_THAT(read_file(folder / name), ::testing::EndsWith("\n")) << name;
  disk_.make_room();
  const auto last = run(file, folder);
  expect_done(last);
  EXPECT_THAT(last.errors, Continues());
  expect_same_files(path("whole"), folder.string());
}

}  // namespace
}  // namespace viscontact
