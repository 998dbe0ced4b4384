// Recognises frames by their names, particles_NNNNN.vtp, flow_NNNNN.vtu and links_NNNNN.vtp, and
// files that Viscontact wrote by their provenance. The form of the names must agree with
// ParticleFrames.
#include "viscontact/particles/run/particles_folder.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/foreign_files.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;

/// True if the name consists of `begin`, at least five digits, and `end`.
bool is_numbered(std::string_view name, std::string_view begin, std::string_view end) {
  constexpr std::size_t kDigits = 5;
  if (!name.starts_with(begin) || !name.ends_with(end) ||
      name.size() < begin.size() + kDigits + end.size())
    return false;
  const auto digits = name.substr(begin.size(), name.size() - begin.size() - end.size());
  return std::ranges::all_of(digits, [](char d) { return d >= '0' && d <= '9'; });
}

bool is_named_as_frame(const fs::path& path) {
  const std::string name = path.filename();
  return is_numbered(name, "particles_", ".vtp") || is_numbered(name, "flow_", ".vtu") ||
         is_numbered(name, "links_", ".vtp");
}

/// The files in the folder that are named as frames.
std::vector<fs::path> frames_in(const fs::path& folder) {
  std::vector<fs::path> frames;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_named_as_frame(entry.path())) frames.push_back(entry.path());
  return frames;
}

template <class Visit>
void for_each_result(const Visit& visit) {
  for (const auto* name : kParticleResults) visit(name);
  for (const auto* name : kFluidResults) visit(name);
  for (const auto* name : kLinkResults) visit(name);
}

}  // namespace

void check_results(const fs::path& folder) {
  for_each_result(
      [&](const char* name) { results::refuse_other_kind(folder / name, "", "result"); });
  for (const auto& frame : frames_in(folder)) results::refuse_other_kind(frame, "", "result");
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
    for_each_result([&](const char* output) {
      std::error_code ignored;
      if (fs::equivalent(input, folder / output, ignored))
        throw_bad_input({input.string()}, "would be overwritten by the run's " +
                                              std::string(output) + "; choose another folder");
    });
  }
}

void remove_results(const fs::path& folder) {
  for_each_result([&](const char* name) { remove_file(folder / name); });
  remove_other_frames({}, folder);
}

void remove_other_frames(const std::vector<FrameFile>& frames, const fs::path& folder) {
  const auto belongs_to = [](const std::string& file) {
    return [&file](const FrameFile& frame) {
      return frame.second == file || flow_name(frame.second) == file ||
             links_name(frame.second) == file;
    };
  };
  for (const auto& file : frames_in(folder))
    if (std::ranges::none_of(frames, belongs_to(file.filename().string()))) remove_file(file);
}

}  // namespace viscontact::particles
