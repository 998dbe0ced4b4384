// Newton's method for the films, and an augmented Lagrangian for contacts.
#include "viscontact/suspensions/suspension_step.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace viscontact::suspensions {
namespace {

using particles::PairTerms;

struct StepTuning {
  // Residual of the last linear problem: its power error over the dissipation is the square.
  static constexpr double kTolerance = 1e-5;
  // Without films, where rounding errors would else grow by 1e8 in ten steps.
  static constexpr double kToleranceWithoutFilm = 1e-7;
  // The last linear problems are solved to this part of it, so that what changes after them, such as
  // directions at the end of the step, does not need another one.
  static constexpr double kSolved = 0.1;
  // The least dissipation that counts, over that of the loads on spheres alone, because spheres that
  // are pressed together and do not move have none.
  static constexpr double kLeastPower = 1e-6;
  // Each linear problem reduces its residual by this factor at least.
  static constexpr double kReduction = 1e-3;
  // Error of the gap of a contact and of friction_error(), in mean radii. A friction of loads of order
  // one has then errors of 1e-3 at most.
  static constexpr double kGapTolerance = 3e-8;
  static constexpr int kMostSolutions = 260;
  // After so many the loads that bound friction follow those of the contacts by this part of the
  // difference, because the iteration may else go on for ever: with it 1 of 100 steps of 0.01 of 200
  // spheres (volume fraction 0.45, roughness 1e-3, coefficient 0.5) is not solved, without it 72.
  // Of 0.1, 0.2, 0.3 and 0.5 this one solves most.
  static constexpr int kMostWithLoads = 40;
  static constexpr double kFollowed = 0.2;
  // After so many the bounds stay as they are.
  static constexpr int kMostFollowing = 200;
  // Error of a bound in use, over the bound, and over the largest one.
  static constexpr double kBoundTolerance = 3e-4, kLeastBound = 1e-6;
  static constexpr int kMostIterations = 5000;
  // The least factor on the tolerance of linear problems, beyond which rounding errors are met.
  static constexpr double kTightest = 1e-6;
  // After so many the motions are good enough for the place of pairs at half of the step.
  static constexpr int kRough = 2;
  // After so many linear problems a change is shortened if the slope at its end is above this part
  // of that at its begin. Without this, contacts may come and go for ever.
  static constexpr int kUnchecked = 3, kBisections = 6;
  static constexpr double kLargestSlope = 0.3;
  // Stiffness of the augmented Lagrangian over that of the film at contact.
  static constexpr double kStiffness = 10, kStiffnessAcross = 0.3;
  // Gaps in mean radii at which that film is taken, if solids touch at smaller ones.
  static constexpr double kLeastWidth = 1e-3, kWidthWithoutFilm = 1e-2;
  // A film is linearised at no less than this part of its width before.
  static constexpr double kLeastPart = 0.2;
  // Smaller gaps at the start of a step count as this one, such as those of spheres that touch.
  static constexpr double kLeastGap = 1e-7;
  // Gaps in mean radii below which a pair may touch in the step; others are added where they do.
  static constexpr double kNearGap = 0.1;
};

void sort(std::vector<ContactMemory>& contacts) {
  std::ranges::sort(contacts, [](const ContactMemory& a, const ContactMemory& b) {
    return a.first < b.first || (a.first == b.first && a.second < b.second);
  });
}

std::size_t index(std::int32_t k) { return static_cast<std::size_t>(k); }

/// The pairs at half of the step, if the spheres have these motions.
std::vector<PlacedPair> predicted(const StepProblem& problem, const std::vector<Motion>& motions) {
  std::vector<PlacedPair> result;
  result.reserve(problem.pairs.size());
  const double half = problem.h / 2;
  const Matrix carry = matrix_of(carried, problem.gradient, half);
  for (const auto& pair : problem.pairs) {
    const auto i = index(pair.first), j = index(pair.second);
    const double sum = problem.radii[i] + problem.radii[j], start = norm(pair.apart) - sum;
    const Vector apart =
        times(carry, pair.apart) + half * vector_of(motions[j].along - motions[i].along);
    const double distance = norm(apart);
    const double contact = problem.lubrication.roughness * sum / 2;
    // The prediction may close a gap; a film resists that.
    const double least =
        std::max({contact, start / 4, StepTuning::kLeastGap * problem.mean_radius});
    result.push_back(
        {pair.first, pair.second, (1 / distance) * apart, std::max(distance - sum, least)});
  }
  return result;
}

}  // namespace

