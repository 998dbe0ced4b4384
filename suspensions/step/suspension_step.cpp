// Newton's method for the films, and an augmented Lagrangian for contacts.
#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/pairs/pair_sizes.hpp"
#include "viscontact/suspensions/pairs/row_blocks.hpp"
#include "viscontact/suspensions/step/step_parts.hpp"
namespace viscontact::suspensions {
namespace {

using particles::PairTerms;

void sort(std::vector<ContactMemory>& contacts) {
  std::ranges::sort(contacts, [](const ContactMemory& a, const ContactMemory& b) {
    return a.first < b.first || (a.first == b.first && a.second < b.second);
  });
}

/// Calls work(p) for all pairs p.
template <class Work>
void for_each_pair(const StepProblem& problem, const Work& work) {
  problem.pool->for_blocks(
      problem.pairs.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) work(p);
      },
      kPairsInBlock);
}

/// The pairs at half of the step, if the spheres have these motions.
std::vector<PlacedPair> predicted(const StepProblem& problem, const std::vector<Motion>& motions) {
  std::vector<PlacedPair> result(problem.pairs.size());
  const double half = problem.h / 2;
  const Matrix carry = matrix_of(carried, problem.gradient, half);
  for_each_pair(problem, [&](std::size_t p) {
    const auto& pair = problem.pairs[p];
    const auto i = index_of(pair.first), j = index_of(pair.second);
    const auto sizes = sizes_of(problem.radii[i], problem.radii[j]);
    const double sum = sizes.touching, length = norm(pair.apart), start = length - sum;
    const Vector apart =
        times(carry, pair.apart) + half * vector_of(motions[j].along - motions[i].along);
    // The normal of a plane does not turn.
    const double distance = sizes.has_plane ? dot(apart, pair.apart) / length : norm(apart);
    const Vector normal = sizes.has_plane ? (1 / length) * pair.apart : (1 / distance) * apart;
    const double contact = problem.lubrication.roughness * sizes.mean;
    // The prediction may close a gap; a film resists that.
    const double least =
        std::max({contact, start / 4, StepTuning::kLeastGap * problem.mean_radius});
    result[p] = {pair.first, pair.second, normal, std::max(distance - sum, least)};
  });
  return result;
}

}  // namespace

SuspensionStep::SuspensionStep(StepProblem problem)
    : problem_(std::move(problem)),
      strain_(strain_rate_of(problem_.gradient)),
      system_(problem_.lubrication, problem_.radii, predicted(problem_, problem_.motions),
              *problem_.pool),
      gradients_(*problem_.pool),
      motions_(std::move(problem_.motions)) {
  add_inertia();
  if (const auto& given = problem_.stress) {
    rate_ = std::make_unique<Rate>();
    rate_->value = given->rate;
    rate_->strain = strain_rate_of(given->gradient);
  }
  add_films();
  add_contacts();
}

SuspensionStep::~SuspensionStep() = default;

void SuspensionStep::place_again() {
  std::vector<double> widths;
  for (const auto& film : films_) widths.push_back(film.at);
  problem_.memories.clear();
  for (const auto& contact : contacts_) problem_.memories.push_back(memory_of(contact));
  sort(problem_.memories);
  contacts_.clear();
  const auto pairs = predicted(problem_, motions_);
  system_.release();
  system_ = PairSystem(problem_.lubrication, problem_.radii, pairs, *problem_.pool);
  add_inertia();
  add_films();
  add_contacts();
  for (std::size_t p = 0; p < films_.size(); ++p) films_[p].at = widths[p];
}

PairSizes SuspensionStep::sizes(std::size_t p) const {
  const auto& pair = problem_.pairs[p];
  return sizes_of(problem_.radii[index_of(pair.first)], problem_.radii[index_of(pair.second)]);
}

