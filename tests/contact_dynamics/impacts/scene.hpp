// Scenes of particles that rebound, and a function that collects their rebounds until a time.
// Lengths, masses and times are in one unit each.
#pragma once

#include <cmath>
#include <vector>

#include "tests/particles/systems.hpp"

namespace viscontact::particles {

struct Scene {
  State state;
  Setting setting;
};

/// Lets contacts without film rebound with the coefficient `dry`, e_d, in steps of the length
/// `step`.
inline void set_rebounds_without_film(Setting& setting, double dry, double step) {
  setting.laws.film.gamma_min = 0;
  setting.laws.restitution.coefficient = dry;
  setting.time_step = step;
}

/// A particle of radius 1 that flies at the velocity -1 to the plane y = 0 from the gap `gap`. Its
/// film has gamma_min = ln(1/100), so that k = 1 and the mass is the Stokes number `stokes` = m/k.
/// `dry` is e_d, and `step` the time step.
inline Scene flying(int dimension, double stokes, double gap, double dry, double step) {
  Scene scene{no_particles(dimension), {}};
  add_particle(scene.state, {0, 1 + gap, 0}, 1, stokes, {0, -1, 0});
  scene.setting.planes = {plane_at_rest({}, {0, 1, 0})};
  scene.setting.laws.film.gamma_min = -std::log(100.0);
  scene.setting.laws.restitution.coefficient = dry;
  scene.setting.time_step = step;
  return scene;
}

/// Lets the simulation go on until the time `end`. Returns the rebounds until then.
inline std::vector<Rebound> rebounds_until(double end, Simulation& simulation) {
  std::vector<Rebound> rebounds;
  run(simulation, end, [&](const StepReport&) {
    rebounds.insert(rebounds.end(), simulation.rebounds().begin(), simulation.rebounds().end());
  });
  return rebounds;
}

}  // namespace viscontact::particles
