// The local solutions of (5.7), (5.9) and (5.17), docs/physics.md, and the extrapolation.
#include "viscontact/contact_solver/methods/accelerated_sweeps.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "viscontact/contact_solver/problem/contact_conditions.hpp"

namespace viscontact::contact_solver {
namespace {

struct SweepTuning {
  // Errors of directions and arms, relative, which rounding may cause.
  static constexpr double kRounding = 1e-12;
  // Residuals are computed if the changes of a sweep are below kNear of those allowed. They end the
  // sweeps at kEnd, because the caller computes them from the rows, with other rounding errors.
  static constexpr double kNear = 1.5, kEnd = 0.99;
  // Contacts that wait are looked at in every kInterval-th sweep whose changes are below kRough of
  // those allowed. Earlier iterates would close gaps that stay open.
  static constexpr int kInterval = 8;
  static constexpr double kRough = 30;
};

template <std::size_t N>
double product(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < N; ++d) sum += a[d] * b[d];
  return sum;
}

/// The displacement of a point at the vector `arm` from the centre by the turn `turn`.
std::array<double, 2> turned(const std::array<double, 1>& turn, const std::array<double, 2>& arm) {
  return {-turn[0] * arm[1], turn[0] * arm[0]};
}
std::array<double, 3> turned(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The moment of `force` at `arm`.
std::array<double, 1> moment(const std::array<double, 2>& arm, const std::array<double, 2>& force) {
  return {arm[0] * force[1] - arm[1] * force[0]};
}
std::array<double, 3> moment(const std::array<double, 3>& arm, const std::array<double, 3>& force) {
  return turned(arm, force);
}

template <int D>
std::array<double, D> along(const Motion<D>& motion) {
  std::array<double, D> result;
  std::copy_n(motion.begin(), D, result.begin());
  return result;
}

template <int D>
std::array<double, kTurns<D>> turn_of(const Motion<D>& motion) {
  std::array<double, kTurns<D>> result;
  std::copy_n(motion.begin() + D, kTurns<D>, result.begin());
  return result;
}

template <int D>
bool has_same_inertia_about_all_axes(const RigidUnit<D>& unit) {
  constexpr auto n = static_cast<std::size_t>(kTurns<D>);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      if (unit.turn_mobility[i * n + k] != (i == k ? unit.turn_mobility[0] : 0)) return false;
  return true;
}

/// The arm with which the rows of a block act on one of its units, part `part` of each row, or
/// nothing if normal impulses turn the unit or its arm is not along the normal. `sign` times the
/// rows are those of a unit that is pushed along `normal`.
template <int D>
std::optional<double> arm_of(const ConstraintProblem<D>& problem, const ConstraintBlock& block,
                             std::size_t part, const std::array<double, D>& normal, double sign) {
  const auto differ = [](double a, double b, double scale) {
    return !(std::abs(a - b) <= SweepTuning::kRounding * scale);
  };
  const auto& [number, first] = problem.parts_of(block.row)[part];
  const auto& unit = problem.units[static_cast<std::size_t>(number)];
  const double radius = std::sqrt(unit.mobility / unit.turn_mobility[0]);  // of gyration
  for (std::size_t d = 0; d < D; ++d)
    if (differ(sign * first[d], normal[d], 1)) return {};
  for (const double turn : turn_of<D>(first))
    if (differ(turn, 0, radius)) return {};
  std::optional<double> arm;
  for (std::size_t k = 1; k < block.rows; ++k) {
    const auto& row = problem.parts_of(block.row + k)[part].coefficients;
    const auto tangent = along<D>(problem.parts_of(block.row + k)[0].coefficients);
    for (std::size_t d = 0; d < D; ++d)
      if (differ(sign * row[d], tangent[d], 1)) return {};
    // Both arms turn their units as impulses of the same direction would at the surface of one.
    const auto of_unit_arm = moment(normal, tangent);
    const auto turn = turn_of<D>(row);
    const double here = -product(turn, of_unit_arm);
    if (arm && differ(here, *arm, radius)) return {};
    arm = here;
    for (std::size_t i = 0; i < turn.size(); ++i)
      if (differ(turn[i], -here * of_unit_arm[i], radius)) return {};
  }
  return arm.value_or(0);
}

}  // namespace

template <int D>
std::optional<AcceleratedSweeps<D>> AcceleratedSweeps<D>::of(ConstraintProblem<D>& problem,
                                                             const std::vector<double>& w) {
  assert(w.size() == problem.rows.size());
  if (!std::ranges::all_of(problem.units, has_same_inertia_about_all_axes<D>)) return {};
  AcceleratedSweeps sweeps(problem, w);
  sweeps.contacts_.reserve(problem.blocks.size());
  for (const auto& block : problem.blocks)
    if (!sweeps.add(block)) return {};
  return sweeps;
}

template <int D>
bool AcceleratedSweeps<D>::add(const ConstraintBlock& block) {
  if (!block.is_contact) return false;
  const auto parts = problem_->parts_of(block.row);
  assert(!parts.empty() && parts.size() <= 2);
  RoundContact contact;
  contact.normal = along<D>(parts[0].coefficients);
  contact.unit = parts[0].unit;
  contact.other = static_cast<std::int32_t>(problem_->units.size());
  const auto arm = arm_of<D>(*problem_, block, 0, contact.normal, 1);
  std::optional<double> other_arm = 0;
  if (parts.size() == 2) {
    contact.other = parts[1].unit;
    other_arm = arm_of<D>(*problem_, block, 1, contact.normal, -1);
  }
  if (!arm || !other_arm) return false;
  contact.arm = *arm;
  contact.other_arm = *other_arm;
  contact.gap = problem_->rows[block.row].offset;
  for (std::size_t k = 1; k < block.rows; ++k) {
    const auto tangent = along<D>(problem_->parts_of(block.row + k)[0].coefficients);
    for (std::size_t d = 0; d < D; ++d)
      contact.slip[d] += problem_->rows[block.row + k].offset * tangent[d];
  }
  contact.w_normal = (*w_)[block.row];
  contact.w_tangential = block.rows > 1 ? (*w_)[block.row + 1] : contact.w_normal;
  contact.inverse_w_normal = 1 / contact.w_normal;
  contact.inverse_w_tangential = 1 / contact.w_tangential;
  const double of_gap = contact.w_normal / block.allowed,
               of_slip = block.rows > 1 ? contact.w_tangential / block.allowed_slip : 0;
  contact.square_of_gap = of_gap * of_gap;
  contact.square_of_slip = of_slip * of_slip;
  contact.lowest = block.lowest;
  contact.friction = block.friction;
  contact.has_friction = block.rows > 1;
  contacts_.push_back(contact);
  return true;
}

template <int D>
void AcceleratedSweeps<D>::begin() {
  const auto& impulses = problem_->impulses;
  waiting_.clear();
  for (std::size_t b = 0; b < contacts_.size(); ++b) {
    const auto& block = problem_->blocks[b];
    auto& contact = contacts_[b];
    contact.bound = block.friction_bound;
    contact.capacity = block.capacity;
    contact.given_load = block.given_load;
    Impulse p{std::max(block.lowest, impulses[block.row]), {}};
    for (std::size_t k = 1; k < block.rows; ++k) {
      const auto tangent = along<D>(problem_->parts_of(block.row + k)[0].coefficients);
      for (std::size_t d = 0; d < D; ++d) p.tangential[d] += impulses[block.row + k] * tangent[d];
    }
    contact.x = contact.y = p;
    contact.waits = block.is_optional && p.normal == 0;
    if (contact.waits) {
      contact.x = contact.y = {};
      waiting_.push_back(b);
    }
  }
  units_.assign(problem_->units.size() + 1, Unit{});
  for (std::size_t u = 0; u < problem_->units.size(); ++u) {
    const auto& unit = problem_->units[u];
    units_[u] = {along<D>(unit.free), unit.mobility, turn_of<D>(unit.free), unit.turn_mobility[0]};
  }
  for (const auto& contact : contacts_) push(contact, contact.x);
}

template <int D>
inline typename AcceleratedSweeps<D>::Impulse AcceleratedSweeps<D>::values_of(
    const RoundContact& contact) const {
  const auto& a = units_[static_cast<std::size_t>(contact.unit)];
  const auto& b = units_[static_cast<std::size_t>(contact.other)];
  Vec apart;
  for (std::size_t d = 0; d < D; ++d) apart[d] = a.moved[d] - b.moved[d];
  Impulse values{product(contact.normal, apart), {}};
  if (!contact.has_friction) {
    values.normal += contact.gap;
    return values;
  }
  Turn turn;
  for (std::size_t i = 0; i < turn.size(); ++i)
    turn[i] = contact.arm * a.turned[i] + contact.other_arm * b.turned[i];
  const auto by_turn = turned(turn, contact.normal);
  for (std::size_t d = 0; d < D; ++d)
    values.tangential[d] =
        contact.slip[d] + apart[d] - values.normal * contact.normal[d] - by_turn[d];
  values.normal += contact.gap;
  return values;
}

template <int D>
inline typename AcceleratedSweeps<D>::Impulse AcceleratedSweeps<D>::solution_of(
    const RoundContact& contact, const Impulse& p, const Impulse& values) const {
  Impulse wanted{p.normal - values.normal * contact.inverse_w_normal, {}};
  if (!contact.has_friction) return {std::max(contact.lowest, wanted.normal), {}};
  for (std::size_t d = 0; d < D; ++d)
    wanted.tangential[d] = p.tangential[d] - values.tangential[d] * contact.inverse_w_tangential;
  const double square = product(wanted.tangential, wanted.tangential);
  double factor = 1;
  if (contact.bound == FrictionBound::kCone) {
    const double mu = contact.friction;
    if (wanted.normal >= 0 && square <= mu * mu * wanted.normal * wanted.normal) return wanted;
    const auto cone = FrictionCone::nearest(mu, wanted.normal, std::sqrt(square), contact.w_normal,
                                            contact.w_tangential);
    wanted.normal = cone.load;
    factor = cone.tangential;
  } else {
    wanted.normal = std::max(contact.lowest, wanted.normal);
    const double bound = contact.friction * (contact.bound == FrictionBound::kGiven
                                                 ? contact.given_load
                                                 : load_of_solids(wanted.normal, contact.capacity));
    if (square > bound * bound) factor = bound / std::sqrt(square);
  }
  for (auto& component : wanted.tangential) component *= factor;
  return wanted;
}

template <int D>
inline double AcceleratedSweeps<D>::square_of(const RoundContact& contact, const Impulse& change) {
  return std::max(contact.square_of_gap * change.normal * change.normal,
                  contact.square_of_slip * product(change.tangential, change.tangential));
}

template <int D>
inline void AcceleratedSweeps<D>::push(const RoundContact& contact, const Impulse& change) {
  auto& a = units_[static_cast<std::size_t>(contact.unit)];
  auto& b = units_[static_cast<std::size_t>(contact.other)];
  for (std::size_t d = 0; d < D; ++d) {
    const double by = change.normal * contact.normal[d] + change.tangential[d];
    a.moved[d] += a.mobility * by;
    b.moved[d] -= b.mobility * by;
  }
  if (!contact.has_friction) return;
  const auto turn = moment(contact.normal, change.tangential);
  for (std::size_t i = 0; i < turn.size(); ++i) {
    a.turned[i] -= a.turn_mobility * contact.arm * turn[i];
    b.turned[i] -= b.turn_mobility * contact.other_arm * turn[i];
  }
}

template <int D>
double AcceleratedSweeps<D>::residual() const {
  double largest = 0;
  for (const auto& contact : contacts_) {
    if (contact.waits) continue;
    const auto wanted = solution_of(contact, contact.x, values_of(contact));
    Impulse change{wanted.normal - contact.x.normal, {}};
    for (std::size_t d = 0; d < D; ++d)
      change.tangential[d] = wanted.tangential[d] - contact.x.tangential[d];
    const double here = square_of(contact, change);
    if (!(here <= largest)) largest = here;
  }
  return std::sqrt(largest);
}

template <int D>
bool AcceleratedSweeps<D>::end_waiting() {
  const auto closed = std::ranges::partition(waiting_, [&](std::size_t c) {
    auto& contact = contacts_[c];
    const double gap = std::min(0.0, values_of(contact).normal) / contact.w_normal;
    contact.waits = gap * gap * contact.square_of_gap <= 1;
    return contact.waits;
  });
  const bool is_any = !closed.empty();
  waiting_.erase(closed.begin(), closed.end());
  return is_any;
}

template <int D>
void AcceleratedSweeps<D>::finish() {
  for (std::size_t b = 0; b < contacts_.size(); ++b) {
    const auto& block = problem_->blocks[b];
    problem_->impulses[block.row] = contacts_[b].x.normal;
    for (std::size_t k = 1; k < block.rows; ++k)
      problem_->impulses[block.row + k] = product(
          contacts_[b].x.tangential, along<D>(problem_->parts_of(block.row + k)[0].coefficients));
  }
}

template <int D>
int AcceleratedSweeps<D>::sweep(int most, int longest) {
  begin();
  if (residual() <= SweepTuning::kEnd && !end_waiting()) return 0;
  before_ = units_;
  double theta = 1;
  int since = 0, sweeps = 0;
  while (sweeps < most) {
    const double next = (1 + std::sqrt(1 + 4 * theta * theta)) / 2;
    ++since;
    const double beta = since >= longest ? 0 : (theta - 1) / next;
    theta = next;
    double largest = 0;
    double away = 0;  // > 0 if the last extrapolation points away from the change
    for (auto& contact : contacts_) {
      if (contact.waits) continue;
      const auto x = solution_of(contact, contact.y, values_of(contact));
      Impulse change{x.normal - contact.y.normal, {}}, step{x.normal - contact.x.normal, {}};
      for (std::size_t d = 0; d < D; ++d) {
        change.tangential[d] = x.tangential[d] - contact.y.tangential[d];
        step.tangential[d] = x.tangential[d] - contact.x.tangential[d];
      }
      push(contact, change);
      largest = std::max(largest, square_of(contact, change));
      away -= contact.w_normal * change.normal * step.normal +
              contact.w_tangential * product(change.tangential, step.tangential);
      contact.x = x;
      contact.y.normal = x.normal + beta * step.normal;
      for (std::size_t d = 0; d < D; ++d)
        contact.y.tangential[d] = x.tangential[d] + beta * step.tangential[d];
    }
    ++sweeps;
    if (largest <= SweepTuning::kRough * SweepTuning::kRough && sweeps % SweepTuning::kInterval == 0)
      end_waiting();
    if (largest <= SweepTuning::kNear * SweepTuning::kNear && residual() <= SweepTuning::kEnd &&
        !end_waiting())
      break;
    if (away > 0 || beta == 0) {
      if (away > 0 || since >= longest) {
        theta = 1;
        since = 0;
      }
      if (beta > 0)
        for (auto& contact : contacts_) contact.y = contact.x;
      before_ = units_;
      continue;
    }
    for (std::size_t u = 0; u < units_.size(); ++u) {
      auto& unit = units_[u];
      auto& before = before_[u];
      const auto after = unit;
      for (std::size_t d = 0; d < D; ++d) unit.moved[d] += beta * (unit.moved[d] - before.moved[d]);
      for (std::size_t i = 0; i < unit.turned.size(); ++i)
        unit.turned[i] += beta * (unit.turned[i] - before.turned[i]);
      before = after;
    }
  }
  finish();
  return sweeps;
}

template class AcceleratedSweeps<2>;
template class AcceleratedSweeps<3>;

}  // namespace viscontact::contact_solver
