// Files that grow while a run of many particles computes: frames, their lists, and tables.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "viscontact/common/vtk/flow_vtk.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/particle_runs/io/link_file.hpp"
#include "viscontact/particle_runs/run/particles_folder.hpp"
#include "viscontact/particles/state/rebound.hpp"
#include "viscontact/particles/state/state.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::particles {

/// Writes the frames, lists and tables of a run, and keeps a RunRecord of what has been written.
/// Rows and frames are not kept in memory. Each function that writes throws Error(kBadInput), which
/// names the file, if a file cannot be written. A run that is continued from its record gives the
/// same files as an uninterrupted one. Lengths, masses and times are in the units of the case;
/// impulses and forces of discs in a fluid are per length.
class RunLog {
 public:
  /// Makes the log of a new run into `folder`, and writes no file yet. The case and `provenance`,
  /// the record of inputs and command that each file gets, must outlive this object.
  RunLog(const ParticlesCase& c, std::filesystem::path folder,
         const results::Provenance& provenance);

  /// Throws Error(kBadInput), which names the file, if a file that an earlier run had written up to
  /// `record` is missing or has been changed since.
  void check(const RunRecord& record) const;

  /// Continues the run with this record: removes what was written after it. Throws the errors of
  /// check(), and Error(kBadInput) if a file cannot be removed or shortened.
  void resume(const RunRecord& record);

  /// Adds a step to the sums of the record and to steps.csv and probes.csv, and the impacts of
  /// solids in the step, `rebounds`, to rebounds.csv. `rebounds` must be empty if the case has no
  /// restitution. `state` is that at the end of the step. After a million steps (50 MB), steps.csv
  /// and probes.csv have only every thousandth step and those that did not converge; rebounds.csv
  /// has at most a million rows (80 MB).
  void add_step(const StepReport& report, const State& state, std::span<const Rebound> rebounds);

  /// Adds the rheology of the step that add_step() added last to rheology.csv and to the means, or
  /// that of the start before any step. rheology.csv has rows of the same steps as steps.csv. The
  /// case must have lubrication.
  void add_rheology(const Rheology& rheology);

  /// Writes a frame of the state, and the rows of the state in the tables. `link_force_errors` are
  /// estimates of the errors of State::link_forces, in the same order and units; empty if they are
  /// not known.
  void add_frame(const State& state, std::span<const double> link_force_errors);

  /// True if the case has a fluid and the flow of the last frame has not been written yet: the next
  /// step computes it.
  bool lacks_flow() const { return case_.setting.fluid && record_.flows < record_.frames; }
  /// Writes the flow of the last frame; lacks_flow() must be true.
  void add_flow(const FlowField& flow);

  /// Returns when all that was added is on the disk.
  void sync();

  RunRecord record() const;
  /// The sums over the steps in record(). The caller sets the computing times [s] and the memory
  /// [MiB] in them.
  StepTotals& totals() { return record_.totals; }

 private:
  /// Adds a file that grows between `head` and `foot`, a text that stays at its end.
  void add_file(const std::string& name, TextKind kind, const std::string& head,
                const std::string& foot = "");
  /// Writes a file and adds it to its list at `time` [T]. It may not be on the disk before sync().
  void write_frame(const FrameKind& kind, std::uint64_t number, double time,
                   const std::string& text);

  const ParticlesCase& case_;
  std::filesystem::path folder_;
  const results::Provenance& provenance_;
  std::map<std::string, GrowingFile> files_;      // the key is the file's name
  std::vector<TimeTable> tables_;                 // those that get rows with each frame
  std::vector<std::filesystem::path> unflushed_;  // files of frames that may not be on the disk yet
  RunRecord record_;                              // its `files` are empty; record() adds them
  double step_began_ = 0;                         // time at the start of the last step [T]
  bool has_row_ = true;                           // whether the last step has a row in steps.csv
};

}  // namespace viscontact::particles