void SuspensionStep::add_films() {
  auto& rows = system_.resistance().pairs;
  assert(rows.size() == problem_.pairs.size());
  films_.assign(rows.size(), {});
  for_each_pair(problem_, [&](std::size_t p) {
    auto& row = rows[p];
    auto& strain = system_.strains()[p];
    auto& film = films_[p];
    const auto& pair = problem_.pairs[p];
    const double sum = strain.radii;
    film.delta = problem_.lubrication.regularisation * sizes(p).mean;
    film.start =
        std::max(norm(pair.apart) - sum, StepTuning::kLeastGap * problem_.mean_radius) + film.delta;
    if (row.squeeze > 0) {
      // The resistance at half of the step, as if it were alpha/(q + delta) at all gaps nearby.
      film.alpha = row.squeeze * (system_.gap_of(p) + film.delta);
      film.arm = strain.squeeze / row.squeeze;
      film.stress_axial = strain.stress_axial - film.arm * strain.squeeze;
      // The flow opens the gap by r nEn, and the surfaces by arm nEn.
      film.excess = strain.squeeze - row.squeeze * (sum + system_.gap_of(p));
    }
    film.solid = is_kept_apart(p) ? StepTuning::kSolidGap * problem_.mean_radius : 0;
    film.at = film.start;
    row.squeeze = 0;
    strain.squeeze = 0;
    strain.stress_axial = 0;
  });
  if (rate_) place_rate();
  set_flow();
}

void SuspensionStep::set_flow() {
  const auto& rows = system_.resistance().pairs;
  const Matrix carry = matrix_of(carried, problem_.gradient, problem_.h);
  for_each_pair(problem_, [&](std::size_t p) {
    auto& film = films_[p];
    const Vector n = vector_of(rows[p].normal);
    film.carried = times(carry, problem_.pairs[p].apart);
    film.affine_gap = dot(n, film.carried) - system_.strains()[p].radii;
    if (film.alpha > 0) film.constant = film.excess * dot(n, strain_.times(n));
  });
  given_loads_ = problem_.loads;
  add_momentum(given_loads_);
  system_.subtract_strain_loads(strain_, given_loads_);
}

void SuspensionStep::add_contact(std::size_t p, const ContactMemory& memory) {
  const auto& row = system_.resistance().pairs[p];
  const auto& lubrication = problem_.lubrication;
  auto& film = films_[p];
  film.contact = static_cast<std::int32_t>(contacts_.size());
  Contact contact;
  contact.pair = p;
  contact.memory = memory;
  assert(memory.least_load <= 0);
  const double a = problem_.radii[index_of(row.first)], b = problem_.radii[index_of(row.second)];
  const auto [touching, mean, reduced, has_plane] = sizes(p);
  const bool is_smooth = is_kept_apart(p);
  contact.gap = is_smooth ? film.solid : lubrication.roughness * mean;
  // Smooth spheres have no friction.
  if (is_smooth) contact.borne_by_film = std::numeric_limits<double>::infinity();
  if (problem_.contact_film) {
    // Infinite for smooth spheres. Rounding errors may leave gamma just below gamma_min.
    const double carried =
        memory.least_load - problem_.contact_film->lowest_gamma(a, b) / problem_.h;
    contact.borne_by_film = std::max(carried, 0.0);
  }
  const double least_width = lubrication.pairs == PairTerms::kNone ? StepTuning::kWidthWithoutFilm
                                                                   : StepTuning::kLeastWidth;
  const double width =
      is_smooth ? film.solid : std::max(contact.gap + film.delta, least_width * mean);
  const double film_at_contact =
      6 * std::numbers::pi * lubrication.viscosity * reduced * reduced / width;
  const double resistance = film_at_contact + inertia_of(row.first, row.second);
  contact.stiffness =
      (problem_.friction > 0 ? StepTuning::kStiffnessWithFriction : StepTuning::kStiffness) *
      resistance;
  if (problem_.friction > 0) {
    const double arm = 1 / row.inverse_arm;
    contact.arm_first = a * arm / touching;
    contact.arm_second = has_plane ? 0 : b * arm / touching;
    contact.arm = arm;
    contact.stiffness_across = StepTuning::kStiffnessAcross * resistance;
    contact.friction = cross(row.normal, lanes_of(memory.friction));
    contact.turn_first = row.turn_first;
    contact.turn_mixed = row.turn_mixed;
    contact.turn_second = row.turn_second;
  }
  contacts_.push_back(contact);
}

