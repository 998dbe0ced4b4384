// Systems of particles that the tests share. Lengths, masses and times are in one unit each.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tests/common/random.hpp"
#include "viscontact/contact_dynamics/simulation.hpp"

namespace viscontact::particles {

State no_particles(int dimension);

/// Adds a particle, which is at rest if no velocity is given. Only the first two components of the
/// vectors of a disc are used.
void add_particle(State& state, const Vector& position, double radius, double mass,
                  const Vector& velocity = {});

/// Adds a homogeneous particle of this shape in the plane.
void add_shape(State& state, const Shape& shape, const Vector& position, double angle, double mass,
               const Vector& velocity = {}, double angular_velocity = 0);

/// A force that is the same at all times.
inline PiecewiseConstant constant(const Vector& force) { return {{{1e300, force}}}; }

/// A hinge at this place that holds body 0.
Hinge hinge_of_body(const Particles& particles, const Vector& at);

Plane plane_at_rest(const Vector& point, const Vector& normal);

/// Discs or spheres that do not overlap, at random places in a square or cube of this width.
/// `radius` gives the radius of each; the density is 1.
State random_cloud(int dimension, std::size_t count, double width,
                   const std::function<double()>& radius, Random& random);

/// Makes steps until the time is `end` within rounding errors, and calls `see` with each report.
void run(
    Simulation& simulation, double end,
    const std::function<void(const StepReport&)>& see = [](const StepReport&) {});

void expect_converged(const StepReport& report);

/// The pair of two particles, or of plane k (first = -1 - k) and a particle, in the lists of the
/// state. If it is not there, a pair with gamma = 0.
Pair pair_of(const State& state, std::int32_t first, std::int32_t second);

/// The present gap of two particles; negative if they overlap.
double pair_gap(const State& state, std::int32_t first, std::int32_t second);

Vector momentum(const Particles& particles);
/// The angular momentum of all particles about the origin.
Vector angular_momentum(const Particles& particles);
/// The same of particles in the plane that turn.
double angular_momentum_with_spin(const Particles& particles);
double kinetic_energy(const Particles& particles);

/// The power of arm 0 in arms.csv.
double power_of_arm(const Setting& setting, const State& state);

/// Makes `steps` steps, each of which must converge. Returns the largest number of iterations of a
/// step.
int take_steps(Simulation& simulation, int steps);

}  // namespace viscontact::particles
