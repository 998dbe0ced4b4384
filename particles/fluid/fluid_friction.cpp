// Solves Coulomb's law of contacts in a fluid (fluid_friction.hpp) in turn with their gaps: given
// friction shifts the velocities without contact, for which solve_listed() keeps gaps open and finds
// the pairs that take part; then solve_constraints() finds both impulses of all of them together, as
// for particles without a fluid, with a root of W in place of masses. Numbers are in the units of the case. Errors
// are those of the mobility. A change must end with gaps that are exact for the friction found.
#include "viscontact/particles/fluid/fluid_friction.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include "viscontact/particles/constraints/constraint_solver.hpp"
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::particles {
namespace {

using Eigen::Index;

/// The problem of all contacts together is solved to this share of what is allowed, because its
/// velocities are sums of rounded answers of the fluid.
constexpr double kShareOfAllowed = 0.1;

/// The sides of a box that are walls, as numbers of SideVelocities, in the order of obstacles.
std::vector<std::size_t> sides_of(const BoxDomain& box) {
  std::vector<std::size_t> sides;
  for (std::size_t d = 0; d < 2; ++d)
    if (!box.periodic[d]) sides.insert(sides.end(), {2 * d, 2 * d + 1});
  return sides;
}

/// Mean velocity, over the step, of the wall that is obstacle number `wall`, at `point` [L/T]. Only
/// its part along the wall matters; that of a parabola and of an open side is 0.
std::array<double, 2> velocity_of_wall(const Setting& setting, std::size_t wall,
                                       const Vector& point, double begin, double end) {
  const auto& boundary = setting.fluid->boundary;
  if (const auto* flow = std::get_if<LinearFlow>(&boundary)) {
    const auto& e = flow->gradient;
    return {e[0] * point[0] + e[1] * point[1], e[2] * point[0] + e[3] * point[1]};
  }
  const auto side = sides_of(std::get<BoxDomain>(setting.domain))[wall];
  const auto& velocity = std::get<SideVelocities>(boundary)[side];
  if (velocity.kind != WallVelocity::Kind::kConstant) return {};
  return velocity.at((begin + end) / 2, begin, end);
}

/// The residual of Coulomb's law as a length: the friction misses the projection of p_t - slip/w on
/// [-mu_s p_s, mu_s p_s] by the residual over w [L].
double residual_of_friction(double p_t, double bound, double slip, double w) {
  if (bound == 0 && p_t == 0) return 0;
  return w * std::abs(p_t - std::clamp(p_t - slip / w, -bound, bound));
}

/// The residual that is allowed for the friction of a contact with its `allowed` set [L].
double allowed_for(const ContactFrictionInFluid& friction, const Contact<2>& contact,
                   const ContactConditions& conditions) {
  const double largest = conditions.solver.tolerance * conditions.mean_radius / 2;
  if (!(contact.w > 0)) return largest;
  return std::min(largest, contact.allowed * std::max(1.0, friction.w / contact.w));
}

/// The rows of all contacts that take part: y = q + W p are their gaps and slips after the step for
/// the impulses p.
struct CoupledRows {
  std::vector<double> q;                            ///< [L]
  std::vector<double> p;                            ///< [M L/T]
  std::vector<const std::vector<double>*> answers;  ///< velocities by a unit force of each row
  std::vector<ConstraintBlock> blocks;              ///< one for each contact
};

/// Adds the rows of the blocks to a problem whose units stand for W = L L^T: each three numbers of a
/// row of L are the coefficients of a unit that an impulse 1 moves by 1. What is left of W because of
/// rounding errors, the directions that no impulse moves, is left out.
void add_rows(const Eigen::MatrixXd& w, std::span<const double> offsets,
              std::span<const double> guesses, ConstraintProblem<2>& problem) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(w);
  const double least = std::numeric_limits<double>::epsilon() * modes.eigenvalues().maxCoeff();
  const Eigen::VectorXd roots = modes.eigenvalues().cwiseMax(least).cwiseSqrt();
  const Eigen::MatrixXd root = modes.eigenvectors() * roots.asDiagonal();
  constexpr Index kOfUnit = 3;
  const Index units = (root.cols() + kOfUnit - 1) / kOfUnit;
  RigidUnit<2> unit;
  unit.mobility = unit.inverse_mobility = 1;
  unit.turn_mobility = unit.inverse_turn_mobility = {1};
  problem.units.assign(static_cast<std::size_t>(units), unit);
  std::vector<RowPart<2>> parts(static_cast<std::size_t>(units));
  for (Index r = 0; r < root.rows(); ++r) {
    for (Index u = 0; u < units; ++u) {
      auto& part = parts[static_cast<std::size_t>(u)];
      part = {static_cast<std::int32_t>(u), {}};
      for (Index k = 0; k < kOfUnit && kOfUnit * u + k < root.cols(); ++k)
        part.coefficients[static_cast<std::size_t>(k)] = root(r, kOfUnit * u + k);
    }
    problem.add_row(offsets[static_cast<std::size_t>(r)], parts,
                    guesses[static_cast<std::size_t>(r)]);
  }
}

/// Improves the impulses of the rows with the matrix W, whose skew part, which is not 0 in a fluid
/// with inertia, acts as an offset. Returns the number of iterations.
int improve(const Eigen::MatrixXd& w, CoupledRows& rows, int most) {
  const Eigen::MatrixXd symmetric = (w + w.transpose()) / 2, skew = w - symmetric;
  // Each round divides the error of the skew part by about the ratio of both parts.
  constexpr int kRounds = 40;
  int iterations = 0;
  for (int round = 0; round < kRounds && iterations < most; ++round) {
    const Eigen::Map<const Eigen::VectorXd> q(rows.q.data(), std::ssize(rows.q));
    const Eigen::VectorXd before =
        Eigen::Map<const Eigen::VectorXd>(rows.p.data(), std::ssize(rows.p));
    const Eigen::VectorXd offsets = q + skew * before;
    ConstraintProblem<2> problem;
    problem.blocks = rows.blocks;
    add_rows(symmetric, {offsets.data(), rows.q.size()}, rows.p, problem);
    const auto solution =
        solve_constraints(problem, most - iterations, ConstraintStart::kLeastImpulses);
    iterations += solution.result.iterations;
    rows.p = problem.impulses;
    const Eigen::VectorXd change =
        skew * (Eigen::Map<const Eigen::VectorXd>(rows.p.data(), std::ssize(rows.p)) - before);
    double allowed = std::numeric_limits<double>::infinity();
    for (const auto& block : rows.blocks) allowed = std::min(allowed, block.allowed);
    if (change.cwiseAbs().maxCoeff() <= allowed) break;
  }
  return iterations;
}

/// The friction of a step, with the answers of the mobility so far.
class FrictionSolver {
 public:
  FrictionSolver(StepContacts& step, double mu_s, const Mobility& mobility,
                 const ContactConditions& conditions)
      : step_(step),
        mu_s_(mu_s),
        mobility_(mobility),
        conditions_(conditions),
        of_gaps_(step.contacts.size()),
        of_slips_(step.frictions.size()) {}

  void solve() {
    constexpr int kMostRounds = 30;
    for (int round = 0;; ++round) {
      solve_gaps();
      if (obeys_coulomb()) return;
      if (round == kMostRounds || step_.iterations >= conditions_.solver.max_iterations) break;
      solve_together();
    }
    step_.is_solved = false;
  }

 private:
  const Contact<2>& contact_of(const ContactFrictionInFluid& friction) const {
    return step_.contacts[friction.contact];
  }

  /// The gaps with the present friction.
  void solve_gaps() {
    std::vector<double> loads(conditions_.free_velocities.size());
    bool is_any = false;
    for (const auto& friction : step_.frictions) {
      if (friction.impulse == 0) continue;
      is_any = true;
      friction.add_force(contact_of(friction), friction.impulse / conditions_.h, loads,
                         conditions_.layout);
    }
    std::vector<double> free(conditions_.free_velocities.begin(),
                             conditions_.free_velocities.end());
    if (is_any) {
      const auto added = mobility_(loads);
      for (std::size_t i = 0; i < free.size(); ++i) free[i] += added[i];
    }
    auto conditions = conditions_;
    conditions.free_velocities = free;
    solve_listed(step_, mobility_, conditions);
    for (std::size_t i = 0; i < loads.size(); ++i) step_.loads[i] += loads[i];
    set_allowed(step_.contacts, conditions);
  }

  /// Whether the law holds within the tolerances. Asks for the tangential mobility of the contacts
  /// for which it is needed.
  bool obeys_coulomb() {
    bool obeys = true;
    for (std::size_t f = 0; f < step_.frictions.size(); ++f) {
      auto& friction = step_.frictions[f];
      const auto& contact = contact_of(friction);
      const double carried = contact.w > 0 ? friction.carried(contact) : 0;
      friction.slides = false;
      if (!(carried > 0) && friction.impulse == 0) continue;
      respond(f);
      const double slip =
          friction.slip(contact, step_.velocities.data(), conditions_.h, conditions_.layout);
      friction.slides = std::abs(friction.impulse - slip / friction.w) > mu_s_ * carried;
      // Half of it is left for the difference between this problem and the final velocities.
      const double allowed = allowed_for(friction, contact, conditions_) / 2;
      obeys = obeys &&
              residual_of_friction(friction.impulse, mu_s_ * carried, slip, friction.w) <= allowed;
    }
    return obeys;
  }

  /// Asks for the velocities by a unit force of friction, unless it is known.
  const std::vector<double>& respond(std::size_t f) {
    auto& friction = step_.frictions[f];
    if (of_slips_[f].empty()) {
      std::vector<double> forces(conditions_.free_velocities.size());
      friction.add_force(contact_of(friction), 1, forces, conditions_.layout);
      of_slips_[f] = mobility_(forces);
      ++step_.iterations;
      friction.w =
          friction.change_of_slip(contact_of(friction), of_slips_[f].data(), conditions_.layout);
    }
    return of_slips_[f];
  }

  /// Improves normal and tangential impulses of all contacts that take part together.
  void solve_together() {
    CoupledRows rows;
    std::vector<std::size_t> contacts, frictions;  // of the blocks; kNone: no friction
    constexpr auto kNone = static_cast<std::size_t>(-1);
    const auto* free = conditions_.free_velocities.data();
    std::size_t f = 0;
    for (std::size_t c = 0; c < step_.contacts.size(); ++c) {
      const auto& contact = step_.contacts[c];
      const bool has_friction = f < step_.frictions.size() && step_.frictions[f].contact == c;
      const auto number = has_friction ? f++ : kNone;
      if (!(contact.w > 0)) {
        if (has_friction) step_.frictions[number].impulse = 0;
        continue;
      }
      ConstraintBlock block;
      block.row = rows.q.size();
      block.lowest = contact.lowest;
      block.allowed = block.allowed_slip = kShareOfAllowed * contact.allowed;
      rows.answers.push_back(&respond_to_gap(c));
      rows.q.push_back(gap_after(contact, free, conditions_.h, conditions_.layout));
      rows.p.push_back(contact.impulse);
      if (has_friction) {
        const auto& friction = step_.frictions[number];
        rows.answers.push_back(&respond(number));
        block.rows = 2;
        block.friction = mu_s_;
        block.capacity = friction.capacity;
        block.allowed_slip = kShareOfAllowed * allowed_for(friction, contact, conditions_);
        rows.q.push_back(friction.slip(contact, free, conditions_.h, conditions_.layout));
        rows.p.push_back(friction.impulse);
      }
      rows.blocks.push_back(block);
      contacts.push_back(c);
      frictions.push_back(number);
    }
    step_.iterations += improve(matrix_of(rows, contacts, frictions), rows,
                                conditions_.solver.max_iterations - step_.iterations);
    for (std::size_t b = 0; b < rows.blocks.size(); ++b) {
      const auto row = rows.blocks[b].row;
      step_.contacts[contacts[b]].impulse = rows.p[row];
      if (frictions[b] != kNone) step_.frictions[frictions[b]].impulse = rows.p[row + 1];
    }
  }

  /// W of the rows: column by column the answers to their unit forces.
  Eigen::MatrixXd matrix_of(const CoupledRows& rows, std::span<const std::size_t> contacts,
                            std::span<const std::size_t> frictions) const {
    const auto n = std::ssize(rows.q);
    Eigen::MatrixXd w(n, n);
    for (Index column = 0; column < n; ++column) {
      const auto* answer = rows.answers[static_cast<std::size_t>(column)]->data();
      for (std::size_t b = 0; b < rows.blocks.size(); ++b) {
        const auto& contact = step_.contacts[contacts[b]];
        const auto row = static_cast<Index>(rows.blocks[b].row);
        w(row, column) = opening(contact, answer, conditions_.layout);
        if (rows.blocks[b].rows > 1)
          w(row + 1, column) =
              step_.frictions[frictions[b]].change_of_slip(contact, answer, conditions_.layout);
      }
    }
    return w;
  }

  const std::vector<double>& respond_to_gap(std::size_t c) {
    if (of_gaps_[c].empty()) {
      std::vector<double> forces(conditions_.free_velocities.size());
      add_contact_force(step_.contacts[c], 1, forces, conditions_.layout);
      of_gaps_[c] = mobility_(forces);
      ++step_.iterations;
    }
    return of_gaps_[c];
  }

  StepContacts& step_;
  double mu_s_;
  const Mobility& mobility_;
  const ContactConditions& conditions_;
  std::vector<std::vector<double>> of_gaps_,
      of_slips_;  // velocities by unit forces; empty: unknown
};

}  // namespace

