// The impact of a step in a fluid, docs/physics.md (6.11): in the compression the solids come to
// rest, in the restitution they give back the share e_d of the impulse that they took up.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "viscontact/immersed/contacts/closed_contacts.hpp"
#include "viscontact/immersed/fluid_motion.hpp"
#include "viscontact/particles/contact/shaped_contacts.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of the impact.
struct FluidImpactTuning {
  // An approach counts only if it changes the gap in the step by more than a thousandth of the
  // tolerance of gaps, and if its velocity exceeds rounding errors.
  static constexpr double kUnseen = 1e-3, kRounding = 1e-12;
  // A contact that bore a load is hit only if its surfaces approached each other faster than
  // kUnderLoad times the rate that the forces of a step cause. Otherwise small rebounds would
  // keep a packing moving. impacts/impacts.cpp uses the same number.
  static constexpr double kUnderLoad = 5;
  // After 50 halvings the error of the share is about a rounding error.
  static constexpr int kHalvings = 50;
  // The rate of a gap below this share of its rate before is a rounding error.
  static constexpr double kAtRest = 1e-9;
};

/// The rate [L/T] at which a gap grows while the particles rest.
double drift_of(const Contact<2>& contact, const Pair& pair, const FluidImpactStep& step,
                double h) {
  const auto& p = step.state.particles;
  if (contact.is_stop()) return 0;
  if (contact.first >= 0) {
    if (contact.image == 0) return 0;
    const auto velocity = velocity_of_image(p.cell, contact.image);
    return contact.normal[0] * velocity[0] + contact.normal[1] * velocity[1];
  }
  const auto& obstacle = step.obstacles[index_of(contact.obstacle)];
  const auto k = index_of(contact.second);
  const auto gap_at = [&](double t) {
    if (is_round(p, pair)) return gap(obstacle.at(t), p.position(k), p.radii[k]);
    const auto place = obstacle.at(t);
    const auto shape = p.placed_shape(k);
    return WallContacts(place, shape).at(pair.place, place, shape).gap;
  };
  return (gap_at(step.end) - gap_at(step.state.time)) / h;
}

/// One impact, whose work is not positive. solve() may be called once. It calls the other functions
/// in an order in which each one uses members of `parts_` that those before it have set.
class Impact {
 public:
  Impact(const StepContacts& contacts, const FluidImpactStep& step, const Mobility& mobility,
         const ContactConditions& conditions)
      : ordinary_(contacts),
        step_(step),
        laws_(step.setting.laws),
        mobility_(mobility),
        conditions_(conditions),
        parts_(contacts.contacts.size()) {}

  std::optional<FluidImpact> solve();

 private:
  struct Part {
    double drift = 0;        // drift_of() [L/T]
    double start = 0;        // gap at the beginning of the step, >= 0 [L]
    double pull = 0;         // rate of the gap by the forces of the step on particles at rest [L/T]
    bool is_closed = false;  // at the beginning of the step
    bool is_hit = false;     // its gap closes in the step by an approach, not by the load alone
    double hit_at = 0;       // time of the hit in the step over its length [1], 0 to 1
    double load = 0;  // impulse of the contact if particles are at rest [M L/T], see take_load()
    // The following numbers are impulses [M L/T].
    double compressed = 0;  // impulse at the end of the compression, load included
    double solid = 0;       // part of `compressed` that the solids take up beyond the load, >= 0
    double left = 0;        // gamma at the end of the compression, <= 0
    double restored = 0;    // least impulse of the whole impact: compressed + left + e_d solid
  };

  /// Sets the members of each part from `drift` to `hit_at`. Returns true if a contact is hit.
  bool find_hits();
  /// The contact problem of an impact. Its impulses act on the velocities as forces would do in the
  /// time FluidImpactStep::impulse_time [T]. The gaps of hit contacts are 0; those of all others
  /// are multiplied by impulse_time/h, so that they close at the same velocity as in the step.
  StepContacts problem() const;
  /// Sets Part::load of the contacts that are closed or hit: the impulses that would keep these
  /// gaps from closing if the forces of the step acted on particles at rest. Returns true if
  /// solved.
  bool take_load();
  /// Divides the impulses at the end of the compression between films and solids. Returns true if
  /// the solids of a contact give back more than its load; otherwise the particles would be apart
  /// for less than two steps, and there is no impact.
  bool share_impulses(const std::vector<Contact<2>>& compressed);
  /// Keeps an impact from adding energy, which it can do if several contacts have films: moves the
  /// impulses `restored` towards those of the compression until their work is not positive.
  void restrain(const StepContacts& compressed, StepContacts& restored) const;
  /// Sets FluidImpact::moved. A hit contact exerts no force until its hit, and then the force of
  /// the impact. A contact that is not hit exerts its load until the first hit, and then that
  /// force.
  void move(FluidImpact& impact);
  /// Sets FluidImpact::absorbed and FluidImpact::rebounds.
  void book(FluidImpact& impact) const;

