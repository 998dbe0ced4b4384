// What a run of many particles writes while it computes: frames, the lists of their files, and
// tables. Nothing of it stays in memory. Lengths, masses and times are in the units of the case.
// Used by particles_stage.cpp and particles_earlier_run.cpp. A change must keep that an interrupted
// run, when it is continued from its record, gives the same files as an uninterrupted one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/vtk/flow_vtk.hpp"
#include "viscontact/particles/case/particles_case.hpp"
#include "viscontact/particles/impacts/rebound.hpp"
#include "viscontact/particles/io/link_file.hpp"
#include "viscontact/particles/run/particles_folder.hpp"
#include "viscontact/particles/state.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::particles {

/// Writes the files of a run. Its record says what has been written (RunRecord). All functions that
/// write throw Error(kBadInput), which names the file, if it cannot be written.
class RunLog {
 public:
  /// A run from the start into `folder`. The case and `provenance` must outlive this object.
  RunLog(const ParticlesCase& c, std::filesystem::path folder,
         const results::Provenance& provenance);

  /// Throws Error(kBadInput), which names the file, if a file that an earlier run had written up to
  /// this record is missing or has been changed since.
  void check(const RunRecord& record) const;

  /// Continues the run that had this record: removes what was written after the record. Throws the
  /// errors of check().
  void resume(const RunRecord& record);

  /// Adds a step to the sums of the record and to steps.csv, and its blows (rebound.hpp) to
  /// rebounds.csv. `state` is that at the end of the step. After a million steps, steps.csv lists
  /// only every thousandth step and those that did not converge; rebounds.csv has at most a million
  /// rows, which are 80 MB.
  void add_step(const StepReport& report, const State& state, std::span<const Rebound> rebounds);

  /// Writes a frame of the state and its rows in the tables. `link_force_errors` are estimates of
  /// the errors of State::link_forces, as many and in the same units; empty: not known.
  void add_frame(const State& state, std::span<const double> link_force_errors);

  /// True if the flow of the last frame has not been written. The flow around the particles of a
  /// frame is known only in the next step.
  bool lacks_flow() const { return case_.setting.fluid && record_.flows < record_.frames; }
  /// Writes the flow of the last frame.
  void add_flow(const FlowField& flow);

  /// Returns when everything is on disk that has been added.
  void sync();

  /// What has been written so far, with the ends of the files.
  RunRecord record() const;
  /// The sums of record(). The caller adds computing times and memory.
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
  std::vector<std::filesystem::path> unflushed_;  // files of frames, not yet on disk
  RunRecord record_;                              // RunRecord::files is empty here
};

}  // namespace viscontact::particles
