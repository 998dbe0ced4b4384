// Writes frames (VTK), keeps some of them for the page and the picture, and reads frames again. A
// run that continues must keep the same frames as one that was not interrupted (every_).
#include "viscontact/particles/run/particles_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/common/vtk/flow_vtk.hpp"
#include "viscontact/particles/current_contacts.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/io/link_vtk.hpp"
#include "viscontact/particles/io/particle_file.hpp"
#include "viscontact/particles/io/vtk.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;

/// A frame of `motion`, which has positions, angles and orientations.
Frame frame_at(double time, const Setting& setting, const auto& motion,
               std::vector<CurrentContact> contacts) {
  Frame frame;
  frame.time = time;
  frame.positions.assign(motion.positions.begin(), motion.positions.end());
  frame.angles.assign(motion.angles.begin(), motion.angles.end());
  frame.orientations.assign(motion.orientations.begin(), motion.orientations.end());
  frame.planes = positions_of(obstacles_of(setting), time);
  frame.contacts = std::move(contacts);
  return frame;
}

/// Another name with the number of the frame in the file `frame`, particles_NNNNN.vtp.
std::string named_as(const std::string& frame, std::string_view begin, std::string_view end) {
  constexpr std::string_view kBegin = "particles", kEnd = ".vtp";
  return std::string(begin) +
         frame.substr(kBegin.size(), frame.size() - kBegin.size() - kEnd.size()) + std::string(end);
}

void check_exists(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw_bad_input({file.string()}, "is missing");
}

}  // namespace

double FrameTimes::after(double time) const {
  return first + (std::floor((time + tiny - first) / interval) + 1) * interval;
}

ParticleFrames::ParticleFrames(fs::path folder, const results::Provenance& provenance,
                               const Setting& setting, const Particles& particles)
    : folder_(std::move(folder)),
      provenance_(provenance),
      has_links_(!setting.links.empty()),
      has_rebounds_(setting.laws.restitution.is_on()),
      tables_(time_tables(setting, particles)),
      table_rows_(tables_.size()) {
  playback_.dimension = particles.dimension;
  playback_.radii.assign(particles.radii.begin(), particles.radii.end());
  playback_.ids = particles.ids;
  playback_.bodies = particles.bodies.of_particle;
  playback_.has_friction = setting.laws.friction.has_value();
  for (const auto& hinge : setting.links.hinges) playback_.links.hinges.push_back(hinge.at);
  for (const auto& spring : setting.links.springs)
    playback_.links.springs.push_back({spring.first, spring.second});
  for (const auto& arm : setting.links.arms)
    playback_.links.arms.push_back({arm.first, arm.second});
}

std::string flow_name(const std::string& frame) { return named_as(frame, "flow", ".vtu"); }

std::string links_name(const std::string& frame) { return named_as(frame, "links", ".vtp"); }

void ParticleFrames::add(const Setting& setting, const State& state,
                         std::span<const double> link_force_errors) {
  playback_.cell = cell_of(setting);
  auto contacts = contacts_of(setting, state);
  const auto name = fmt::format("particles_{:05}.vtp", files_.size());
  results::write_output(folder_ / name, TextKind::kXml,
                        write_vtp(state.particles, contacts, setting.laws.friction.has_value()),
                        provenance_);
  if (has_links_)
    results::write_output(folder_ / links_name(name), TextKind::kXml, write_links(setting, state),
                          provenance_);
  files_.emplace_back(state.time, name);
  if (setting.fluid) {
    if (motion_.empty()) motion_ = motion_header(playback_.dimension);
    motion_ += motion_rows(state.time, state.particles);
    add_contact_rows(state.time, contacts);
  }
  for (std::size_t t = 0; t < tables_.size(); ++t)
    table_rows_[t] += tables_[t].rows(setting, state, link_force_errors);
  if ((files_.size() - 1) % every_ == 0)
    keep(frame_at(state.time, setting, state.particles, std::move(contacts)));
}

void ParticleFrames::add_rebounds(const Particles& particles, std::span<const Rebound> rebounds) {
  constexpr std::size_t kMostRows = 1000000;
  const auto more = rebounds.first(std::min(rebounds.size(), kMostRows - rebound_count_));
  rebounds_ += rebound_rows(particles, more);
  rebound_count_ += more.size();
}

void ParticleFrames::add_flow(const particles::FlowField& flow) {
  const auto name = flow_name(files_.back().second);
  results::write_output(folder_ / name, TextKind::kXml, write_flow(flow, playback_.dimension == 1),
                        provenance_);
  flows_.emplace_back(files_.back().first, name);
  show_flow(flows_.back());
}

void ParticleFrames::show_flow(const FrameFile& flow) {
  const auto frame = std::ranges::find(playback_.frames, flow.first, &Frame::time);
  if (frame != playback_.frames.end()) frame->flow = folder_ / flow.second;
}

void ParticleFrames::add_contact_rows(double time, const std::vector<CurrentContact>& contacts) {
  if (contacts_.empty()) contacts_ = contacts_header();
  Particles named;  // only the ids are needed
  named.ids = playback_.ids;
  contacts_ += contact_rows(time, named, contacts);
}

void ParticleFrames::resume_fluid(double time) {
  // The flow of a frame at the present time belongs to the next step.
  for (const auto& [frame_time, name] : files_)
    if (frame_time < time) flows_.emplace_back(frame_time, flow_name(name));
  for (const auto& flow : flows_) {
    check_exists(folder_ / flow.second);
    show_flow(flow);
  }
  motion_ = motion_header(playback_.dimension) + earlier_rows("motion.csv", playback_.radii.size());
}

