// A sweep over a case of many particles: the case is run at each point of a grid, at each point
// with several random arrangements if draws are asked for, and each run gives a row of results
// (docs/file-formats.md). Lengths, masses and times are in the units of the case. A change of the
// columns must keep their names, because scripts of users read them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/case_file/particles/particles_case.hpp"
#include "viscontact/common/stop_token.hpp"
#include "viscontact/sweep/rows.hpp"
#include "viscontact/sweep/variation.hpp"

namespace viscontact::sweep {

/// What is run in a sweep of particles.
struct ParticlesSweepPlan {
  std::filesystem::path case_path;    ///< the case file that is varied
  std::vector<Variation> variations;  ///< may be empty if there are draws
  std::uint64_t samples = 0;          ///< number of random points; 0: the whole grid
  std::uint64_t seed = 1;             ///< seed of the random points
  /// Number of arrangements at each point, the seeds of which are those of the case and the
  /// following numbers; 0: the arrangement of the case alone.
  std::uint64_t draws = 0;
};

/// The plan of the section [sweep] of a case of particles. Throws Error(kBadInput) if the case is
/// wrong or a range in [sweep] is not valid.
ParticlesSweepPlan planned_particles(const std::filesystem::path& case_path);

/// The results of a run.
struct RunResults {
  /// Values of the columns of result_columns() that the run has. All are finite.
  std::map<std::string, double> values;
  std::string failure;  ///< why the run failed or is not complete; empty: it succeeded
};

/// The points of a sweep of particles, their cases and the rows that their results give.
class ParticlesSweep {
 public:
  /// Reads the case. Throws Error(kBadInput) if the first or the last row of the plan gives no
  /// valid case, and Error(kWrongUsage) if nothing is varied, if a key is varied twice or changes
  /// nothing, or if there are draws but the case has no [arrangement].
  explicit ParticlesSweep(ParticlesSweepPlan plan);

  /// What is run, as the constructor was given it.
  const ParticlesSweepPlan& plan() const { return plan_; }
  std::uint64_t points() const { return points_; }  ///< of the grid, or random
  std::uint64_t size() const;                       ///< number of rows: points times draws

  /// The varied keys, followed by arrangement.seed if there are draws.
  std::vector<std::string> keys() const;

  /// Names of the columns with results. A case without a fluid lacks those of the fluid.
  const std::vector<std::string>& result_columns() const { return result_columns_; }

  /// Keys and values that row `index` changes in the case. The draws of a point follow each other.
  std::vector<std::pair<std::string, double>> numbers(std::uint64_t index) const;

  /// The case of row `index`. Throws Error(kBadInput) if it is not valid.
  case_file::ParticlesCase case_of(std::uint64_t index) const { return case_.with(numbers(index)); }

  /// The text of a case file for row `index`, which may be in any folder. Rows whose case is the
  /// same have the same text.
  std::string case_text(std::uint64_t index) const;

  /// The text of the case with no number changed, which may be in any folder.
  std::string base_text() const { return case_.text_with({}); }

  /// The CSV file of particles that the case names; empty if there is none.
  const std::filesystem::path& particles_file() const { return particles_file_; }

  /// Hash of everything that determines the results of row `index`, with this version of
  /// Viscontact.
  std::string identity(std::uint64_t index, const std::string& version) const;

  /// The values of keys() at a row, as the CSV fields with which it begins.
  std::string key_fields(std::uint64_t index) const;

  /// The row with these results, as a line of CSV.
  std::string row(std::uint64_t index, const RunResults& results) const;

 private:
  ParticlesSweepPlan plan_;
  case_file::ParticlesCaseTemplate case_;
  std::filesystem::path particles_file_;
  std::uint64_t points_ = 1;
  std::uint64_t first_seed_ = 1;
  std::vector<std::string> result_columns_;
};

/// Runs the case of a row. It is called by several threads at once. Results of a run that failed
/// have a `failure`; an error that ends the whole sweep is thrown.
using ParticlesRunner = std::function<RunResults(std::uint64_t index, const StopToken& stop)>;

/// The rows of a sweep of particles, for its file. The sweep must outlive the result. `version` is
/// that of Viscontact.
Rows rows_of(const ParticlesSweep& sweep, const std::string& version, ParticlesRunner run);

}  // namespace viscontact::sweep
