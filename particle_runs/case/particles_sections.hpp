// Sections of a case of many particles (docs/case-file.md, "Many particles").
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
#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/particles/values/piecewise_constant.hpp"
#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

/// Bound of the magnitude of all numbers of a case. Squares and cubes of numbers from 1e-100 to
/// 1e100 are finite and not 0 in double precision, whose largest number is 1.8e308.
inline constexpr double kLargestNumber = 1e100;
inline constexpr Allowed kModerate = {[](double v) { return std::abs(v) <= kLargestNumber; },
                                      "at most 1e100 in magnitude"};
/// Both the number and its inverse are at most kLargestNumber.
inline constexpr Allowed kModeratelyPositive = {
    [](double v) { return v >= 1 / kLargestNumber && v <= kLargestNumber; },
    "from 1e-100 to 1e100"};
inline constexpr Allowed kModeratelyPositiveOr0 = {
    [](double v) { return v == 0 || (v >= 1 / kLargestNumber && v <= kLargestNumber); },
    "0, or from 1e-100 to 1e100"};

/// Reads an array with one number for each dimension of space, in the unit of the key, into
/// `place`; other components become 0. In a case with dimension 1 a number without brackets is
/// read, too. Throws for another count of numbers, and for one above 1e100 in magnitude.
void read_vector(const case_file::TomlSection& section, std::string_view key, Vector& place,
                 int dimension);

// Each function that reads or checks something throws Error(kBadInput) with file, line, key and
// what is allowed if a key is unknown or missing, or has a wrong value ("also throws" adds
// conditions). Numbers of particles count from 0.
//
// Functions whose names end in _keys declare the keys of a table: name, range, meaning and default.
// When a case is read (keys.reads() is true), such a function stores the values in its second
// argument, and throws. The same functions make the tables of docs/case-file.md, without an error.
//
// The next four functions are values of keys, for the declarations of keys.hpp. They keep
// references to their arguments.

case_file::KeyValue vector(Vector& place, const int& dimension);
/// A constant vector, or a list of pieces { until, value }: `value` holds until the time `until`
/// [T]. These times must be > 0 and increase, and the last one must not be earlier than `end_time`.
/// The last piece is extended a little beyond `end_time`.
case_file::KeyValue pieces(PiecewiseConstant& place, const int& dimension, const double& end_time);
/// A torque [M L^2/T^2] or an angular velocity [1/T]. For discs it is a number, which becomes
/// component 2 of `place`; for spheres it is a vector.
case_file::KeyValue turn(Vector& place, const int& dimension);
/// A constant torque or angular velocity as turn() reads it, or a list of pieces as in pieces().
case_file::KeyValue pieces_of_turn(PiecewiseConstant& place, const int& dimension,
                                   const double& end_time);

inline constexpr std::array kAxes = {"x", "y", "z"};

/// Largest number of particles of an arrangement or a source; bench/README.md gives times and
/// memory of runs of up to this size.
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
/// dimension.
Domain read_domain(const case_file::TomlSection& section, int dimension);

/// Throws if a case with [lubrication] has another dimension than 3, or a section that cannot stand
/// beside it.
void check_beside_lubrication(const case_file::TomlSection& root, const ParticlesCase& c);
/// Reads [lubrication] and the fits that it names. Path and domain of the case must be set.
/// Also throws if the flow does not carry the images of spheres, or does not stick to the walls of
/// the domain.
void read_lubrication(const case_file::TomlSection& root, ParticlesCase& c);
/// Throws at a piece of the flow that is too short for the steps, and if the last one ends before
/// the case. The end and the step must have been read.
void check_pieces_of_flow(const case_file::TomlSection& root, const ParticlesCase& c);
/// Throws if a period of the domain is too short for the range of a pair, at any strain. The
/// particles must have been read, at least one. No box is turned for an instant.
void check_range(const case_file::TomlSection& root, ParticlesCase& c);
/// Throws at the key of a `[[plane]]` that cannot stand in the flow of [lubrication] until the end.
void check_plane_in_flow(const case_file::TomlSection& section, const Plane& plane,
                         const ParticlesCase& c);
/// The velocities of the flow at the centres, at the start, of particles with inertia whose
/// velocities are not given.
struct GivenAtStart {
  std::vector<bool> velocities, turns;  ///< of each particle
};
void set_velocities_of_flow(const GivenAtStart& given, ParticlesCase& c);
/// Throws Error(kBadInput) if there is a gravity and no sphere has a mass.
void check_weights(const case_file::TomlSection& root, const ParticlesCase& c);
/// Declares the keys of [viscous_contact] in a case with [lubrication]: the end and the step, in
/// units of time or of strain, and the contact of the solids.
void lubricated_contact_keys(case_file::Keys& keys, ParticlesCase& c);
std::vector<case_file::KeyTable> lubrication_tables();

/// Whether particles may have no mass: in a fluid, and with lubrication without inertia.
inline bool may_lack_mass(const Setting& setting) {
  return setting.fluid || (setting.lubrication && !setting.lubrication->inertia);
}

