// The charts of the page of a suspension.
#pragma once

#include <string>
#include <vector>

#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/particle_runs/run/pair_distribution.hpp"
#include "viscontact/suspensions/values/rheology.hpp"

namespace viscontact::particles {

/// What a run with lubrication has computed, and the run of contact alone beside it.
struct SuspensionCurves {
  std::vector<Rheology> rheology, compared;  ///< `compared` is empty without comparison
  std::vector<PairDistributionRow> pairs, compared_pairs;
};

/// The relative viscosity over the strain and the pair distribution, as SVG.
std::string suspension_charts(const ParticlesCase& c, const SuspensionCurves& curves);

}  // namespace viscontact::particles
