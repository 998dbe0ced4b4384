// Coulomb's law of contacts in a fluid, docs/physics.md (6.14). In rounds, the gaps are made exact
// for the friction found so far, and then all impulses are improved together.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include "viscontact/constraint_rows/contact_rows.hpp"
#include "viscontact/contact_solver/dense_constraints.hpp"
#include "viscontact/immersed/contacts/closed_contacts.hpp"
#include "viscontact/immersed/contacts/fluid_contacts.hpp"
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of the rounds.
struct FluidFrictionTuning {
  // The problem of all contacts together is solved to this share of the allowed residuals; the rest
  // is left for errors of its velocities. Any share well below 1 works.
  static constexpr double kShareOfAllowed = 0.1;
  // One round is enough unless further contacts are added after it; a packing takes a few more.
  static constexpr int kMostRounds = 30;
  // Up to this ratio of the residual to the allowed one the solution with given loads counts as
  // near the law.
  static constexpr double kNear = 100;
};

/// The sides of a box that are walls, as indices of SideVelocities, in the order of the obstacles.
std::vector<std::size_t> walls_of(const BoxDomain& box) {
  std::vector<std::size_t> sides;
  for (std::size_t d = 0; d < 2; ++d)
    if (!box.periodic[d]) sides.insert(sides.end(), {2 * d, 2 * d + 1});
  return sides;
}

/// Mean velocity [L/T] of wall number `wall` of the obstacles at `point` [L], from `begin` to `end`
/// [T]. Only its component along the wall is used; this is 0 on an open side, and on a side with a
/// parabolic velocity, which is normal to the side.
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
/// and the projection of p_t - slip/w on [-bound, bound].
double residual_of_friction(double p_t, double bound, double slip, double w) {
  if (bound == 0 && p_t == 0) return 0;
  return w * std::abs(p_t - std::clamp(p_t - slip / w, -bound, bound));
}

/// The residual [L] that is allowed for the friction of a contact; Contact::allowed must be set.
double allowed_for(const ContactFrictionInFluid& friction, const Contact<2>& contact,
                   const ContactConditions& conditions) {
  const double largest = conditions.solver.tolerance * conditions.mean_radius / 2;
  if (!(contact.w > 0)) return largest;
  return std::min(largest, contact.allowed * std::max(1.0, friction.w / contact.w));
}