/// Force f = [alpha ln((q' + delta)/(q + delta))/h + constant] n on the fluid by the second sphere,
/// > 0 where gaps open, linearised at the gap `at`.
struct SuspensionStep::Film {
  double alpha = 0;         // [M L/T]
  double start = 0;         // q + delta [L]
  double delta = 0;         // [L]
  double constant = 0;      // [M L/T^2]
  double arm = 0;           // the strain's share in the motion of the surfaces [L]
  double stress_axial = 0;  // beside the force [M L^2/T]
  Vector carried{};         // from the first to the second sphere, if they move with the flow [L]
  double affine_gap = 0;    // along the normal, if the spheres only move with the flow [L]
  double curvature = 0;     // the gap at the end less the linear one [L]
  double at = 0;            // q' + delta [L]
  double load = 0;          // linearised force without motion, with that of the contact
  std::int32_t contact = -1;

  double force(double h) const { return alpha * std::log(at / start) / h + constant; }
  // The same at a gap, which may be far below the last one.
  double force_at(double gap, double h) const {
    const double least = StepTuning::kLeastPart * at, width = std::max(gap + delta, least);
    return alpha * (std::log(width / start) + (gap + delta - width) / width) / h + constant;
  }
};

struct SuspensionStep::Contact {
  std::size_t pair = 0;
  ContactMemory memory;
  double gap = 0;            // at contact [L]
  double stiffness = 0;      // [M/T]
  double borne_by_film = 0;  // part of the load that has no friction, (gamma - gamma_min)/h
  bool pushes = false;       // its load is above the least one
  // Of friction [L]: l of the pair, by which forces across the normal turn it, and its parts.
  double arm = 0, arm_first = 0, arm_second = 0;
  double stiffness_across = 0;
  Lanes friction{};
  // Where friction was linearised: slip, friction, stiffness, and the direction without stiffness.
  bool slides = false;
  double given_bound = 0;  // of friction, unless it is that of the load
  Lanes at_slip{}, at_friction{}, direction{};
  double at_stiffness = 0;
  double turn_first = 0, turn_mixed = 0, turn_second = 0;  // of the film
};

SuspensionStep::SuspensionStep(StepProblem problem)
    : problem_(std::move(problem)),
      strain_(strain_rate_of(problem_.gradient)),
      system_(problem_.lubrication, problem_.radii, predicted(problem_, problem_.motions)),
      motions_(problem_.motions) {
  add_films();
  add_contacts();
}

SuspensionStep::~SuspensionStep() = default;

void SuspensionStep::place_again() {
  std::vector<double> widths;
  for (const auto& film : films_) widths.push_back(film.at);
  problem_.memories.clear();
  for (auto& contact : contacts_) {
    contact.memory.friction = vector_of(contact.friction);
    problem_.memories.push_back(contact.memory);
  }
  sort(problem_.memories);
  contacts_.clear();
  system_ = PairSystem(problem_.lubrication, problem_.radii, predicted(problem_, motions_));
  add_films();
  add_contacts();
  for (std::size_t p = 0; p < films_.size(); ++p) films_[p].at = widths[p];
}

