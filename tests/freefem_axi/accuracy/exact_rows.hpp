// Rows of tabulations whose drag is known exactly, drawn at random, for the tests of the error
// estimate and for bench_estimates.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::freefem_axi {

using Random = std::mt19937_64;

/// A uniform number in [from, to], made from the bits of the generator, because the distributions
/// of the standard library differ between libraries.
inline double uniform(Random& random, double from, double to) {
  return std::lerp(from, to, static_cast<double>(random() >> 11U) * 0x1p-53);
}

inline double log_uniform(Random& random, double from, double to) {
  return std::exp(uniform(random, std::log(from), std::log(to)));
}

struct ExactRow {
  Tabulation tabulation;   ///< has this row only; radius and viscosity are 1, the velocity is -1
  double drag_factor = 0;  ///< exact

  double gap() const { return tabulation.gaps.front(); }
};

/// A row in unbounded fluid or in a cavity; `gap` is in radii of the sphere.
ExactRow exact_row(const std::string& geometry, double gap, std::vector<double> parameters,
                   double accuracy, double drag_factor);

ExactRow draw_plane(Random& random, double accuracy);
ExactRow draw_free_surface(Random& random, double accuracy);
/// Equal spheres: one is at rest, or both move together, or against each other.
ExactRow draw_equal_spheres(Random& random, double accuracy);
/// Radius ratios from 0.01 to 100, velocity ratios from -2 to 2.
ExactRow draw_spheres(Random& random, double accuracy);
/// Cavities from 1.05 to 50 radii.
ExactRow draw_cavity(Random& random, double accuracy);
/// Closed cylinders from 3 x 6 to 80 x 160 radii, gaps from 1e-4 to mid-height.
ExactRow draw_cylinder(Random& random, double accuracy);

/// The same row in other units, in which the sphere has this radius and speed and the fluid this
/// viscosity, all > 0; in `tabulation` all three are 1. The drag factor has no dimension and stays.
Tabulation in_units(const Tabulation& tabulation, double radius, double viscosity, double speed);

struct ExactRows {
  const char* name;
  ExactRow (*draw)(Random& random, double accuracy);
};

/// All functions that draw rows, with their names.
std::span<const ExactRows> exact_rows();

struct SolvedRow {
  ExactRow row;
  lubrication::MotionRow answer;

  double error() const { return std::abs(answer.force_factor / row.drag_factor - 1); }
  double ratio() const { return error() / answer.relative_error_estimate; }
  bool says_reached() const {
    return answer.relative_error_estimate <= row.tabulation.relative_accuracy;
  }
  std::string in_words() const;
};

SolvedRow solve(const FreeFem& freefem, const ExactRow& row);

}  // namespace viscontact::freefem_axi
