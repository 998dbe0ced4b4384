// A sweep over a case of many particles: its runs, one for each point or draw, and the tables of
// their results.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/sweep/study.hpp"

namespace viscontact::particles {

/// Column with the fraction [1] of the domain that the particles of [arrangement] cover.
inline const char* fraction_column(const ParticlesCase& c) {
  return c.particles.dimension == 3 ? "volume_fraction" : "area_fraction";
}

/// The points of the section [sweep] of a case; without it nothing is varied. Throws
/// Error(kBadInput) if the case is wrong or a range in [sweep] is not valid.
sweep::Points planned_particles(const std::filesystem::path& case_path);

/// Runs the case of row `index`, from 0, and returns its results. Several threads call it at once.
/// If only this run fails, the results have a text `failure`. An Error that it throws ends the
/// whole sweep, such as Error(kInterrupted) if `stop` requests a stop.
using ParticlesRunner =
    std::function<sweep::RowResults(std::uint64_t index, const StopToken& stop)>;

/// The points of a sweep of particles, and the cases of its rows. A point is a set of values of the
/// varied keys. At each point the case is run once, or with several random arrangements of its
/// particles (draws), which follow each other in the table of rows. `index` is the number of a row,
/// from 0.
class ParticlesSweep {
 public:
  /// Reads the case. Points::first_draw becomes arrangement.seed of the case. Throws
  /// Error(kBadInput) if the case cannot be read or is wrong, or if the first or the last row gives
  /// no valid case. Throws Error(kWrongUsage) if nothing is varied and there are no draws; if a key
  /// is varied twice, or is in [sweep] or [output]; if a grid leaves out the end of a range; if
  /// there are random samples but no varied key; if draws make more than 1e12 rows; if there are
  /// draws but the case has no [arrangement], or arrangement.seed is varied; or if the seed of the
  /// last draw exceeds 2^31 - 1.
  ParticlesSweep(const std::filesystem::path& case_path, sweep::Points points);

  const sweep::Points& points() const { return points_; }
  const std::filesystem::path& case_path() const { return cases_.path(); }

  /// Columns of the fluid are missing if the case has no fluid.
  const std::vector<std::string>& result_columns() const { return result_columns_; }

  /// Throws Error(kBadInput) if the case is not valid.
  ParticlesCase case_of(std::uint64_t index) const { return cases_.with(points_.numbers(index)); }

  /// The text of a case file for row `index`. Paths in it are absolute, so that the file may be in
  /// any folder. Rows with equal cases have equal texts.
  std::string case_text(std::uint64_t index) const;

  /// The text of a case file in which no key has been varied, in any folder.
  std::string base_text() const;

  /// The files that the case names (files_of()).
  const std::vector<std::filesystem::path>& files() const { return files_; }
  const Units& units() const { return units_; }  ///< may be empty

  /// Hash (SHA-256) of everything that determines the results of row `index`: the version of
  /// Viscontact, the case, and the files that it names. Results with the same identity are not
  /// computed again. Throws Error(kBadInput) if a file cannot be read.
  std::string identity(std::uint64_t index, const std::string& version) const;

  /// The sweep in the form that sweep/study.hpp computes and writes; `run` computes its rows.
  /// Throws Error(kBadInput) if the case or its CSV file of particles cannot be read.
  sweep::Study study(const std::string& version, ParticlesRunner run) const;

 private:
  case_file::CaseTemplate<ParticlesCase> cases_;
  sweep::Points points_;
  std::vector<std::filesystem::path> files_;
  Units units_;
  std::vector<std::string> result_columns_;
};

/// The table of means, as CSV, of the finished file of rows at `path`. For each point of the sweep
/// it has the varied keys, the numbers of draws that succeeded (`draws`) and failed (`failed`),
/// and, for each column of results, COLUMN.mean and COLUMN.standard_error over the draws that
/// succeeded. The standard error is the standard deviation (with n - 1) of n draws over the root of
/// n; it is empty if n < 2. Both are empty if no draw has a finite value. Throws Error(kBadInput)
/// if the file cannot be read or has other rows than the sweep.
std::string table_of_means(const ParticlesSweep& sweep, const std::filesystem::path& path);

/// "rows.csv" gives "rows_means.csv".
std::filesystem::path path_of_means(const std::filesystem::path& rows);

}  // namespace viscontact::particles
