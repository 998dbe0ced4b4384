// Residuals after a solution of (5.4), docs/physics.md, and links that contradict each other.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "viscontact/constraint_rows/solver_names.hpp"
#include "viscontact/contact_dynamics/projection/step_projection.hpp"

namespace viscontact::particles {
namespace {

/// Adds a residual of a gap or link [L] to `result`. Returns true if it is larger than allowed or
/// NaN. A residual above scale.rounding also counts as an error of an impulse, times `ratio`.
bool take(double residual, const ResidualScale& scale, const SolverSettings& settings,
          double mean_radius, ProjectionResult& result, double ratio = 1) {
  if (residual > scale.rounding)
    result.residuals.take_impulse(ratio * residual / scale.w, scale.impulse);
  return result.residuals.take(residual, scale.allowed_gap(settings, mean_radius));
}

/// The largest error of an impulse that is allowed [M L/T].
double allowed_error(const ImpulseError& error, const ResidualScale& scale,
                     const SolverSettings& settings) {
  return std::max(
      {settings.impulse_tolerance * scale.impulse, error.rounding, scale.rounding / scale.w});
}

/// The same with the error of the impulse, if it is known.
bool take(double residual, const ImpulseError& error, const ResidualScale& scale,
          const SolverSettings& settings, double mean_radius, ProjectionResult& result,
          double ratio = 1) {
  if (!(error.estimate >= 0)) return take(residual, scale, settings, mean_radius, result, ratio);
  // Particles in touch without load have impulses that are rounding errors themselves.
  if (error.estimate > std::max(error.rounding, scale.rounding / scale.w))
    result.residuals.take_impulse(error.estimate, scale.impulse);
  const bool is_beyond = result.residuals.take(residual, scale.allowed_gap(settings, mean_radius));
  return result.residuals.take_error(error.estimate, allowed_error(error, scale, settings)) ||
         is_beyond;
}

}  // namespace

template <int D>
ResidualScale StepProjection<D>::scale_of_link(const LinkEquations& link,
                                               ResidualScales<D>& scales) const {
  std::vector<std::int32_t> particles;
  double w = 0, length = 0;
  for (const auto& part : link.parts()) {
    particles.push_back(part.particle);
    w += mobilities_[index_of(part.particle)];
    // A particle at the origin has the rounding errors of its neighbours, which its radius bounds.
    length += norm(state_.particles.position(index_of(part.particle))) +
              state_.particles.radii[index_of(part.particle)];
    // Residuals of angles are arcs [L], with the rounding errors of angles of 1 rad or more.
    if (link.is_angle())
      length +=
          state_.particles.radii[index_of(part.particle)] * (1 + std::abs(link.rows.front().value));
  }
  auto scale = scales.of(particles, w, length);
  // A particle that a link holds may be at rest without any other force.
  scale.impulse = std::max(scale.impulse, scales.largest_change(particles) / w);
  return scale;
}

template <int D>
void StepProjection<D>::examine_links(const SolverSettings& settings, double mean_radius,
                                      ProjectionResult& result) {
  assert(constraints_);
  auto scales = residual_scales();
  const auto& links = constraints_->links();
  std::vector<std::size_t> beyond;
  for (std::size_t l = 0; l < links.size(); ++l) {
    const double residual = constraints_->link_residual(l);
    const auto scale = scale_of_link(links[l], scales);
    result.link_residual = std::max(result.link_residual, residual);
    if (take(residual, constraints_->link_impulse_error(l), scale, settings, mean_radius, result))
      beyond.push_back(l);
  }
  if (!beyond.empty()) name_contradictions(beyond, mean_radius, result);
}

template <int D>
void StepProjection<D>::name_contradictions(const std::vector<std::size_t>& beyond,
                                            double mean_radius, ProjectionResult& result) {
  // Without an overlap or residual of this size the contradiction is no error of the case.
  if (std::max(result.link_residual, -result.residuals.smallest_gap) <= kBroken * mean_radius)
    return;
  const auto& links = constraints_->links();
  const auto violations = constraints_->least_violations();
  const double largest = *std::ranges::max_element(violations);
  // Links are named whose equations are violated by the motion that violates all of them least.
  if (largest > kBroken * mean_radius) {
    // A violation below kPart times the largest one counts as an error of least_violations(), whose
    // errors are about 1e-6 times the largest violation.
    constexpr double kPart = 1e-3;
    const std::size_t contacts = selection_.members().size();
    for (std::size_t b = 0; b < contacts; ++b)
      result.contact_contradicts |= violations[b] > kPart * largest;
    for (std::size_t l = 0; l < links.size(); ++l)
      if (!links[l].is_spring() && violations[contacts + l] > kPart * largest)
        result.unsolved_links.push_back(name_of(links[l], *links_, state_.particles));
    return;
  }
  // Finite turns of bodies make the contradiction. All links are named that share a particle or
  // body with one of `beyond`.
  result.contact_contradicts = result.turns_too_far = true;
  std::vector<char> is_held(state_.particles.count(), 0);
  const auto for_particles = [&](const LinkEquations& link, const auto& visit) {
    for (const auto& part : link.parts()) {
      const auto body = state_.particles.bodies.body_of(part.particle);
      if (body < 0) visit(index_of(part.particle));
      if (body >= 0)
        for (const auto member : state_.particles.bodies.bodies[index_of(body)].members)
          visit(index_of(member));
    }
  };
  for (const auto l : beyond) for_particles(links[l], [&](std::size_t k) { is_held[k] = 1; });
  for (const auto& link : links) {
    bool is_named = false;
    for_particles(link, [&](std::size_t k) { is_named = is_named || is_held[k] != 0; });
    if (is_named && !link.is_spring())
      result.unsolved_links.push_back(name_of(link, *links_, state_.particles));
  }
}

template <int D>
std::vector<std::size_t> StepProjection<D>::examine(const SolverSettings& settings,
                                                    double mean_radius, bool is_final,
                                                    ProjectionResult& result) {
  auto scales = residual_scales();
  result.residuals = {};
  result.residuals.converged = is_final;
  result.unresolved = 0;
  result.link_residual = 0;
  result.unsolved_links.clear();
  result.contact_contradicts = result.turns_too_far = false;
  result.residuals.impulse_errors.resize(system_.contacts.size());
  const auto factors = is_final ? understated() : std::vector<Understated>{};
  for (std::size_t c = 0; is_final && c < selection_.members().size(); ++c) {
    const auto& here = system_.contacts[c];
    const auto scale = scales.of(here);
    const double gap = system_.gap(here);
    const double residual = constraints_
                                ? constraints_->residual(c).normal
                                : contact_residual(gap, here.w * (here.impulse - here.lowest));
    const auto error = error_of_contact(c);
    take(residual, error, scale, settings, mean_radius, result, factors[c].by_masses);
    if (constraints_)
      result.residuals.take(
          constraints_->residual(c).tangential,
          scale.allowed(settings.tolerance * mean_radius / 2, fraction_of_slips(settings)));
    result.residuals.impulse_errors[c] =
        error.estimate >= 0 ? error.estimate
                            : factors[c].by_masses * factors[c].by_chains * residual / scale.w;
    result.residuals.take_gap(gap - here.tolerated, pair(selection_.members()[c]));
    if ((here.impulse != 0 || here.lowest < 0) && turns_too_far(here)) ++result.unresolved;
  }
  if (constraints_ && is_final) examine_links(settings, mean_radius, result);
  std::vector<std::size_t> closed;
  // Free motion closes the gaps of chosen pairs only.
  for (std::size_t k = 0; k < pair_count(); ++k) {
    if (!may_have_closed(k) || !gap_would_close(k, 0)) continue;
    const auto here = contact(k);
    const double gap = system_.gap(here);
    if (take(-gap, scales.of(here), settings, mean_radius, result)) closed.push_back(k);
    result.residuals.take_gap(gap - here.tolerated, pair(k));
  }
  return closed;
}

template std::vector<std::size_t> StepProjection<2>::examine(const SolverSettings&, double, bool,
                                                             ProjectionResult&);
template std::vector<std::size_t> StepProjection<3>::examine(const SolverSettings&, double, bool,
                                                             ProjectionResult&);
template void StepProjection<2>::name_contradictions(const std::vector<std::size_t>&, double,
                                                     ProjectionResult&);
template void StepProjection<3>::name_contradictions(const std::vector<std::size_t>&, double,
                                                     ProjectionResult&);
template ResidualScale StepProjection<2>::scale_of_link(const LinkEquations&,
                                                        ResidualScales<2>&) const;
template ResidualScale StepProjection<3>::scale_of_link(const LinkEquations&,
                                                        ResidualScales<3>&) const;

}  // namespace viscontact::particles
