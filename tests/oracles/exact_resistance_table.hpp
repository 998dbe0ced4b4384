// Tables of exact resistance matrices, in place of those of FreeFEM.
#pragma once

#include <vector>

#include "tests/oracles/collinear_spheres.hpp"
#include "viscontact/swimmer/resistance/resistance_fit.hpp"
#include "viscontact/swimmer/resistance/resistance_table.hpp"

namespace viscontact {

/// The table of three spheres in unbounded fluid of viscosity 1. Each of the two arms has `count`
/// lengths between `from` and `to` [L]. All entries have the relative error estimate `estimate`.
inline swimmer::ResistanceTable exact_table(const std::vector<double>& radii, double from,
                                            double to, int count, double estimate = 1e-6) {
  swimmer::ResistanceTable table;
  table.viscosity = 1;
  table.radii = radii;
  const auto arms = swimmer::chebyshev_arms(from, to, count);
  const auto n = arms.size();
  for (std::size_t i1 = 0; i1 < n; ++i1)
    for (std::size_t i2 = 0; i2 < n; ++i2) {
      swimmer::ResistanceRow row;
      row.gaps = {arms[i1] - radii[0] - radii[1], arms[i2] - radii[1] - radii[2]};
      if (i2 < i1 && radii[0] == radii[2]) {
        // The mirror image of an earlier row, whose entries are R11, R12, R13, R22, R23, R33.
        const auto& e = table.rows[i2 * n + i1].entries;
        row.entries = {e[5], e[4], e[2], e[3], e[1], e[0]};
      } else {
        const auto matrix = exact_resistance(radii, row.gaps);
        for (Eigen::Index i = 0; i < 3; ++i)
          for (Eigen::Index j = i; j < 3; ++j)
            row.entries.push_back((matrix(i, j) + matrix(j, i)) / 2);
      }
      row.relative_error_estimates.assign(row.entries.size(), estimate);
      table.rows.push_back(row);
    }
  return table;
}

}  // namespace viscontact
