// Frames as VTK, their lists as PVD, tables as CSV; a run is continued at the ends of its files.
#include "viscontact/particle_runs/run/run_log.hpp"

#include <algorithm>
#include <cassert>
#include <fstream>
#include <string_view>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/particle_runs/io/contact_file.hpp"
#include "viscontact/particle_runs/io/rheology_file.hpp"
#include "viscontact/particle_runs/io/step_columns.hpp"
#include "viscontact/particle_runs/io/vtk.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;

/// Free choices of the lengths of the tables, which stay below 50 MB and 80 MB.
struct RunLogTuning {
  // After kMostRows steps, only one step in kOneIn has a row, and each step that has not converged.
  static constexpr std::int64_t kMostRows = 1000000, kOneIn = 1000;
  // Later rebounds have no rows.
  static constexpr std::uint64_t kMostRebounds = 1000000;
};

/// Throws Error(kBadInput), which names the file, if one of the first `count` files of a kind is
/// missing or does not end as an XML file of VTK must end.
void check_frames(const fs::path& folder, const FrameKind& kind, std::uint64_t count) {
  constexpr std::string_view kEnd = "</VTKFile>\n";
  for (std::uint64_t number = 0; number < count; ++number) {
    const auto path = folder / frame_name(kind, number);
    std::ifstream file(path, std::ios::binary);
    std::string end(kEnd.size(), '\0');
    file.seekg(-std::ssize(kEnd), std::ios::end).read(end.data(), std::ssize(end));
    if (!file || end != kEnd) throw_bad_input({path.string()}, "is missing or cut short");
  }
}

/// The values of which run.json has the means: the stress if there is a domain, the forces on
/// obstacles, and without a fluid the forces and torques on particles whose motion is given.
std::vector<double> values_to_average(const Setting& setting, const State& state) {
  std::vector<double> values;
  if (!std::holds_alternative<std::monostate>(setting.domain))
    values = contact_stress(setting, state);
  const auto n = static_cast<std::ptrdiff_t>(state.particles.dimension);
  for (const auto& force : wall_forces(setting, state))
    values.insert(values.end(), force.begin(), force.begin() + n);
  for (const auto& load : state.given_loads) {
    values.insert(values.end(), load.force.begin(), load.force.begin() + n);
    values.insert(values.end(), load.torque.begin() + (n == 3 ? 0 : 2), load.torque.end());
  }
  return values;
}

/// The name of the list of the files of a kind, such as particles.pvd.
std::string list_of(const FrameKind& kind) { return std::string(kind.begin) + ".pvd"; }

}  // namespace

RunLog::RunLog(const ParticlesCase& c, fs::path folder, const results::Provenance& provenance)
    : case_(c), folder_(std::move(folder)), provenance_(provenance) {
  const auto add_list = [&](const FrameKind& kind) {
    add_file(list_of(kind), TextKind::kXml, std::string(kPvdHead), kPvdFoot);
  };
  add_list(kFrameFile);
  add_file("steps.csv", TextKind::kHashComment, steps_header(c.setting.fluid, c.step_columns));
  if (c.setting.laws.restitution.is_on())
    add_file("rebounds.csv", TextKind::kHashComment, rebounds_header());
  if (c.setting.lubrication) add_file(kRheologyFile, TextKind::kHashComment, rheology_header());
  if (!c.setting.links.empty()) add_list(kLinksFile);
  if (c.setting.fluid) add_list(kFlowFile);
  if (c.setting.fluid && !c.setting.fluid->probes.empty())
    add_file("probes.csv", TextKind::kHashComment, probes_header());
  for (const auto& tables :
       {time_tables(c.setting, c.particles), asked_tables(c.setting, c.particles, c.tables)})
    for (const auto& table : tables) {
      add_file(table.name, TextKind::kHashComment, table.header);
      tables_.push_back(table);
    }
}

void RunLog::add_file(const std::string& name, TextKind kind, const std::string& head,
                      const std::string& foot) {
  const auto path = folder_ / name;
  files_.try_emplace(name, path, results::output_text(path, kind, head, provenance_), foot);
}

