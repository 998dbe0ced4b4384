// Solves Coulomb's law of contacts in a fluid, docs/physics.md (6.14): the friction is at most
// mu_s >= 0, its coefficient, times the load of the solids, and equal to this bound if they slide.
// There are rounds of two parts. First solve_listed() finds the normal impulses that keep the gaps
// open with the friction found so far, and adds contacts whose gaps would close. Then, if the law
// does not hold yet, solve_constraints() finds the normal and tangential impulses of all these
// contacts together. Impulses are in [M L/T], gaps and slips in [L], velocities of all particles in
// [L/T, 1/T], 3 numbers for each. Only the errors of the mobility are thrown; if the law is not
// reached, StepContacts::is_solved is false. fluid_contacts.cpp, fluid_acceptance.cpp and
// fluid_simulation.cpp use this file. A change must keep that each solution ends with the first
// part, so that gaps are exact for the friction found.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/particles/constraints/constraint_solver.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/fluid/closed_contacts.hpp"
#include "viscontact/particles/fluid/fluid_contacts.hpp"

namespace viscontact::particles {
namespace {

using Eigen::Index;

/// The problem of all contacts together is solved to this share of the allowed residuals. The rest
/// is left for errors of its velocities, which are sums of rounded velocities of the fluid solver.
/// Any share well below 1 works.
constexpr double kShareOfAllowed = 0.1;

/// The sides of a box that are walls, as indices of SideVelocities (0 left, 1 right, 2 bottom, 3
/// top), in the order in which the walls are obstacles.
std::vector<std::size_t> walls_of(const BoxDomain& box) {
  std::vector<std::size_t> sides;
  for (std::size_t d = 0; d < 2; ++d)
    if (!box.periodic[d]) sides.insert(sides.end(), {2 * d, 2 * d + 1});
  return sides;
}

/// Mean velocity [L/T] of the wall with the number `wall` among the obstacles, at `point` [L], from
/// the time `begin` to `end` [T]. The caller uses the component along the wall only. This component
/// is 0 on an open side, and on a side with a parabolic velocity, which is normal to the side.
std::array<double, 2> velocity_of_wall(const Setting& setting, std::size_t wall,
                                       const Vector& point, double begin, double end) {
  const auto& boundary = setting.fluid->boundary;
  if (const auto* flow = std::get_if<LinearFlow>(&boundary)) {
    const auto& e = flow->gradient;
    return {e[0] * point[0] + e[1] * point[1], e[2] * point[0] + e[3] * point[1]};
  }
  const auto side = walls_of(std::get<BoxDomain>(setting.domain))[wall];
  const auto& velocity = std::get<SideVelocities>(boundary)[side];
  if (velocity.kind != WallVelocity::Kind::kConstant) return {};
  return velocity.at((begin + end) / 2, begin, end);
}

/// The residual of Coulomb's law as a length [L]: w times the difference between the friction p_t
/// and the projection of p_t - slip/w on [-bound, bound]; w [T/M] is the change of the slip per
/// impulse of friction.
double residual_of_friction(double p_t, double bound, double slip, double w) {
  if (bound == 0 && p_t == 0) return 0;
  return w * std::abs(p_t - std::clamp(p_t - slip / w, -bound, bound));
}

/// The residual [L] that is allowed for the friction of a contact, > 0. Contact::allowed must be
/// set.
double allowed_for(const ContactFrictionInFluid& friction, const Contact<2>& contact,
                   const ContactConditions& conditions) {
  const double largest = conditions.solver.tolerance * conditions.mean_radius / 2;
  if (!(contact.w > 0)) return largest;
  return std::min(largest, contact.allowed * std::max(1.0, friction.w / contact.w));
}

/// The rows of all contacts of the step: for each contact a gap and, with friction, a slip. With
/// the impulses p of the rows, gaps and slips after the step are q + W p (W: see matrix_of()).
struct CoupledRows {
  std::vector<double> q;                            ///< gaps and slips without contact [L]
  std::vector<double> p;                            ///< normal and tangential impulses [M L/T]
  std::vector<const std::vector<double>*> answers;  ///< velocities by a unit force of each row
  std::vector<ConstraintBlock> blocks;              ///< one for each contact
};

/// The eigenvectors of a symmetric matrix W with a positive diagonal that is known up to a relative
/// error, after its rows and columns were scaled to the diagonal 1. Eigenvectors whose eigenvalue
/// is 0 within the error are called unmoved: no impulse changes the sum of the rows, each divided
/// by (W_rr)^(1/2), with the entries of such a vector as weights.
struct MovedDirections {
  Eigen::MatrixXd root;     ///< a matrix L with W = L L^T within the error
  Eigen::MatrixXd unmoved;  ///< the unmoved eigenvectors, as columns
  Eigen::VectorXd scales;   ///< square roots of the diagonal entries W_rr