void SuspensionStep::add_films() {
  auto& rows = system_.resistance().pairs;
  assert(rows.size() == problem_.pairs.size());
  const Matrix carry = matrix_of(carried, problem_.gradient, problem_.h);
  films_.assign(rows.size(), {});
  for (std::size_t p = 0; p < rows.size(); ++p) {
    auto& row = rows[p];
    auto& strain = system_.strains()[p];
    auto& film = films_[p];
    const auto& pair = problem_.pairs[p];
    const Vector n = vector_of(row.normal);
    const double sum = strain.radii, along = dot(n, strain_.times(n));
    film.carried = times(carry, pair.apart);
    film.delta = problem_.lubrication.regularisation * sum / 2;
    film.start =
        std::max(norm(pair.apart) - sum, StepTuning::kLeastGap * problem_.mean_radius) + film.delta;
    film.affine_gap = dot(n, film.carried) - sum;
    if (row.squeeze > 0) {
      // The resistance at half of the step, as if it were alpha/(q + delta) at all gaps nearby.
      film.alpha = row.squeeze * (system_.gap_of(p) + film.delta);
      film.arm = strain.squeeze / row.squeeze;
      film.stress_axial = strain.stress_axial - film.arm * strain.squeeze;
      // The flow opens the gap by r nEn, and the surfaces by arm nEn.
      film.constant = (strain.squeeze - row.squeeze * (sum + system_.gap_of(p))) * along;
    }
    film.at = film.start;
    row.squeeze = 0;
    strain.squeeze = 0;
    strain.stress_axial = 0;
  }
  given_loads_ = problem_.loads;
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
  const double a = problem_.radii[index(row.first)], b = problem_.radii[index(row.second)];
  const double mean = (a + b) / 2, reduced = a * b / (a + b);
  contact.gap = lubrication.roughness * mean;
  if (problem_.contact_film) {
    // Infinite for smooth spheres. Rounding errors may leave gamma just below gamma_min.
    const double carried =
        memory.least_load - problem_.contact_film->lowest_gamma(a, b) / problem_.h;
    contact.borne_by_film = std::max(carried, 0.0);
  }
  const double width = std::max(contact.gap + film.delta, (lubrication.pairs == PairTerms::kNone
                                                               ? StepTuning::kWidthWithoutFilm
                                                               : StepTuning::kLeastWidth) *
                                                              mean);
  const double film_at_contact =
      6 * std::numbers::pi * lubrication.viscosity * reduced * reduced / width;
  contact.stiffness = StepTuning::kStiffness * film_at_contact;
  if (problem_.friction > 0) {
    const double arm = 1 / row.inverse_arm;
    contact.arm_first = a * arm / (a + b);
    contact.arm_second = b * arm / (a + b);
    contact.arm = arm;
    contact.stiffness_across = StepTuning::kStiffnessAcross * film_at_contact;
    contact.friction = lanes_of(memory.friction);
    contact.friction -= dot(contact.friction, row.normal) * row.normal;
    contact.turn_first = row.turn_first;
    contact.turn_mixed = row.turn_mixed;
    contact.turn_second = row.turn_second;
  }
  contacts_.push_back(contact);
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
    else if (!is_kept_apart(p) && films_[p].start - films_[p].delta <
                                      (problem_.lubrication.roughness + StepTuning::kNearGap) *
                                          system_.strains()[p].radii / 2)
      add_contact(p, {row.first, row.second});
  }
}

bool SuspensionStep::is_kept_apart(std::size_t p) const {
  return films_[p].alpha > 0 && films_[p].delta == 0 && problem_.lubrication.roughness == 0;
}

double SuspensionStep::opening(std::size_t p, const std::vector<Motion>& motions) const {
  const auto& row = system_.resistance().pairs[p];
  return dot(row.normal, motions[index(row.second)].along - motions[index(row.first)].along);
}

Lanes SuspensionStep::slip_by_strain(const Contact& contact) const {
  const Lanes n = system_.resistance().pairs[contact.pair].normal;
  return -contact.arm * cross(n, lanes_of(strain_.times(vector_of(n))));
}

Lanes SuspensionStep::slip_by_motions(const Contact& contact,
                                      const std::vector<Motion>& motions) const {
  const auto& row = system_.resistance().pairs[contact.pair];
  const Lanes n = row.normal;
  const Motion &first = motions[index(row.first)], &second = motions[index(row.second)];
  const Lanes rotation = row.inverse_arm * cross(n, second.along - first.along);
  const Lanes sum =
      contact.arm_first * (first.turn - rotation) + contact.arm_second * (second.turn - rotation);
  return sum - dot(sum, n) * n;
}

Lanes SuspensionStep::slip(const Contact& contact, const std::vector<Motion>& motions) const {
  return slip_by_motions(contact, motions) + slip_by_strain(contact);
}

