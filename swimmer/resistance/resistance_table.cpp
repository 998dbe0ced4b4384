// Reads, writes and scales a table of resistance matrices (docs/file-formats.md).
#include "viscontact/swimmer/resistance/resistance_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/lubrication/scaling.hpp"
#include "viscontact/lubrication/table_codec.hpp"

namespace viscontact::swimmer {
namespace {

using lubrication::Column;
using lubrication::IfAbsent;
using lubrication::TableHead;

/// The numbers of two spheres, counted from 1, in the name of a column: "12", or "9_10" if one of
/// them has two digits. The arguments i and j count from 0.
std::string pair_name(std::size_t i, std::size_t j) {
  return fmt::format("{}{}{}", i + 1, std::max(i, j) >= 9 ? "_" : "", j + 1);
}

}  // namespace

std::size_t entry_position(std::size_t i, std::size_t j, std::size_t spheres) {
  assert(i < spheres && j < spheres);
  const auto [row, column] = std::minmax(i, j);
  return row * spheres - row * (row + 1) / 2 + column;
}

Eigen::MatrixXd matrix_of(const ResistanceRow& row, std::size_t spheres) {
  const auto size = static_cast<Eigen::Index>(spheres);
  Eigen::MatrixXd matrix(size, size);
  for (std::size_t i = 0; i < spheres; ++i)
    for (std::size_t j = 0; j < spheres; ++j)
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          row.entries.at(entry_position(i, j, spheres));
  return matrix;
}

std::vector<Column> columns_of(const TableHead& head, ResistanceRow& row) {
  const std::size_t spheres = head.radii.size();
  assert(row.gaps.size() + 1 == spheres && row.entries.size() == entry_count(spheres));
  assert(row.relative_error_estimates.size() == row.entries.size());
  std::vector<Column> columns, estimates;
  for (std::size_t i = 0; i + 1 < spheres; ++i)
    columns.push_back({"gap" + pair_name(i, i + 1), &row.gaps[i], IfAbsent::kRefused, kPositive});
  for (std::size_t i = 0; i < spheres; ++i)
    for (std::size_t j = i; j < spheres; ++j) {
      const auto entry = entry_position(i, j, spheres);
      columns.push_back({"R" + pair_name(i, j), &row.entries[entry], IfAbsent::kRefused});
      estimates.push_back({columns.back().name + "_relative_error_estimate",
                           &row.relative_error_estimates[entry], IfAbsent::kZero, kNotNegative});
    }
  std::ranges::move(estimates, std::back_inserter(columns));
  columns.push_back(
      {"relative_error_estimate", &row.relative_error_estimate, IfAbsent::kAlwaysComputed});
  columns.push_back({"degrees_of_freedom", &row.degrees_of_freedom});
  columns.push_back({"seconds", &row.seconds});
  columns.push_back({"observed_order", &row.observed_order});
  return columns;
}

void prepare(const TableHead& head, ResistanceRow& row) {
  assert(!head.radii.empty());
  row.gaps.resize(head.radii.size() - 1);
  row.entries.resize(entry_count(head.radii.size()));
  row.relative_error_estimates.resize(row.entries.size());
}

void complete(const TableHead& /*head*/, ResistanceRow& row) {
  row.relative_error_estimate = largest_estimate(row);
}

void check(const TableHead& head, const ResistanceRow& row, const FilePosition& here) {
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix_of(row, head.radii.size()));
  if (factor.info() != Eigen::Success)
    throw_bad_input(here, "the matrix R is not positive definite; forces would drive the spheres");
}

double largest_estimate(const ResistanceRow& row) {
  const auto& estimates = row.relative_error_estimates;
  return estimates.empty() ? 0 : std::ranges::max(estimates);
}

ResistanceTable read_resistance_table(const std::filesystem::path& path) {
  return lubrication::read_table<ResistanceRow>(path);
}

std::vector<std::vector<double>> gap_grid(const ResistanceTable& table) {
  assert(!table.radii.empty());
  std::vector<std::vector<double>> grid(table.radii.size() - 1);
  for (std::size_t k = 0; k < grid.size(); ++k) {
    for (const auto& row : table.rows) grid[k].push_back(row.gaps[k]);
    std::ranges::sort(grid[k]);
    // Clang 14, which scripts/fuzz uses, refuses std::ranges::unique of GCC 12.
    grid[k].erase(std::unique(grid[k].begin(), grid[k].end()), grid[k].end());
  }
  return grid;
}

double ratio_of_radii(const std::vector<double>& radii, const std::vector<double>& other,
                      std::string_view what) {
  assert(!radii.empty() && !other.empty());
  const double ratio = radii.front() / other.front();
  const bool has_ratio = std::ranges::equal(radii, other, [&](double one, double of_other) {
    return equal_up_to_rounding(one, ratio * of_other);
  });
  if (!has_ratio)
    throw Error(ErrorKind::kBadInput,
                "the radii [{}] of the case are no multiple of those of the {}, [{}]; give a {} of "
                "the same ratios",
                fmt::join(radii, ", "), what, fmt::join(other, ", "), what);
  return ratio;
}

ResistanceTable scaled_to(ResistanceTable table, double viscosity,
                          const std::vector<double>& radii) {
  assert(viscosity > 0);
  const double ratio = ratio_of_radii(radii, table.radii, "table");
  const double factor = viscosity / table.viscosity * ratio;
  table.viscosity = viscosity;
  table.radii = radii;
  table.container = lubrication::with_lengths_scaled(table.container, ratio);
  table.case_hash.clear();
  for (auto& row : table.rows) {
    for (auto& gap : row.gaps) gap *= ratio;
    for (auto& entry : row.entries) entry *= factor;
  }
  return table;
}

std::string write_resistance_table(const ResistanceTable& table) {
  assert(!table.rows.empty());
  return lubrication::write_table(table);
}

}  // namespace viscontact::swimmer