/// The rows of a table whose first column is a time, until `time` [T], without the header.
std::string ParticleFrames::rows_until(const fs::path& table, double time) {
  std::istringstream lines(results::without_provenance(read_file(table)));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    const auto row_time = parse_number(line.substr(0, line.find(',')));
    if (!row_time) continue;
    if (*row_time > time) break;
    text += line + "\n";
  }
  return text;
}

/// The rows of a table until the last frame, of which each frame has `rows_per_frame`. The file may
/// have rows of later frames, because it is written before restart.bin.
std::string ParticleFrames::earlier_rows(const std::string& name,
                                         std::size_t rows_per_frame) const {
  const auto path = folder_ / name;
  auto text = rows_until(path, files_.back().first);
  if (static_cast<std::size_t>(std::ranges::count(text, '\n')) != files_.size() * rows_per_frame)
    throw_bad_input({path.string()},
                    fmt::format("does not have {} rows for each frame", rows_per_frame));
  return text;
}

std::vector<FrameFile> ParticleFrames::links() const {
  std::vector<FrameFile> links;
  if (has_links_)
    for (const auto& [time, name] : files_) links.emplace_back(time, links_name(name));
  return links;
}

std::vector<std::pair<std::string, std::string>> ParticleFrames::tables() const {
  std::vector<std::pair<std::string, std::string>> texts;
  for (std::size_t t = 0; t < tables_.size(); ++t)
    texts.emplace_back(tables_[t].name, tables_[t].header + table_rows_[t]);
  if (has_rebounds_) texts.emplace_back("rebounds.csv", particles::kReboundsHeader + rebounds_);
  return texts;
}

/// Reads a frame that is there. The last frame is always kept.
void ParticleFrames::read_frame(const FrameFile& file, const Setting& setting, bool is_last) {
  files_.push_back(file);
  // Frames that are not kept are read, too, to check that their files exist and are complete.
  auto content = read_vtp(folder_ / file.second, playback_.dimension);
  if (content.positions.size() !=
      playback_.radii.size() * static_cast<std::size_t>(playback_.dimension))
    throw_bad_input({(folder_ / file.second).string()}, "is a frame of other particles");
  if (setting.fluid) add_contact_rows(file.first, content.contacts);
  if (is_last || (files_.size() - 1) % every_ == 0)
    keep(frame_at(file.first, setting, content, std::move(content.contacts)));
}

void ParticleFrames::read_all(const Setting& setting) {
  playback_.cell = cell_of(setting);
  const auto files = read_pvd(folder_ / "particles.pvd");
  if (files.empty()) throw_bad_input({(folder_ / "particles.pvd").string()}, "has no frame");
  for (const auto& file : files) read_frame(file, setting, &file == &files.back());
  if (setting.fluid)
    for (const auto& flow : read_pvd(folder_ / "flow.pvd")) show_flow(flow);
}

void ParticleFrames::resume(const std::vector<FrameFile>& files, const Setting& setting,
                            double time) {
  playback_.cell = cell_of(setting);
  for (const auto& file : files) read_frame(file, setting, false);
  for (const auto& links : links()) check_exists(folder_ / links.second);
  if (setting.fluid) resume_fluid(time);
  for (std::size_t t = 0; t < tables_.size(); ++t)
    table_rows_[t] = earlier_rows(tables_[t].name, tables_[t].count);
  if (has_rebounds_) rebounds_ = rows_until(folder_ / "rebounds.csv", time);
  rebound_count_ = static_cast<std::size_t>(std::ranges::count(rebounds_, '\n'));
}

void ParticleFrames::end(const Setting& setting, const State& state,
                         std::span<const double> link_force_errors) {
  if (files_.empty()) return;  // writing the first frame failed
  if (files_.back().first < state.time) add(setting, state, link_force_errors);
  if (playback_.frames.back().time < state.time)
    keep(frame_at(state.time, setting, state.particles, contacts_of(setting, state)));
}

void ParticleFrames::keep(Frame frame) {
  kept_bytes_ +=
      frame.positions.size() * sizeof(float) + frame.contacts.size() * sizeof(CurrentContact);
  playback_.frames.push_back(std::move(frame));
  // A page cannot show 256 MiB, so beyond this size every second frame is dropped.
  constexpr std::size_t kMostBytes = std::size_t{256} << 20U;
  if (kept_bytes_ > kMostBytes && playback_.frames.size() > 4) {
    std::vector<Frame> half;
    for (std::size_t i = 0; i < playback_.frames.size(); i += 2)
      half.push_back(std::move(playback_.frames[i]));
    playback_.frames = std::move(half);
    kept_bytes_ /= 2;
    every_ *= 2;
  }
}

std::vector<FrameFile> frames_until(const fs::path& pvd, double time, const FrameTimes& times) {
  auto files = read_pvd(pvd);
  std::erase_if(files, [&](const FrameFile& file) { return file.first > time + times.tiny; });
  if (files.size() > 1 &&
      files.back().first < times.after(files[files.size() - 2].first) - times.tiny)
    files.pop_back();
  if (files.empty()) throw_bad_input({pvd.string()}, "has no frame");
  return files;
}

}  // namespace viscontact::particles
