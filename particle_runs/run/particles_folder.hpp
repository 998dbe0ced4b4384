// Names, replacement and removal of the files in the folder of a run (docs/file-formats.md), the
// sums over its steps, and the record in restart.bin.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "viscontact/common/files/growing_file.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/particle_runs/run/particle_regime.hpp"
#include "viscontact/particle_runs/run/rheology_means.hpp"
#include "viscontact/particles/state/state.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// The names of all files that a run may have, except those of its frames, in the order in which
/// they are removed. restart.bin is the first, because no run continues without it.
inline constexpr auto kParticleResults = std::to_array<const char*>(
    {"restart.bin",   "particles.pvd", "particles.html",      "particles.svg",
     "run.json",      "steps.csv",     "final_particles.csv", "final_contacts.csv",
     "motion.csv",    "contacts.csv",  "walls.csv",           "stress.csv",
     "flow.pvd",      "bodies.csv",    "hinges.csv",          "springs.csv",
     "arms.csv",      "membranes.csv", "links.pvd",           "rebounds.csv",
     "probes.csv",    "particles.h5",  "planes.csv",          "particles.pdf",
     "particles.xyz", "rheology.csv",  "rheology.svg",        "pair_distribution.csv"});

/// A kind of file of which each frame (output time) has one, named `begin`_NUMBER`end`.
struct FrameKind {
  const char* begin;  ///< with ".pvd" it is also the name of the list of these files
  const char* end;    ///< extension, with the dot
};
/// Particles and contacts, the flow, and the links of a frame.
inline constexpr FrameKind kFrameFile{"particles", ".vtp"}, kFlowFile{"flow", ".vtu"},
    kLinksFile{"links", ".vtp"};

/// The name of a file, such as particles_00000.vtp. `number` counts from 0; it has at least five
/// digits.
std::string frame_name(const FrameKind& kind, std::uint64_t number);

/// Throws Error(kBadInput) if a file in the folder has the name of a result or of a frame, but
/// Viscontact did not write it. If the folder does not exist, this function, remove_results() and
/// remove_later_frames() throw std::filesystem::filesystem_error.
void check_results(const std::filesystem::path& folder);

/// Throws Error(kBadInput) if a run into `folder` would overwrite one of its inputs: the case, its
/// file of particles, or the file at the path `restart`, which may be empty.
void check_inputs_stay(const ParticlesCase& c, const std::filesystem::path& restart,
                       const std::filesystem::path& folder);

/// Removes all results and frames, so that the folder never has files of two runs. The function
/// goes by names alone, so check_results() must be called before. Throws Error(kBadInput), which
/// names the file, if a file cannot be removed.
void remove_results(const std::filesystem::path& folder);

/// Removes the files of all frames but the first `frames`, the flows of all but the first `flows`,
/// and files that a killed process has not finished. Like remove_results() it goes by names alone.
/// Throws Error(kBadInput), which names the file, if a file cannot be removed.
void remove_later_frames(const std::filesystem::path& folder, std::uint64_t frames,
                         std::uint64_t flows);

/// The largest factor (StepReport::excess) by which a step may miss the tolerances and still count
/// as a result, with a warning. If a step misses them by more, the command ends with an error.
inline constexpr double kStillAResult = 10;

