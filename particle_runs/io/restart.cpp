// The binary restart file. Another field of State or Pair (state.hpp) needs a new version.
#include "viscontact/particle_runs/io/restart.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"

namespace viscontact::particles {
namespace {

// Another one means other fields.
constexpr int kVersion = 18;
constexpr std::string_view kWhat = "# viscontact: restart of particles, version ";
constexpr std::string_view kHash = "# sha256 of the rest: ";
constexpr std::string_view kOrder =
    std::endian::native == std::endian::little ? "little-endian" : "big-endian";

/// A pair as files store it, with members of Pair (state.hpp); the others are in arrays of their
/// own.
struct StoredPair {
  std::int32_t first, second;
  double gamma, impulse, gamma_error;
};

struct StoredArrays {
  std::vector<std::int32_t> images;  ///< of state.pairs; empty if all are 0
  std::vector<std::int32_t> places;  ///< of state.pairs, then of state.walls; empty if all are 0
  std::vector<Vector> frictions;     ///< of pairs and walls; empty if all are 0
  std::vector<double> solid_load;    ///< Remembered::kSolidLoad, as `frictions`
  std::vector<BodyMotion> bodies;
  /// The other memories (kMemoryFields), if not all of their numbers are 0: `names` has the name of
  /// each with a line break, `memories` for each name one number for each pair and wall.
  std::vector<char> names;
  std::vector<double> memories;
  // The members of State::impact_impulses, in an array for each, because ImpactImpulse has bytes
  // without a value, which would change the hash of the file.
  std::vector<std::int32_t> impact_firsts;
  std::vector<Vector> impact_impulses, impact_branches;
  std::vector<std::int32_t> given_particles;
  std::vector<Vector> given_forces, given_torques;
};

/// Calls `field` for each stored field, in the order of a file. Both writing and reading use the
/// function, so that the orders agree.
template <class State, class Arrays, class Field>
void for_fields(State& state, Arrays& arrays, Field&& field) {
  auto& p = state.particles;
  field(p.dimension);
  field(state.time);
  field(state.steps);
  field(state.grid_time);
  field(state.grid_step);
  field(p.positions);
  field(p.velocities);
  field(p.radii);
  field(p.masses);
  field(state.pairs);
  field(state.walls);
  field(state.positions_at_listing);
  field(state.skins);
  field(arrays.images);
  field(p.angles);
  field(p.angular_velocities);
  field(p.inertias);
  field(state.earlier_velocities);
  field(state.earlier_forces);
  field(state.earlier_step);
  field(p.orientations);
  field(arrays.frictions);
  field(state.velocity_lag);
  field(arrays.solid_load);
  field(arrays.bodies);
  field(state.link_forces);
  field(state.arm_powers);
  field(arrays.names);
  field(arrays.memories);
  field(state.step_before);
  field(state.flow);
  field(state.earlier_positions);
  field(arrays.places);
  field(state.sources);
  field(arrays.impact_firsts);
  field(arrays.impact_impulses);
  field(arrays.impact_branches);
  field(state.planes);
  field(state.shear);
  field(arrays.given_particles);
  field(arrays.given_forces);
  field(arrays.given_torques);
}

/// The first of kMemoryFields that has no array of its own.
constexpr std::size_t kFirstNamed = 4;

void store_memories(const State& state, StoredArrays& arrays) {
  const auto all = [&](const auto& visit) {
    for (const auto* pairs : {&state.pairs, &state.walls})
      for (const auto& pair : *pairs) visit(state.memories.of(pair.memory));
  };
  all([&](const PairMemory& memory) {
    arrays.frictions.push_back(memory.friction());
    arrays.solid_load.push_back(memory[Remembered::kSolidLoad]);
  });
  for (std::size_t f = kFirstNamed; f < kMemoryFields.size(); ++f) {
    std::vector<double> values;
    all([&](const PairMemory& memory) { values.push_back(memory.values()[f]); });
    if (std::ranges::all_of(values, [](double value) { return value == 0; })) continue;
    const auto name = kMemoryFields[f].name;
    arrays.names.insert(arrays.names.end(), name.begin(), name.end());
    arrays.names.push_back('\n');
    arrays.memories.insert(arrays.memories.end(), values.begin(), values.end());
  }
}

/// Returns false if the arrays do not fit the pairs of the state, or have a name or value that is
/// not allowed.
bool take_memories(const StoredArrays& arrays, State& state) {
  const auto count = state.pairs.size() + state.walls.size();
  const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
  if (!fits(arrays.frictions.size()) || !fits(arrays.solid_load.size())) return false;
  std::vector<PairMemory> memories(count);
  for (std::size_t k = 0; k < arrays.frictions.size(); ++k)
    memories[k].set_friction(arrays.frictions[k]);
  for (std::size_t k = 0; k < arrays.solid_load.size(); ++k) {
    if (!(arrays.solid_load[k] >= 0)) return false;
    memories[k][Remembered::kSolidLoad] = arrays.solid_load[k];
  }
  std::size_t begin = 0, used = 0;
  while (begin < arrays.names.size()) {
    const auto rest = std::string_view(arrays.names.data(), arrays.names.size()).substr(begin);
    const auto name = rest.substr(0, rest.find('\n'));
    const auto field = std::ranges::find(kMemoryFields, name, &MemoryField::name);
    if (name.size() == rest.size() || field == kMemoryFields.end() ||
        used + count > arrays.memories.size())
      return false;
    const auto place = static_cast<std::size_t>(field - kMemoryFields.begin());
    for (std::size_t k = 0; k < count; ++k) memories[k].values()[place] = arrays.memories[used + k];
    begin += name.size() + 1;
    used += count;
  }
  if (used != arrays.memories.size()) return false;
  std::size_t k = 0;
  for (auto* pairs : {&state.pairs, &state.walls})
    for (auto& pair : *pairs) state.memories.set(pair.memory, memories[k++]);
  return true;
}

/// Returns false if the arrays do not fit each other or the particles, or if the state has no last
/// step.
bool take_impacts(const StoredArrays& arrays, State& state) {
  const auto count = arrays.impact_firsts.size();
  if (arrays.impact_impulses.size() != count || arrays.impact_branches.size() != count)
    return false;
  if (count > 0 && !(state.earlier_step > 0)) return false;
  const auto is_finite = [](const Vector& x) {
    return std::ranges::all_of(x, [](double number) { return std::isfinite(number); });
  };
  for (std::size_t k = 0; k < count; ++k) {
    const ImpactImpulse impact{arrays.impact_firsts[k], arrays.impact_impulses[k],
                               arrays.impact_branches[k]};
    if (impact.first >= 0 && index_of(impact.first) >= state.particles.count()) return false;
    if (!is_finite(impact.impulse) || !is_finite(impact.branch)) return false;
    state.impact_impulses.push_back(impact);
  }
  return true;
}

/// Returns false if the arrays do not fit each other or the particles.
bool take_given_loads(const StoredArrays& arrays, State& state) {
  const auto count = arrays.given_particles.size();
  if (arrays.given_forces.size() != count || arrays.given_torques.size() != count) return false;
  for (std::size_t k = 0; k < count; ++k) {
    const auto particle = arrays.given_particles[k];
    if (particle < 0 || index_of(particle) >= state.particles.count()) return false;
    state.given_loads.push_back({particle, arrays.given_forces[k], arrays.given_torques[k]});
  }
  return std::ranges::all_of(state.planes, [](const PlaneMotion& plane) {
    return std::isfinite(plane.displacement) && std::isfinite(plane.velocity);
  });
}

/// Appends values to `bytes` as they are in memory. A list begins with the number of its elements,
/// in 64 bits.
class Writer {
 public:
  template <class T>
  void operator()(const T& value) const {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void operator()(const std::vector<T>& values) const {
    (*this)(static_cast<std::uint64_t>(values.size()));
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void operator()(const std::vector<Pair>& pairs) const {
    std::vector<StoredPair> stored;
    stored.reserve(pairs.size());
    for (const auto& pair : pairs)
      stored.push_back({pair.first, pair.second, pair.gamma, pair.impulse, pair.gamma_error});
    (*this)(stored);
  }
  std::string& bytes;
};

/// Reads what Writer has written. Throws Error(kBadInput), which names the file, if too few bytes
/// are left.
class Reader {
 public:
  Reader(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&value, take(sizeof value), sizeof value);
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    std::uint64_t count = 0;
    (*this)(count);
    if (count > bytes_.size() / sizeof(T)) throw_damaged();
    values.resize(static_cast<std::size_t>(count));
    if (count > 0) std::memcpy(values.data(), take(count * sizeof(T)), count * sizeof(T));
  }
  void operator()(std::vector<Pair>& pairs) {
    std::vector<StoredPair> stored;
    operator()<StoredPair>(stored);
    for (const auto& pair : stored)
      pairs.push_back({pair.first, pair.second, pair.gamma, pair.impulse, pair.gamma_error});
  }
  bool at_end() const { return bytes_.empty(); }
  [[noreturn]] void throw_damaged() const {
    throw_bad_input({file_}, "is damaged: it was cut short, or its bytes have changed");
  }

 private:
  const char* take(std::size_t size) {
    if (size > bytes_.size()) throw_damaged();
    const char* at = bytes_.data();
    bytes_.remove_prefix(size);
    return at;
  }
  std::string_view bytes_;
  std::string file_;
};

/// Removes the first line of `rest`, and returns what follows `begin` in it.
std::string_view line_of(std::string_view& rest, std::string_view begin, const std::string& file) {
  const auto end = rest.find('\n');
  if (!rest.starts_with(begin) || end == std::string_view::npos)
    throw_bad_input({file}, "is not a restart file of viscontact particles (restart.bin)");
  const auto value = rest.substr(begin.size(), end - begin.size());
  rest.remove_prefix(end + 1);
  return value;
}

/// Reads the first line. Throws Error(kBadInput) if the version or the byte order is another one.
void read_version(std::string_view& rest, const std::string& file) {
  const auto line = line_of(rest, kWhat, file);
  int version = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), version);
  const auto rest_of_line = line.substr(static_cast<std::size_t>(end - line.data()));
  if (error != std::errc{} || version != kVersion || !rest_of_line.starts_with(", "))
    throw_bad_input({file}, "is a restart file of another version ({}); it must be of version {}",
                    line.substr(0, 20), kVersion);
  if (const auto order = rest_of_line.substr(2); order != kOrder)
    throw_bad_input({file}, "was written by a machine with another byte order ({}; it must be {})",
                    order.substr(0, 20), kOrder);
}

/// True if the sizes of the arrays fit the number of particles, the dimension is 1 to 3, the times
/// velocity_lag, earlier_step and step_before are finite and >= 0, and there are at least as many
/// particles as sources have poured.
bool is_consistent(const State& state) {
  const auto& p = state.particles;
  const auto numbers = p.count() * static_cast<std::size_t>(p.dimension);
  const auto is_empty_or = [](const std::vector<double>& values, std::size_t size) {
    return values.empty() || values.size() == size;
  };
  const auto is_finite = [](const Vector& x) { return std::isfinite(norm(x)); };
  auto others = static_cast<std::int64_t>(p.count());  // of no source counted so far
  for (const auto& source : state.sources) {
    if (source.poured < 0 || source.poured > others || !std::isfinite(source.begin)) return false;
    others -= source.poured;
  }
  return p.dimension >= 1 && p.dimension <= 3 && p.positions.size() == numbers &&
         p.velocities.size() == numbers && p.masses.size() == p.count() &&
         (state.positions_at_listing.empty() ||
          (state.positions_at_listing.size() == numbers && state.skins.size() == p.count())) &&
         is_empty_or(p.angles, p.count()) &&
         p.angular_velocities.size() ==
             (p.dimension == 3 ? p.orientations.size() / 4 * 3 : p.angles.size()) &&
         is_empty_or(p.orientations, 4 * p.count()) && is_empty_or(p.inertias, p.count()) &&
         is_empty_or(state.earlier_velocities, p.count() * motion_components(p.dimension)) &&
         is_empty_or(state.earlier_positions, numbers) &&
         is_empty_or(state.earlier_forces, p.count() * motion_components(p.dimension)) &&
         std::isfinite(state.velocity_lag) && state.velocity_lag >= 0 &&
         std::isfinite(state.earlier_step) && state.earlier_step >= 0 &&
         std::isfinite(state.step_before) && state.step_before >= 0 &&
         std::isfinite(state.shear.strain) && std::isfinite(state.shear.rate) &&
         std::isfinite(state.shear.offset) && std::isfinite(state.shear.net_strain) &&
         std::ranges::all_of(state.shear.gradient, is_finite) &&
         std::ranges::all_of(state.shear.periods, is_finite);
}

/// True if the numbers of the particles, the image and the place of the contact are in their
/// ranges, gamma is finite and <= 0, the impulse is finite, and gamma_error is >= 0.
bool is_consistent(const Pair& pair, bool at_obstacle, std::size_t particles) {
  constexpr std::int32_t kMostPlaces = 64;  // more than shapes have
  const bool first_in_range =
      at_obstacle ? pair.first < 0 : pair.first >= 0 && pair.first < pair.second;
  return first_in_range && pair.second >= 0 && index_of(pair.second) < particles &&
         pair.gamma <= 0 && std::isfinite(pair.gamma) && std::isfinite(pair.impulse) &&
         pair.gamma_error >= 0 && pair.image >= -kLargestImage && pair.image <= kLargestImage &&
         pair.place >= 0 && pair.place < kMostPlaces;
}

}  // namespace