ContactMemory SuspensionStep::memory_of(const Contact& contact) const {
  auto memory = contact.memory;
  const Lanes normal = system_.resistance().pairs[contact.pair].normal;
  memory.friction = vector_of(cross(contact.friction, normal));
  return memory;
}

void SuspensionStep::add_contacts() {
  auto memory = problem_.memories.begin();
  const auto& rows = system_.resistance().pairs;
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const auto& row = rows[p];
    const auto before = [&](const ContactMemory& m) {
      return m.first < row.first || (m.first == row.first && m.second < row.second);
    };
    while (memory != problem_.memories.end() && before(*memory)) ++memory;
    if (memory != problem_.memories.end() && memory->first == row.first &&
        memory->second == row.second)
      add_contact(p, *memory);
    else if (!is_kept_apart(p) &&
             films_[p].start - films_[p].delta <
                 (problem_.lubrication.roughness + StepTuning::kNearGap) * sizes(p).mean)
      add_contact(p, {row.first, row.second});
  }
}

bool SuspensionStep::is_kept_apart(std::size_t p) const {
  return films_[p].alpha > 0 && films_[p].delta == 0 && problem_.lubrication.roughness == 0;
}

double SuspensionStep::opening(std::size_t p, const std::vector<Motion>& motions) const {
  const auto& row = system_.resistance().pairs[p];
  return dot(row.normal, motions[index_of(row.second)].along - motions[index_of(row.first)].along);
}

void SuspensionStep::find_gaps() {
  const auto& rows = system_.resistance().pairs;
  const Matrix mean = matrix_of(mean_carried, problem_.gradient, problem_.h);
  struct Gaps {
    double error = 0, smallest = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> touching;  // pairs that have no contact yet
    Gaps& operator+=(const Gaps& other) {
      error = std::max(error, other.error);
      smallest = std::min(smallest, other.smallest);
      touching.insert(touching.end(), other.touching.begin(), other.touching.end());
      return *this;
    }
  };
  const auto error_of = [&](const Contact& contact, double gap) {
    const double over = gap - contact.gap;
    // Where the load is the least one the gap may be open.
    return contact.memory.load > contact.memory.least_load ? std::abs(over) : std::max(-over, 0.0);
  };
  const auto apart_of = [&](std::size_t p) {
    const auto& pair = problem_.pairs[p];
    const Vector change =
        vector_of(motions_[index_of(pair.second)].along - motions_[index_of(pair.first)].along);
    return films_[p].carried + problem_.h * times(mean, change);
  };
  const auto distance_of = [&](std::size_t p, const Vector& apart) {
    return sizes(p).has_plane ? dot(vector_of(rows[p].normal), apart) : norm(apart);
  };
  // A gap along the normal is a lower bound of the gap. A film whose gap may become 0 has this one:
  // with the gap itself, spheres that pass each other come as near as 1e-12.
  const auto gap_of = [&](std::size_t p, const Vector& apart) {
    return (is_kept_apart(p) ? dot(vector_of(rows[p].normal), apart) : distance_of(p, apart)) -
           sizes(p).touching;
  };
  const auto find_gap = [&](std::size_t p, Gaps& gaps) {
    auto& film = films_[p];
    const Vector apart = apart_of(p);
    const auto of = sizes(p);
    const double gap = gap_of(p, apart);
    film.curvature = gap - film.affine_gap - problem_.h * opening(p, motions_);
    gaps.smallest = std::min(gaps.smallest, distance_of(p, apart) - of.touching);
    if (film.contact >= 0) {
      gaps.error = std::max(gaps.error, error_of(contacts_[index_of(film.contact)], gap));
    } else if (is_kept_apart(p)) {
      if (gap < film.solid && film.at <= film.solid) gaps.touching.push_back(p);
    } else {
      const double least = problem_.lubrication.roughness * of.mean;
      if (gap < least) gaps.touching.push_back(p);
    }
  };
  const auto gaps = problem_.pool->sum_of_blocks<Gaps>(
      rows.size(),
      [&](std::size_t begin, std::size_t end) {
        Gaps part;
        for (std::size_t p = begin; p < end; ++p) find_gap(p, part);
        return part;
      },
      kPairsInBlock);
  gap_error_ = gaps.error;
  smallest_gap_ = gaps.smallest;
  for (const auto p : gaps.touching) {
    add_contact(p, {problem_.pairs[p].first, problem_.pairs[p].second});
    gap_error_ = std::max(gap_error_, error_of(contacts_.back(), gap_of(p, apart_of(p))));
  }
}

