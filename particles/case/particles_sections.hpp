// Reads the sections of a case of many particles, a TOML file of the user (particles_case.hpp).
// docs/case-file.md, "Many particles", describes the sections and their keys. Lengths, masses and
// times are in the units of the case; numbers of particles count from 0. Each function that reads
// or checks something throws Error(kBadInput) with file, line, key and what is allowed if a key is
// unknown or missing, or has a wrong value ("also throws" in comments adds conditions). The other
// functions throw nothing. Only sources in particles/case/ include this file. particles_case.cpp
// calls the functions in an order in which each finds what its comment says it needs. A change must
// keep accepting users' cases. After it, the tables of docs/case-file.md must be made again from
// the texts of the keys.
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

/// Bound of the magnitude of all numbers of a case. Squares and cubes of numbers from 1e-100 to
/// 1e100 are finite and not 0 in double precision, whose largest number is 1.8e308. A smaller bound
/// would refuse cases that are accepted now.
inline constexpr double kLargestNumber = 1e100;
/// A number whose magnitude is at most kLargestNumber.
inline constexpr Allowed kModerate = {[](double v) { return std::abs(v) <= kLargestNumber; },
                                      "at most 1e100 in magnitude"};
/// A number > 0; both it and its inverse are at most kLargestNumber.
inline constexpr Allowed kModeratelyPositive = {
    [](double v) { return v >= 1 / kLargestNumber && v <= kLargestNumber; },
    "from 1e-100 to 1e100"};
/// 0, or a number that kModeratelyPositive allows.
inline constexpr Allowed kModeratelyPositiveOr0 = {
    [](double v) { return v == 0 || (v >= 1 / kLargestNumber && v <= kLargestNumber); },
    "0, or from 1e-100 to 1e100"};

/// Reads an array with one number for each dimension of space, in the unit of the key, into
/// `place`; other components become 0. In a case with dimension 1 a number without brackets is
/// read, too. Throws for another count of numbers, and for one above 1e100 in magnitude.
void read_vector(const case_file::TomlSection& section, std::string_view key, Vector& place,
                 int dimension);

// Values of keys, for the declarations of keys.hpp. They keep references to their arguments.

/// A vector, read by read_vector().
case_file::KeyValue vector(Vector& place, const int& dimension);
/// A constant vector, or a list of pieces { until, value }: `value` holds until the time `until`
/// [T]. These times must be > 0 and increase, and the last one must not be earlier than `end_time`
/// [T]. The last piece is extended a little beyond `end_time`.
case_file::KeyValue pieces(PiecewiseConstant& place, const int& dimension, const double& end_time);
/// A torque [M L^2/T^2] or an angular velocity [1/T]. For discs it is a number, which becomes
/// component 2 of `place`; for spheres it is a vector.
case_file::KeyValue turn(Vector& place, const int& dimension);
/// A constant torque or angular velocity as turn() reads it, or a list of pieces { until, value }
/// with times as in pieces().
case_file::KeyValue pieces_of_turn(PiecewiseConstant& place, const int& dimension,
                                   const double& end_time);

/// Names of the axes, for messages.
inline constexpr std::array kAxes = {"x", "y", "z"};

/// Largest number of particles of an arrangement or a source. It is a free choice: bench/README.md
/// gives times and memory of runs of up to this size.
inline constexpr int kLargestCount = 1000000;

/// `solver.tolerance` times the mean radius must be at most this fraction of each radius [1], so
/// that each gap is known to a hundredth of the radius.
inline constexpr double kToleranceOfRadius = 0.01;

/// Least gap between a particle and its own image in the next period, divided by the radius [1]. It
/// leaves space for the skin of the neighbour list, the distance that a particle may move before
/// the list is made again.
inline constexpr double kLeastGapToImage = 0.01;

/// Reads [domain]. `dimension` is that of the case: 1 (spheres on an axis), 2 (discs) or 3
/// (spheres). Also throws unless exactly one shape is given, or if the shape does not fit the
/// dimension: discs move in a disc or a box, spheres in a box, and spheres on an axis in a
/// cylinder.
Domain read_domain(const case_file::TomlSection& section, int dimension);

/// Reads [fluid]. `domain` holds the fluid and must not be empty (std::monostate). If the section
/// does not give threshold_gap, threshold_gap is 0 in the result, and set_default_threshold_gap()
/// must set its default.
///
/// Also throws for keys of a fluid with inertia if the density is 0. Also throws if the density is
/// > 0 and there is a solver of the user's own, or a shear or strain of a box that is periodic both
/// ways. Also throws for `constraint = "rigid"` together with `mesh = "fixed"`, and for a velocity
/// of the boundary that does not fit the domain: a shear or strain that is not the same on both
/// sides of a period, an entry for a side that is periodic, a net flux through walls without an
/// open side, and any velocity of the walls of a cylinder.
Fluid read_fluid(const case_file::TomlSection& section, const Domain& domain);
/// Reads the sections [[probe]], lines on which flow and pressure are measured, into `fluid`. Also
/// throws for a line that does not go from wall to wall of a box. Also throws if there is a probe
/// in a case without a fluid, with a solver of the user's own or with membranes.
void read_probes(const case_file::TomlSection& root, const Domain& domain,
                 std::optional<Fluid>& fluid);