void SuspensionStep::find_gaps() {
  const auto& rows = system_.resistance().pairs;
  const Matrix mean = matrix_of(mean_carried, problem_.gradient, problem_.h);
  gap_error_ = 0;
  smallest_gap_ = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < rows.size(); ++p) {
    auto& film = films_[p];
    const auto& pair = problem_.pairs[p];
    const Vector change =
        vector_of(motions_[index(pair.second)].along - motions_[index(pair.first)].along);
    const Vector apart = film.carried + problem_.h * times(mean, change);
    const double distance = norm(apart);
    // A gap along the normal is a lower bound of the gap. A film whose gap may become 0 has this
    // one: with the gap itself, spheres that pass each other come as near as 1e-12.
    film.curvature = (is_kept_apart(p) ? dot(vector_of(rows[p].normal), apart) : distance) -
                     system_.strains()[p].radii - film.affine_gap -
                     problem_.h * opening(p, motions_);
    const double gap = distance - system_.strains()[p].radii;
    smallest_gap_ = std::min(smallest_gap_, gap);
    if (film.contact < 0) {
      if (is_kept_apart(p)) continue;
      const double least = problem_.lubrication.roughness * system_.strains()[p].radii / 2;
      if (gap < least) add_contact(p, {pair.first, pair.second});
    }
    if (film.contact < 0) continue;
    const auto& contact = contacts_[index(film.contact)];
    const double over = gap - contact.gap;
    // Where the load is the least one the gap may be open.
    const double error =
        contact.memory.load > contact.memory.least_load ? std::abs(over) : std::max(-over, 0.0);
    gap_error_ = std::max(gap_error_, error);
  }
}

void SuspensionStep::linearise(bool is_first) {
  auto& rows = system_.resistance().pairs;
  right_ = given_loads_;
  is_film_exact_ = true;
  system_.resistance().slips.clear();
  for (std::size_t p = 0; p < rows.size(); ++p) {
    auto& row = rows[p];
    auto& film = films_[p];
    const double h = problem_.h, affine = film.affine_gap + film.curvature;
    const double gap = affine + h * opening(p, motions_);
    row.squeeze = 0;
    film.load = 0;
    if (film.alpha > 0) {
      const double least = StepTuning::kLeastPart * film.at;
      if (gap + film.delta < least) is_film_exact_ = false;
      film.at = std::max(gap + film.delta, least);
      row.squeeze = film.alpha / film.at;
      film.load = film.force(h) + row.squeeze * (affine + film.delta - film.at) / h;
    }
    Lanes turn1{}, turn2{};
    if (film.contact >= 0) {
      auto& contact = contacts_[index(film.contact)];
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
      if (problem_.friction > 0) linearise_friction(contact, turn1, turn2);
    }
    const Lanes along = film.load * row.normal + row.inverse_arm * cross(row.normal, turn1 + turn2);
    auto &first = right_[index(row.first)], &second = right_[index(row.second)];
    first.along += along;
    first.turn -= turn1;
    second.along -= along;
    second.turn -= turn2;
  }
}

double SuspensionStep::friction_bound(const Contact& contact) const {
  return bounds_ == Bounds::kOfLoads ? coulomb_bound(contact) : contact.given_bound;
}

double SuspensionStep::coulomb_bound(const Contact& contact) const {
  return problem_.friction * std::max(contact.memory.load - contact.borne_by_film, 0.0);
}