void SuspensionStep::linearise(bool is_first) {
  auto& rows = system_.resistance().pairs;
  right_ = given_loads_;
  system_.resistance().slips.clear();
  std::atomic<bool> is_exact = true;
  for_each_pair(problem_, [&](std::size_t p) {
    if (!linearise_pair(p, is_first)) is_exact = false;
  });
  is_film_exact_ = is_exact;
  if (problem_.friction > 0)
    for (const auto& film : films_)
      if (film.contact >= 0) linearise_friction(contacts_[index_of(film.contact)]);
  add_by_blocks(right_.size(), rows, *problem_.pool,
                [&](std::size_t p, bool to_first, bool to_second) {
                  const auto& row = rows[p];
                  const auto& film = films_[p];
                  Lanes turn1{}, turn2{};
                  if (film.contact >= 0 && problem_.friction > 0) {
                    const auto& contact = contacts_[index_of(film.contact)];
                    turn1 = contact.arm_first * contact.at_load;
                    turn2 = contact.arm_second * contact.at_load;
                  }
                  const Lanes along =
                      film.load * row.normal + row.inverse_arm * cross(row.normal, turn1 + turn2);
                  if (to_first) {
                    auto& first = right_[index_of(row.first)];
                    first.along += along;
                    first.turn -= turn1;
                  }
                  if (to_second) {
                    auto& second = right_[index_of(row.second)];
                    second.along -= along;
                    second.turn -= turn2;
                  }
                });
}

bool SuspensionStep::linearise_pair(std::size_t p, bool is_first) {
  auto& row = system_.resistance().pairs[p];
  auto& film = films_[p];
  bool is_exact = true;
  const double h = problem_.h, affine = film.affine_gap + film.curvature;
  row.squeeze = 0;
  film.load = 0;
  if (film.alpha > 0) {
    const double gap = affine + h * opening(p, motions_);
    const double least = std::max(StepTuning::kLeastPart * film.at, film.solid);
    is_exact = gap + film.delta >= least || least <= film.solid;
    film.at = std::max(gap + film.delta, least);
    row.squeeze = film.alpha / film.at;
    film.load = film.force(h) + row.squeeze * (affine + film.delta - film.at) / h;
  }
  if (film.contact >= 0) {
    auto& contact = contacts_[index_of(film.contact)];
    const auto& memory = contact.memory;
    contact.pushes = is_first && memory.load > memory.least_load
                         ? true
                         : trial_load(contact) > memory.least_load;
    if (contact.pushes) {
      row.squeeze += contact.stiffness;
      film.load += contact.stiffness * (affine - contact.gap) / h - memory.load;
    } else {
      film.load -= memory.least_load;
    }
  }
  return is_exact;
}

