// Systems of particles that the tests share.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include "viscontact/particles/simulation.hpp"

namespace viscontact::particles {

class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double uniform(double from, double to) {
    return std::uniform_real_distribution(from, to)(generator_);
  }
  /// 10^x, x uniform.
  double decades(double from, double to) { return std::pow(10, uniform(from, to)); }
  int integer(int from, int to) { return std::uniform_int_distribution(from, to)(generator_); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  /// In all directions alike; of length 1.
  Vector direction(int dimension);

 private:
  std::mt19937_64 generator_;
};

State no_particles(int dimension);

/// At rest if no velocity is given; of a disc's vectors the first two numbers count.
void add_particle(State& state, const Vector& position, double radius, double mass,
                  const Vector& velocity = {});

/// The force at all times.
inline PiecewiseConstant constant(const Vector& force) { return {{{1e300, force}}}; }

Plane plane_at_rest(const Vector& point, const Vector& normal);

/// Discs or spheres without a common point, at random in a cube of that width, radii by `radius`,
/// mass of density 1.
State random_cloud(int dimension, std::size_t count, double width,
                   const std::function<double()>& radius, Random& random);

/// Steps until the time is `end`, but for rounding; sees each report.
void run(
    Simulation& simulation, double end,
    const std::function<void(const StepReport&)>& see = [](const StepReport&) {});

/// The film of a pair, or of plane k (first = -1 - k) and a particle; one of gamma 0 if there is
/// none.
Pair pair_of(const State& state, std::int32_t first, std::int32_t second);

/// |x_j - x_i| - r_i - r_j now.
double pair_gap(const State& state, std::int32_t first, std::int32_t second);

Vector momentum(const Particles& particles);
/// About the origin.
Vector angular_momentum(const Particles& particles);
double kinetic_energy(const Particles& particles);

/// The power of arm 0 in arms.csv.
double power_of_arm(const Setting& setting, const State& state);

/// Takes `steps` steps, each of which must converge. Returns the most iterations of a step.
int take_steps(Simulation& simulation, int steps);

}  // namespace viscontact::particles