/// The tables of docs/case-file.md for the keys of [domain], [fluid] and [[probe]].
std::vector<case_file::KeyTable> domain_and_fluid_tables();

/// The command of a user's own fluid solver, with an absolute path in place of each word that names
/// an existing file relative to `folder`, the folder of the case file. A first word without a slash
/// is not replaced, because it is the name of a program on PATH.
std::vector<std::string> with_absolute_files(std::vector<std::string> command,
                                             const std::filesystem::path& folder);

/// The numbers of the lines in which the particles are given, for messages; the first line has 1.
struct ParticleLines {
  std::vector<int> in_file;  ///< lines of the CSV file, whose particles come first
  std::vector<int> in_case;  ///< lines of the tables [[particle]], whose particles come next
};

/// Reads the particles with their forces, torques and given motions, in this order: those of the
/// CSV file, of the tables [[particle]], of [arrangement] and of [[membrane]]. Then it reads the
/// sources. It needs c.path, c.end_time and c.particles.dimension, and in c.setting the domain, the
/// fluid, the laws, the planes and the solver. Returns the lines in which the particles are given.
///
/// Also throws if there is neither a particle nor a source; for a key of particles in a fluid if
/// the case has no fluid; for a rotation on an axis; for a force, a torque or an initial velocity
/// of a particle whose motion is given, because none of them has an effect; for an arrangement in a
/// domain that is no disc or box; and if its particles do not fit.
ParticleLines read_particles_of_case(const case_file::TomlSection& root, ParticlesCase& c);

/// Reads [arrangement] into c.arrangement, and adds its particles, at rest and at random places,
/// after those that c.particles has. read_particles_of_case() calls it.
void read_arrangement(const case_file::TomlSection& section, ParticlesCase& c);
/// The tables of docs/case-file.md for the keys of [arrangement] and of species.
std::vector<case_file::KeyTable> arrangement_tables();
/// Declares the keys of species, the kinds of particles of an arrangement or source: either the
/// list `species`, or the keys of a single species in the section itself.
void all_species_keys(case_file::Keys& keys, std::vector<Species>& all, bool has_fluid);

/// Reads the sections [[source]] into c.setting.sources. read_particles_of_case() calls it after it
/// has read all particles. Also throws in a case with a fluid; for a region that is outside the
/// domain or reaches into an obstacle (wall or plane) at time 0; for radii with which a particle
/// has no place in the region; for radii that are too large for a period or too small for
/// `solver.tolerance`; and if fewer ids are left than the source adds particles.
void read_sources(const case_file::TomlSection& root, ParticlesCase& c);
/// The tables of docs/case-file.md for the keys of [[source]].
std::vector<case_file::KeyTable> source_tables();

/// Reads the sections [[membrane]], closed chains of particles, which are called beads.
/// read_particles_of_case() calls it. The beads are added to c.particles, their lines to `lines`,
/// and the membranes to c.setting.fluid or, without a fluid, to c.setting.links. Also throws if the
/// case or its fluid has something that cannot be combined with membranes; if a membrane of so few
/// beads cannot have the reduced area that is asked for; and for membranes that cross.
void read_membranes(const case_file::TomlSection& root, ParticlesCase& c, ParticleLines& lines);
/// The tables of docs/case-file.md for the keys of [[membrane]].
std::vector<case_file::KeyTable> membrane_tables();

// The following functions are the checks of read_membranes(). `section` is that of the last
// membrane that was read, which is the last one in `c`.

/// Throws if the case has something that cannot be computed together with membranes. `first` is the
/// section of the first membrane.
void check_case_of_membranes(const case_file::TomlSection& root,
                             const case_file::TomlSection& first, const ParticlesCase& c);

/// Throws if the given beads of a new membrane are too few, if one is named twice or belongs to
/// another membrane, or if one has a given motion or, in a fluid, a mass.
void check_given_beads(const case_file::TomlSection& section, const ParticlesCase& c,
                       const Membrane& membrane);

/// Throws if the last membrane crosses itself, if two of its beads that are no neighbours overlap,
/// or if it crosses another membrane or a periodic image of a membrane. In a fluid it also throws
/// if one of two membranes contains the other.
void check_place(const case_file::TomlSection& section, const ParticlesCase& c);

/// Throws if the viscosity inside the last membrane over that outside is not from 1e-4 to 1e3, or
/// if the membrane is too stiff for its number of beads. The case must have a fluid.
void check_in_fluid(const case_file::TomlSection& section, const ParticlesCase& c);

/// Throws if a case with a fluid has, besides the beads of its membranes, particles with a mass or
/// a torque, ellipses, or particles that cross a membrane. `first` is the section of the first
/// membrane.
void check_others(const case_file::TomlSection& first, const ParticlesCase& c);

