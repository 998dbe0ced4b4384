// What a run of many particles writes while it computes: frames, the lists of their files, and
// tables. Nothing of it stays in memory. Lengths, masses and times are in the units of the case.
// particles_stage.cpp writes by it. A change must keep that a record continues its files exactly.
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

/// Writes the files of a run, and knows what has been written (record()). All functions that write
/// throw Error(kBadInput), which names the file, if it cannot be written.
class RunLog {
 public:
  /// A run from the start into `folder`. The case and `provenance` must outlive this object.
  RunLog(const ParticlesCase& c, std::filesystem::path folder,
         const results::Provenance& provenance);

  /// Throws Error(kBadInput), which names the file, if a file that an earlier run had written when
  /// it had this record is missing or has been changed.
  void check(const RunRecord& record) const;

  /// Continues the run that had this record: removes what it wrote later. Errors as check().
  void resume(const RunRecord& record);

  /// Adds the last step, which ended in this state and had these blows, to the sums, to steps.csv
  /// and to rebounds.csv. After a million steps, steps.csv lists only every thousandth step and
  /// those that did not converge; rebounds.csv has at most a million rows, which are 80 MB.
  void add_step(const StepReport& report, const State& state, std::span<const Rebound> rebounds);

  /// Writes a frame of the state and its rows in the tables. `link_force_errors` are those of
  /// State::link_forces, empty if they are not known.
  void add_frame(const State& state, std::span<const double> link_force_errors);

  /// True if the flow of the last frame has not been written. The flow around the particles of a
  /// frame is known only in the next step.
  bool lacks_flow() const { return case_.setting.fluid && record_.flows < record_.frames; }
  /// Writes the flow of the last frame.
  void add_flow(const FlowField& flow);

  /// Returns when everything is on disk that has been added.
  void sync();

  /// What has been added. The caller counts costs in the sums.
  RunRecord record() const;
  StepTotals& totals() { return record_.totals; }  ///< the sums of record()

 private:
  void add_file(const std::string& name, TextKind kind, const std::string& head,
                const std::string& foot = "");
  void write_frame(const FrameKind& kind, std::uint64_t number, double time,
                   const std::string& text);

  const ParticlesCase& case_;
  std::filesystem::path folder_;
  const results::Provenance& provenance_;
  std::map<std::string, GrowingFile> files_;      // by name
  std::vector<TimeTable> tables_;                 // those with rows of each frame
  std::vector<std::filesystem::path> unflushed_;  // files of frames that may not be on disk
  RunRecord record_;                              // without ends of files
};

}  // namespace viscontact::particles
