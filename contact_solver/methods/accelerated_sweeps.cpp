// The local solutions of (5.7), (5.9) and (5.17), docs/physics.md, and the extrapolation.
#include "viscontact/contact_solver/methods/accelerated_sweeps.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "viscontact/common/splitmix.hpp"
#include "viscontact/contact_solver/methods/fastest_instructions.hpp"
#include "viscontact/contact_solver/problem/contact_conditions.hpp"

namespace viscontact::contact_solver {
namespace {

struct SweepTuning {
  // Neighbours in the list of blocks share units, so that the processor would have to finish one
  // contact before it begins the next. Contacts are therefore taken in turn from so many distant
  // parts of the list. With 2000 spheres a sweep takes 21, 17, 15, 15 and 16 ns a contact with 1,
  // 3, 8, 16 and 32 parts, and as many sweeps are needed.
  static constexpr std::size_t kInterleaved = 16;
  // Errors of directions and arms, relative, which rounding may cause.
  static constexpr double kRounding = 1e-12;
  // Residuals are computed if the changes of a sweep are below kNear of those allowed. They end the
  // sweeps at kEnd, because the caller computes them from the rows, with other rounding errors.
  static constexpr double kNear = 1.5, kEnd = 0.99;
  // Contacts that wait are looked at in every kInterval-th sweep whose changes are below kRough of
  // those allowed. Earlier iterates would close gaps that stay open.
  static constexpr int kInterval = 8;
  static constexpr double kRough = 30;
  // With SweepPlan::is_adaptive: the longest extrapolation, the bound of each square in the sum that
  // decides whether they grow, and the growth of the sum after which sweeps return to where they
  // were.
  static constexpr int kMostLongest = 300;
  static constexpr double kMostOfSum = 1e4, kMuchMore = 3;
  // With SweepPlan::Map::kProximal centers move after so many sweeps, or when the change of a sweep
  // is below this part of what the centers keep the impulses from.
  static constexpr int kMostWithCenters = 200;
  static constexpr double kPartOfLeft = 0.3;
};

using Vector = Lanes;
using viscontact::cross;
using viscontact::dot;

template <int D>
Vector along(const Motion<D>& motion) {
  Vector result{};
  for (int d = 0; d < D; ++d) result[d] = motion[static_cast<std::size_t>(d)];
  return result;
}

template <int D>
Vector turn_of(const Motion<D>& motion) {
  Vector result{};
  for (int i = 0; i < kTurns<D>; ++i)
    result[3 - kTurns<D> + i] = motion[static_cast<std::size_t>(D + i)];
  return result;
}

/// True if a component of a - b is larger than rounding errors of numbers of the size `scale`.
inline bool differ(const Vector& a, const Vector& b, double scale) {
  const Vector c = a - b;
  return !(std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2])}) <=
           SweepTuning::kRounding * scale);
}

template <int D>
bool has_same_inertia_about_all_axes(const RigidUnit<D>& unit) {
  constexpr auto n = static_cast<std::size_t>(kTurns<D>);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      if (unit.turn_mobility[i * n + k] != (i == k ? unit.turn_mobility[0] : 0)) return false;
  return true;
}

/// The tangent of row `k` of the block.
template <int D>
Vector tangent_of(const ConstraintProblem<D>& problem, const ConstraintBlock& block,
                  std::size_t k) {
  return along<D>(problem.parts_of(block.row + k)[0].coefficients);
}

/// The arm with which the rows of a block act on one of its units, part `part` of each row, or
/// nothing if normal impulses turn the unit or its arm is not along the normal. `sign` times the
/// coefficients of the rows are the normal and the tangents.
template <int D>
std::optional<double> arm_of(const ConstraintProblem<D>& problem, const ConstraintBlock& block,
                             std::size_t part, const Vector& normal, double sign) {
  const auto& [number, first] = problem.parts_of(block.row)[part];
  const auto& unit = problem.units[static_cast<std::size_t>(number)];
  const double radius = std::sqrt(unit.mobility / unit.turn_mobility[0]);  // of gyration
  if (differ(sign * along<D>(first), normal, 1) || differ(turn_of<D>(first), Vector{}, radius))
    return {};
  std::optional<double> arm;
  for (std::size_t k = 1; k < block.rows; ++k) {
    const auto& row = problem.parts_of(block.row + k)[part].coefficients;
    const Vector tangent = tangent_of<D>(problem, block, k);
    // Opposite impulses at the ends of opposite arms turn both units in the same direction.
    const Vector turn = turn_of<D>(row), of_unit_arm = -cross(normal, tangent);
    const double here = dot(turn, of_unit_arm);
    if (differ(sign * along<D>(row), tangent, 1) || differ(turn, here * of_unit_arm, radius) ||
        differ(Vector{here}, Vector{arm.value_or(here)}, radius))
      return {};
    arm = here;
  }
  return arm.value_or(0);
}

}  // namespace