/// Throws an error at `key` if new particles cannot get `count` ids: these are whole numbers above
/// the largest id of `p` and are bounded, so that fewer of them may be left.
void require_ids(const case_file::TomlSection& section, std::string_view key, const Particles& p,
                 std::size_t count);

/// Reads the sections [[force]], each of which gives the same force to all particles whose ids it
/// names. The particles must have been read. Also throws for an id that does not exist, or whose
/// particle has a force already.
void read_forces_by_id(const case_file::TomlSection& root, ParticlesCase& c);
/// The tables of docs/case-file.md for the keys of particles and [[force]].
std::vector<case_file::KeyTable> particle_tables();

/// Finds the number of a particle, its place from 0 in ParticlesCase::particles, by the id that the
/// user gave it.
class ParticleIds {
 public:
  /// `c` must outlive this object, and its particles must have been read.
  explicit ParticleIds(const ParticlesCase& c);

  /// The number of the particle with the id `id`, which is a value of `key`. Throws for an id that
  /// does not exist or is not whole; the message is "KEY VERB ID ...", with a verb such as "is" or
  /// "contains".
  std::int32_t number(const case_file::TomlSection& section, std::string_view key, double id,
                      std::string_view verb) const;

 private:
  const ParticlesCase& case_;
  std::unordered_map<std::int32_t, std::int32_t> places_;  // number of each id
};

/// Reads a list of ids of particles, and puts the numbers of these particles into `place`. Throws
/// for an id that does not exist.
void read_ids(const case_file::TomlSection& section, std::string_view key,
              std::vector<std::int32_t>& place, const ParticleIds& ids);

/// Reads the sections [[body]], rigid bodies of several particles, into c.particles.bodies. The
/// particles and their motions must have been read. Also throws for a particle that does not exist,
/// is named twice or belongs to an earlier body; and for a particle whose motion is given.
void read_bodies(const case_file::TomlSection& root, ParticlesCase& c);

/// Reads the sections [[hinge]], [[spring]] and [[arm]] into c.setting.links. Particles and bodies
/// must have been read. Also throws for particles and bodies that do not exist; for a hinge outside
/// its body; for a spring or an arm between particles of one body; and for an arm whose length at
/// the start is not the distance of its particles, is less than the sum of their radii at a later
/// time, or breaks the triangle inequality with two other arms.
void read_links(const case_file::TomlSection& root, ParticlesCase& c);
/// The tables of docs/case-file.md for the keys of [[body]], [[hinge]], [[spring]] and [[arm]].
std::vector<case_file::KeyTable> body_and_link_tables();

/// Describes a particle in a message, and says in which file and line it is given.
class ParticleNames {
 public:
  /// Both arguments must outlive this object.
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
  std::int32_t second;  ///< number of the other particle
  double gap;           ///< [L], < 0 if they overlap
};
/// All gaps at the start that are smaller than `limit` >= 0 [L], also across periods. Gaps of
/// ellipses and plates that are larger than `limit` may be among them. The gap between a sphere on
/// an axis and the side of its cylinder, which never changes, is left out. The largest diameter
/// plus `limit` must be less than each period, so that no particle is close to an image of itself;
/// this is not checked.
std::vector<StartGap> gaps_at_start(const ParticlesCase& c, double limit);

/// Name of obstacle k, from 0, in a message, for example "the left side of the box" or "plane 2".
std::string obstacle_name(const ParticlesCase& c, std::size_t k);

/// Throws Error(kBadInput) if the simulation cannot begin with these particles: if a particle is
/// outside the domain, overlaps another one, reaches behind a plane or a wall, or is too far from
/// the origin, or if a radius is too small for solver.tolerance or too large for a period of the
/// domain. A case without particles is accepted.
void check_start(const ParticlesCase& c, const ParticleLines& lines);

/// Sets fluid.threshold_gap to its default: 0.05 times the smallest radius or semi-axis, or half of
/// the smallest gap at the start, also between a particle and its own image, if this half is
/// smaller. The default is at least the gap 2 s at which the solids of particles of roughness s [L]
/// touch. `c` must have a fluid, and check_start() must have accepted it.
void set_default_threshold_gap(ParticlesCase& c);

/// Throws Error(kBadInput) if the flow cannot be computed. Among others it throws if there is no
/// wall, period or driven particle that can take up the forces on the particles; if a particle has
/// no mass and the coupling of fluid and contacts is Coupling::kSplitting; if, with the fitted
/// mesh, a gap is less than a thousandth of the smaller radius; if the threshold gap is less than
/// the gap at which the solids touch; and if a gap is smaller than the threshold gap by more than
/// solver.tolerance mean radii, because contact would then have been made before the start.
///
/// `root` is the root table of the case. `c` must have a fluid, and check_start() must have
/// accepted it.
void check_fluid_start(const case_file::TomlSection& root, const ParticlesCase& c,
                       const ParticleLines& lines);

}  // namespace viscontact::particles
