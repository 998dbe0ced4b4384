// Writes the files that grow while a run of many particles computes: frames (the states at the
// output times), the lists of their files, and tables. Nothing of them stays in memory. Lengths,
// masses and times are in the units of the case. A file that cannot be written, or that somebody
// else has changed, throws Error(kBadInput) with its name. Used by particles_stage.cpp and
// particles_earlier_run.cpp. A change must keep that an interrupted run that is continued from its
// record gives the same files as an uninterrupted one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "viscontact/common/vtk/flow_vtk.hpp"
#include "viscontact/particles/case/particles_case.hpp"
#include "viscontact/particles/impacts/rebound.hpp"
#include "viscontact/particles/io/link_file.hpp"
#include "viscontact/particles/run/particles_folder.hpp"
#include "viscontact/particles/state.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::particles {

/// Writes these files, and keeps a RunRecord of what has been written. Each function that writes
/// throws Error(kBadInput), which names the file, if a file cannot be written.
class RunLog {
 public:
  /// The log of a new run into `folder`. The case and `provenance` must outlive this object.
  RunLog(const ParticlesCase& c, std::filesystem::path folder,
         const results::Provenance& provenance);

  /// Throws Error(kBadInput), which names the file, if a file that an earlier run had written up to
  /// `record` is missing or has been changed since.
  void check(const RunRecord& record) const;

  /// Continues the run with this record: removes what was written after it. Throws as check() does.
  void resume(const RunRecord& record);

  /// Adds a step to the sums of the record and to steps.csv, and its blows (impacts of solids,
  /// rebound.hpp) to rebounds.csv. `state` is that at the end of the step. After a million steps
  /// (50 MB), steps.csv and probes.csv have only every thousandth step and those that did not
  /// converge; rebounds.csv has at most a million rows (80 MB). These limits are free choices.
  void add_step(const StepReport& report, const State& state, std::span<const Rebound> rebounds);

  /// Writes a frame of the state and its rows in the tables. `link_force_errors` are estimates of
  /// the errors of State::link_forces, in the same order and units; empty: not known.
  void add_frame(const State& state, std::span<const double> link_force_errors);

  /// True if the case has a fluid and the flow of the last frame has not been written yet. The flow
  /// around the particles of a frame is computed in the next step.
  bool lacks_flow() const { return case_.setting.fluid && record_.flows < record_.frames; }
  /// Writes the flow of the last frame; needs lacks_flow() (not checked).
  void add_flow(const FlowField& flow);

  /// Returns when all that was added is on the disk. Throws if the disk reports an error.
  void sync();

  /// What has been written so far, with the places at which the files end.
  RunRecord record() const;
  /// The sums of record(), in which the caller sets the computing times and memory.
  StepTotals& totals() { return record_.totals; }

 private:
  void add_file(const std::string& name, TextKind kind, const std::string& head,
                const std::string& foot = "");
  void write_frame(const FrameKind& kind, std::uint64_t number, double time,
                   const std::string& text);

  const ParticlesCase& case_;
  std::filesystem::path folder_;
  const results::Provenance& provenance_;
  std::map<std::string, GrowingFile> files_;      // by name
  std::vector<TimeTable> tables_;                 // tables that get rows with each frame
  std::vector<std::filesystem::path> unflushed_;  // files of frames that may not be on the disk yet
  RunRecord record_;                              // without RunRecord::files, which record() adds
};

}  // namespace viscontact::particles