double SuspensionStep::trial_load(const Contact& contact) const {
  const auto& film = films_[contact.pair];
  const double gap =
      film.affine_gap + film.curvature + problem_.h * opening(contact.pair, motions_);
  return contact.memory.load - contact.stiffness * (gap - contact.gap) / problem_.h;
}

std::size_t SuspensionStep::count_changes() const {
  // Loads of this part of a stiffness are rounding errors of gaps, which may change for ever.
  const double rounding = StepTuning::kGapRounding * problem_.mean_radius / problem_.h;
  return problem_.pool->sum_of_blocks<std::size_t>(
      contacts_.size(),
      [&](std::size_t begin, std::size_t end) {
        return static_cast<std::size_t>(std::ranges::count_if(
            std::span(contacts_).subspan(begin, end - begin), [&](const Contact& contact) {
              const double over = trial_load(contact) - contact.memory.least_load;
              return (over > 0) != contact.pushes && std::abs(over) > rounding * contact.stiffness;
            }));
      },
      kPairsInBlock);
}

double SuspensionStep::power_of_changes() const {
  return problem_.pool->sum_of_blocks<double>(
      contacts_.size(),
      [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t c = begin; c < end; ++c) {
          const auto& contact = contacts_[c];
          const double change =
              std::max(trial_load(contact), contact.memory.least_load) - contact.memory.load;
          sum += change * change / contact.stiffness;
        }
        return sum;
      },
      kPairsInBlock);
}

void SuspensionStep::update_contacts() {
  for (auto& contact : contacts_) {
    contact.memory.load = std::max(trial_load(contact), contact.memory.least_load);
    if (!(problem_.friction > 0)) continue;
    contact.friction = friction_at(contact, slip(contact, motions_));
  }
}

void SuspensionStep::settle_contacts() {
  for (auto& contact : contacts_) {
    if (problem_.friction > 0) contact.friction = friction_at(contact, slip(contact, motions_));
    contact.memory.load = std::max(trial_load(contact), contact.memory.least_load);
  }
}

void SuspensionStep::shorten(const std::vector<Motion>& before, double rate_before,
                             double curvature) {
  const std::size_t count = motions_.size();
  std::vector<Motion> change(count);
  for (std::size_t k = 0; k < count; ++k) {
    change[k].along = motions_[k].along - before[k].along;
    change[k].turn = motions_[k].turn - before[k].turn;
  }
  const double rate_change = rate_ ? rate_->value - rate_before : 0;
  if (rate_) {
    std::vector<Motion> product(count);
    system_.resistance().multiply(change, product);
    curvature = rate_->resistance * rate_change * rate_change;
    for (std::size_t k = 0; k < count; ++k)
      curvature += dot(change[k].along, product[k].along) + dot(change[k].turn, product[k].turn);
    for (std::size_t k = 0; k < count; ++k)
      curvature +=
          2 * rate_change *
          (dot(change[k].along, rate_->loads[k].along) + dot(change[k].turn, rate_->loads[k].turn));
  }
  const auto& rows = system_.resistance().pairs;
  const double h = problem_.h;
  // The slope of the function to be minimised at a part of the change: that of the linear problem,
  // and what films, contacts and friction differ from it.
  const auto slope_at = [&](double part) {
    const auto slope_of = [&](std::size_t p) {
      const auto& film = films_[p];
      double slope = 0;
      if (film.alpha == 0 && film.contact < 0) return slope;
      const double rate = opening(p, change) + (rate_ ? rate_change * rate_->opening[p] : 0);
      const double at = opening(p, before) + part * rate;
      const double gap = film.affine_gap + film.curvature + h * at;
      double force = film.alpha > 0 ? film.force_at(gap, h) : 0;
      if (film.contact >= 0) {
        const auto& contact = contacts_[index_of(film.contact)];
        force -= std::max(contact.memory.load - contact.stiffness * (gap - contact.gap) / h,
                          contact.memory.least_load);
        if (problem_.friction > 0) {
          Lanes turned = slip_by_motions(contact, change);
          if (rate_) turned += rate_change * slip_by_strain(contact, rate_->strain);
          slope +=
              dot(turned, friction_at(contact, contact.at_slip + part * turned) -
                              contact.at_friction - change_of_friction(contact, part * turned));
        }
      }
      return slope + rate * (force - film.load - rows[p].squeeze * at);
    };
    return problem_.pool->sum_of_blocks<double>(
               rows.size(),
               [&](std::size_t begin, std::size_t end) {
                 double sum = 0;
                 for (std::size_t p = begin; p < end; ++p) sum += slope_of(p);
                 return sum;
               },
               kPairsInBlock) -
           (1 - part) * curvature;
  };
  if (slope_at(1) <= StepTuning::kLargestSlope * curvature) return;
  double low = 0, high = 1;
  for (int k = 0; k < StepTuning::kBisections; ++k) {
    const double middle = (low + high) / 2;
    (slope_at(middle) > 0 ? high : low) = middle;
  }
  for (std::size_t k = 0; k < count; ++k) {
    motions_[k].along = before[k].along + high * change[k].along;
    motions_[k].turn = before[k].turn + high * change[k].turn;
  }
  if (rate_) rate_->value = rate_before + high * rate_change;
}

