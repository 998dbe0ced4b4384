// Newton's method for a step of membranes (membrane_motion.hpp).
#include "viscontact/particles/membranes/membrane_motion.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <array>
#include <cmath>
#include <limits>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

Membranes::Membranes(std::span<const Membrane> membranes) : membranes_(membranes), first_{0} {
  for (const auto& membrane : membranes) {
    curves_.emplace_back(membrane.beads);
    first_.push_back(first_.back() + membrane.beads);
  }
}

Eigen::VectorXd Membranes::places(std::span<const double> positions, const PeriodicCell& cell,
                                  const Eigen::VectorXd* near) const {
  auto all = from_particles(positions, 2);
  for (std::size_t m = 0; m < membranes_.size(); ++m)
    for (Eigen::Index d = 0; d < 2; ++d) {
      const double period = cell.lengths[static_cast<std::size_t>(d)];
      if (!(period > 0)) continue;
      const auto begin = d * beads() + first_[m];
      if (near != nullptr)
        all(begin) -= period * std::round((all(begin) - (*near)(begin)) / period);
      for (Eigen::Index k = begin + 1; k < begin + membranes_[m].beads; ++k)
        all(k) -= period * std::round((all(k) - all(k - 1)) / period);
    }
  return all;
}

Eigen::VectorXd Membranes::from_particles(std::span<const double> numbers,
                                          std::size_t components) const {
  Eigen::VectorXd all(2 * beads());
  for (std::size_t m = 0; m < membranes_.size(); ++m)
    for (Eigen::Index k = 0; k < membranes_[m].beads; ++k) {
      const auto at = components * static_cast<std::size_t>(membranes_[m].first + k);
      all(first_[m] + k) = numbers[at];
      all(beads() + first_[m] + k) = numbers[at + 1];
    }
  return all;
}

void Membranes::to_particles(const Eigen::VectorXd& all, std::size_t components,
                             std::vector<double>& numbers) const {
  for (std::size_t m = 0; m < membranes_.size(); ++m)
    for (Eigen::Index k = 0; k < membranes_[m].beads; ++k) {
      const auto at = components * static_cast<std::size_t>(membranes_[m].first + k);
      numbers[at] = all(first_[m] + k);
      numbers[at + 1] = all(beads() + first_[m] + k);
    }
}

Eigen::VectorXd Membranes::of(std::size_t m, const Eigen::VectorXd& all) const {
  const auto n = first_[m + 1] - first_[m];
  Eigen::VectorXd own(2 * n);
  own << all.segment(first_[m], n), all.segment(beads() + first_[m], n);
  return own;
}

void Membranes::put(std::size_t m, const Eigen::VectorXd& own, Eigen::VectorXd& all) const {
  const auto n = first_[m + 1] - first_[m];
  all.segment(first_[m], n) = own.head(n);
  all.segment(beads() + first_[m], n) = own.tail(n);
}

Eigen::MatrixXd Membranes::speed_rows(const Eigen::VectorXd& positions) const {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(beads(), 2 * beads());
  for (std::size_t m = 0; m < curves_.size(); ++m) {
    const auto n = first_[m + 1] - first_[m];
    const Eigen::MatrixXd own = curves_[m].speed_rows(of(m, positions));
    rows.block(first_[m], first_[m], n, n) = own.leftCols(n);
    rows.block(first_[m], beads() + first_[m], n, n) = own.rightCols(n);
  }
  return rows;
}

Eigen::VectorXd Membranes::bending_forces(const Eigen::VectorXd& positions) const {
  Eigen::VectorXd forces(2 * beads());
  for (std::size_t m = 0; m < curves_.size(); ++m)
    put(m, -membranes_[m].bending_rigidity * curves_[m].bending_gradient(of(m, positions)), forces);
  return forces;
}

/// Second derivatives of the bending energy and of the tensions times the speeds.
Eigen::MatrixXd Membranes::stiffness(const Eigen::VectorXd& positions,
                                     const Eigen::VectorXd& tension) const {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(2 * beads(), 2 * beads());
  for (std::size_t m = 0; m < curves_.size(); ++m) {
    const auto n = first_[m + 1] - first_[m];
    const Eigen::MatrixXd own =
        membranes_[m].bending_rigidity * curves_[m].bending_hessian(of(m, positions)) +
        curves_[m].speeds_hessian(of(m, positions), tension.segment(first_[m], n));
    for (Eigen::Index i = 0; i < 2; ++i)
      for (Eigen::Index j = 0; j < 2; ++j)
        stiffness.block(i * beads() + first_[m], j * beads() + first_[m], n, n) =
            own.block(i * n, j * n, n, n);
  }
  return stiffness;
}

MembraneMotion Membranes::motion_at(const Eigen::VectorXd& positions,
                                    const FluidAnswer& answer) const {
  const Eigen::MatrixXd rows = speed_rows(positions);
  MembraneMotion motion;
  motion.forces = bending_forces(positions);
  const Eigen::VectorXd free = answer.flow + answer.mobility * motion.forces;
  const Eigen::MatrixXd answers = answer.mobility * rows.transpose();
  // The tension of a circle is not unique, because it acts like a pressure inside: the decomposition
  // then chooses the smallest one.
  const Eigen::VectorXd tension =
      (rows * answers).completeOrthogonalDecomposition().solve(rows * free);
  motion.forces -= rows.transpose() * tension;
  motion.velocities = free - answers * tension;
  return motion;
}