template <int D>
std::optional<AcceleratedSweeps<D>> AcceleratedSweeps<D>::of(ConstraintProblem<D>& problem,
                                                             const std::vector<double>& w) {
  assert(w.size() == problem.rows.size());
  assert(std::ranges::all_of(problem.units,
                             [](const auto& unit) { return unit.turn_mobility[0] > 0; }));
  if (!std::ranges::all_of(problem.units, has_same_inertia_about_all_axes<D>)) return {};
  AcceleratedSweeps sweeps(problem, w);
  sweeps.contacts_.reserve(problem.blocks.size());
  const std::size_t count = problem.blocks.size();
  const std::size_t strand = (count + SweepTuning::kInterleaved - 1) / SweepTuning::kInterleaved;
  const bool is_each_round = by_fastest_instructions([&] {
    for (std::size_t first = 0; first < strand; ++first)
      for (std::size_t b = first; b < count; b += strand)
        if (!sweeps.add(b)) return false;
    return true;
  });
  if (!is_each_round) return {};
  return sweeps;
}

template <int D>
bool AcceleratedSweeps<D>::add(std::size_t b) {
  const auto& block = problem_->blocks[b];
  if (!block.is_contact) return false;
  const auto parts = problem_->parts_of(block.row);
  assert(!parts.empty() && parts.size() <= 2);
  assert(parts.size() == 1 || parts[0].unit != parts[1].unit);
  RoundContact contact;
  contact.block = b;
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
  contact.offset = problem_->rows[block.row].offset * contact.normal;
  for (std::size_t k = 1; k < block.rows; ++k)
    contact.offset += problem_->rows[block.row + k].offset * tangent_of<D>(*problem_, block, k);
  contact.has_friction = block.rows > 1;
  contact.w_normal = (*w_)[block.row];
  contact.w_tangential = contact.has_friction ? (*w_)[block.row + 1] : contact.w_normal;
  contact.inverse_w_normal = 1 / contact.w_normal;
  contact.inverse_w_tangential = 1 / contact.w_tangential;
  contact.gap_share = contact.w_normal / block.allowed;
  contact.slip_share = contact.has_friction ? contact.w_tangential / block.allowed_slip : 0;
  contact.lowest = block.lowest;
  contact.friction = block.friction;
  contact.capacity = block.capacity;
  contact.bound = block.friction_bound;
  contacts_.push_back(contact);
  return true;
}

template <int D>
void AcceleratedSweeps<D>::begin() {
  const auto& impulses = problem_->impulses;
  waiting_.clear();
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    auto& contact = contacts_[c];
    const auto& block = problem_->blocks[contact.block];
    contact.given_load = block.given_load;
    const double load = std::max(block.lowest, impulses[block.row]);
    contact.waits = block.is_optional && load == 0;
    contact.x = {Vector{}, load};
    for (std::size_t k = 1; k < block.rows && !contact.waits; ++k)
      contact.x.tangential += impulses[block.row + k] * tangent_of<D>(*problem_, block, k);
    contact.y = contact.x;
    if (contact.waits) waiting_.push_back(c);
  }
  units_.assign(problem_->units.size() + 1, Unit{});
  for (std::size_t u = 0; u < problem_->units.size(); ++u) {
    const auto& unit = problem_->units[u];
    units_[u] = {along<D>(unit.free), turn_of<D>(unit.free), unit.mobility, unit.turn_mobility[0]};
  }
  for (const auto& contact : contacts_) push(contact, contact.x);
  before_ = units_;
}

template <int D>
inline double AcceleratedSweeps<D>::find_values(const RoundContact& contact, Vector& slip) const {
  const auto& a = units_[static_cast<std::size_t>(contact.unit)];
  const auto& b = units_[static_cast<std::size_t>(contact.other)];
  const Vector apart = contact.offset + (a.moved - b.moved);
  const Vector turn = contact.arm * a.turned + contact.other_arm * b.turned;
  const double gap = dot(contact.normal, apart);
  slip = apart - cross(turn, contact.normal) - gap * contact.normal;
  return gap;
}

