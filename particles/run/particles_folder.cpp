// Recognises the files of frames by their names, and files that Viscontact wrote by their
// provenance (particles_folder.hpp). Numbers of frames count from 0. A file of the user in the way
// is an Error(kBadInput). A change must keep that only files of Viscontact are removed.
#include "viscontact/particles/run/particles_folder.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/foreign_files.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;

/// The number of the frame whose file of this kind has that name; nothing if no frame has it.
std::optional<std::uint64_t> number_of_frame(const FrameKind& kind, std::string_view name) {
  const std::string_view begin(kind.begin);
  if (!name.starts_with(begin) || name.size() <= begin.size()) return {};
  std::uint64_t number = 0;
  std::from_chars(name.data() + begin.size() + 1, name.data() + name.size(), number);
  if (name != frame_name(kind, number)) return {};
  return number;
}

/// The files of one kind in the folder whose numbers are at least `first`.
std::vector<fs::path> frames_in(const fs::path& folder, const FrameKind& kind,
                                std::uint64_t first) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const auto number = number_of_frame(kind, entry.path().filename().string());
        number && *number >= first)
      files.push_back(entry.path());
  return files;
}

}  // namespace

std::string frame_name(const FrameKind& kind, std::uint64_t number) {
  return fmt::format("{}_{:05}{}", kind.begin, number, kind.end);
}

void check_results(const fs::path& folder) {
  for (const auto* name : kParticleResults) results::refuse_other_kind(folder / name, "", "result");
  for (const auto& kind : {kFrameFile, kFlowFile, kLinksFile})
    for (const auto& file : frames_in(folder, kind, 0))
      results::refuse_other_kind(file, "", "result");
}

void check_inputs_stay(const ParticlesCase& c, const fs::path& restart, const fs::path& folder) {
  std::error_code none;
  if (!restart.empty() && fs::equivalent(fs::absolute(restart).parent_path(), folder, none))
    throw_bad_input(
        {restart.string()},
        "belongs to the run in the output folder, whose frames and record would be lost; choose "
        "another folder, or give no restart file: the same command continues an interrupted run in "
        "its own folder");
  for (const auto& input : {c.path, c.particles_file}) {
    if (input.empty()) continue;
    for (const std::string output : kParticleResults)
      if (fs::equivalent(input, folder / output, none))
        throw_bad_input({input.string()},
                        "would be overwritten by the run's " + output + "; choose another folder");
  }
}

void remove_results(const fs::path& folder) {
  for (const auto* name : kParticleResults) remove_file(folder / name);
  remove_later_frames(folder, 0, 0);
}

void remove_later_frames(const fs::path& folder, std::uint64_t frames, std::uint64_t flows) {
  for (const auto& [kind, first] :
       {std::pair{kFrameFile, frames}, {kLinksFile, frames}, {kFlowFile, flows}})
    for (const auto& file : frames_in(folder, kind, first)) remove_file(file);
  remove_unfinished(folder);
}

}  // namespace viscontact::particles