std::string write_restart(const State& state) {
  StoredArrays arrays;
  for (const auto& pair : state.pairs) arrays.images.push_back(pair.image);
  store_memories(state, arrays);
  const auto clear_zeros = [](auto& values) {
    using Value = std::remove_cvref_t<decltype(values[0])>;
    if (std::ranges::all_of(values, [](const Value& value) { return value == Value{}; }))
      values.clear();
  };
  for (const auto* pairs : {&state.pairs, &state.walls})
    for (const auto& pair : *pairs) arrays.places.push_back(pair.place);
  clear_zeros(arrays.images);
  clear_zeros(arrays.places);
  clear_zeros(arrays.frictions);
  clear_zeros(arrays.solid_load);
  for (const auto& body : state.particles.bodies.bodies) arrays.bodies.push_back(body);
  for (const auto& impact : state.impact_impulses) {
    arrays.impact_firsts.push_back(impact.first);
    arrays.impact_impulses.push_back(impact.impulse);
    arrays.impact_branches.push_back(impact.branch);
  }
  for (const auto& [particle, force, torque] : state.given_loads) {
    arrays.given_particles.push_back(particle);
    arrays.given_forces.push_back(force);
    arrays.given_torques.push_back(torque);
  }
  std::string bytes;
  for_fields(state, arrays, Writer{bytes});
  std::string text;
  text.append(kWhat).append(std::to_string(kVersion)).append(", ").append(kOrder).append("\n");
  text.append(kHash).append(sha256(bytes)).append("\n");
  return text + bytes;
}

