// Measures the residuals of the contacts and links of a step after a solution (step_projection.hpp).
#include <algorithm>
#include <cmath>
#include <vector>

#include "viscontact/particles/projection/step_projection.hpp"

namespace viscontact::particles {
namespace {

/// Takes residuals into the result of a step.
struct ResidualRecord {
  const SolverSettings& settings;
  double mean_radius;
  ProjectionResult& result;

  /// Returns true if the residual is larger than allowed.
  bool residual(double residual, const ResidualScale& scale) {
    result.residual = std::max(result.residual, residual);
    const double allowed =
        scale.allowed(settings.tolerance * mean_radius / 2, settings.impulse_tolerance);
    const bool beyond = !(residual <= allowed);
    if (beyond) result.converged = false;
    result.excess = std::max(result.excess, residual / allowed);
    if (residual > scale.rounding && scale.impulse > 0)
      result.impulse_residual =
          std::max(result.impulse_residual, residual / scale.w / scale.impulse);
    return beyond;
  }
  /// A sticking contact may slip by the tolerance of the gaps: its impulse is not unique in
  /// packings, and no memory depends on it.
  void slip(double residual) {
    const double allowed = settings.tolerance * mean_radius / 2;
    result.residual = std::max(result.residual, residual);
    result.excess = std::max(result.excess, residual / allowed);
    if (residual > allowed) result.converged = false;
  }
};

}  // namespace

/// The scales of a link are those of a contact between its particles, at which a force is at work
/// also if all is at rest: its own.
template <int D>
ResidualScale StepProjection<D>::scale_of_link(const LinkEquations& link,
                                               ResidualScales<D>& scales) const {
  const auto& row = link.rows.front();
  Contact<D> contact{};
  contact.first = row.first.particle;
  contact.second = row.second.particle;
  contact.w = w(contact.first, contact.second);
  for (const auto particle : {contact.first, contact.second})
    if (particle >= 0) contact.gap += norm(state_.particles.position(index_of(particle)));
  return scales.of(contact);
}

/// Measures the residuals of the links as those of contacts are measured.
template <int D>
void StepProjection<D>::examine_links(const SolverSettings& settings, double mean_radius,
                                      ProjectionResult& result) {
  auto scales = residual_scales();
  const auto& links = constraints_->links();
  std::vector<std::size_t> beyond;
  ResidualRecord record{settings, mean_radius, result};
  for (std::size_t l = 0; l < links.size(); ++l) {
    const double residual = constraints_->link_residual(l);
    const auto scale = scale_of_link(links[l], scales);
    result.link_residual = std::max(result.link_residual, residual);
    if (record.residual(residual, scale)) beyond.push_back(l);
  }
  if (beyond.empty()) return;
  // Named are also the links that hold the same particles, because one of them may be the cause.
  std::vector<char> is_held(state_.particles.count(), 0);
  const auto for_particles = [&](const LinkEquations& link, const auto& visit) {
    for (const auto* part : {&link.rows.front().first, &link.rows.front().second}) {
      if (part->particle < 0) continue;
      const auto body = state_.particles.bodies.body_of(part->particle);
      if (body < 0) visit(index_of(part->particle));
      if (body >= 0)
        for (const auto member : state_.particles.bodies.bodies[index_of(body)].members)
          visit(index_of(member));
    }
  };
  for (const auto l : beyond) for_particles(links[l], [&](std::size_t k) { is_held[k] = 1; });
  for (const auto& link : links) {
    bool is_named = false;
    for_particles(link, [&](std::size_t k) { is_named = is_named || is_held[k] != 0; });
    if (is_named && link.kind != LinkEquations::Kind::kTorsion &&
        link.kind != LinkEquations::Kind::kSpring)
      result.unsolved_links.push_back(name_of(link, *links_, state_.particles));
  }
}

/// Measures the residuals of a solution, by the impulses at work in it. The residuals of the chosen
/// contacts are measured only if `is_final`. Returns the pairs that are not chosen yet, have a
/// particle that takes part, and whose gap is now closed. No other pair needs a test, because its
/// particles move freely.
template <int D>
std::vector<std::size_t> StepProjection<D>::examine(const SolverSettings& settings,
                                                    double mean_radius, bool is_final,
                                                    ProjectionResult& result) {
  auto scales = residual_scales();
  result.converged = is_final;
  result.residual = result.impulse_residual = result.smallest_gap = result.excess = 0;
  result.unresolved = 0;
  result.link_residual = 0;
  result.unsolved_links.clear();
  result.impulse_errors.resize(system_.contacts.size());
  ResidualRecord record{settings, mean_radius, result};
  const auto record_gap = [&](std::size_t k, double gap) {
    if (gap >= result.smallest_gap) return;
    result.smallest_gap = gap;
    result.deepest_overlap = pair(k);
  };
  for (std::size_t c = 0; is_final && c < chosen_.size(); ++c) {
    const auto& here = system_.contacts[c];
    const auto scale = scales.of(here);
    const double gap = gap_after(here, displacements_);
    const double residual = constraints_
                                ? constraints_->residual(c).normal
                                : contact_residual(gap, here.w * (here.impulse - here.lowest));
    record.residual(residual, scale);
    if (constraints_) record.slip(constraints_->residual(c).tangential);
    result.impulse_errors[c] = residual / scale.w;
    record_gap(chosen_[c], gap - here.tolerated);
    if ((here.impulse != 0 || here.lowest < 0) &&
        turns_too_far(state_.particles, here, displacements_))
      ++result.unresolved;
  }
  if (constraints_ && is_final) examine_links(settings, mean_radius, result);
  std::vector<std::size_t> closed;
  for (std::size_t k = 0; k < pair_count(); ++k) {
    if (is_chosen_[k] != 0 || !(takes_part(pair(k).second) || takes_part(pair(k).first)) ||
        !gap_would_close(k))
      continue;
    const auto here = contact(k);
    const double gap = gap_after(here, displacements_);
    if (record.residual(-gap, scales.of(here))) closed.push_back(k);
    record_gap(k, gap - here.tolerated);
  }
  return closed;
}

template std::vector<std::size_t> StepProjection<2>::examine(const SolverSettings&, double, bool,
                                                             ProjectionResult&);
template std::vector<std::size_t> StepProjection<3>::examine(const SolverSettings&, double, bool,
                                                             ProjectionResult&);
template ResidualScale StepProjection<2>::scale_of_link(const LinkEquations&,
                                                        ResidualScales<2>&) const;
template ResidualScale StepProjection<3>::scale_of_link(const LinkEquations&,
                                                        ResidualScales<3>&) const;

}  // namespace viscontact::particles
