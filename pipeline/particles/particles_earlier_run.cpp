// Compares the provenance of restart.bin with that of this call, and reads state, record and
// frames.
#include "viscontact/pipeline/particles/particles_earlier_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/particles/io/restart.hpp"
#include "viscontact/particles/io/vtk.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

/// The provenance of a restart file. Only its first 64 kB are read: they contain the provenance,
/// and the file can be a gigabyte long.
std::optional<Provenance> provenance_at_head(const fs::path& path) {
  constexpr std::size_t kHead = 65536;
  std::string head(kHead, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return provenance_in(head, path.string());
}

/// Says in words how the inputs or the version of the run `before` differ from `now`; empty if they
/// are the same.
std::string difference(const Provenance& before, const Provenance& now) {
  const auto version = [](const Provenance& provenance) {
    const auto found = provenance.versions.find("Viscontact");
    return found == provenance.versions.end() ? std::string() : found->second;
  };
  if (version(before) != version(now))
    return fmt::format("is of Viscontact {}, this is {}", version(before), version(now));
  if (before.inputs.size() != now.inputs.size()) return "is of other input files";
  for (std::size_t i = 0; i < now.inputs.size(); ++i)
    if (now.inputs[i].sha256.empty() || before.inputs[i].sha256 != now.inputs[i].sha256)
      return fmt::format("is of another {} than the present one", now.inputs[i].file);
  return "";
}

}  // namespace

FrameTimes frame_times(const ParticlesCase& c, double first_time) {
  // Times that differ by less than 1e-6 time steps differ by rounding only.
  return {first_time, std::max(c.frame_interval, c.setting.time_step), 1e-6 * c.setting.time_step};
}

void check_same_particles(const particles::State& state, const ParticlesCase& c,
                          const fs::path& restart) {
  const auto& p = state.particles;
  const auto differs = [&](const std::string& what) {
    throw_bad_input({restart.string()},
                    fmt::format("is of other particles than {}: {}; a case that continues a "
                                "run must have the same particles in the same order",
                                c.path.string(), what));
  };
  if (p.dimension != c.particles.dimension)
    differs(fmt::format("{} dimensions, not {}", p.dimension, c.particles.dimension));
  if (p.count() != c.particles.count())
    differs(fmt::format("{}, not {}", p.count(), c.particles.count()));
  if (p.radii != c.particles.radii) differs("with other radii");
  if (p.masses != c.particles.masses) differs("with other masses");
  for (const auto& film : state.walls)
    if (static_cast<std::size_t>(-1 - film.first) >= c.setting.planes.size())
      differs(fmt::format("at plane {}, which is not there", -film.first));
}

std::optional<EarlierRun> find_earlier_run(const ParticlesCase& c, const fs::path& folder,
                                           const Provenance& provenance) {
  const auto restart = folder / "restart.bin";
  if (!fs::is_regular_file(restart)) return {};
  try {
    const auto before = provenance_at_head(restart);
    const std::string other = before ? difference(*before, provenance) : "says not of what it is";
    if (!other.empty()) {
      say(fmt::format("particles: the run in {} {}: it is replaced by one from the start",
                      folder.string(), other));
      return {};
    }
    auto state = particles::read_restart(restart);
    check_same_particles(state, c, restart);
    state.particles.ids = c.particles.ids;
    auto record = read_step_record(folder / "steps.csv", state.steps);
    ParticleFrames frames(folder, provenance, state.particles);
    frames.resume(
        frames_until(folder / "particles.pvd", state.time, frame_times(c, record.first_time)),
        c.setting);
    return EarlierRun{std::move(state), std::move(record), std::move(frames)};
  } catch (const Error& error) {
    say(
        fmt::format("particles: the run in {} cannot be gone on with ({}): it is replaced by one "
                    "from the start",
                    folder.string(), error.what()));
    return {};
  }
}

bool is_finished(const EarlierRun& run, const ParticlesCase& c, const fs::path& folder) {
  if (run.state.time < c.end_time - frame_times(c, 0).tiny) return false;
  const auto is_there = [&](const auto& name) { return fs::is_regular_file(folder / name); };
  if (!std::ranges::all_of(kParticleResults, is_there)) return false;
  try {
    // run.json is the last file that a run writes.
    const auto record = nlohmann::json::parse(read_file(folder / "run.json"));
    return record.at("to_time") == run.state.time &&
           std::ranges::all_of(particles::read_pvd(folder / "particles.pvd"), is_there,
                               &FrameFile::second);
  } catch (const std::exception&) {
    return false;  // a damaged file: the run continues and writes it again
  }
}

bool is_named_as_frame(const fs::path& path) {
  constexpr std::string_view kBegin = "particles_", kEnd = ".vtp";
  constexpr std::size_t kDigits = 5;  // smallest number of digits
  const std::string name = path.filename();
  if (!name.starts_with(kBegin) || !name.ends_with(kEnd) ||
      name.size() < kBegin.size() + kDigits + kEnd.size())
    return false;
  const auto digits =
      std::string_view(name).substr(kBegin.size(), name.size() - kBegin.size() - kEnd.size());
  return std::ranges::all_of(digits, [](char d) { return d >= '0' && d <= '9'; });
}

void remove_later_frames(const EarlierRun& run, const fs::path& folder) {
  const auto& frames = run.frames.files();
  std::vector<fs::path> later;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_named_as_frame(entry.path()) &&
        std::ranges::find(frames, entry.path().filename().string(), &FrameFile::second) ==
            frames.end())
      later.push_back(entry.path());
  for (const auto& frame : later) remove_file(frame);
}

}  // namespace viscontact
