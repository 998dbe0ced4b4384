// The pair distribution of the spheres of a suspension, from the frames of a run.
#pragma once

#include <string>
#include <vector>

#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/particle_runs/io/columns.hpp"
#include "viscontact/particle_runs/io/playback.hpp"

namespace viscontact::particles {

/// Number of pairs per volume at a distance, over that of spheres without order [1]. The distance is
/// that of the centres over the sum of the radii, so that spheres of all radii touch at 1.
struct PairDistributionRow {
  double distance = 0;  ///< the middle of a bin
  double all = 0;
  /// Of the pairs whose direction is in the quadrants of the plane of the shear in which the flow
  /// compresses (xy < 0 at a positive rate), and in those in which it extends.
  double compression = 0, extension = 0;
};

/// The mean over the frames from average_from on, or of the last frame. Empty if the case has no
/// box, or fewer than two spheres.
std::vector<PairDistributionRow> pair_distribution(const ParticlesCase& c,
                                                   const Playback& playback);

/// The text of pair_distribution.csv.
std::string write_pair_distribution(const std::vector<PairDistributionRow>& rows);

/// The table of docs/file-formats.md.
ColumnTable pair_distribution_column_table();

}  // namespace viscontact::particles
