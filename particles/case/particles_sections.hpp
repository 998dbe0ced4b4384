// The parts of the reader of a case of many particles (particles_case.hpp), for its sources only.
// Each function reads sections of docs/case-file.md, "Many particles", and throws Error(kBadInput)
// with file, line, key and what is allowed. Lengths, masses and times are in the units of the case.
// particles_case.cpp calls the functions in the order of their needs, which their comments say. A
// change must keep accepting users' cases.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "viscontact/case_file/keys.hpp"
#include "viscontact/particles/case/particles_case.hpp"
#include "viscontact/particles/piecewise_constant.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Bound of the magnitude of all numbers. Squares and cubes of numbers within it, and of their
/// inverses, are finite and not 0 in double precision (largest 1.8e308).
inline constexpr double kLargestNumber = 1e100;
/// A number whose magnitude is within the bound.
inline constexpr Allowed kModerate = {[](double v) { return std::abs(v) <= kLargestNumber; },
                                      "at most 1e100 in magnitude"};
/// A number > 0 for which the number and its inverse are within the bound.
inline constexpr Allowed kModeratelyPositive = {
    [](double v) { return v >= 1 / kLargestNumber && v <= kLargestNumber; },
    "from 1e-100 to 1e100"};
/// 0, or a number that kModeratelyPositive allows.
inline constexpr Allowed kModeratelyPositiveOr0 = {
    [](double v) { return v == 0 || (v >= 1 / kLargestNumber && v <= kLargestNumber); },
    "0, or from 1e-100 to 1e100"};

/// Reads an array with one number for each dimension of space. In a case with dimension 1 a number
/// without brackets is read, too.
void read_vector(const case_file::TomlSection& section, std::string_view key, Vector& place,
                 int dimension);

// Values of keys (keys.hpp). They refer to their arguments.

/// A vector, read by read_vector().
case_file::KeyValue vector(Vector& place, const int& dimension);
/// A constant vector, or pieces { until, value } that must last until `end_time` [T].
case_file::KeyValue pieces(PiecewiseConstant& place, const int& dimension, const double& end_time);
/// A torque or an angular velocity: for discs a number, which becomes component 2, for spheres a
/// vector.
case_file::KeyValue turn(Vector& place, const int& dimension);
/// A constant torque or angular velocity, or pieces { until, value } that must last until
/// `end_time` [T].
case_file::KeyValue pieces_of_turn(PiecewiseConstant& place, const int& dimension,
                                   const double& end_time);

/// Names of the axes, for messages.
inline constexpr std::array kAxes = {"x", "y", "z"};

/// Largest number of particles of an arrangement or a source: bench/README.md has the time and the
/// memory of runs of up to so many.
inline constexpr int kLargestCount = 1000000;

/// solver.tolerance times the mean radius must be at most this part of each radius. Gaps are then
/// known to a hundredth of the radius.
inline constexpr double kToleranceOfRadius = 0.01;

/// Least gap of a particle and its own image without a fluid, in radii. It leaves room for the skin
/// of the neighbour list.
inline constexpr double kLeastGapToImage = 0.01;

/// Reads [domain]. `dimension` is that of the case: 1 (spheres on an axis), 2 or 3. Also throws if
/// not exactly one shape is given, and for a shape that does not belong to the dimension: discs
/// move in a disc or a box, spheres in a box, and spheres on an axis in a cylinder.
Domain read_domain(const case_file::TomlSection& section, int dimension);

/// Reads [fluid]. `domain` holds the fluid and must not be empty. If the section does not give
/// threshold_gap, it is 0 in the result, and set_default_threshold_gap() sets its default.
///
/// Also throws for keys of a fluid with inertia if the density is 0; for a solver of the user's
/// own, or a sheared cell, if it is > 0; for `constraint = "rigid"` together with `mesh = "fixed"`;
/// and for a velocity of the boundary that does not fit the domain: a shear or strain that is not
/// the same on both sides of a period, an entry for a side that is periodic, a net flux through
/// walls without an open side, and any velocity of the walls of a cylinder.
Fluid read_fluid(const case_file::TomlSection& section, const Domain& domain);
/// Reads [[probe]] into `fluid`. Also throws for a line that does not go from wall to wall of a
/// box, and in a case without FreeFEM or with membranes.
void read_probes(const case_file::TomlSection& root, const Domain& domain,
                 std::optional<Fluid>& fluid);
/// Describes these sections.
std::vector<case_file::KeyTable> domain_and_fluid_tables();