void SuspensionStep::linearise_friction(Contact& contact, Lanes& turn1, Lanes& turn2) {
  auto& resistance = system_.resistance();
  auto& row = resistance.pairs[contact.pair];
  const Lanes here = slip(contact, motions_);
  const Lanes trial = contact.friction + contact.stiffness_across * here;
  const double size = std::sqrt(dot(trial, trial)), bound = friction_bound(contact);
  contact.slides = size > bound;
  const double share = contact.slides ? bound / size : 1;
  const double stiffness = share * contact.stiffness_across;
  row.turn_first = contact.turn_first + stiffness * contact.arm_first * contact.arm_first;
  row.turn_mixed = contact.turn_mixed + stiffness * contact.arm_first * contact.arm_second;
  row.turn_second = contact.turn_second + stiffness * contact.arm_second * contact.arm_second;
  contact.at_slip = here;
  contact.at_friction = share * trial;
  contact.at_stiffness = stiffness;
  contact.direction = contact.slides ? (1 / size) * trial : Lanes{};
  if (contact.slides)
    resistance.slips.push_back({row.normal, contact.direction, stiffness, contact.arm_first,
                                contact.arm_second, row.first, row.second});
  const Lanes load =
      contact.at_friction - change_of_friction(contact, here - slip_by_strain(contact));
  turn1 = contact.arm_first * load;
  turn2 = contact.arm_second * load;
}

Lanes SuspensionStep::change_of_friction(const Contact& contact, const Lanes& change) {
  return contact.at_stiffness * (change - dot(contact.direction, change) * contact.direction);
}

Lanes SuspensionStep::friction_at(const Contact& contact, const Lanes& at_slip) const {
  const Lanes trial = contact.friction + contact.stiffness_across * at_slip;
  const double size = std::sqrt(dot(trial, trial)), bound = friction_bound(contact);
  return (size > bound ? bound / size : 1) * trial;
}

SuspensionStep::FrictionError SuspensionStep::friction_error() const {
  FrictionError error;
  if (!(problem_.friction > 0)) return error;
  for (const auto& contact : contacts_) {
    const Lanes here = slip(contact, motions_), force = friction_at(contact, here);
    const Lanes trial = force + contact.stiffness_across * here;
    const double size = std::sqrt(dot(trial, trial));
    const auto error_of = [&](double bound) {
      const Lanes wrong = force - (size > bound ? bound / size : 1) * trial;
      return problem_.h * std::sqrt(dot(wrong, wrong)) / contact.stiffness_across;
    };
    error.with_bounds = std::max(error.with_bounds, error_of(friction_bound(contact)));
    error.with_loads = std::max(error.with_loads, error_of(coulomb_bound(contact)));
  }
  return error;
}

bool SuspensionStep::are_bounds_right() const {
  double largest = 0;
  for (const auto& contact : contacts_) largest = std::max(largest, coulomb_bound(contact));
  return std::ranges::all_of(contacts_, [&](const Contact& contact) {
    const double right = coulomb_bound(contact);
    return std::abs(friction_bound(contact) - right) <=
           StepTuning::kBoundTolerance * right + StepTuning::kLeastBound * largest;
  });
}

double SuspensionStep::trial_load(const Contact& contact) const {
  const auto& film = films_[contact.pair];
  const double gap =
      film.affine_gap + film.curvature + problem_.h * opening(contact.pair, motions_);
  return contact.memory.load - contact.stiffness * (gap - contact.gap) / problem_.h;
}

std::size_t SuspensionStep::count_changes() const {
  return static_cast<std::size_t>(std::ranges::count_if(contacts_, [&](const Contact& contact) {
    return (trial_load(contact) > contact.memory.least_load) != contact.pushes;
  }));
}

void SuspensionStep::update_contacts() {
  for (auto& contact : contacts_) {
    contact.memory.load = std::max(trial_load(contact), contact.memory.least_load);
    if (bounds_ == Bounds::kFollowing)
      contact.given_bound += StepTuning::kFollowed * (coulomb_bound(contact) - contact.given_bound);
    if (!(problem_.friction > 0)) continue;
    contact.friction = friction_at(contact, slip(contact, motions_));
  }
}