/// Keeps the velocities that unit forces of contacts cause, so that the fluid solver computes each
/// of them once.
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
    double least = std::numeric_limits<double>::infinity();
    auto best = impulses();
    step_.has_given_loads = false;
    for (int round = 0; round < FluidFrictionTuning::kMostRounds; ++round) {
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

  using Impulses = std::pair<std::vector<double>, std::vector<double>>;

  /// Bounds the friction by given loads, docs/physics.md (5.17): those in the round `best`, if the
  /// solution with them nearly obeys Coulomb's law, otherwise those of a solution without friction.
  /// The loads of the rounds grow without bound where friction locks particles that must move.
  void give_up(const Impulses& best) {
    step_.has_given_loads = true;
    for (auto& contact : step_.contacts) contact.impulse = 0;
    for (auto& friction : step_.frictions) friction.impulse = 0;
    solve_gaps(false);
    const auto without_friction = impulses();
    const double load = largest_load();
    take(best);
    solve_with_given_loads_of_step();
    // Residuals are allowed in proportion to the impulses: none may count as small because the
    // impulses are large.
    const double excess = excess_of_coulomb() * std::max(1.0, largest_load() / load);
    if (step_.is_solved && excess <= FluidFrictionTuning::kNear) return;
    take(without_friction);
    solve_with_given_loads_of_step();
    excess_of_coulomb();
  }

  void solve_with_given_loads_of_step() {
    solve_together(true);
    solve_gaps(true);
  }

  double largest_load() const {
    double largest = 0;
    for (const auto& friction : step_.frictions)
      largest = largest_or_nan(largest, friction.solid_load(contact_of(friction)));
    return largest;
  }

  const Contact<2>& contact_of(const ContactFrictionInFluid& friction) const {
    return step_.contacts[friction.contact];
  }

  /// Finds the normal impulses that keep the gaps open with the present friction. With
  /// `keeps_solution`, impulses that do so already stay: in redundant contacts they are not unique,
  /// and other ones would change the bounds of friction.
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

  /// The largest residual of Coulomb's law over the allowed one [1]. Sets
  /// ContactFrictionInFluid::slides, and w of each contact that carries a load or has friction.
  double excess_of_coulomb() {
    double excess = 0;
    for (std::size_t f = 0; f < step_.frictions.size(); ++f) {
      auto& friction = step_.frictions[f];
      const auto& contact = contact_of(friction);
      const double solid_load = contact.w > 0 ? friction.solid_load(contact) : 0;
      friction.slides = 0;
      if (!(solid_load > 0) && friction.impulse == 0) continue;
      respond(f);
      if (!(friction.w > 0)) {
        if (friction.impulse != 0) excess = std::numeric_limits<double>::infinity();
        continue;
      }
      const double slip =
          friction.slip(contact, step_.velocities.data(), conditions_.h, conditions_.layout);
      const double aim = friction.impulse - slip / friction.w;
      if (std::abs(aim) > mu_s_ * solid_load) friction.slides = aim > 0 ? 1 : -1;
      // Half of the allowed residual is left for errors of the velocities that the fluid solver
      // computes from the final forces.
      const double allowed = allowed_for(friction, contact, conditions_) / 2;
      const double residual =
          residual_of_friction(friction.impulse, mu_s_ * solid_load, slip, friction.w);
      excess = largest_or_nan(excess, residual / allowed);
    }
    return excess;
  }

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

  /// Improves the normal and tangential impulses of all contacts in one problem. With `gives_loads`
  /// the loads of the solids at the present impulses bound the friction.
  void solve_together(bool gives_loads) {
    // A gap and, with friction, a slip for each contact.
    DenseConstraints problem;
    std::vector<const std::vector<double>*> answers;  // velocities by a unit force of each row
    std::vector<std::size_t> contacts, frictions;     // numbers for each block; kNone: no friction
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
      block.row = problem.offsets.size();
      block.lowest = contact.lowest;
      block.allowed = block.allowed_slip = FluidFrictionTuning::kShareOfAllowed * contact.allowed;
      answers.push_back(&respond_to_gap(c));
      problem.offsets.push_back(gap_after(contact, free, conditions_.h, conditions_.layout));
      problem.impulses.push_back(contact.impulse);
      if (number != kNone) {
        const auto& friction = step_.frictions[number];
        answers.push_back(&respond(number));
        block.rows = 2;
        block.friction = mu_s_;
        block.capacity = friction.capacity;
        block.allowed_slip =
            FluidFrictionTuning::kShareOfAllowed * allowed_for(friction, contact, conditions_);
        problem.offsets.push_back(friction.slip(contact, free, conditions_.h, conditions_.layout));
        problem.impulses.push_back(friction.impulse);
      }
      problem.blocks.push_back(block);
      contacts.push_back(c);
      frictions.push_back(number);
    }
    // W has the relative error of the velocities.
    problem.error = std::max(std::numeric_limits<double>::epsilon(), conditions_.velocity_error);
    problem.rounding = rounding_error_of_gaps(conditions_);
    set_w(answers, contacts, frictions, problem);
    const auto solved = solve_dense_constraints(
        problem, conditions_.solver.max_iterations - step_.iterations, gives_loads);
    step_.iterations += solved.iterations;
    step_.stages += solved.stages;
    for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
      const auto row = problem.blocks[b].row;
      step_.contacts[contacts[b]].impulse = problem.impulses[row];
      if (frictions[b] != kNone) step_.frictions[frictions[b]].impulse = problem.impulses[row + 1];
    }
  }

  /// Column c of W has the rates of all gaps and slips by a unit force of row c, its answer.
  void set_w(std::span<const std::vector<double>* const> answers,
             std::span<const std::size_t> contacts, std::span<const std::size_t> frictions,
             DenseConstraints& problem) const {
    const auto n = answers.size();
    problem.w.resize(n * n);
    for (std::size_t column = 0; column < n; ++column) {
      const auto* answer = answers[column]->data();
      for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
        const auto& contact = step_.contacts[contacts[b]];
        const auto& block = problem.blocks[b];
        problem.w[block.row * n + column] = opening(contact, answer, conditions_.layout);
        if (block.rows > 1)
          problem.w[(block.row + 1) * n + column] =
              step_.frictions[frictions[b]].slip_rate(contact, answer, conditions_.layout);
      }
    }
  }

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

ContactFrictionInFluid friction_of_contact(const FrictionOfStep& step, const Particles& particles,
                                           const Pair& pair, const Contact<2>& contact,
                                           const FrictionPlace& place, const PairRadii& radii,
                                           const ContactConditions& conditions) {
  assert(step.end > step.begin);
  const auto& setting = step.setting;
  ContactFrictionInFluid friction{.tangent = {-contact.normal[1], contact.normal[0]}};
  friction.levers = {pair.first < 0 ? 0 : -place.arms[0], -place.arms[1]};
  const double lowest = setting.laws.lowest_gamma(pair, step.memories.of(pair.memory), radii);
  // Where the surface of a particle that rolls is curved more, gamma_min is nearer to 0.
  friction.capacity = std::max(0.0, pair.gamma - lowest) / conditions.share_of_impulse;
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

void solve_with_friction(StepContacts& step, double mu_s, const Mobility& mobility,
                         const ContactConditions& conditions) {
  assert(mu_s >= 0 && (step.frictions.empty() || conditions.layout.components == 3));
  FrictionSolver(step, mu_s, mobility, conditions).solve();
}

double heat_of_friction(const StepContacts& step, std::span<const double> velocities,
                        const ContactConditions& conditions) {
  double heat = 0;
  for (const auto& friction : step.frictions)
    heat -= friction.impulse * friction.slip(step.contacts[friction.contact], velocities.data(),
                                             conditions.h, conditions.layout);
  return heat / (conditions.h * conditions.h);
}

void take_residuals_of_friction(const StepContacts& step, double mu_s,
                                std::span<const double> velocities,
                                const ContactConditions& conditions, StepResiduals& residuals) {
  for (const auto& friction : step.frictions) {
    const auto& contact = step.contacts[friction.contact];
    // w is 0 if it was not needed, or if a hinge holds the point. There is then no friction.
    if (!(contact.w > 0 && friction.w > 0)) continue;
    const double slip = friction.slip(contact, velocities.data(), conditions.h, conditions.layout);
    residuals.take(residual_of_friction(friction.impulse, mu_s * friction.solid_load(contact), slip,
                                        friction.w),
                   allowed_for(friction, contact, conditions));
  }
}

}  // namespace viscontact::particles
