#include "tests/freefem_axi/accuracy/exact_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tests/oracles/bispherical/bispherical.hpp"
#include "tests/oracles/cylinder/sphere_in_cylinder.hpp"

namespace viscontact::freefem_axi {
namespace {

constexpr double kSmallestGap = 1e-6;
constexpr double kLargestGap = 10;

double draw_gap(Random& random) { return log_uniform(random, kSmallestGap, kLargestGap); }

constexpr std::array kAll = {
    ExactRows{"plane", draw_plane},
    ExactRows{"free_surface", draw_free_surface},
    ExactRows{"equal_spheres", draw_equal_spheres},
    ExactRows{"spheres", draw_spheres},
    ExactRows{"cavity", draw_cavity},
    ExactRows{"cylinder", draw_cylinder},
};

}  // namespace

ExactRow exact_row(const std::string& geometry, double gap, std::vector<double> parameters,
                   double accuracy, double drag_factor) {
  ExactRow row;
  row.tabulation.viscosity = 1;
  row.tabulation.radius = 1;
  row.tabulation.gaps = {gap};
  row.tabulation.reference_velocities = {-1};
  row.tabulation.relative_accuracy = accuracy;
  row.tabulation.geometry = geometry;
  row.tabulation.geometry_parameters = std::move(parameters);
  row.drag_factor = drag_factor;
  return row;
}

ExactRow draw_plane(Random& random, double accuracy) {
  const double gap = draw_gap(random);
  return exact_row("plane", gap, {}, accuracy, bispherical_plane_factor(gap));
}

ExactRow draw_free_surface(Random& random, double accuracy) {
  const double gap = draw_gap(random);
  return exact_row("free_surface", gap, {}, accuracy, free_surface_drag_factor(gap));
}

ExactRow draw_equal_spheres(Random& random, double accuracy) {
  const double gap = draw_gap(random);
  const double velocity_ratio = std::floor(uniform(random, 0, 3)) - 1;
  return exact_row("sphere", gap, {1, velocity_ratio, 0}, accuracy,
                   two_sphere_drag_factor(gap, 1, velocity_ratio));
}

ExactRow draw_spheres(Random& random, double accuracy) {
  const double gap = draw_gap(random);
  const double radius = log_uniform(random, 0.01, 100);
  const double velocity_ratio = uniform(random, -2, 2);
  return exact_row("sphere", gap, {radius, velocity_ratio, 0}, accuracy,
                   two_sphere_drag_factor(gap, radius, velocity_ratio));
}

ExactRow draw_cavity(Random& random, double accuracy) {
  const double radius = 1 + log_uniform(random, 0.05, 49);
  const double gap = log_uniform(random, kSmallestGap, radius - 1);
  return exact_row("cavity", gap, {radius}, accuracy, cavity_drag_factor(gap, radius));
}

ExactRow draw_cylinder(Random& random, double accuracy) {
  const double radius = log_uniform(random, 3, 80);
  const double height = 2 * radius;
  // What the exact solution covers.
  const double gap = log_uniform(random, 1e-4, std::min(kLargestGap, radius - 1));
  auto row =
      exact_row("plane", gap, {}, accuracy, sphere_in_cylinder_drag_factor(gap, radius, height));
  row.tabulation.container = Container{radius, height};
  return row;
}

Tabulation in_units(const Tabulation& tabulation, double radius, double viscosity, double speed) {
  auto changed = tabulation;
  changed.radius *= radius;
  changed.viscosity *= viscosity;
  for (double& gap : changed.gaps) gap *= radius;
  for (double& velocity : changed.reference_velocities) velocity *= speed;
  if (changed.container) {
    changed.container->radius *= radius;
    changed.container->height *= radius;
  }
  // The further parameters of a sphere are ratios of velocities.
  auto& parameters = changed.geometry_parameters;
  const std::size_t lengths = changed.geometry == "sphere" ? 1 : parameters.size();
  for (std::size_t i = 0; i < lengths; ++i) parameters[i] *= radius;
  return changed;
}

std::span<const ExactRows> exact_rows() { return kAll; }

std::string SolvedRow::in_words() const {
  return fmt::format("{}, gap {:.6g}, asked {:.2g}: error {:.2e}, estimate {:.2e}",
                     geometry_in_words(row.tabulation), row.gap(), row.tabulation.relative_accuracy,
                     error(), answer.relative_error_estimate);
}

SolvedRow solve(const FreeFem& freefem, const ExactRow& row) {
  return {row, solve_row(freefem, row.tabulation, row.gap(),
                         row.tabulation.reference_velocities.front())};
}

}  // namespace viscontact::freefem_axi