void RunLog::check(const RunRecord& record) const {
  for (const auto& [name, file] : files_) {
    const auto end = record.files.find(name);
    file.check(end == record.files.end() ? FileEnd{} : end->second);
  }
  check_frames(folder_, kFrameFile, record.frames);
  check_frames(folder_, kLinksFile, case_.setting.links.empty() ? 0 : record.frames);
  check_frames(folder_, kFlowFile, record.flows);
}

void RunLog::resume(const RunRecord& record) {
  check(record);
  record_ = record;
  record_.files.clear();
  remove_later_frames(folder_, record.frames, record.flows);
  for (auto& [name, file] : files_) file.resume(record.files.at(name));
}

void RunLog::add_step(const StepReport& report, const State& state,
                      std::span<const Rebound> rebounds) {
  assert(rebounds.empty() || case_.setting.laws.restitution.is_on());
  const double duration = report.time - std::max(record_.totals.last_time, case_.average_from);
  if (case_.average_from_given && duration > 0)
    record_.totals.add_means(values_to_average(case_.setting, state), duration);
  step_began_ = record_.totals.last_time;
  record_.totals.add(report, case_.average_from);
  record_.totals.regime.add(case_, state, report.glued > 0);
  const auto steps = record_.totals.steps;
  has_row_ =
      steps <= RunLogTuning::kMostRows || steps % RunLogTuning::kOneIn == 0 || !report.converged;
  if (has_row_) {
    files_.at("steps.csv")
        .append(step_row(state.steps, report, case_.setting.fluid, case_.step_columns));
    if (!report.fluid.probes.empty())
      files_.at("probes.csv").append(probe_rows(report.fluid, case_.setting.fluid->probes));
  }
  const auto more =
      rebounds.first(std::min(rebounds.size(), RunLogTuning::kMostRebounds - record_.rebounds));
  if (more.empty()) return;
  files_.at("rebounds.csv").append(rebound_rows(state.particles, more));
  record_.rebounds += more.size();
}

void RunLog::add_rheology(const Rheology& rheology) {
  record_.totals.rheology.add(rheology, step_began_, rheology.time, case_.average_from,
                              case_.end_time);
  if (has_row_) files_.at(kRheologyFile).append(rheology_row(rheology));
}

void RunLog::add_frame(const State& state, std::span<const double> link_force_errors) {
  const auto& setting = case_.setting;
  const auto contacts = contacts_of(setting, state);
  const auto write = [&](const FrameKind& kind, const std::string& text) {
    write_frame(kind, record_.frames, state.time, text);
  };
  write(kFrameFile, write_vtp(state.particles, contacts, setting.laws.friction.has_value()));
  if (!setting.links.empty()) write(kLinksFile, write_links(setting, state));
  for (const auto& table : tables_)
    files_.at(table.name).append(table.rows(setting, state, link_force_errors));
  ++record_.frames;
  record_.last_frame = state.time;
}

void RunLog::add_flow(const FlowField& flow) {
  assert(lacks_flow());
  write_frame(kFlowFile, record_.frames - 1, record_.last_frame,
              write_flow(flow, case_.particles.dimension == 1));
  record_.flows = record_.frames;
}

void RunLog::write_frame(const FrameKind& kind, std::uint64_t number, double time,
                         const std::string& text) {
  const auto name = frame_name(kind, number);
  const auto path = folder_ / name;
  write_unflushed(path, results::output_text(path, TextKind::kXml, text, provenance_));
  unflushed_.push_back(path);
  files_.at(list_of(kind)).append(pvd_line(time, name));
}

void RunLog::sync() {
  flush_files(unflushed_);
  unflushed_.clear();
  for (auto& [name, file] : files_) file.sync();
}

RunRecord RunLog::record() const {
  auto record = record_;
  for (const auto& [name, file] : files_) record.files[name] = file.end();
  return record;
}

}  // namespace viscontact::particles