/// The command of a user's own fluid solver, with an absolute path in place of each word that names
/// an existing file relative to `folder`, that of the case file. A first word without a slash
/// stays, because it is the name of a program on PATH.
std::vector<std::string> with_absolute_files(std::vector<std::string> command,
                                             const std::filesystem::path& folder);

/// Lines in which the particles are given, for messages.
struct ParticleLines {
  std::vector<int> in_file;  ///< of the particles of the CSV file, which are the first ones
  std::vector<int> in_case;  ///< of the tables [[particle]], whose particles are the next ones
};

/// Reads the particles, first those of the CSV file, then those of the tables [[particle]] and
/// those of [arrangement], and the sources of others, with their forces, torques and given motions.
/// Needs c.path, c.end_time, c.particles.dimension, c.setting.domain and c.setting.fluid. Returns
/// where the particles are given.
///
/// Also throws if there is neither a particle nor a source; for a key of particles in a fluid if
/// the case has no fluid; for a rotation on an axis; for a force, a torque or an initial velocity
/// of a particle whose motion is given, because it has no effect; for an arrangement in a domain
/// that is no disc or box; and if its particles do not fit.
ParticleLines read_particles_of_case(const case_file::TomlSection& root, ParticlesCase& c);

/// Reads [arrangement], called by read_particles_of_case(), and adds its particles, which are at
/// rest, after the others, which keep their places. They are c.arrangement.
void read_arrangement(const case_file::TomlSection& section, ParticlesCase& c);
/// Describes this section, and species.
std::vector<case_file::KeyTable> arrangement_tables();
/// Declares the keys of species: either the list `species`, or one species whose keys stand in the
/// section itself.
void all_species_keys(case_file::Keys& keys, std::vector<Species>& all, bool has_fluid);

/// Reads [[source]], called by read_particles_of_case() after all particles, into
/// c.setting.sources. Also throws in a case with a fluid; for a region that is outside the domain
/// or reaches into an obstacle at time 0; for radii that have no place in the region, are too large
/// for a period or too small for solver.tolerance; and if there are too few ids for the particles.
void read_sources(const case_file::TomlSection& root, ParticlesCase& c);
/// Describes this section.
std::vector<case_file::KeyTable> source_tables();

/// Reads [[membrane]], called by read_particles_of_case(): makes beads, which become particles, and
/// the membranes of c.setting.fluid or, without a fluid, of c.setting.links. Also throws if the
/// case has something that cannot be combined with membranes, or a fluid that cannot have them; if
/// so few beads cannot have the reduced area; and for membranes that cross.
void read_membranes(const case_file::TomlSection& root, ParticlesCase& c, ParticleLines& lines);
/// Describes this section.
std::vector<case_file::KeyTable> membrane_tables();

// What of [[membrane]] is refused, each with its line, for read_membranes().

/// Throws if the case has what cannot be computed together with membranes. `first` is the section
/// of the first membrane.
void check_case_of_membranes(const case_file::TomlSection& root,
                             const case_file::TomlSection& first, const ParticlesCase& c);

/// Throws if the given beads of a new membrane are too few, if one is named twice or belongs to
/// another membrane, or if one has a given motion or, in a fluid, a mass.
void check_given_beads(const case_file::TomlSection& section, const ParticlesCase& c,
                       const Membrane& membrane);

/// Throws if the last membrane crosses itself, if beads of it that are no neighbours overlap, or if
/// it crosses another membrane or an image of it in the next period. In a fluid it also throws if
/// one of two membranes contains the other.
void check_place(const case_file::TomlSection& section, const ParticlesCase& c);

/// Throws if the fluid inside the last membrane is much less or much more viscous than outside, or
/// if the membrane is too stiff for its number of beads. The case has a fluid.
void check_in_fluid(const case_file::TomlSection& section, const ParticlesCase& c);

/// Throws if a case with a fluid has, beside the beads of its membranes, particles with a mass or a
/// torque, ellipses, or particles that cross a membrane.
void check_others(const case_file::TomlSection& first, const ParticlesCase& c);

/// Throws an error at `key` if there are fewer than `count` ids above the largest one of `p`.
void require_ids(const case_file::TomlSection& section, std::string_view key, const Particles& p,
                 std::size_t count);

/// Reads [[force]]: the same force on all particles whose ids it names. The particles must have
/// been read. Also throws for an id that does not exist or has a force already.
void read_forces_by_id(const case_file::TomlSection& root, ParticlesCase& c);
/// Describes these sections.
std::vector<case_file::KeyTable> particle_tables();