/// Sums and largest values over the steps of a run, including the earlier calls that it continues.
struct StepTotals {
  /// Numbers of steps, of steps that did not converge, and of iterations of all steps.
  std::int64_t steps = 0, unconverged = 0, iterations = 0;
  /// Number of `unconverged` steps whose StepReport::excess is above kStillAResult.
  std::int64_t failed = 0;
  int most_iterations = 0;               ///< in a step
  double first_time = 0, last_time = 0;  ///< times at the start and after the last step [T]
  /// Largest residual of a step and largest overlap, in mean radii [1].
  double largest_residual = 0, largest_overlap = 0;
  double largest_impulse_residual = 0;  ///< largest StepReport::impulse_residual [1]
  std::int64_t divided = 0;             ///< number of steps that were divided into parts
  std::int64_t unresolved = 0;          ///< sum of StepReport::unresolved
  std::int64_t buckling = 0;            ///< number of steps with StepReport::buckling > 1
  double largest_buckling = 0;          ///< the largest StepReport::buckling [1]
  double first_buckling = 0;            ///< the first StepReport::buckling > 1 [1], or 0
  std::int64_t lacks_springs = 0;       ///< number of steps with StepReport::lacks_springs
  std::int64_t given_loads = 0;         ///< number of steps with StepReport::has_given_loads
  /// Computing time of earlier calls [s]. In a saved record it includes the call that saved it.
  double seconds = 0;
  /// Largest memory of earlier calls [MiB]. In a saved record it includes the call that saved it.
  double peak_memory_mebibytes = 0;
  ParticleRegime regime;
  // The following members are used in a fluid only.
  double fluid_seconds = 0;  ///< sum of FluidStepReport::seconds [s]
  /// Number of steps with an advection_error above kNamedAdvectionError, and the largest one [1].
  std::int64_t advection_errors = 0;
  double largest_advection_error = 0;
  std::uint64_t unknowns = 0;  ///< of the fluid solver in the last step
  /// Estimates of the relative errors [1] of velocities and forces, at the first and at the last
  /// step at which they were estimated; < 0 if they were not estimated.
  RelativeErrors first_velocity_errors, last_velocity_errors;
  RelativeErrors first_force_errors, last_force_errors;

  double averaged_time = 0;  ///< time over which the next two means are taken [T]; 0: no means
  /// Means over time of FluidStepReport::dissipation [M L^2/T^3], in two dimensions [M L/T^3], and
  /// FluidStepReport::apparent_viscosity [1], whose values are taken as constant over their step.
  double mean_dissipation = 0, mean_apparent_viscosity = 0;

  double contact_time = 0;            ///< time over which contact_means are taken [T]
  std::vector<double> contact_means;  ///< means over time of the values of add_means()

  RheologyMeans rheology;  ///< with lubrication

  std::int64_t jammed = 0;    ///< number of steps in which a packing jams, see add()
  double first_jam = 0;       ///< time at the end of the first of these steps [T]
  std::string jammed_bodies;  ///< StepReport::pressing of that step
  double given_load = 0;      ///< StepReport::given_load of the last step [M L/T^2]
  int growing = 0;            ///< number of last steps in which it grew fast

  /// Adds a step, which must end after the steps before. The means begin at the time `average_from`
  /// [T]. A packing jams in a step with StepReport::jams, and in one in which bodies with given
  /// motions push and the load on them has grown by a factor of 1.5 in each of ten steps.
  void add(const StepReport& report, double average_from);
  /// Adds the values of a step that has lasted `duration` [T] to contact_means; always equally
  /// many.
  void add_means(const std::vector<double>& values, double duration);
};

/// What a run has done until a state.
struct RunRecord {
  StepTotals totals;
  std::uint64_t frames = 0, flows = 0;   ///< numbers of frames, and of frames whose flow is written
  double last_frame = 0;                 ///< time of the last frame [T]; 0 without a frame
  std::uint64_t rebounds = 0;            ///< rows of rebounds.csv
  std::map<std::string, FileEnd> files;  ///< for the name of each growing file where it ends
};

/// The comment line of restart.bin that contains the record after the step with the number `step`.
std::string record_comment(const RunRecord& record, std::int64_t step);
/// Reads the line of record_comment() from `head`, the first lines of the file `restart`. Throws
/// Error(kBadInput), which names the file, if it has no such line or the line is damaged.
RunRecord read_record(const std::string& head, const std::filesystem::path& restart);

/// The text of run.json at the end of a run: one JSON object (docs/file-formats.md) with the
/// numbers of StepTotals in their units. A number that is not known is null.
std::string run_json(const ParticlesCase& c, const StepTotals& totals, const State& state);

}  // namespace viscontact::particles