double SuspensionStep::least_power() const {
  double sum = 0;
  for (std::size_t k = 0; k < problem_.loads.size(); ++k) {
    double drag = 6 * std::numbers::pi * problem_.lubrication.viscosity * problem_.radii[k];
    if (k < inertia_.size()) drag += inertia_[k].move;
    sum += dot(problem_.loads[k].along, problem_.loads[k].along) / drag;
  }
  // The fluid alone would have this power.
  if (const auto& given = problem_.stress)
    sum += given->of_stress * given->of_stress / given->of_fluid;
  return StepTuning::kLeastPower * sum;
}

double SuspensionStep::rounding_power() const {
  double resistance = 0;
  for (const auto& film : films_)
    if (film.alpha > 0) resistance += film.alpha / film.at;
  for (const auto& contact : contacts_) resistance += contact.stiffness;
  const double speed = StepTuning::kGapRounding * problem_.mean_radius / problem_.h;
  return resistance * speed * speed;
}

double SuspensionStep::least_rate() const {
  double least = StepTuning::kRestStrain / problem_.h;
  if (!rate_) return least;
  // A contact may close or open its gap by the tolerance.
  if (!contacts_.empty()) least = StepTuning::kGapTolerance / problem_.h;
  const double shear = std::sqrt(2 * rate_->strain.contracted(rate_->strain));
  return std::max(least, StepTuning::kRestErrors * shear * rate_error());
}

double SuspensionStep::rate_error() const { return std::sqrt(rounding_power() / rate_->resisted); }

ConjugateGradients::Result SuspensionStep::solve_linear(const ConjugateGradients::End& end) {
  if (rate_) return solve_with_rate(end);
  const BlockPreconditioner preconditioner(system_.resistance(), *problem_.pool);
  return gradients_.solve(system_.resistance(), preconditioner, right_, motions_, end,
                          StepTuning::kMostIterations);
}