/// Reads [fluid], which the walls or periods of `domain` hold. If the section does not give
/// threshold_gap, it is 0 in the result, and set_default_threshold_gap() must set its default. Also
/// throws for keys of a fluid with inertia if the density is 0, and for keys that exclude each
/// other or do not fit the domain, such as velocities of walls with a net flux and no open side.
Fluid read_fluid(const case_file::TomlSection& section, const Domain& domain);
/// Reads the sections [[probe]] into `fluid`. Also throws for a line that does not go from wall to
/// wall of a box, and if the case cannot have probes.
void read_probes(const case_file::TomlSection& root, const Domain& domain,
                 std::optional<Fluid>& fluid);
/// Functions whose names end in _tables return tables of docs/case-file.md.
std::vector<case_file::KeyTable> domain_and_fluid_tables();

/// The command of a user's own fluid solver, with an absolute path in place of each word that names
/// an existing file relative to `folder`. A first word without a slash is the name of a program on
/// PATH and stays. Throws std::filesystem::filesystem_error if the working folder cannot be looked
/// up.
std::vector<std::string> with_absolute_files(std::vector<std::string> command,
                                             const std::filesystem::path& folder);

/// The lines in which the particles are given, for messages, counted from 1.
struct ParticleLines {
  std::vector<int> in_file;  ///< of the CSV file, whose particles come first
  std::vector<int> in_case;  ///< of the tables [[particle]], whose particles come next; 0: no line
};

/// Reads the particles with their forces, torques and given motions, in this order: those of the
/// CSV file, of the tables [[particle]], of [arrangement] and of [[membrane]]; then the sources. It
/// needs c.path, c.end_time and c.particles.dimension, and in c.setting the domain, the fluid, the
/// laws, the planes and the solver. Returns the lines in which the particles are given.
///
/// Also throws if there is neither a particle nor a source; for a key of particles in a fluid if
/// the case has no fluid; for a rotation on an axis; for a force, a torque or an initial velocity
/// of a particle whose motion is given, because none of them has an effect; and if an arrangement
/// does not fit its domain.
ParticleLines read_particles_of_case(const case_file::TomlSection& root, ParticlesCase& c);

/// Reads [arrangement] into c.arrangement, and adds its particles, at rest and at random places,
/// after those that c.particles has, which read_particles_of_case() has read. Also throws if too
/// few ids are left.
void read_arrangement(const case_file::TomlSection& section, ParticlesCase& c);
std::vector<case_file::KeyTable> arrangement_tables();
/// Appends to `all` the species, the kinds of particles of an arrangement or source: either the
/// list `species`, or the keys of a single species in the section itself.
void all_species_keys(case_file::Keys& keys, std::vector<Species>& all, bool has_fluid);

/// Reads the sections [[source]] into c.setting.sources. All particles, the domain, the planes and
/// the solver must have been read. Also throws in a case with a fluid; for a region that is outside
/// the domain or reaches into an obstacle at time 0; for radii that are too large for the region or
/// a period, or too small for `solver.tolerance`; and if too few ids are left.
void read_sources(const case_file::TomlSection& root, ParticlesCase& c);
std::vector<case_file::KeyTable> source_tables();

/// Reads the sections [[membrane]]. The beads are added to c.particles, their lines to `lines`, and
/// the membranes to c.setting.fluid or, without a fluid, to c.setting.links. Also throws the errors
/// of the functions below, and if a membrane of so few beads cannot have the reduced area that is
/// asked for.
void read_membranes(const case_file::TomlSection& root, ParticlesCase& c, ParticleLines& lines);
std::vector<case_file::KeyTable> membrane_tables();

// The following functions are the checks of read_membranes(). `section` is that of the last
// membrane in `c`, and `first` that of the first one.

/// Throws if the dimension is not 2, or if the case has something that cannot be computed together
/// with membranes.
void check_case_of_membranes(const case_file::TomlSection& root,
                             const case_file::TomlSection& first, const ParticlesCase& c);

/// Throws if the given beads of a new membrane are fewer than 4, in a fluid 12, if one is named
/// twice or belongs to another membrane, or if one has a given motion or, in a fluid, has a mass or
/// is no disc.
void check_given_beads(const case_file::TomlSection& section, const ParticlesCase& c,
                       const Membrane& membrane);

/// Throws if the last membrane crosses itself, is too flat or too round or as wide as a period, if
/// two of its beads that are no neighbours overlap, or if it crosses another membrane or a periodic
/// image of a membrane. In a fluid it also throws if one of two membranes contains the other.
void check_place(const case_file::TomlSection& section, const ParticlesCase& c);

/// Throws if the viscosity inside the last membrane over that outside is not from 1e-4 to 1e3, or
/// if the membrane is too stiff for its number of beads.
void check_in_fluid(const case_file::TomlSection& section, const ParticlesCase& c);

/// Throws if a case with a fluid has, besides the beads of its membranes, particles with a mass or
/// a torque, ellipses or plates, or particles that cross a membrane.
void check_others(const case_file::TomlSection& first, const ParticlesCase& c);

