// Viscous contact of very many spheres that do not feel each other, for sweeps over parameters.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "reduced_model/external_force.hpp"

namespace viscontact {

/// The spheres, one to an index: vectors of the same length, which may be 0.
struct ManySpheres {
  std::vector<double> mass;              ///< m [M], > 0
  std::vector<double> initial_gap;       ///< q0 [L], > 0
  std::vector<double> initial_velocity;  ///< v0 [L/T]
  std::vector<double>
      gamma_min;  ///< solid contact [M L/T], in [-infinity, 0]; -infinity: none; 0: no film, plain inelastic contact
  std::vector<double> force_scale;  ///< [1]; the sphere feels force_scale f_ext(t)
};

/// What became of them, one to an index: vectors of the spheres' length. "At a step's end" leaves out what happens within a step: beside
/// Trajectory::contact_interval, which looks into the steps of impact and release, first_contact is late and last_contact early by up to a step.
struct ManyContacts {
  std::vector<double>
      minimal_gap;  ///< least of the gaps at the start and at the steps' ends [L], >= 0
  std::vector<double> minimal_gap_time;  ///< when it is first met [T]
  std::vector<double>
      lowest_gamma;  ///< [M L/T], <= 0; the film is thinnest there: q0 exp(gamma/k), q0 the initial gap
  std::vector<double> first_contact;  ///< first step's end at which the gap is 0 [T]; NaN: none
  std::vector<double> last_contact;   ///< last step's end at which the gap is 0 [T]; NaN: none
  std::vector<double> gap;            ///< at the end [L], >= 0
  std::vector<double> velocity;       ///< at the end [L/T]
  std::vector<double> gamma;          ///< at the end [M L/T], gamma_min <= gamma <= 0
};

/// The vector instructions that the steps are made with. The figures are the same with each, to the bit.
enum class InstructionSet {
  kBaseline,  ///< what the library is compiled for
  kAvx2,      ///< 4 spheres at a time
  kAvx512,    ///< 8 spheres at a time (AVX-512 F)
};

/// Those that this processor and system can run, slowest first; kBaseline is always there.
std::span<const InstructionSet> runnable_instruction_sets();

/// "baseline", "AVX2", "AVX-512".
std::string_view name_of(InstructionSet set);

struct ManySpheresRun {
  double end_time = 0;   ///< [T], > 0
  double time_step = 0;  ///< h [T], > 0
  int threads = 1;       ///< >= 1; the results do not depend on it
  std::optional<InstructionSet>
      instruction_set{};  ///< none: the last of runnable_instruction_sets()
};

/// Runs the scheme of viscous_contact.hpp for each sphere: contact_step (contact_step.hpp) with NoDrag, steps of step_count and step_time, and
/// h (force_scale f^n), f^n the mean of f_ext over the step, for a push. Where force_scale is 1, the end is that of run_contact_model with the
/// same gamma_min and no drag, to the bit. (Not where a value overflows.) Beyond arguments and results it takes memory of fixed size.
/// Throws Error(kBadInput) that names value and index if a value is not finite or out of its range or the vectors differ in length, if there are
/// more steps than step_count allows, or if this processor has not got the instruction set.
ManyContacts simulate_viscous_contact_many(const ManySpheres& spheres, const ExternalForce& force,
                                           const ManySpheresRun& run);

}  // namespace viscontact
