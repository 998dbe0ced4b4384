// Recognises frames by their name, particles_NNNNN.vtp, and files that Viscontact wrote by their
// provenance. The form of the name must agree with ParticleFrames::add.
#include "viscontact/pipeline/particles/particles_folder.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/foreign_files.hpp"

namespace viscontact::pipeline {
namespace {

namespace fs = std::filesystem;

/// True for a file name of the form particles_NNNNN.vtp.
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

/// The files in the folder that are named as frames.
std::vector<fs::path> frames_in(const fs::path& folder) {
  std::vector<fs::path> frames;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_named_as_frame(entry.path())) frames.push_back(entry.path());
  return frames;
}

}  // namespace

void check_results(const fs::path& folder) {
  for (const auto* name : kParticleResults) results::refuse_other_kind(folder / name, "", "result");
  for (const auto& frame : frames_in(folder)) results::refuse_other_kind(frame, "", "result");
}

void check_inputs_stay(const case_file::ParticlesCase& c, const fs::path& restart,
                       const fs::path& folder) {
  std::error_code none;
  if (!restart.empty() && fs::equivalent(fs::absolute(restart).parent_path(), folder, none))
    throw_bad_input(
        {restart.string()},
        "belongs to the run in the output folder, whose frames and record would be lost; choose "
        "another folder, or give no restart file: the same command continues an interrupted run in "
        "its own folder");
  for (const auto& input : {c.path, c.particles_file}) {
    if (input.empty()) continue;
    for (const auto* output : kParticleResults) {
      std::error_code ignored;
      if (fs::equivalent(input, folder / output, ignored))
        throw_bad_input({input.string()}, "would be overwritten by the run's " +
                                              std::string(output) + "; choose another folder");
    }
  }
}

void remove_results(const fs::path& folder) {
  for (const auto* name : kParticleResults) remove_file(folder / name);
  remove_other_frames({}, folder);
}

void remove_other_frames(const std::vector<FrameFile>& frames, const fs::path& folder) {
  for (const auto& file : frames_in(folder))
    if (std::ranges::find(frames, file.filename().string(), &FrameFile::second) == frames.end())
      remove_file(file);
}

}  // namespace viscontact::pipeline