  /// `w` is W [T/M], and `error` > 0 [1] its relative error.
  MovedDirections(const Eigen::MatrixXd& w, double error) : scales(w.diagonal().cwiseSqrt()) {
    const Eigen::MatrixXd scaled = w.cwiseQuotient(scales * scales.transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(scaled);
    const double least = error * modes.eigenvalues().maxCoeff();
    const auto count = (modes.eigenvalues().array() <= least).count();  // they come first
    unmoved = modes.eigenvectors().leftCols(count);
    Eigen::VectorXd roots = modes.eigenvalues().cwiseMax(0).cwiseSqrt();
    roots.head(count).setZero();
    root = scales.asDiagonal() * modes.eigenvectors() * roots.asDiagonal();
  }

  /// Removes from the offsets, the gaps and slips without contact [L], the sums with the weights of
  /// unmoved eigenvectors, if the error `rounding` [L] of each offset explains them. Otherwise the
  /// impulses would grow without end, because they cannot change these sums.
  Eigen::VectorXd consistent(const Eigen::VectorXd& offsets, double rounding) const {
    Eigen::VectorXd scaled = offsets.cwiseQuotient(scales);
    for (Index m = 0; m < unmoved.cols(); ++m) {
      const auto mode = unmoved.col(m);
      const double sum = mode.dot(scaled);
      if (std::abs(sum) <= rounding * mode.cwiseAbs().cwiseQuotient(scales).sum())
        scaled -= sum * mode;
    }
    return scaled.cwiseProduct(scales);
  }
};

/// Adds the rows to a problem of solve_constraints() whose matrix is W = root root^T. `offsets` are
/// gaps and slips without contact [L], `guesses` are impulses [M L/T], one number of each for a
/// row. Each column of `root` is an imagined degree of freedom, which a unit impulse moves by a
/// unit length. Three columns each take the place of the degrees of freedom of one RigidUnit.
void add_rows(const Eigen::MatrixXd& root, std::span<const double> offsets,
              std::span<const double> guesses, ConstraintProblem<2>& problem) {
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

/// Improves the impulses rows.p in at most about `most` iterations, and returns the number of
/// iterations. `w` [T/M] has the relative error `error`, and gaps and slips have the error
/// `rounding` [L]. In a fluid with inertia W is not symmetric: its skew part times the impulses of
/// the round before is added to the offsets. With `gives_loads` the friction is bounded by mu_s
/// times the load of the solids in the first guess, docs/physics.md (5.17), not in the solution.
int improve(const Eigen::MatrixXd& w, double error, double rounding, bool gives_loads, int most,
            CoupledRows& rows) {
  const Eigen::MatrixXd symmetric = (w + w.transpose()) / 2, skew = w - symmetric;
  const MovedDirections directions(symmetric, error);
  const auto n = std::ssize(rows.q);
  double allowed = std::numeric_limits<double>::infinity();
  for (const auto& block : rows.blocks) allowed = std::min(allowed, block.allowed);
  // Each round multiplies the error by about the ratio of the skew part to the symmetric part. The
  // limit is a free choice. It is the same as kRoundsOfSkewPart in contact_problem.cpp, which
  // solves the same problem without friction.
  constexpr int kRounds = 40;
  int iterations = 0;
  for (int round = 0; round < kRounds && (gives_loads || iterations < most); ++round) {
    const Eigen::VectorXd before = Eigen::Map<const Eigen::VectorXd>(rows.p.data(), n);
    const auto offsets = directions.consistent(
        Eigen::Map<const Eigen::VectorXd>(rows.q.data(), n) + skew * before, rounding);
    ConstraintProblem<2> problem;
    problem.blocks = rows.blocks;
    add_rows(directions.root, {offsets.data(), rows.q.size()}, rows.p, problem);
    const auto solution = gives_loads ? solve_with_given_loads(problem, false)
                                      : solve_constraints(problem, most - iterations,
                                                          ConstraintStart::kLeastImpulses);
    iterations += solution.result.iterations;
    rows.p = problem.impulses;
    const Eigen::VectorXd change =
        skew * (Eigen::Map<const Eigen::VectorXd>(rows.p.data(), n) - before);
    if (gives_loads || change.cwiseAbs().maxCoeff() <= allowed) break;
  }
  return iterations;
}

/// Solves the friction of a step (solve_with_friction()). It keeps the velocities that unit forces
/// of contacts cause, so that the fluid solver computes each of them once.
class FrictionSolver {
 public:
  /// All references must outlive the object. `mu_s` [1] is >= 0.
  FrictionSolver(StepContacts& step, double mu_s, const Mobility& mobility,
                 const ContactConditions& conditions)
      : step_(step),
        mu_s_(mu_s),
        mobility_(mobility),
        conditions_(conditions),
        of_gaps_(step.contacts.size()),
        of_slips_(step.frictions.size()) {}

  /// Finds the normal and tangential impulses of the step. If Coulomb's law is not reached,
  /// step.is_solved becomes false, and given loads bound the friction.
  void solve() {
    solve_in_rounds();
    share_responses();
  }

 private:
  void share_responses() {
    for (std::size_t c = 0; c < of_gaps_.size(); ++c)
      if (step_.of_gaps[c].empty()) step_.of_gaps[c] = of_gaps_[c];
    step_.of_slips = of_slips_;
  }

  void solve_in_rounds() {
    // One round is enough unless further contacts are added after the round; a packing takes a few
    // more rounds. The limit is a free choice.
    constexpr int kMostRounds = 30;
    double least = std::numeric_limits<double>::infinity();
    auto best = impulses();
    step_.has_given_loads = false;
    for (int round = 0; round < kMostRounds; ++round) {
      solve_gaps(round > 0);
      double excess = excess_of_coulomb();
      if (excess > 1 && round > 0) {
        share_responses();
        correct_impulses(step_, mu_s_, mobility_, conditions_);
        excess = excess_of_coulomb();
      }
      if (excess <= 1) return;
      if (excess < least) {
        least = excess;
        best = impulses();
      }
      if (step_.iterations >= conditions_.solver.max_iterations) break;
      solve_together(false);
    }
    give_up(best);
    step_.is_solved = false;
  }

  /// Normal and tangential impulses of all contacts [M L/T].
  using Impulses = std::pair<std::vector<double>, std::vector<double>>;

  /// Bounds the friction by given loads, docs/physics.md (5.17), after the rounds have not
  /// converged. These are the loads of the solids in the best round (`best`), if the solution with
  /// them nearly obeys Coulomb's law. Otherwise they are the loads of a solution without friction.
  /// The loads of the rounds begin with the loads of the step before, and grow without bound where
  /// friction locks particles that must move.
  void give_up(const Impulses& best) {
    // If the residual is at most kNear times the allowed one, the solution counts as near the law.
    // The number is a free choice.
    constexpr double kNear = 100;
    step_.has_given_loads = true;
    for (auto& contact : step_.contacts) contact.impulse = 0;
    for (auto& friction : step_.frictions) friction.impulse = 0;
    solve_gaps(false);
    const auto without_friction = impulses();
    const double load = largest_load();
    take(best);
    solve_with_given_loads_of_step();
    // Residuals are allowed in proportion to the impulses. The excess is therefore multiplied by
    // the ratio of the loads, so that no residual counts as small because the impulses are large.
    const double excess = excess_of_coulomb() * std::max(1.0, largest_load() / load);
    if (step_.is_solved && excess <= kNear) return;
    take(without_friction);
    solve_with_given_loads_of_step();
    excess_of_coulomb();
  }

  /// Solves the problem in which the loads of the present impulses bound the friction.
  void solve_with_given_loads_of_step() {
    solve_together(true);
    solve_gaps(true);
  }

  /// The largest impulse that solids carry [M L/T].
  double largest_load() const {
    double largest = 0;
    for (const auto& friction : step_.frictions)
      largest = largest_or_nan(largest, friction.carried(contact_of(friction)));
    return largest;
  }

  const Contact<2>& contact_of(const ContactFrictionInFluid& friction) const {
    return step_.contacts[friction.contact];
  }

  /// Finds the normal impulses that keep the gaps open with the present friction. With
  /// `keeps_solution`, impulses that keep the gaps open already are not changed. In redundant
  /// contacts such impulses are not unique, and other ones would change the bounds of friction.
  void solve_gaps(bool keeps_solution) {
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
    conditions.keeps_solution = keeps_solution;
    solve_listed(step_, mobility_, conditions);
    for (std::size_t i = 0; i < loads.size(); ++i) step_.loads[i] += loads[i];
    set_allowed(step_.contacts, conditions_);
  }

  Impulses impulses() const {
    Impulses found;
    for (const auto& contact : step_.contacts) found.first.push_back(contact.impulse);
    for (const auto& friction : step_.frictions) found.second.push_back(friction.impulse);
    return found;
  }
  void take(const Impulses& found) {
    for (std::size_t c = 0; c < found.first.size(); ++c) step_.contacts[c].impulse = found.first[c];
    for (std::size_t f = 0; f < found.second.size(); ++f)
      step_.frictions[f].impulse = found.second[f];
  }

  /// The largest residual of Coulomb's law divided by the allowed one [1]. The law holds if the
  /// result is at most 1. Sets ContactFrictionInFluid::slides, and w of each contact that carries a
  /// load or has friction.
  double excess_of_coulomb() {
    double excess = 0;
    for (std::size_t f = 0; f < step_.frictions.size(); ++f) {
      auto& friction = step_.frictions[f];
      const auto& contact = contact_of(friction);
      const double carried = contact.w > 0 ? friction.carried(contact) : 0;
      friction.slides = 0;
      if (!(carried > 0) && friction.impulse == 0) continue;
      respond(f);
      if (!(friction.w > 0)) {
        if (friction.impulse != 0) excess = std::numeric_limits<double>::infinity();
        continue;
      }
      const double slip =
          friction.slip(contact, step_.velocities.data(), conditions_.h, conditions_.layout);
      const double aim = friction.impulse - slip / friction.w;
      if (std::abs(aim) > mu_s_ * carried) friction.slides = aim > 0 ? 1 : -1;
      // Half of the allowed residual is left for errors of the velocities that the fluid solver
      // computes from the final forces.
      const double allowed = allowed_for(friction, contact, conditions_) / 2;
      const double residual =
          residual_of_friction(friction.impulse, mu_s_ * carried, slip, friction.w);
      excess = largest_or_nan(excess, residual / allowed);
    }
    return excess;
  }

  /// The velocities by a unit force of friction number `f`. Sets w of this friction.
  const std::vector<double>& respond(std::size_t f) {
    auto& friction = step_.frictions[f];
    if (of_slips_[f].empty()) {
      std::vector<double> forces(conditions_.free_velocities.size());
      friction.add_force(contact_of(friction), 1, forces, conditions_.layout);
      of_slips_[f] = mobility_(forces);
      ++step_.iterations;
      friction.w =
          friction.slip_rate(contact_of(friction), of_slips_[f].data(), conditions_.layout);
      // If a hinge holds the point of contact, no force moves this point, and there is no friction.
      if (!(friction.w > conditions_.least_w)) friction.w = 0;
    }
    return of_slips_[f];
  }

  /// Improves the normal and tangential impulses of all contacts of the step, in one problem. With
  /// `gives_loads` the loads of the solids at the present impulses bound the friction.
  void solve_together(bool gives_loads) {
    CoupledRows rows;
    std::vector<std::size_t> contacts, frictions;  // numbers for each block; kNone: no friction
    constexpr auto kNone = static_cast<std::size_t>(-1);
    const auto* free = conditions_.free_velocities.data();
    std::size_t f = 0;
    for (std::size_t c = 0; c < step_.contacts.size(); ++c) {
      const auto& contact = step_.contacts[c];
      auto number = f < step_.frictions.size() && step_.frictions[f].contact == c ? f++ : kNone;
      if (number != kNone && contact.w > 0) respond(number);
      if (number != kNone && !(contact.w > 0 && step_.frictions[number].w > 0)) {
        step_.frictions[number].impulse = 0;
        number = kNone;
      }
      if (!(contact.w > 0)) continue;
      ConstraintBlock block;
      block.row = rows.q.size();
      block.lowest = contact.lowest;
      block.allowed = block.allowed_slip = kShareOfAllowed * contact.allowed;
      rows.answers.push_back(&respond_to_gap(c));
      rows.q.push_back(gap_after(contact, free, conditions_.h, conditions_.layout));
      rows.p.push_back(contact.impulse);
      if (number != kNone) {
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
    // W consists of velocities of the fluid solver and has their relative error.
    const double error =
        std::max(std::numeric_limits<double>::epsilon(), conditions_.velocity_error);
    const double rounding = rounding_error_of_gaps(conditions_);
    const int most = conditions_.solver.max_iterations;
    step_.iterations += improve(matrix_of(rows, contacts, frictions), error, rounding, gives_loads,
                                most - step_.iterations, rows);
    for (std::size_t b = 0; b < rows.blocks.size(); ++b) {
      const auto row = rows.blocks[b].row;
      step_.contacts[contacts[b]].impulse = rows.p[row];
      if (frictions[b] != kNone) step_.frictions[frictions[b]].impulse = rows.p[row + 1];
    }
  }

  /// The matrix W of the rows [T/M]: column c has the rates of all gaps and slips by a unit force
  /// of row c.
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
              step_.frictions[frictions[b]].slip_rate(contact, answer, conditions_.layout);
      }
    }
    return w;
  }

  /// The velocities by a unit force of contact c.
  const std::vector<double>& respond_to_gap(std::size_t c) {
    if (of_gaps_[c].empty()) {
      std::vector<double> forces(conditions_.free_velocities.size());
      add_contact_force(step_.contacts[c], 1, forces, conditions_.layout);
      of_gaps_[c] = mobility_(forces);
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

/// The friction of a contact before the problem is solved. `contact` must have the distance of the
/// surfaces as its gap, and `place` says where the friction acts. The first guess of the impulse is
/// the friction that the pair remembers.
ContactFrictionInFluid friction_of_contact(const FrictionOfStep& step, const Particles& particles,
                                           const Pair& pair, const Contact<2>& contact,
                                           const FrictionPlace& place,
                                           const ContactConditions& conditions) {
  const auto& setting = step.setting;
  ContactFrictionInFluid friction{.tangent = {-contact.normal[1], contact.normal[0]}};
  friction.levers = {pair.first < 0 ? 0 : -place.arms[0], -place.arms[1]};
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
    if (pair.image != 0)
      friction.displacement = h * along(velocity_of_image(particles.cell, pair.image));
    return friction;
  }
  const auto& point = place.on_obstacle;
  const auto walls = step.obstacles.size() - setting.planes.size();
  if (pair.plane() < walls) {
    const auto velocity = velocity_of_wall(setting, pair.plane(), point, step.begin, step.end);
    friction.displacement = -h * along({velocity[0], velocity[1], 0});
  } else {
    friction.displacement =
        -along(step.obstacles[pair.plane()].displacement(point, step.begin, step.end));
  }
  return friction;
}

/// Finds the impulses of the contacts of a step with the friction step.frictions and its
/// coefficient `mu_s` >= 0 [1].
void solve_with_friction(StepContacts& step, double mu_s, const Mobility& mobility,
                         const ContactConditions& conditions) {
  FrictionSolver(step, mu_s, mobility, conditions).solve();
}

/// The power [M L^2/T^3] that friction turns into heat in the step, for the `velocities` of the
/// particles.
double heat_of_friction(const StepContacts& step, std::span<const double> velocities,
                        const ContactConditions& conditions) {
  double heat = 0;
  for (const auto& friction : step.frictions)
    heat -= friction.impulse * friction.slip(step.contacts[friction.contact], velocities.data(),
                                             conditions.h, conditions.layout);
  return heat / (conditions.h * conditions.h);
}

/// Adds the residuals [L] of Coulomb's law to `residuals`, for the `velocities` of the particles
/// with the contact forces.
void take_residuals_of_friction(const StepContacts& step, double mu_s,
                                std::span<const double> velocities,
                                const ContactConditions& conditions, StepResiduals& residuals) {
  for (const auto& friction : step.frictions) {
    const auto& contact = step.contacts[friction.contact];
    // w is 0 if it was not needed, or if a hinge holds the point. There is then no friction.
    if (!(contact.w > 0 && friction.w > 0)) continue;
    const double slip = friction.slip(contact, velocities.data(), conditions.h, conditions.layout);
    residuals.take(
        residual_of_friction(friction.impulse, mu_s * friction.carried(contact), slip, friction.w),
        allowed_for(friction, contact, conditions));
  }
}

}  // namespace viscontact::particles
