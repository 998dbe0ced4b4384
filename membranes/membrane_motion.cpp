// Steps of membranes in a fluid by Newton's method, docs/physics.md (8.4) to (8.6).
#include "viscontact/membranes/membrane_motion.hpp"

#include <cassert>
#include <cmath>
#include <limits>

#include "viscontact/common/error.hpp"
#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of Newton's method for a step.
struct MembraneStepTuning {
  // The limit only ends a search that fails.
  static constexpr int kMostRounds = 30;
  // Newton's method is quadratic: after a change of the positions by less than kExact times their
  // size, the next one would be a rounding error. In stiff membranes rounding errors are larger.
  // Therefore a change below kRounding and above half of the one before also ends the method.
  static constexpr double kExact = 1e-9, kRounding = 1e-6;
  // Halvings of the first of the shorter steps that are solved after a failure.
  static constexpr int kHalvings = 12;
};

}  // namespace

Membranes::Membranes(std::span<const Membrane> membranes) : membranes_(membranes), first_{0} {
  for (const auto& membrane : membranes) {
    curves_.emplace_back(membrane.count());
    first_.push_back(first_.back() + membrane.count());
  }
}

Eigen::VectorXd Membranes::places(std::span<const double> positions, const PeriodicCell& cell,
                                  const Eigen::VectorXd* near) const {
  assert(near == nullptr || near->size() == 2 * beads());
  auto all = from_particles(positions, 2);
  for (std::size_t m = 0; m < membranes_.size(); ++m)
    for (Eigen::Index d = 0; d < 2; ++d) {
      const double period = cell.lengths[static_cast<std::size_t>(d)];
      if (!(period > 0)) continue;
      const auto begin = d * beads() + first_[m];
      if (near != nullptr)
        all(begin) -= period * std::round((all(begin) - (*near)(begin)) / period);
      for (Eigen::Index k = begin + 1; k < begin + membranes_[m].count(); ++k)
        all(k) -= period * std::round((all(k) - all(k - 1)) / period);
    }
  return all;
}

Eigen::VectorXd Membranes::from_particles(std::span<const double> numbers,
                                          std::size_t components) const {
  assert(components >= 2);
  Eigen::VectorXd all(2 * beads());
  for (std::size_t m = 0; m < membranes_.size(); ++m)
    for (Eigen::Index k = 0; k < membranes_[m].count(); ++k) {
      const auto at = components * index_of(membranes_[m].beads[static_cast<std::size_t>(k)]);
      assert(at + 1 < numbers.size());
      all(first_[m] + k) = numbers[at];
      all(beads() + first_[m] + k) = numbers[at + 1];
    }
  return all;
}

void Membranes::to_particles(const Eigen::VectorXd& all, std::size_t components,
                             std::vector<double>& numbers) const {
  assert(components >= 2 && all.size() == 2 * beads());
  for (std::size_t m = 0; m < membranes_.size(); ++m)
    for (Eigen::Index k = 0; k < membranes_[m].count(); ++k) {
      const auto at = components * index_of(membranes_[m].beads[static_cast<std::size_t>(k)]);
      assert(at + 1 < numbers.size());
      numbers[at] = all(first_[m] + k);
      numbers[at + 1] = all(beads() + first_[m] + k);
    }
}

Eigen::VectorXd Membranes::of(std::size_t m, const Eigen::VectorXd& all) const {
  assert(m < curves_.size() && all.size() == 2 * beads());
  const auto n = first_[m + 1] - first_[m];
  Eigen::VectorXd own(2 * n);
  own << all.segment(first_[m], n), all.segment(beads() + first_[m], n);
  return own;
}

