// The resistance matrix of a row of a table as a matrix of Eigen. It is not in
// resistance_table.hpp, because readers of tables need no Eigen.
#pragma once

#include <Eigen/Core>

#include "viscontact/swimmer/resistance/resistance_table.hpp"

namespace viscontact::swimmer {

/// The symmetric matrix R [M/T] of a row of a table of `spheres` spheres.
inline Eigen::MatrixXd matrix_of(const ResistanceRow& row, std::size_t spheres) {
  const auto size = static_cast<Eigen::Index>(spheres);
  Eigen::MatrixXd matrix(size, size);
  for (std::size_t i = 0; i < spheres; ++i)
    for (std::size_t j = 0; j < spheres; ++j)
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          row.entries.at(entry_position(i, j, spheres));
  return matrix;
}

}  // namespace viscontact::swimmer
