// A new column is a row of rheology_columns().
#include "viscontact/particle_runs/io/rheology_file.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "viscontact/common/text/csv.hpp"

namespace viscontact::particles {
namespace {

std::optional<double> if_finite(double number) {
  if (!std::isfinite(number)) return {};
  return number + 0.0;  // the sum is 0 instead of -0
}

constexpr Presence kNotInFrames{.at_end = kNever, .frames = kNever};

/// The field is empty if the number is not finite.
template <auto kMember>
Column<Rheology> if_known(std::string_view name, std::string_view meaning,
                          std::string_view unit = "1") {
  return column<Rheology>({name, unit, meaning, kNotInFrames},
                          [](const Rheology& row) { return if_finite(row.*kMember); });
}

/// The field is empty without a box, which has no volume, and at rest, because the number is one
/// over the shear rate.
template <auto kMember>
Column<Rheology> of_stress(std::string_view name, std::string_view meaning) {
  return column<Rheology>({name, "1", meaning, kNotInFrames}, [](const Rheology& row) {
    return row.shear_rate != 0 ? if_finite(row.*kMember) : std::nullopt;
  });
}

constexpr int kSpace = 3;

}  // namespace

const std::vector<Column<Rheology>>& rheology_columns() {
  static const std::vector<Column<Rheology>> columns = {
      if_known<&Rheology::time>("time", "at the end of the step", "T"),
      if_known<&Rheology::strain>(
          "strain",
          "since the start of the case, of whatever direction: the integral of the magnitude of "
          "the shear rate"),
      of_stress<&Rheology::viscosity>(
          "viscosity",
          "relative to that of the fluid: shear stress over viscosity and shear rate, > 0 for both "
          "signs of the rate. It and the next six are empty at rest and without a box"),
      of_stress<&Rheology::n1>(
          "n1",
          "first difference of the normal stresses, xx less yy, over the viscosity of the "
          "fluid and the magnitude of the shear rate"),
      of_stress<&Rheology::n2>("n2", "second difference, yy less zz, over the same"),
      of_stress<&Rheology::pressure>("pressure", "that of the particles, over the same"),
      of_stress<&Rheology::viscosity_film>("viscosity_film",
                                           "part of `viscosity`: drag and films. The rest is 1, of "
                                           "the fluid, and the part of the repulsion"),
      of_stress<&Rheology::viscosity_contact>("viscosity_contact",
                                              "part of `viscosity`: the normal forces of contacts"),
      of_stress<&Rheology::viscosity_friction>("viscosity_friction",
                                               "part of `viscosity`: the friction"),
      column<&Rheology::pairs>({"pairs", "", "number of close pairs", kNotInFrames}),
      column<&Rheology::contacts>({"contacts", "", "number of contacts", kNotInFrames}),
      if_known<&Rheology::smallest_gap>("smallest_gap", "empty without pairs", "L"),
      if_known<&Rheology::shear_rate>(
          "shear_rate",
          "given, or the result of a given stress, with the sign of `shear_rate` or `strain_rate`, "
          "or of the first derivative in `gradient` that is not 0",
          "1/T"),
      if_known<&Rheology::net_strain>("net_strain", "the integral of the column `shear_rate`"),
  };
  return columns;
}

std::array<double, kRheologyMeans.size()> numbers_to_average(const Rheology& r) {
  std::array<double, kRheologyMeans.size()> unknown{};
  unknown.fill(std::numeric_limits<double>::quiet_NaN());
  if (r.shear_rate == 0) return unknown;
  return {r.viscosity,         r.n1, r.n2, r.pressure, r.viscosity_film, r.viscosity_contact,
          r.viscosity_friction};
}

std::string rheology_header() { return table_over_time(rheology_columns(), kSpace).header(); }

std::string rheology_row(const Rheology& rheology) {
  std::string text;
  table_over_time(rheology_columns(), kSpace).add(text, rheology);
  return text;
}

std::vector<Rheology> read_rheology(const std::filesystem::path& path) {
  constexpr std::array kMembers = {&Rheology::time,
                                   &Rheology::strain,
                                   &Rheology::viscosity,
                                   &Rheology::viscosity_film,
                                   &Rheology::viscosity_contact,
                                   &Rheology::viscosity_friction,
                                   &Rheology::net_strain};
  const auto file =
      read_csv<kMembers.size()>(path,
                                {"time", "strain", "viscosity", "viscosity_film",
                                 "viscosity_contact", "viscosity_friction", "net_strain"},
                                kMembers.size());
  std::vector<Rheology> read;
  for (const auto& row : file.rows) {
    auto& rheology = read.emplace_back();
    for (std::size_t k = 0; k < kMembers.size(); ++k)
      rheology.*kMembers[k] = row.fields[k].value_or(std::numeric_limits<double>::quiet_NaN());
  }
  return read;
}

namespace {

const std::vector<Column<PairDistributionRow>>& pair_distribution_columns() {
  using Pairs = PairDistributionRow;
  static const std::vector<Column<Pairs>> columns = {
      column<&Pairs::distance>({"distance", "1",
                                "of the centres over the sum of the radii, the middle of a bin",
                                only_over_time()}),
      column<&Pairs::all>({"g", "1",
                           "number of pairs at this distance over that of spheres without order, "
                           "mean over the frames from `average_from` on",
                           only_over_time()}),
      column<&Pairs::compression>(
          {"g_compression", "1",
           "the same of the directions in the two quadrants of the plane of the shear in which the "
           "flow compresses",
           only_over_time()}),
      column<&Pairs::extension>(
          {"g_extension", "1", "the same of those in which it extends", only_over_time()}),
  };
  return columns;
}

}  // namespace

std::string write_pair_distribution(const std::vector<PairDistributionRow>& rows) {
  const auto table = table_over_time(pair_distribution_columns(), kSpace);
  auto text = table.header();
  for (const auto& row : rows) table.add(text, row);
  return text;
}

std::vector<ColumnTable> rheology_column_tables() {
  return {column_table("`rheology.csv`", rheology_columns()),
          column_table("`pair_distribution.csv`", pair_distribution_columns())};
}

}  // namespace viscontact::particles