ContactFrictionInFluid friction_of_contact(const FrictionOfStep& step, const Particles& particles,
                                           const Pair& pair, const Contact<2>& contact,
                                           std::size_t number, const std::array<double, 2>& arms,
                                           const ContactConditions& conditions) {
  const auto& setting = step.setting;
  ContactFrictionInFluid friction{number, {-contact.normal[1], contact.normal[0]}};
  friction.levers = {-arms[0], -arms[1]};
  const double lowest =
      setting.laws.lowest_gamma(pair, step.memories.of(pair.memory),
                                radii_in_fluid(*setting.fluid, pair, particles, step.obstacles));
  friction.capacity = (pair.gamma - lowest) / conditions.share_of_impulse;
  const Vector before = step.memories.of(pair.memory).friction();
  const auto along = [&](const Vector& x) {
    return friction.tangent[0] * x[0] + friction.tangent[1] * x[1];
  };
  friction.impulse = along(before) / conditions.share_of_impulse;
  const double h = conditions.h;
  if (pair.first >= 0) {
    if (pair.image != 0) friction.way = h * along(velocity_of_image(particles.cell, pair.image));
    return friction;
  }
  const Vector normal{contact.normal[0], contact.normal[1], 0};
  const auto j = index_of(pair.second);
  const Vector centre = particles.position(j);
  const Vector point = centre - (arms[1] + contact.gap) * normal;
  const auto walls = step.obstacles.size() - setting.planes.size();
  if (pair.plane() < walls) {
    const auto velocity = velocity_of_wall(setting, pair.plane(), point, step.begin, step.end);
    friction.way = -h * along({velocity[0], velocity[1], 0});
  } else {
    friction.way = -along(step.obstacles[pair.plane()].displacement(point, step.begin, step.end));
  }
  return friction;
}

void solve_with_friction(StepContacts& step, double mu_s, const Mobility& mobility,
                         const ContactConditions& conditions) {
  FrictionSolver(step, mu_s, mobility, conditions).solve();
}

void take_residuals_of_friction(const StepContacts& step, double mu_s,
                                std::span<const double> velocities,
                                const ContactConditions& conditions, StepResiduals& residuals) {
  for (const auto& friction : step.frictions) {
    const auto& contact = step.contacts[friction.contact];
    if (!(contact.w > 0)) continue;
    const double slip = friction.slip(contact, velocities.data(), conditions.h, conditions.layout);
    residuals.take(
        residual_of_friction(friction.impulse, mu_s * friction.carried(contact), slip, friction.w),
        allowed_for(friction, contact, conditions));
  }
}

}  // namespace viscontact::particles
