// Newton's method for the films, and an augmented Lagrangian for contacts.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/step_parts.hpp"
namespace viscontact::suspensions {
namespace {

using particles::PairTerms;

void sort(std::vector<ContactMemory>& contacts) {
  std::ranges::sort(contacts, [](const ContactMemory& a, const ContactMemory& b) {
    return a.first < b.first || (a.first == b.first && a.second < b.second);
  });
}

/// The pairs at half of the step, if the spheres have these motions.
std::vector<PlacedPair> predicted(const StepProblem& problem, const std::vector<Motion>& motions) {
  std::vector<PlacedPair> result;
  result.reserve(problem.pairs.size());
  const double half = problem.h / 2;
  const Matrix carry = matrix_of(carried, problem.gradient, half);
  for (const auto& pair : problem.pairs) {
    const auto i = index_of(pair.first), j = index_of(pair.second);
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
  const double a = problem_.radii[index_of(row.first)], b = problem_.radii[index_of(row.second)];
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
  return dot(row.normal, motions[index_of(row.second)].along - motions[index_of(row.first)].along);
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
        vector_of(motions_[index_of(pair.second)].along - motions_[index_of(pair.first)].along);
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
    const auto& contact = contacts_[index_of(film.contact)];
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
      if (problem_.friction > 0) linearise_friction(contact, turn1, turn2);
    }
    const Lanes along = film.load * row.normal + row.inverse_arm * cross(row.normal, turn1 + turn2);
    auto &first = right_[index_of(row.first)], &second = right_[index_of(row.second)];
    first.along += along;
    first.turn -= turn1;
    second.along -= along;
    second.turn -= turn2;
  }
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
        const auto& contact = contacts_[index_of(film.contact)];
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