  // The stop of a hinge has no film and is in no list: its pair is empty.
  const Pair& pair(std::size_t c) const {
    static const Pair kOfStop{};
    const auto n = ordinary_.pairs.size();
    if (ordinary_.contacts[c].is_stop()) return kOfStop;
    return c < n ? ordinary_.pairs[c] : ordinary_.walls[c - n];
  }
  // gamma_min of contact `c` [M L/T].
  double lowest_gamma(std::size_t c) const {
    if (ordinary_.contacts[c].is_stop()) return 0;
    const auto& of = pair(c);
    return laws_.lowest_gamma(of, step_.state.memories.of(of.memory), ordinary_.circles[c].radii);
  }
  double rate(std::size_t c, std::span<const double> velocities) const {
    return opening(ordinary_.contacts[c], velocities.data(), conditions_.layout) + parts_[c].drift;
  }
  // For a problem in which the impulse of a contact is its force times `length` [T].
  ContactConditions conditions_over(double length) const {
    auto conditions = conditions_;
    conditions.h = length;
    conditions.share_of_impulse = 1;
    return conditions;
  }

  const StepContacts& ordinary_;  // the contacts of the step, as it was solved without restitution
  const FluidImpactStep& step_;
  const ContactLaws& laws_;
  const Mobility& mobility_;
  const ContactConditions& conditions_;
  std::vector<Part> parts_;
  int iterations_ = 0;  // of all problems
  StagesRun stages_;    // of the same
};

bool Impact::find_hits() {
  const auto free = conditions_.free_velocities;
  const double h = conditions_.h;
  const double touching = conditions_.solver.tolerance * conditions_.mean_radius;
  const double unseen =
      std::max(FluidImpactTuning::kUnseen * touching / h,
               FluidImpactTuning::kRounding * std::max(fastest(free, conditions_.layout),
                                                       fastest(step_.before, conditions_.layout)));
  const auto approaches = [&](std::size_t c) {
    const auto& part = parts_[c];
    const double approach = rate(c, free);
    return ordinary_.contacts[c].w > 0 && -approach > unseen && part.start + h * approach < 0 &&
           (!part.is_closed || -rate(c, step_.before) > unseen);
  };
  std::vector<std::size_t> approaching;
  for (std::size_t c = 0; c < parts_.size(); ++c) {
    auto& part = parts_[c];
    const auto& contact = ordinary_.contacts[c];
    part.drift = drift_of(contact, pair(c), step_, h);
    part.start = std::max(0.0, contact.gap - h * part.drift);
    part.is_closed = part.start <= touching || contact.lowest < 0;
    if (approaches(c)) approaching.push_back(c);
  }
  if (approaching.empty()) return false;
  // Driven particles count as at rest, because forces do not change their velocity.
  const auto of_free = [&](std::span<const double> velocities) {
    std::vector<double> result(velocities.begin(), velocities.end());
    for (const auto& [particle, motion] : step_.setting.given_motions)
      std::fill_n(result.begin() + static_cast<std::ptrdiff_t>(conditions_.layout.at(particle, 0)),
                  conditions_.layout.components, 0.0);
    return result;
  };
  const auto loaded = of_free(step_.loaded()), after = of_free(free),
             before = of_free(step_.before);
  for (std::size_t c = 0; c < parts_.size(); ++c) {
    const double by_load = rate(c, loaded) - parts_[c].drift;
    parts_[c].pull = std::min(by_load, rate(c, after) - rate(c, before));
  }
  bool any = false;
  for (const auto c : approaching) {
    auto& part = parts_[c];
    const auto& of = pair(c);
    const bool bore_load = of.impulse != 0 || of.gamma < 0;
    if (part.is_closed && bore_load &&
        !(rate(c, step_.before) < FluidImpactTuning::kUnderLoad * part.pull))
      continue;
    part.is_hit = any = true;
    part.hit_at = part.start / (-rate(c, free) * h);
  }
  return any;
}