void Membranes::put(std::size_t m, const Eigen::VectorXd& own, Eigen::VectorXd& all) const {
  assert(m < curves_.size() && all.size() == 2 * beads());
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

Eigen::MatrixXd Membranes::stiffness(const Eigen::VectorXd& positions,
                                     const MembraneMotion& motion) const {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(2 * beads(), 2 * beads());
  for (std::size_t m = 0; m < curves_.size(); ++m) {
    const auto n = first_[m + 1] - first_[m];
    const Eigen::MatrixXd own =
        membranes_[m].bending_rigidity * curves_[m].bending_hessian(of(m, positions)) +
        curves_[m].speeds_hessian(of(m, positions), motion.tension.segment(first_[m], n)) +
        motion.pressure(static_cast<Eigen::Index>(m)) * curves_[m].area_hessian();
    for (Eigen::Index i = 0; i < 2; ++i)
      for (Eigen::Index j = 0; j < 2; ++j)
        stiffness.block(i * beads() + first_[m], j * beads() + first_[m], n, n) =
            own.block(i * n, j * n, n, n);
  }
  return stiffness;
}

MembraneMotion Membranes::motion_at(const Eigen::VectorXd& positions,
                                    const FluidAnswer& answer) const {
  assert(positions.size() == 2 * beads());
  const Eigen::MatrixXd rows = speed_rows(positions);
  MembraneMotion motion;
  motion.forces = bending_forces(positions);
  const Eigen::VectorXd free = answer.flow + answer.mobility * motion.forces;
  const Eigen::MatrixXd answers = answer.mobility * rows.transpose();
  // The tension of a circle is not unique, because a constant tension acts like a pressure inside.
  // This decomposition then finds the tension with the least sum of squares.
  const Eigen::MatrixXd rates = rows * answers;
  const Eigen::VectorXd of_free = rows * free;
  const Eigen::VectorXd tension = rates.completeOrthogonalDecomposition().solve(of_free);
  motion.forces -= rows.transpose() * tension;
  motion.velocities = free - answers * tension;
  return motion;
}

Eigen::MatrixXd Membranes::area_columns(const Eigen::VectorXd& positions) const {
  const auto count = static_cast<Eigen::Index>(curves_.size());
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(2 * beads(), count);
  for (std::size_t m = 0; m < curves_.size(); ++m) {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(2 * beads());
    put(m, curves_[m].area_row(of(m, positions)), column);
    columns.col(static_cast<Eigen::Index>(m)) = column;
  }
  return columns;
}

Eigen::MatrixXd Membranes::step_matrix(double time, const FluidAnswer& answer,
                                       const Eigen::VectorXd& positions,
                                       const MembraneMotion& motion, double unit) const {
  const auto n = beads(), count = static_cast<Eigen::Index>(curves_.size());
  const Eigen::MatrixXd moves = time * answer.mobility;
  const Eigen::MatrixXd rows = speed_rows(positions), areas = area_columns(positions);
  const Eigen::MatrixXd of_forces = stiffness(positions, motion);
  const Eigen::VectorXd lengths = areas.colwise().norm();
  const Eigen::MatrixXd scaled_areas = areas * lengths.cwiseInverse().asDiagonal();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * n + count, 3 * n + count);
  matrix.topLeftCorner(2 * n, 2 * n) = Eigen::MatrixXd::Identity(2 * n, 2 * n) + moves * of_forces;
  matrix.block(0, 2 * n, 2 * n, n) = unit * moves * rows.transpose();
  matrix.topRightCorner(2 * n, count) = unit * moves * scaled_areas;
  matrix.block(2 * n, 0, n, 2 * n) = rows;
  // These rows demand that flow_forces do no work when the area of a membrane changes.
  matrix.bottomLeftCorner(count, 2 * n) = scaled_areas.transpose() * of_forces / unit;
  for (std::size_t m = 0; m < curves_.size(); ++m) {
    const auto row = static_cast<Eigen::Index>(m);
    Eigen::VectorXd turned = Eigen::VectorXd::Zero(2 * n);
    put(m, curves_[m].area_hessian() * of(m, motion.flow_forces), turned);
    matrix.row(3 * n + row).head(2 * n) -= turned.transpose() / (unit * lengths(row));
  }
  matrix.block(3 * n, 2 * n, count, n) = scaled_areas.transpose() * rows.transpose();
  matrix.bottomRightCorner(count, count).setIdentity();
  return matrix;
}