template <int D>
template <SweepPlan::Map map>
inline void AcceleratedSweeps<D>::solve(std::size_t c, const SweepPlan& plan,
                                        Impulse& impulse) const {
  const auto& contact = contacts_[c];
  Vector slip;
  const double gap = find_values(contact, slip);
  double load = impulse.normal - contact.inverse_w_normal * gap;
  impulse.tangential -= contact.inverse_w_tangential * slip;
  if constexpr (map == Map::kProximal) {
    const double part = 1 / (1 + plan.epsilon);
    load = part * (load + plan.epsilon * centers_[c].normal);
    impulse.tangential = part * (impulse.tangential + plan.epsilon * centers_[c].tangential);
  }
  impulse.normal = std::max(contact.lowest, load);
  if (!contact.has_friction) {
    impulse.tangential = Vector{};
    return;
  }
  const double square = dot(impulse.tangential, impulse.tangential);
  if (contact.bound == FrictionBound::kCone) {
    if (load >= 0 && square <= contact.friction * contact.friction * load * load) return;
    const auto cone = FrictionCone::nearest(contact.friction, load, std::sqrt(square),
                                            contact.w_normal, contact.w_tangential);
    impulse.normal = cone.load;
    impulse.tangential *= cone.tangential;
    return;
  }
  const double bound = contact.friction * (contact.bound == FrictionBound::kGiven
                                               ? contact.given_load
                                               : load_of_solids(impulse.normal, contact.capacity));
  if (square > bound * bound) impulse.tangential *= bound / std::sqrt(square);
}

template <int D>
inline void AcceleratedSweeps<D>::push(const RoundContact& contact, const Impulse& change) {
  auto& a = units_[static_cast<std::size_t>(contact.unit)];
  auto& b = units_[static_cast<std::size_t>(contact.other)];
  const Vector impulse = change.normal * contact.normal + change.tangential;
  a.moved += a.mobility * impulse;
  b.moved -= b.mobility * impulse;
  const Vector moment = cross(contact.normal, change.tangential);
  a.turned -= (a.turn_mobility * contact.arm) * moment;
  b.turned -= (b.turn_mobility * contact.other_arm) * moment;
}

template <int D>
double AcceleratedSweeps<D>::residual() const {
  double largest = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const auto& contact = contacts_[c];
    if (contact.waits) continue;
    Impulse impulse = contact.x;
    solve<Map::kLaw>(c, {}, impulse);
    const double of_gap = contact.gap_share * std::abs(impulse.normal - contact.x.normal);
    const Vector across = contact.slip_share * (impulse.tangential - contact.x.tangential);
    largest = largest_or_nan(largest, largest_or_nan(of_gap, std::sqrt(dot(across, across))));
  }
  return largest;
}

template <int D>
bool AcceleratedSweeps<D>::end_waiting() {
  const auto closed = std::partition(waiting_.begin(), waiting_.end(), [&](std::size_t c) {
    auto& contact = contacts_[c];
    Vector slip;
    contact.waits = -contact.gap_share * contact.inverse_w_normal * find_values(contact, slip) <= 1;
    return contact.waits;
  });
  const bool is_any = closed != waiting_.end();
  waiting_.erase(closed, waiting_.end());
  return is_any;
}

template <int D>
template <SweepPlan::Map map, bool is_adaptive>
inline typename AcceleratedSweeps<D>::Sweep AcceleratedSweeps<D>::sweep_once(const SweepPlan& plan,
                                                                             double beta) {
  Sweep result;
  double largest = 0, away_along = 0;
  Vector squares{}, away_across{}, squares_left{};
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    auto& contact = contacts_[c];
    if (contact.waits) continue;
    Impulse x = contact.y;
    solve<map>(c, plan, x);
    const Impulse change{x.tangential - contact.y.tangential, x.normal - contact.y.normal},
        step{x.tangential - contact.x.tangential, x.normal - contact.x.normal};
    push(contact, change);
    const double along_normal = contact.gap_share * std::abs(change.normal);
    largest = std::max(largest, along_normal);
    const Vector across = contact.slip_share * change.tangential, square = across * across;
    squares = squares > square ? squares : square;
    away_along -= contact.w_normal * change.normal * step.normal;
    away_across -= contact.w_tangential * change.tangential * step.tangential;
    if constexpr (is_adaptive)
      result.sum += std::min(SweepTuning::kMostOfSum, std::max(along_normal * along_normal,
                                                               square[0] + square[1] + square[2]));
    if constexpr (map == Map::kProximal) {
      const auto& center = centers_[c];
      result.left = std::max(result.left,
                             plan.epsilon * contact.gap_share * std::abs(x.normal - center.normal));
      const Vector apart = (plan.epsilon * contact.slip_share) * (x.tangential - center.tangential);
      const Vector square_left = apart * apart;
      squares_left = squares_left > square_left ? squares_left : square_left;
    }
    contact.x = x;
    contact.y = {x.tangential + beta * step.tangential, x.normal + beta * step.normal};
  }
  for (int d = 0; d < 3; ++d) {
    largest = std::max(largest, std::sqrt(squares[d]));
    result.left = std::max(result.left, std::sqrt(squares_left[d]));
  }
  result.change = largest;
  result.away = away_along + away_across[0] + away_across[1] + away_across[2];
  return result;
}

