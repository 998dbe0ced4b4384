// Writes and reads the binary restart file (restart.hpp). Files of version 1 must stay readable; a
// change of the fields of State or Pair needs a new version.
#include "viscontact/particles/io/restart.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"

namespace viscontact::particles {
namespace {

constexpr std::string_view kWhat = "# viscontact: restart of particles, version 2, ";
constexpr std::string_view kVersion1 = "# viscontact: restart of particles, version 1, ";
constexpr std::string_view kHash = "# sha256 of the rest: ";
constexpr std::string_view kOrder =
    std::endian::native == std::endian::little ? "little-endian" : "big-endian";

/// Calls `field` for each stored field, in the order of the file, for writing and for reading.
template <class State, class Field>
void for_fields(State& state, Field&& field) {
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
}

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
  std::string& bytes;
};

class Reader {
 public:
  Reader(std::string_view bytes, std::string file, bool version_1)
      : bytes_(bytes), file_(std::move(file)), version_1_(version_1) {}

  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&value, take(sizeof value), sizeof value);
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    std::uint64_t count = 0;
    (*this)(count);
    if (count > bytes_.size() / sizeof(T)) throw_short();
    values.resize(static_cast<std::size_t>(count));
    if (count > 0) std::memcpy(values.data(), take(count * sizeof(T)), count * sizeof(T));
  }
  void operator()(std::vector<Pair>& pairs) {
    if (!version_1_) return operator()<Pair>(pairs);
    // Version 1 did not record the error of gamma.
    struct PairOfVersion1 {
      std::int32_t first, second;
      double gamma, impulse;
    };
    std::vector<PairOfVersion1> old;
    operator()<PairOfVersion1>(old);
    pairs.clear();
    for (const auto& pair : old)
      pairs.push_back({pair.first, pair.second, pair.gamma, pair.impulse, 0});
  }
  bool at_end() const { return bytes_.empty(); }
  [[noreturn]] void throw_short() const {
    throw_bad_input({file_}, "is not a whole restart file; it seems to be cut short");
  }

 private:
  const char* take(std::size_t size) {
    if (size > bytes_.size()) throw_short();
    const char* at = bytes_.data();
    bytes_.remove_prefix(size);
    return at;
  }
  std::string_view bytes_;
  std::string file_;
  bool version_1_;
};

/// Removes the line that begins with `begin` from the front of `rest` and returns the remainder of
/// that line. Throws Error(kBadInput) if `rest` does not begin with it.
std::string_view line_of(std::string_view& rest, std::string_view begin, const std::string& file) {
  const auto end = rest.find('\n');
  if (!rest.starts_with(begin) || end == std::string_view::npos)
    throw_bad_input({file}, "is not a restart file of viscontact particles (restart.bin)");
  const auto value = rest.substr(begin.size(), end - begin.size());
  rest.remove_prefix(end + 1);
  return value;
}

}  // namespace

std::string write_restart(const State& state) {
  std::string bytes;
  for_fields(state, Writer{bytes});
  std::string text;
  text.append(kWhat).append(kOrder).append("\n").append(kHash).append(sha256(bytes)).append("\n");
  return text + bytes;
}

State read_restart(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string text = read_file(path);
  std::string_view rest = text;
  if (rest.starts_with("# provenance"))
    rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  const bool version_1 = rest.starts_with(kVersion1);
  if (const auto order = line_of(rest, version_1 ? kVersion1 : kWhat, file); order != kOrder)
    throw_bad_input({file}, "was written by a machine with another byte order (" +
                                std::string(order.substr(0, 20)) + "; it must be " +
                                std::string(kOrder) + ")");
  const auto hash = line_of(rest, kHash, file);
  Reader reader(rest, file, version_1);
  if (hash != sha256(rest)) reader.throw_short();
  State state;
  for_fields(state, reader);
  if (!reader.at_end()) reader.throw_short();
  const auto& p = state.particles;
  const auto numbers = p.count() * static_cast<std::size_t>(p.dimension);
  const bool consistent =
      (p.dimension == 2 || p.dimension == 3) && p.positions.size() == numbers &&
      p.velocities.size() == numbers && p.masses.size() == p.count() &&
      (state.positions_at_listing.empty() ||
       (state.positions_at_listing.size() == numbers && state.skins.size() == p.count()));
  if (!consistent) reader.throw_short();
  for (const auto* pairs : {&state.pairs, &state.walls})
    for (const auto& pair : *pairs) {
      const bool first_in_range =
          pairs == &state.walls ? pair.first < 0 : pair.first >= 0 && pair.first < pair.second;
      if (!first_in_range || pair.second < 0 || index_of(pair.second) >= p.count() ||
          !(pair.gamma <= 0) || !std::isfinite(pair.gamma) || !std::isfinite(pair.impulse) ||
          !(pair.gamma_error >= 0))
        reader.throw_short();
    }
  return state;
}

}  // namespace viscontact::particles