/// Finds the numbers of particles, which count from 0 in the order of ParticlesCase::particles, by
/// the ids that users gave them.
class ParticleIds {
 public:
  /// `c` must outlive this object, and its particles must have been read.
  explicit ParticleIds(const ParticlesCase& c);

  /// The number of the particle with the id `id`, which the user gave at `key`. Throws for an id
  /// that does not exist; the message is "KEY VERB ID ...", with a verb such as "is" or "contains".
  std::int32_t number(const case_file::TomlSection& section, std::string_view key, double id,
                      std::string_view verb) const;

 private:
  const ParticlesCase& case_;
  std::unordered_map<std::int32_t, std::int32_t> places_;  // number of each id
};

/// Reads a list of ids, and puts the numbers of their particles into `place`. Throws for an id that
/// does not exist.
void read_ids(const case_file::TomlSection& section, std::string_view key,
              std::vector<std::int32_t>& place, const ParticleIds& ids);

/// Reads [[body]] into c.particles.bodies. The particles, and their motion, must have been read.
/// Also throws for a particle that does not exist, is named twice or belongs to an earlier body;
/// and for a motion that is given in a fluid.
void read_bodies(const case_file::TomlSection& root, ParticlesCase& c);

/// Reads [[hinge]], [[spring]] and [[arm]] into c.setting.links. Particles and bodies must have
/// been read. Also throws for particles and bodies that do not exist; for a hinge outside its body;
/// for a spring or an arm between particles of one body; and for an arm whose length at the start
/// is not the distance of its particles, is less than the sum of their radii at a later time, or
/// breaks the triangle inequality with two other arms.
void read_links(const case_file::TomlSection& root, ParticlesCase& c);
/// Describes these sections.
std::vector<case_file::KeyTable> body_and_link_tables();

/// Describes a particle in a message, and says in which file and line it is given.
class ParticleNames {
 public:
  /// Both arguments must outlive the object.
  ParticleNames(const ParticlesCase& c, const ParticleLines& lines) : case_(c), lines_(lines) {}
  /// Describes particle `k` (from 0) by its id, centre and radius, such as "particle 3 (centre 0,
  /// 1, radius 0.5)".
  std::string operator()(std::size_t k) const;
  /// The file and the line in which particle `k` (from 0) is given; line 0 if it has no line of its
  /// own.
  FilePosition at(std::size_t k) const;

 private:
  const ParticlesCase& case_;
  const ParticleLines& lines_;
};

/// A gap at the start between two particles, or an obstacle and a particle.
struct StartGap {
  std::int32_t first;   ///< number of a particle, or -1 - k for obstacle k
  std::int32_t second;  ///< number of a particle
  double gap;           ///< [L], < 0 if they overlap
};
/// All gaps at the start that are smaller than `limit` >= 0 [L], also across periods. The gap
/// between a sphere on an axis and the side of its cylinder, which never changes, is left out. No
/// particle may be close to an image of itself: the largest diameter plus `limit` must be less than
/// each period.
std::vector<StartGap> gaps_at_start(const ParticlesCase& c, double limit);

/// Name of obstacle k in a message, for example "the left side of the box" or "plane 2".
std::string obstacle_name(const ParticlesCase& c, std::size_t k);

/// Throws the Error(kBadInput) of read_particles_case() if the solver cannot begin with this state:
/// particles outside the domain, overlaps, particles behind a plane or too far away, and radii that
/// are too small, or too large for the periods of the domain.
void check_start(const ParticlesCase& c, const ParticleLines& lines);

/// Sets the default of fluid.threshold_gap: 0.05 times the smallest radius, or half of the smallest
/// gap at the start, also between a particle and its own image, if this is smaller; but at least
/// the gap 2 s at which the solids of particles of roughness s touch. `c` has a fluid, and
/// check_start() has accepted it.
void set_default_threshold_gap(ParticlesCase& c);

/// Throws Error(kBadInput), with file and line, if the flow cannot be computed: no wall, period or
/// driven particle that can take up the forces on the particles; particles without mass with the
/// splitting, whose projection is in the norm of the masses; a gap that is less than a thousandth
/// of the radius, which the fitted mesh does not resolve; a threshold gap below that at which the
/// solids touch; and a gap that is smaller than the threshold gap by more than solver.tolerance
/// mean radii, so that contact would be made before the start.
///
/// `root` is the root table of the case; `c` has a fluid, and check_start() has accepted it.
void check_fluid_start(const case_file::TomlSection& root, const ParticlesCase& c,
                       const ParticleLines& lines);

}  // namespace viscontact::particles