void SuspensionStep::sum_stresses(StepSolution& solution) {
  auto& rows = system_.resistance().pairs;
  // The terms of films and contacts along n are added apart.
  std::vector<double> squeezes(rows.size());
  for (std::size_t p = 0; p < rows.size(); ++p) squeezes[p] = std::exchange(rows[p].squeeze, 0);
  for (auto& contact : contacts_) {
    if (!(problem_.friction > 0)) break;
    auto& row = rows[contact.pair];
    row.turn_first = contact.turn_first;
    row.turn_mixed = contact.turn_mixed;
    row.turn_second = contact.turn_second;
  }
  system_.resistance().slips.clear();
  auto& sums = solution.stresses;
  sums = {};
  sums.film.stress = system_.stresslets(motions_, strain_);
  std::vector<Motion> product(motions_.size()), strained(motions_.size());
  system_.resistance().multiply(motions_, product);
  system_.subtract_strain_loads(strain_, strained);
  solution.dissipation = sums.film.stress.contracted(strain_);
  double given = 0;
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    const auto &v = motions_[k], &given_load = problem_.loads[k];
    solution.dissipation += dot(v.along, product[k].along - strained[k].along) +
                            dot(v.turn, product[k].turn - strained[k].turn);
    given += dot(v.along, given_load.along) + dot(v.turn, given_load.turn);
  }
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const auto& row = rows[p];
    const auto& film = films_[p];
    const Vector n = vector_of(row.normal);
    const double along = dot(n, strain_.times(n)), rate = opening(p, motions_);
    if (film.alpha > 0) {
      const double gap = film.affine_gap + film.curvature + problem_.h * rate;
      const double force =
          film.alpha * std::log(std::max(gap + film.delta, film.at / 2) / film.start) / problem_.h +
          film.constant;
      const double axial = film.arm * force + film.stress_axial * along;
      auto& stress = sums.film.stress;
      stress.add_dyad(axial, n, n);
      stress.add_isotropic((system_.strains()[p].radii * force - axial) / 3);
      solution.dissipation += force * (rate + film.arm * along) + film.stress_axial * along * along;
    }
    if (film.contact < 0) continue;
    const auto& contact = contacts_[index(film.contact)];
    const double load = contact.memory.load;
    const Vector change =
        vector_of(motions_[index(row.second)].along - motions_[index(row.first)].along);
    const Vector lever = mean_path(problem_.gradient, problem_.h, problem_.pairs[p].apart, change);
    if (load != 0) {
      sums.contact.add_pair_force(load * n, lever, problem_.gradient);
      solution.dissipation -= load * (rate + dot(n, times(problem_.gradient, lever)));
    }
    if (!(problem_.friction > 0) || !(dot(contact.friction, contact.friction) > 0)) continue;
    const Vector force = vector_of(cross(contact.friction, row.normal));
    sums.friction.stress.add_dyad(-contact.arm, n, force);
    sums.friction.power -= contact.arm * dot(force, strain_.times(n));
    solution.dissipation += dot(contact.friction, slip(contact, motions_));
  }
  // The power that the dissipation needs. It differs from stress:E by the residuals of the motions,
  // and has an error of their square.
  sums.film.power = solution.dissipation - given - sums.contact.power - sums.friction.power;
  for (std::size_t p = 0; p < rows.size(); ++p) rows[p].squeeze = squeezes[p];
}