bool Membranes::solve_step(const Eigen::VectorXd& from, double time, const FluidAnswer& answer,
                           Eigen::VectorXd& positions, MembraneMotion& motion) const {
  const auto n = beads(), count = static_cast<Eigen::Index>(curves_.size());
  // A force on a bead moves it by about this force over `unit` in the step.
  const double unit = static_cast<double>(2 * n) / (time * answer.mobility.trace());
  Eigen::VectorXd wanted(n);
  double size = 0;
  for (std::size_t m = 0; m < curves_.size(); ++m) {
    const double speed = membranes_[m].perimeter / kTwoPi;
    wanted.segment(first_[m], first_[m + 1] - first_[m]).setConstant(speed);
    size = std::max(size, speed);
  }
  double last = std::numeric_limits<double>::infinity();
  for (int round = 0; round < MembraneStepTuning::kMostRounds; ++round) {
    const Eigen::MatrixXd areas = area_columns(positions);
    const Eigen::VectorXd lengths = areas.colwise().norm();
    motion.forces = bending_forces(positions) - speed_rows(positions).transpose() * motion.tension;
    motion.flow_forces = motion.forces - areas * motion.pressure;
    Eigen::VectorXd missing(3 * n + count);
    missing.head(2 * n) =
        from + time * (answer.flow + answer.mobility * motion.flow_forces) - positions;
    for (std::size_t m = 0; m < curves_.size(); ++m) {
      const auto beads_of_m = first_[m + 1] - first_[m];
      missing.segment(2 * n + first_[m], beads_of_m) =
          wanted.segment(first_[m], beads_of_m) - curves_[m].speeds(of(m, positions));
    }
    missing.tail(count) = (areas.transpose() * motion.flow_forces).cwiseQuotient(lengths) / unit;
    const Eigen::VectorXd change =
        step_matrix(time, answer, positions, motion, unit).partialPivLu().solve(missing);
    if (!change.allFinite()) return false;
    positions += change.head(2 * n);
    motion.tension += unit * change.segment(2 * n, n);
    motion.pressure += unit * change.tail(count).cwiseQuotient(lengths);
    const double changed = change.head(2 * n).lpNorm<Eigen::Infinity>() / size;
    if (changed < MembraneStepTuning::kExact ||
        (changed < MembraneStepTuning::kRounding && changed > last / 2))
      return true;
    last = changed;
  }
  return false;
}

MembraneMotion Membranes::step(const Eigen::VectorXd& from, double time, const FluidAnswer& answer,
                               const Eigen::VectorXd& loads, Eigen::VectorXd& positions) const {
  assert(time > 0);
  assert(from.size() == 2 * beads() && loads.size() == 2 * beads());
  assert(positions.size() == 2 * beads());
  const Eigen::VectorXd guess = positions;
  const FluidAnswer loaded{answer.flow + answer.mobility * loads, answer.mobility};
  MembraneMotion motion;
  const auto begin = [&] {
    positions = guess;
    motion.tension = Eigen::VectorXd::Zero(beads());
    motion.pressure = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(curves_.size()));
  };
  begin();
  bool is_solved = solve_step(from, time, loaded, positions, motion);
  if (!is_solved) {
    // Newton's method may fail if a stiff membrane is far from its equilibrium. Then steps of the
    // lengths time/2^kHalvings, ..., time/2, time are solved, each with the solution of the shorter
    // one as its first guess.
    begin();
    is_solved = true;
    for (int halvings = MembraneStepTuning::kHalvings; halvings >= 0 && is_solved; --halvings)
      is_solved = solve_step(from, std::ldexp(time, -halvings), loaded, positions, motion);
  }
  motion.forces =
      loads + bending_forces(positions) - speed_rows(positions).transpose() * motion.tension;
  motion.flow_forces = motion.forces - area_columns(positions) * motion.pressure;
  motion.velocities = answer.flow + answer.mobility * motion.flow_forces;
  for (std::size_t m = 0; m < curves_.size() && is_solved; ++m) {
    auto own = of(m, positions);
    is_solved =
        restore_lengths_and_area(curves_[m], membranes_[m].perimeter, membranes_[m].area, own);
    put(m, own, positions);
  }
  if (!is_solved)
    throw Error(ErrorKind::kNotConverged,
                "a step of the membranes does not converge; use a shorter time_step, in particular "
                "if a membrane is nearly round");
  return motion;
}

LoadResponse Membranes::response(double time, const FluidAnswer& answer,
                                 const Eigen::VectorXd& loads, const MembraneMotion& motion,
                                 const Eigen::VectorXd& positions,
                                 const Eigen::MatrixXd& moves) const {
  assert(time > 0 && loads.size() == 2 * beads() && moves.rows() == 2 * beads());
  const auto n = beads(), count = static_cast<Eigen::Index>(curves_.size());
  const double unit = static_cast<double>(2 * n) / (time * answer.mobility.trace());
  MembraneMotion unloaded = motion;
  unloaded.flow_forces -= loads;
  const Eigen::MatrixXd matrix = step_matrix(time, answer, positions, unloaded, unit);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(matrix.rows(), moves.cols());
  right.topRows(2 * n) = moves;
  const Eigen::MatrixXd solved = matrix.partialPivLu().solve(right);
  const Eigen::MatrixXd areas = area_columns(positions);
  const Eigen::VectorXd lengths = areas.colwise().norm();
  LoadResponse response;
  response.positions = solved.topRows(2 * n);
  response.forces =
      -(stiffness(positions, motion) * response.positions +
        unit * speed_rows(positions).transpose() * solved.middleRows(2 * n, n) +
        unit * (areas * lengths.cwiseInverse().asDiagonal()) * solved.bottomRows(count));
  return response;
}

}  // namespace viscontact::particles