/// Throws an error at `key` if there are not `count` ids left above the largest id of `p`.
void require_ids(const case_file::TomlSection& section, std::string_view key, const Particles& p,
                 std::size_t count);

/// Reads the sections [[force]]. The particles must have been read. Also throws for an id that does
/// not exist, or whose particle has a force already or a given motion.
void read_forces_by_id(const case_file::TomlSection& root, ParticlesCase& c);
std::vector<case_file::KeyTable> particle_tables();

/// Finds the number of a particle by the id that the user gave it.
class ParticleIds {
 public:
  /// `c` must outlive this object, and its particles must have been read.
  explicit ParticleIds(const ParticlesCase& c);

  /// The number of the particle with the id `id`, which is a value of `key`. The message for an id
  /// that does not exist or is not whole is "KEY VERB ID ...", with a verb such as "is" or
  /// "contains".
  std::int32_t number(const case_file::TomlSection& section, std::string_view key, double id,
                      std::string_view verb) const;

 private:
  const ParticlesCase& case_;
  std::unordered_map<std::int32_t, std::int32_t> places_;  // number of each id
};

/// Reads a list of ids of particles, and appends the numbers of these particles to `place`.
void read_ids(const case_file::TomlSection& section, std::string_view key,
              std::vector<std::int32_t>& place, const ParticleIds& ids);

/// Reads the sections [[body]] into c.particles.bodies, and replaces the velocities of their
/// members by those of the rigid motions. The particles and their motions must have been read. Also
/// throws for a particle that does not exist, is named twice or belongs to an earlier body; for a
/// particle whose motion is given; and on an axis.
void read_bodies(const case_file::TomlSection& root, ParticlesCase& c);

/// Reads the sections [[hinge]], [[spring]] and [[arm]] into c.setting.links. Particles and bodies
/// must have been read. Also throws for a hinge outside its body; for a spring or an arm between
/// particles of one body; and for an arm whose length at the start is not the distance of its
/// particles, is less than the sum of their radii at a later time, or breaks the triangle
/// inequality with two other arms.
void read_links(const case_file::TomlSection& root, ParticlesCase& c);
std::vector<case_file::KeyTable> body_and_link_tables();

class ParticleNames {
 public:
  /// Both arguments must outlive this object.
  ParticleNames(const ParticlesCase& c, const ParticleLines& lines) : case_(c), lines_(lines) {}
  /// Describes particle `k` by its id, centre and radius, such as "particle 3 (centre 0, 1, radius
  /// 0.5)".
  std::string operator()(std::size_t k) const;
  /// The file and the line in which particle `k` is given; line 0 if it has no line of its own.
  FilePosition at(std::size_t k) const;

 private:
  const ParticlesCase& case_;
  const ParticleLines& lines_;
};

struct StartGap {
  std::int32_t first;   ///< number of a particle, or -1 - k for obstacle k
  std::int32_t second;  ///< number of the other particle
  double gap;           ///< [L], < 0 if they overlap
};
/// All gaps at the start that are smaller than `limit` >= 0 [L], also across periods. Gaps of
/// ellipses and plates that are larger than `limit` may be among them. Gaps between particles of
/// one body, neighbours on a membrane (in a fluid all beads of one membrane), and between a sphere
/// on an axis and the side of its cylinder are left out. The largest diameter plus `limit` is less
/// than each period, so that no particle is close to an image of itself.
std::vector<StartGap> gaps_at_start(const ParticlesCase& c, double limit);

/// Name of obstacle k, from 0, in a message, for example "the left side of the box" or "plane 2".
std::string obstacle_name(const ParticlesCase& c, std::size_t k);

/// Throws if a particle is outside the domain, overlaps another one, reaches behind a plane or a
/// wall, or is too far from the origin, or if a radius is too small for solver.tolerance or too
/// large for a period of the domain. A case without particles is accepted.
void check_start(const ParticlesCase& c, const ParticleLines& lines);

/// Sets fluid.threshold_gap to its default: 0.05 times the smallest radius or semi-axis, or half of
/// the smallest gap at the start, also between a particle and its own image, if this half is
/// smaller; but at least the gap at which the solids touch. `c` must have a fluid, and
/// check_start() must have accepted it.
void set_default_threshold_gap(ParticlesCase& c);

/// Throws if the flow cannot be computed. Among others it throws if there is no wall, period or
/// driven particle that can take up the forces on the particles; if a particle has no mass and the
/// coupling of fluid and contacts is Coupling::kSplitting; if, with the fitted mesh, a gap is less
/// than a thousandth of the smaller radius; if the threshold gap is less than the gap at which the
/// solids touch; and if a gap is smaller than the threshold gap by more than solver.tolerance mean
/// radii, because contact would then have been made before the start. `c` must have a fluid, and
/// check_start() must have accepted it.
void check_fluid_start(const case_file::TomlSection& root, const ParticlesCase& c,
                       const ParticleLines& lines);

}  // namespace viscontact::particles
