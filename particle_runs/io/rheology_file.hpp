// The columns and rows of rheology.csv and pair_distribution.csv.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/particle_runs/io/columns.hpp"
#include "viscontact/suspensions/values/rheology.hpp"

namespace viscontact::particles {

inline constexpr const char* kRheologyFile = "rheology.csv";

/// The numbers of Rheology of which run.json has means.
inline constexpr auto kRheologyMeans =
    std::to_array<std::string_view>({"viscosity", "n1", "n2", "pressure", "viscosity_film",
                                     "viscosity_contact", "viscosity_friction"});
/// These numbers, in the same order; NaN at rest and without a box.
std::array<double, kRheologyMeans.size()> numbers_to_average(const Rheology& rheology);

/// The columns of the table, and the members of Rheology in Python.
const std::vector<Column<Rheology>>& rheology_columns();

/// The line with the names of the columns.
std::string rheology_header();
std::string rheology_row(const Rheology& rheology);

/// The times, strains and viscosities of the rows of a file, with NaN where a field is empty, and
/// no other members. Throws Error(kBadInput), which names the file, if it cannot be read or has
/// other columns.
std::vector<Rheology> read_rheology(const std::filesystem::path& path);

/// Number of pairs per volume at a distance, over that of spheres without order [1]. The distance
/// is that of the centres over the sum of the radii, so that spheres of all radii touch at 1.
struct PairDistributionRow {
  double distance = 0;  ///< the middle of a bin
  double all = 0;
  /// Of the pairs whose direction is in the quadrants of the plane of the shear in which the flow
  /// compresses (xy < 0 at a positive rate), and in those in which it extends.
  double compression = 0, extension = 0;
};

/// The text of pair_distribution.csv.
std::string write_pair_distribution(const std::vector<PairDistributionRow>& rows);

/// The tables of docs/file-formats.md.
std::vector<ColumnTable> rheology_column_tables();

}  // namespace viscontact::particles