StepSolution SuspensionStep::solve() {
  StepSolution solution;
  const int rough = problem_.friction > 0 ? StepTuning::kRoughWithFriction : StepTuning::kRough;
  find_gaps();
  double tightening = problem_.friction > 0 ? StepTuning::kTightWithFriction : 1, allowed = 0;
  double first_allowed = 0, placed_allowed = 0;
  std::vector<Motion> before;
  while (solution.solutions < StepTuning::kMostSolutions) {
    if (solution.solutions < StepTuning::kMeasured ||
        allowed < StepTuning::kFallen * first_allowed) {
      sum_stresses(solution);
      const double tolerance = problem_.lubrication.pairs == PairTerms::kNone
                                   ? StepTuning::kToleranceWithoutFilm
                                   : StepTuning::kTolerance;
      allowed = tolerance * tolerance * std::max(std::abs(solution.dissipation), least_power());
      if (solution.solutions == 0) first_allowed = allowed;
    }
    const double rounding = rounding_power();
    if (problem_.friction > 0 && solution.solutions == StepTuning::kMostWithLoads) {
      for (auto& contact : contacts_) contact.given_bound = friction_bound(contact);
      if (!problem_.takes_given_bounds) break;
      bounds_ = Bounds::kGiven;
      acceleration_.forget();
    }
    ++unchanged_;
    linearise(solution.solutions == 0);
    const double rate_before = rate_ ? rate_->value : 0;
    if (rate_) linearise_rate();
    const bool is_checked = solution.solutions >= StepTuning::kUnchecked || problem_.friction > 0;
    if (is_checked) before = motions_;
    const auto result = solve_linear(
        {StepTuning::kSolved * std::max(tightening * allowed, rounding), StepTuning::kReduction});
    ++solution.solutions;
    solution.iterations += result.iterations;
    const bool is_steady = result.start <= std::max(tightening * allowed, rounding) &&
                           solution.solutions > 1 && is_film_exact_;
    const double tolerated = StepTuning::kGapTolerance * problem_.mean_radius;
    if (is_steady && gap_error_ <= tolerated && (!rate_ || rate_->is_right)) {
      const auto error = friction_error();
      solution.is_solved = error.with_bounds <= tolerated;
      solution.converged =
          solution.is_solved && error.with_loads <= tolerated && are_bounds_right();
      if (solution.is_solved && (solution.converged || bounds_ == Bounds::kGiven)) {
        // The last linear problem may have moved a pair too far.
        if (!rate_) find_gaps();
        if (gap_error_ <= tolerated) break;
        solution.is_solved = solution.converged = false;
      }
    }
    // Errors of the linear problem may be what remains.
    if (is_steady && result.iterations <= 1 && tightening > StepTuning::kTightest)
      tightening *= 0.1;
    if (is_checked && (count_changes() > 0 || !is_film_exact_ || problem_.friction > 0))
      shorten(before, rate_before, result.curvature);
    if (rate_) set_rate();
    // The motions may since have fallen to a small part of those by which pairs were placed.
    const bool is_placed_roughly =
        solution.solutions == rough ||
        (solution.solutions > rough && bounds_ == Bounds::kOfLoads && allowed > rounding &&
         allowed < StepTuning::kFallen * placed_allowed);
    if (is_placed_roughly) {
      place_again();
      placed_allowed = allowed;
    }
    find_gaps();
    // Multipliers are those of a problem that is solved, whose contacts are the right ones, or is
    // solved better than the change of multipliers is large.
    const bool is_early = !(problem_.friction > 0) && !rate_ &&
                          solution.solutions <= StepTuning::kMostEarly &&
                          result.start <= power_of_changes();
    if (is_placed_roughly || (!is_early && count_changes() > 0)) {
      acceleration_.forget();
    } else if (problem_.friction > 0) {
      update_friction(solution.solutions);
    } else {
      update_contacts();
    }
  }
  if (rate_) set_rate();
  // Those of the last motions.
  find_gaps();
  if (rate_) settle_rate(solution);
  solution.least_rate = least_rate();
  sum_stresses(solution);
  solution.motions = motions_;
  solution.changes = changes_of_velocities();
  solution.has_given_loads = bounds_ == Bounds::kGiven && !solution.converged;
  solution.residual = std::max(gap_error_, friction_error().with_loads) / problem_.mean_radius;
  solution.smallest_gap = smallest_gap_;
  for (const auto& contact : contacts_) {
    if (contact.memory.load > 0) ++solution.touching;
    if (contact.memory.load != 0 || contact.memory.least_load != 0)
      solution.contacts.push_back(memory_of(contact));
  }
  sort(solution.contacts);
  return solution;
}

}  // namespace viscontact::suspensions
