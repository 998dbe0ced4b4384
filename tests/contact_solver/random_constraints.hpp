// Random problems with friction, films and bilateral rows, for tests of their solvers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/common/random.hpp"
#include "viscontact/constraint_rows/contact_rows.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"

namespace viscontact::contact_solver {

using particles::cross;
using particles::displacement_row;
using particles::norm;
using particles::operator*;
using particles::unit_of_particle;
using particles::Vector;

/// Lengths, masses and times of a problem are multiplied by these.
struct ProblemUnits {
  double length = 1, mass = 1, time = 1;
};

/// What a random problem has.
struct RandomConstraints {
  int units = 8, contacts = 20;
  double friction = 0.5, largest_mass_ratio = 1e4;
  bool has_films = false, has_links = false;
  bool is_round = false;  ///< arms are along the normals, as of discs and spheres
};

/// Calls `test(what, seed)` for 60 kinds of random problems: with mu_s from 0 to 2, masses in the
/// ratio 1 and 1e4, with and without links, and with few and many contacts. Each has its own seed.
template <class Test>
void for_each_random_constraints(bool has_films, Test test) {
  unsigned seed = 0;
  for (const double friction : {0.0, 0.1, 0.5, 1.0, 2.0})
    for (const double ratio : {1.0, 1e4})
      for (const bool has_links : {false, true})
        for (const int contacts : {4, 12, 24}) {
          RandomConstraints what;
          what.contacts = contacts;
          what.friction = friction;
          what.largest_mass_ratio = ratio;
          what.has_links = has_links;
          what.has_films = has_films;
          test(what, ++seed);
        }
}

/// Units in random motion with contacts of gap 0 at random places and in random directions. They
/// have more rows than the units have degrees of freedom, and one contact occurs twice, so that
/// impulses are not unique. `y` = 0 satisfies all constraints.
template <int D>
ConstraintProblem<D> random_constraints(const RandomConstraints& what, const ProblemUnits& in,
                                        unsigned seed) {
  Random random(seed);
  ConstraintProblem<D> problem;
  const auto masses = std::log(what.largest_mass_ratio);
  for (int u = 0; u < what.units; ++u) {
    const double mobility = std::exp(masses * random.uniform(-0.5, 0.5)) * in.time / in.mass;
    const double radius = random.uniform(0.3, 3) * in.length;
    std::array<double, 3> moves{}, turned{};
    for (auto& x : moves) x = random.uniform(-1, 1) * in.length;
    for (auto& x : turned) x = random.uniform(-1, 1);
    problem.units.push_back(unit_of_particle<D>(mobility, mobility / (0.4 * radius * radius),
                                                moves.data(), turned.data()));
  }
  const double impulse = in.mass * in.length / in.time;
  const auto unit = [&] { return random.integer(0, what.units - 1); };
  std::vector<RowPart<D>> parts;
  const auto add_block = [&](int first, int second, const std::array<Vector, 3>& directions,
                             const Vector& arm_of_first, const Vector& arm_of_second,
                             ConstraintBlock block) {
    block.row = problem.rows.size();
    problem.blocks.push_back(block);
    for (std::size_t k = 0; k < block.rows; ++k) {
      parts = {{second, displacement_row<D>(directions[k], arm_of_second)}};
      if (first >= 0)
        parts.push_back({first, displacement_row<D>(-1 * directions[k], arm_of_first)});
      problem.add_row(0, parts, 0);
    }
  };
  for (int c = 0; c < what.contacts; ++c) {
    const int second = unit();
    int first = random.chance(0.3) ? -1 : unit();
    if (first == second) first = -1;
    const Vector normal = random.direction(D);
    std::array<Vector, 3> directions{normal};
    if constexpr (D == 2) {
      directions[1] = {-normal[1], normal[0], 0};
    } else {
      const Vector other = cross(normal, random.direction(3));
      directions[1] = (1 / norm(other)) * other;
      directions[2] = cross(normal, directions[1]);
    }
    ConstraintBlock block;
    block.friction = what.friction;
    block.rows = what.friction > 0 ? static_cast<std::size_t>(D) : 1;
    if (what.has_films) {
      block.lowest = -random.uniform(0, 0.5) * impulse;
      block.capacity = c % 3 == 0 ? 0 : random.uniform(0, 0.3) * impulse;
    }
    if (what.has_links && c < 2) {
      block.is_contact = false;
      block.lowest = block.capacity = 0;
      block.rows = static_cast<std::size_t>(D);
      block.compliance = c == 0 ? 0 : random.uniform(0, 1) * in.time / in.mass;
    }
    Vector arm = random.uniform(0.3, 2) * in.length * random.direction(D);
    Vector other = random.uniform(0.3, 2) * in.length * random.direction(D);
    if (what.is_round) {
      arm = norm(arm) * normal;
      other = -norm(other) * normal;
    }
    add_block(first, second, directions, arm, other, block);
    if (c == what.contacts - 1) add_block(first, second, directions, arm, other, block);
  }
  return problem;
}

/// Adds two rows of unit 0 that no motion satisfies.
inline void add_contradicting_links(ConstraintProblem<2>& problem) {
  ConstraintBlock block;
  block.is_contact = false;
  for (const double offset : {0.0, 1.0}) {
    block.row = problem.rows.size();
    problem.blocks.push_back(block);
    const std::vector<RowPart<2>> parts{{0, displacement_row<2>({1, 0, 0}, {})}};
    problem.add_row(offset, parts, 0);
  }
}

/// Makes a problem of dry contacts in the cones of (5.9) and of contacts with films whose loads are
/// given (5.17): a random one of them has no load.
template <int D>
void make_convex(ConstraintProblem<D>& problem, const ProblemUnits& in, unsigned seed) {
  Random random(seed);
  problem.is_convex = true;
  for (auto& block : problem.blocks) {
    if (!block.is_contact) continue;
    block.friction_bound = block.has_film() ? FrictionBound::kGiven : FrictionBound::kCone;
    const double load = random.uniform(-0.2, 0.5) * in.mass * in.length / in.time;
    block.given_load = block.has_film() ? std::max(load, 0.0) : 0;
  }
}

/// Largest value of a row, its offset included, in the motion without constraints [L].
template <int D>
double size_of(const ConstraintProblem<D>& problem) {
  std::vector<Motion<D>> free;
  for (const auto& unit : problem.units) free.push_back(unit.free);
  double size = 0;
  for (std::size_t r = 0; r < problem.rows.size(); ++r)
    size = std::max(size, std::abs(problem.rows[r].offset + problem.product(r, free)));
  return size;
}

/// Twice the kinetic energy of motions, times the square of the step [M L^2/T].
template <int D>
double square_of(const ConstraintProblem<D>& problem, const std::vector<Motion<D>>& y) {
  double sum = 0;
  for (std::size_t u = 0; u < y.size(); ++u) {
    const auto impulse = problem.units[u].impulse_of(y[u]);
    for (std::size_t k = 0; k < impulse.size(); ++k) sum += impulse[k] * y[u][k];
  }
  return sum;
}

}  // namespace viscontact::contact_solver