StepContacts Impact::problem() const {
  const double impulse_time = step_.impulse_time;
  StepContacts problem;
  problem.contacts = ordinary_.contacts;
  for (std::size_t c = 0; c < parts_.size(); ++c) {
    auto& contact = problem.contacts[c];
    contact.gap = parts_[c].is_hit ? impulse_time * parts_[c].drift
                                   : contact.gap * (impulse_time / conditions_.h);
    contact.lowest *= conditions_.share_of_impulse;
    contact.impulse *= conditions_.share_of_impulse;
  }
  return problem;
}

bool Impact::take_load() {
  auto load = problem();
  std::vector<Contact<2>> contacts;
  std::vector<std::size_t> numbers;
  for (std::size_t c = 0; c < parts_.size(); ++c) {
    const auto& part = parts_[c];
    if (!part.is_hit && !part.is_closed) continue;
    auto& contact = load.contacts[c];
    contact.gap = step_.impulse_time * part.pull;
    contact.impulse = part.is_hit ? 0 : contact.impulse;
    contacts.push_back(contact);
    numbers.push_back(c);
  }
  load.contacts = std::move(contacts);
  const std::vector<double> still(conditions_.free_velocities.size());
  auto conditions = conditions_over(step_.impulse_time);
  conditions.free_velocities = still;
  solve_listed(load, mobility_, conditions);
  iterations_ += load.iterations;
  stages_ += load.stages;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    parts_[numbers[i]].load = load.contacts[i].impulse;
  return load.is_solved;
}

bool Impact::share_impulses(const std::vector<Contact<2>>& compressed) {
  bool any = false;
  for (std::size_t c = 0; c < parts_.size(); ++c) {
    auto& part = parts_[c];
    const double gamma = pair(c).gamma, lowest = lowest_gamma(c);
    part.compressed = compressed[c].impulse;
    const double by_load = std::clamp(gamma - part.load, lowest, 0.0);
    part.solid = RestitutionLaw::solid_impulse(part.compressed - part.load, by_load - lowest);
    part.left = std::clamp(gamma - part.compressed, lowest, 0.0);
    // A contact that is neither hit nor closed may close after the impact only.
    const bool gives_back = !compressed[c].is_stop() &&
                            laws_.restitution.coefficient * part.solid > std::max(part.load, 0.0);
    if (gives_back && (part.is_hit || part.is_closed))
      any = true;
    else
      part.solid = 0;
  }
  return any;
}

void Impact::restrain(const StepContacts& compressed, StepContacts& restored) const {
  // The sum over the contacts of the impulse times the mean of the rates of the gap before and
  // after the impact.
  const auto work = [&](double share) {
    double sum = 0;
    for (std::size_t c = 0; c < parts_.size(); ++c) {
      const double from = compressed.contacts[c].impulse, to = restored.contacts[c].impulse;
      if (from == 0 && to == 0) continue;
      const double before = rate(c, conditions_.free_velocities),
                   least = rate(c, compressed.velocities), most = rate(c, restored.velocities);
      sum += (from + share * (to - from)) * (before + least + share * (most - least)) / 2;
    }
    return sum;
  };
  if (!(work(1) > 0)) return;
  double low = 0, high = 1;
  for (int n = 0; n < FluidImpactTuning::kHalvings; ++n) {
    const double middle = (low + high) / 2;
    (work(middle) > 0 ? high : low) = middle;
  }
  const auto go_back = [&](double from, double& to) { to = from + low * (to - from); };
  for (std::size_t c = 0; c < parts_.size(); ++c) {
    auto& contact = restored.contacts[c];
    go_back(compressed.contacts[c].impulse, contact.impulse);
    // The impulse is then at its bound, so that measure_residuals() allows the gap to open.
    contact.lowest = contact.impulse;
  }
  for (std::size_t i = 0; i < restored.loads.size(); ++i) {
    go_back(compressed.loads[i], restored.loads[i]);
    go_back(compressed.velocities[i], restored.velocities[i]);
  }
}