void SuspensionStep::shorten(const std::vector<Motion>& before) {
  const std::size_t count = motions_.size();
  std::vector<Motion> change(count), product(count);
  for (std::size_t k = 0; k < count; ++k) {
    change[k].along = motions_[k].along - before[k].along;
    change[k].turn = motions_[k].turn - before[k].turn;
  }
  system_.resistance().multiply(change, product);
  double curvature = 0;
  for (std::size_t k = 0; k < count; ++k)
    curvature += dot(change[k].along, product[k].along) + dot(change[k].turn, product[k].turn);
  const auto& rows = system_.resistance().pairs;
  const double h = problem_.h;
  // The slope of the function to be minimised at a part of the change: that of the linear problem,
  // and what films, contacts and friction differ from it.
  const auto slope_at = [&](double part) {
    double slope = -(1 - part) * curvature;
    for (std::size_t p = 0; p < rows.size(); ++p) {
      const auto& film = films_[p];
      if (film.alpha == 0 && film.contact < 0) continue;
      const double rate = opening(p, change), at = opening(p, before) + part * rate;
      const double gap = film.affine_gap + film.curvature + h * at;
      double force = film.alpha > 0 ? film.force_at(gap, h) : 0;
      if (film.contact >= 0) {
        const auto& contact = contacts_[index(film.contact)];
        force -= std::max(contact.memory.load - contact.stiffness * (gap - contact.gap) / h,
                          contact.memory.least_load);
        if (problem_.friction > 0) {
          const Lanes turned = slip_by_motions(contact, change);
          slope +=
              dot(turned, friction_at(contact, contact.at_slip + part * turned) -
                              contact.at_friction - change_of_friction(contact, part * turned));
        }
      }
      slope += rate * (force - film.load - rows[p].squeeze * at);
    }
    return slope;
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
}

double SuspensionStep::least_power() const {
  double sum = 0;
  for (std::size_t k = 0; k < problem_.loads.size(); ++k) {
    const double drag = 6 * std::numbers::pi * problem_.lubrication.viscosity * problem_.radii[k];
    sum += dot(problem_.loads[k].along, problem_.loads[k].along) / drag;
  }
  return StepTuning::kLeastPower * sum;
}

StepSolution SuspensionStep::solve() {
  StepSolution solution;
  find_gaps();
  double tightening = 1, allowed = 0;
  std::vector<Motion> before;
  while (solution.solutions < StepTuning::kMostSolutions) {
    if (solution.solutions < 3) {
      sum_stresses(solution);
      const double tolerance = problem_.lubrication.pairs == PairTerms::kNone
                                   ? StepTuning::kToleranceWithoutFilm
                                   : StepTuning::kTolerance;
      allowed = tolerance * tolerance * std::max(std::abs(solution.dissipation), least_power());
    }
    if (problem_.friction > 0 && solution.solutions == StepTuning::kMostWithLoads) {
      for (auto& contact : contacts_) contact.given_bound = friction_bound(contact);
      bounds_ = Bounds::kFollowing;
    }
    if (problem_.friction > 0 && solution.solutions == StepTuning::kMostFollowing)
      bounds_ = Bounds::kGiven;
    linearise(solution.solutions == 0);
    const bool is_checked = solution.solutions >= StepTuning::kUnchecked || problem_.friction > 0;
    if (is_checked) before = motions_;
    const BlockPreconditioner preconditioner(system_.resistance());
    const auto result =
        gradients_.solve(system_.resistance(), preconditioner, right_, motions_,
                         {tightening * StepTuning::kSolved * allowed, StepTuning::kReduction},
                         StepTuning::kMostIterations);
    ++solution.solutions;
    solution.iterations += result.iterations;
    const bool is_steady =
        result.start <= tightening * allowed && solution.solutions > 1 && is_film_exact_;
    const double tolerated = StepTuning::kGapTolerance * problem_.mean_radius;
    if (is_steady && gap_error_ <= tolerated) {
      const auto error = friction_error();
      solution.is_solved = error.with_bounds <= tolerated;
      solution.converged =
          solution.is_solved && error.with_loads <= tolerated && are_bounds_right();
      if (solution.is_solved && (solution.converged || bounds_ == Bounds::kGiven)) break;
    }
    // Errors of the linear problem may be what remains.
    if (is_steady && result.iterations <= 1 && tightening > StepTuning::kTightest)
      tightening *= 0.1;
    if (is_checked && (count_changes() > 0 || !is_film_exact_ || problem_.friction > 0))
      shorten(before);
    if (solution.solutions == StepTuning::kRough) place_again();
    find_gaps();
    // Multipliers are those of a problem that is solved, whose contacts are the right ones.
    if (solution.solutions != StepTuning::kRough && count_changes() == 0) update_contacts();
  }
  sum_stresses(solution);
  solution.motions = motions_;
  solution.has_given_loads = bounds_ == Bounds::kGiven && !solution.converged;
  solution.residual = std::max(gap_error_, friction_error().with_loads) / problem_.mean_radius;
  solution.smallest_gap = smallest_gap_;
  for (auto& contact : contacts_) {
    contact.memory.friction = vector_of(contact.friction);
    if (contact.memory.load > 0) ++solution.touching;
    if (contact.memory.load != 0 || contact.memory.least_load != 0)
      solution.contacts.push_back(contact.memory);
  }
  sort(solution.contacts);
  return solution;
}

}  // namespace viscontact::suspensions