template <int D>
void AcceleratedSweeps<D>::extrapolate_units(double beta) {
  for (std::size_t u = 0; u < units_.size(); ++u) {
    auto& unit = units_[u];
    const Unit after = unit;
    unit.moved += beta * (unit.moved - before_[u].moved);
    unit.turned += beta * (unit.turned - before_[u].turned);
    before_[u] = after;
  }
}

template <int D>
void AcceleratedSweeps<D>::finish() {
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const auto& block = problem_->blocks[contacts_[c].block];
    problem_->impulses[block.row] = contacts_[c].x.normal;
    for (std::size_t k = 1; k < block.rows; ++k)
      problem_->impulses[block.row + k] =
          dot(tangent_of<D>(*problem_, block, k), contacts_[c].x.tangential);
  }
}

template <int D>
void AcceleratedSweeps<D>::shuffle() {
  SplitMix64 random(contacts_.size());
  for (std::size_t c = contacts_.size(); c > 1; --c)
    std::swap(contacts_[c - 1], contacts_[static_cast<std::size_t>(random.next() % c)]);
  list_waiting();
}

template <int D>
void AcceleratedSweeps<D>::list_waiting() {
  waiting_.clear();
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    if (contacts_[c].waits) waiting_.push_back(c);
}

template <int D>
template <SweepPlan::Map map, bool is_adaptive>
inline int AcceleratedSweeps<D>::run(const SweepPlan& plan) {
  using Tuning = SweepTuning;
  double theta = 1;
  int since = 0;         // sweeps since the extrapolation has begun
  int with_centers = 0;  // sweeps with the present centers
  int longest = plan.longest;
  // With is_adaptive what the sweeps return to.
  double last_sum = std::numeric_limits<double>::infinity();
  std::vector<RoundContact> last_contacts;
  std::vector<Unit> last_units;
  int sweeps = 0;
  while (sweeps < plan.most) {
    const double next = (1 + std::sqrt(1 + 4 * theta * theta)) / 2;
    const double beta = ++since < longest ? std::min(plan.longest_step, (theta - 1) / next) : 0;
    theta = next;
    const auto [change, away, sum, left] = sweep_once<map, is_adaptive>(plan, beta);
    ++sweeps;
    if (change <= Tuning::kRough && sweeps % Tuning::kInterval == 0) end_waiting();
    if (std::max(change, left) <= Tuning::kNear && residual() <= Tuning::kEnd && !end_waiting())
      break;
    if constexpr (map == Map::kProximal)
      if (++with_centers >= Tuning::kMostWithCenters || change < Tuning::kPartOfLeft * left) {
        for (std::size_t c = 0; c < contacts_.size(); ++c) centers_[c] = contacts_[c].x;
        with_centers = 0;
      }
    if (is_adaptive && since >= longest) {
      longest = sum < last_sum ? std::min(Tuning::kMostLongest, longest + std::max(1, longest / 4))
                               : std::max(2, longest / 2);
      if (sum > Tuning::kMuchMore * last_sum) {
        contacts_ = last_contacts;
        units_ = last_units;
        list_waiting();
        last_sum *= 2;
      } else {
        last_contacts = contacts_;
        last_units = units_;
        last_sum = sum;
      }
      since = longest;
    }
    if (away > 0 || since >= longest) {
      for (auto& contact : contacts_) contact.y = contact.x;
      before_ = units_;
      theta = 1;
      since = 0;
    } else {
      extrapolate_units(beta);
    }
  }
  return sweeps;
}

template <int D>
int AcceleratedSweeps<D>::sweep(const SweepPlan& plan) {
  assert(plan.most >= 1 && plan.longest >= 2);
  const int sweeps = by_fastest_instructions([&] {
    begin();
    if (residual() <= SweepTuning::kEnd && !end_waiting()) return 0;
    if (plan.is_shuffled) shuffle();
    if (plan.map == Map::kProximal) {
      centers_.clear();
      for (const auto& contact : contacts_) centers_.push_back(contact.x);
      return run<Map::kProximal, false>(plan);
    }
    return plan.is_adaptive ? run<Map::kLaw, true>(plan) : run<Map::kLaw, false>(plan);
  });
  finish();
  return sweeps;
}

template class AcceleratedSweeps<2>;
template class AcceleratedSweeps<3>;

}  // namespace viscontact::contact_solver