void Impact::move(FluidImpact& impact) {
  const auto& layout = conditions_.layout;
  double first = 1;
  for (const auto& part : parts_)
    if (part.is_hit) first = std::min(first, part.hit_at);
  std::vector<double> loads(impact.velocities.size());
  for (std::size_t c = 0; c < parts_.size(); ++c) {
    const auto& part = parts_[c];
    const double load = part.is_hit ? 0 : part.load;
    const double rest = 1 - (part.is_hit ? part.hit_at : first);
    const double impulse = load + rest * (impact.contacts[c].impulse - load);
    add_contact_force(impact.contacts[c], impulse / step_.impulse_time, loads, layout);
  }
  impact.moved = mobility_(loads);
  ++iterations_;
  for (std::size_t i = 0; i < impact.moved.size(); ++i)
    impact.moved[i] += conditions_.free_velocities[i];
  // Because hits have different times, some particles may now overlap, or a gap may be open
  // although its film still pulls. Contact forces then change the displacements.
  StepContacts gaps;
  gaps.contacts = ordinary_.contacts;
  const double allowed = conditions_.solver.tolerance * conditions_.mean_radius / 2;
  bool any_off = false;
  for (std::size_t c = 0; c < parts_.size(); ++c) {
    auto& contact = gaps.contacts[c];
    contact.impulse = 0;
    contact.lowest =
        std::min(0.0, pair(c).gamma - impact.absorbed[c]) / conditions_.share_of_impulse;
    const double after = gap_after(contact, impact.moved.data(), conditions_.h, layout);
    any_off = any_off || after < -allowed || (contact.lowest < 0 && after > allowed);
  }
  if (!any_off) return;
  auto conditions = conditions_;
  conditions.free_velocities = impact.moved;
  solve_listed(gaps, mobility_, conditions);
  iterations_ += gaps.iterations;
  stages_ += gaps.stages;
  impact.is_solved = impact.is_solved && gaps.is_solved;
  impact.moved = std::move(gaps.velocities);
}

void Impact::book(FluidImpact& impact) const {
  for (std::size_t c = 0; c < parts_.size(); ++c) {
    const auto& part = parts_[c];
    const auto& contact = impact.contacts[c];
    const auto& of = pair(c);
    impact.absorbed.push_back(contact.impulse);
    if (!(part.solid > 0)) continue;
    const double gamma =
        RestitutionLaw::gamma_after(part.restored, contact.impulse, lowest_gamma(c), of.gamma);
    impact.absorbed.back() = of.gamma - gamma;
    const double approach = rate(c, conditions_.free_velocities),
                 after = rate(c, impact.velocities);
    impact.rebounds.push_back(
        {step_.state.time + part.hit_at * conditions_.h, of.first, of.second,
         std::min(approach, 0.0), part.solid,
         after <= FluidImpactTuning::kAtRest * std::abs(approach) ? 0 : after});
  }
}

std::optional<FluidImpact> Impact::solve() {
  if (!find_hits()) return std::nullopt;
  const auto conditions = conditions_over(step_.impulse_time);
  auto compressed = problem();
  solve_listed(compressed, mobility_, conditions);
  correct_impulses(compressed, 0, mobility_, conditions);
  iterations_ += compressed.iterations;
  stages_ += compressed.stages;
  const bool knows_loads = take_load();
  if (!share_impulses(compressed.contacts)) return std::nullopt;
  auto restored = problem();
  for (std::size_t c = 0; c < parts_.size(); ++c) {
    auto& part = parts_[c];
    auto& contact = restored.contacts[c];
    contact.impulse = part.compressed;
    if (part.solid > 0)
      contact.lowest = part.restored =
          part.compressed + laws_.restitution.lowest_in_restitution(part.left, part.solid);
  }
  solve_listed(restored, mobility_, conditions);
  correct_impulses(restored, 0, mobility_, conditions);
  iterations_ += restored.iterations;
  stages_ += restored.stages;
  restrain(compressed, restored);
  FluidImpact impact;
  impact.is_solved = compressed.is_solved && knows_loads && restored.is_solved;
  impact.contacts = std::move(restored.contacts);
  impact.loads = std::move(restored.loads);
  impact.velocities = std::move(restored.velocities);
  impact.of_gaps = std::move(restored.of_gaps);
  impact.amplification = restored.amplification;
  book(impact);
  move(impact);
  impact.iterations = iterations_;
  impact.stages = stages_;
  return impact;
}

}  // namespace

std::optional<FluidImpact> solve_impact(const StepContacts& contacts, const FluidImpactStep& step,
                                        const Mobility& mobility,
                                        const ContactConditions& conditions) {
  assert(step.impulse_time > 0 && step.end > step.state.time);
  assert(step.before.size() == conditions.free_velocities.size());
  return Impact(contacts, step, mobility, conditions).solve();
}

}  // namespace viscontact::particles