/// Newton's method for step(): returns whether it has found `positions` and the `tension`, of which both
/// are first guesses.
bool Membranes::solve_step(const Eigen::VectorXd& from, double time, const FluidAnswer& answer,
                           Eigen::VectorXd& positions, Eigen::VectorXd& tension) const {
  const auto n = beads();
  // In the matrix, tensions are in units in which a tension moves a bead by about its own number.
  const double unit = static_cast<double>(2 * n) / (time * answer.mobility.trace());
  const Eigen::MatrixXd moves = time * answer.mobility;
  Eigen::VectorXd wanted(n);
  double size = 0;
  for (std::size_t m = 0; m < curves_.size(); ++m) {
    const double speed = membranes_[m].perimeter / kTwoPi;
    wanted.segment(first_[m], first_[m + 1] - first_[m]).setConstant(speed);
    size = std::max(size, speed);
  }
  constexpr int kMostRounds = 30;
  // Newton's method is quadratic: after a change of this size the next one would be a rounding error.
  // Rounding errors of stiff membranes are larger; then changes no longer become smaller.
  constexpr double kExact = 1e-9, kRounding = 1e-6;
  double last = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kMostRounds; ++round) {
    const Eigen::MatrixXd rows = speed_rows(positions);
    const Eigen::MatrixXd moves_by_tension = moves * rows.transpose();
    Eigen::VectorXd missing(3 * n);
    missing.head(2 * n) = from + time * answer.flow + moves * bending_forces(positions) -
                          moves_by_tension * tension - positions;
    for (std::size_t m = 0; m < curves_.size(); ++m) {
      const auto beads_of_m = first_[m + 1] - first_[m];
      missing.segment(2 * n + first_[m], beads_of_m) =
          wanted.segment(first_[m], beads_of_m) - curves_[m].speeds(of(m, positions));
    }
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    matrix.topLeftCorner(2 * n, 2 * n) =
        Eigen::MatrixXd::Identity(2 * n, 2 * n) + moves * stiffness(positions, tension);
    matrix.topRightCorner(2 * n, n) = unit * moves_by_tension;
    matrix.bottomLeftCorner(n, 2 * n) = rows;
    const Eigen::VectorXd change = matrix.partialPivLu().solve(missing);
    if (!change.allFinite()) return false;
    positions += change.head(2 * n);
    tension += unit * change.tail(n);
    const double changed = change.head(2 * n).lpNorm<Eigen::Infinity>() / size;
    if (changed < kExact || (changed < kRounding && changed > last / 2)) return true;
    last = changed;
  }
  return false;
}

MembraneMotion Membranes::step(const Eigen::VectorXd& from, double time, const FluidAnswer& answer,
                               const Eigen::VectorXd& loads, Eigen::VectorXd& positions) const {
  const Eigen::VectorXd guess = positions;
  const FluidAnswer loaded{answer.flow + answer.mobility * loads, answer.mobility};
  MembraneMotion motion;
  auto& tension = motion.tension;
  tension = Eigen::VectorXd::Zero(beads());
  bool is_solved = solve_step(from, time, loaded, positions, tension);
  if (!is_solved) {
    // A stiff membrane that is far from its equilibrium: solutions of shorter times lead to it.
    positions = guess;
    tension.setZero();
    is_solved = true;
    for (int halvings = 12; halvings >= 0 && is_solved; --halvings)
      is_solved = solve_step(from, std::ldexp(time, -halvings), loaded, positions, tension);
  }
  motion.forces = loads + bending_forces(positions) - speed_rows(positions).transpose() * tension;
  motion.velocities = answer.flow + answer.mobility * motion.forces;
  for (std::size_t m = 0; m < curves_.size() && is_solved; ++m) {
    auto own = of(m, positions);
    is_solved =
        restore_lengths_and_area(curves_[m], membranes_[m].perimeter, membranes_[m].area, own);
    put(m, own, positions);
  }
  if (!is_solved)
    throw Error(ErrorKind::kNotConverged,
                "the step of the membranes does not converge; use a shorter time_step");
  return motion;
}

Eigen::MatrixXd Membranes::response(double time, const FluidAnswer& answer,
                                    const MembraneMotion& motion,
                                    const Eigen::VectorXd& positions) const {
  const auto n = beads();
  const Eigen::MatrixXd moves = time * answer.mobility;
  const double unit = static_cast<double>(2 * n) / moves.trace();
  const Eigen::MatrixXd rows = speed_rows(positions);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  matrix.topLeftCorner(2 * n, 2 * n) =
      Eigen::MatrixXd::Identity(2 * n, 2 * n) + moves * stiffness(positions, motion.tension);
  matrix.topRightCorner(2 * n, n) = unit * moves * rows.transpose();
  matrix.bottomLeftCorner(n, 2 * n) = rows;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(3 * n, 2 * n);
  right.topRows(2 * n) = moves;
  const Eigen::MatrixXd solved = matrix.partialPivLu().solve(right).topRows(2 * n);
  // Rounding errors are not symmetric.
  return (solved + solved.transpose()) / 2;
}

MembraneMeasures measure(const Membrane& membrane, const PeriodicCell& cell,
                         std::span<const double> positions, std::span<const double> velocities) {
  const std::array one = {membrane};
  return measure(MembraneCurve(membrane.beads), Membranes(one).places(positions, cell),
                 Membranes(one).from_particles(velocities, 2));
}

std::string membrane_rows(const Setting& setting, const State& state,
                          std::span<const double> /*force_errors*/) {
  std::string text;
  const auto& p = state.particles;
  for (std::size_t m = 0; m < setting.fluid->membranes.size(); ++m) {
    const auto measures = measure(setting.fluid->membranes[m], p.cell, p.positions, p.velocities);
    text += fmt::format("{},{}", format_number(state.time), m);
    for (const double value :
         {measures.x, measures.y, measures.inclination, measures.area, measures.perimeter,
          measures.membrane_speed, measures.tank_treading_frequency})
      text += "," + format_number(value);
    text += '\n';
  }
  return text;
}

}  // namespace viscontact::particles