State read_restart(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string text = read_file(path);
  std::string_view rest = text;
  while (rest.starts_with("# provenance") || rest.starts_with("# record"))
    rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  read_version(rest, file);
  const auto hash = line_of(rest, kHash, file);
  Reader reader(rest, file);
  if (hash != sha256(rest)) reader.throw_damaged();
  State state;
  StoredArrays arrays;
  for_fields(state, arrays, reader);
  const auto of_pairs = state.pairs.size(), of_all = of_pairs + state.walls.size();
  if (!reader.at_end() || (!arrays.images.empty() && arrays.images.size() != of_pairs) ||
      (!arrays.places.empty() && arrays.places.size() != of_all) || !take_memories(arrays, state) ||
      !take_impacts(arrays, state) || !take_given_loads(arrays, state))
    reader.throw_damaged();
  for (std::size_t k = 0; k < arrays.images.size(); ++k) state.pairs[k].image = arrays.images[k];
  for (std::size_t k = 0; k < arrays.places.size(); ++k)
    (k < of_pairs ? state.pairs[k] : state.walls[k - of_pairs]).place = arrays.places[k];
  for (const auto& motion : arrays.bodies)
    state.particles.bodies.bodies.emplace_back().BodyMotion::operator=(motion);
  if (!is_consistent(state)) reader.throw_damaged();
  for (const auto* pairs : {&state.pairs, &state.walls})
    for (const auto& pair : *pairs)
      if (!is_consistent(pair, pairs == &state.walls, state.particles.count()))
        reader.throw_damaged();
  return state;
}

}  // namespace viscontact::particles
