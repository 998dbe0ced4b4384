// Makes cases of many particles with other numbers (particles_template.hpp). A file that the case
// names by a path relative to its own folder must be named by an absolute path in text_with().
#include "viscontact/case_file/particles/particles_template.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "viscontact/case_file/fluid/solver_files.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact::case_file {
namespace {

namespace fs = std::filesystem;

std::uint64_t read_whole(const TomlSection& section, std::string_view key) {
  if (!section.has(key)) return 0;
  constexpr Allowed kWhole = {[](double v) { return v >= 1 && v <= 1e12 && v == std::floor(v); },
                              "from 1 to 1e12 without a fraction"};
  return static_cast<std::uint64_t>(section.number(key, kWhole));
}

}  // namespace

bool is_particles_case(const fs::path& path) {
  return TomlSection::parse(read_file(path), path.string()).has("space");
}

ParticlesSweepRequest read_particles_sweep(const TomlSection& section) {
  ParticlesSweepRequest sweep;
  if (section.has("vary")) sweep.vary = section.texts("vary");
  sweep.samples = read_whole(section, "samples");
  sweep.draws = read_whole(section, "draws");
  section.finish();
  return sweep;
}

ParticlesCaseTemplate::ParticlesCaseTemplate(const fs::path& path)
    : path_(path), text_(read_file(path)), root_(TomlSection::parse(text_, path.string())) {}

ParticlesCase ParticlesCaseTemplate::with(
    std::span<const std::pair<std::string, double>> numbers) const {
  return read_particles_case(root_.with_numbers(numbers), text_, path_);
}

std::string ParticlesCaseTemplate::text_with(
    std::span<const std::pair<std::string, double>> numbers) const {
  const auto changed = root_.with_numbers(numbers);
  std::vector<std::pair<std::string, std::string>> paths;
  const auto folder = fs::absolute(path_).parent_path();
  if (changed.has("particles")) {
    const auto section = changed.section("particles");
    if (section.is_text("file"))
      paths.emplace_back("particles.file",
                         (folder / section.text("file")).lexically_normal().string());
  }
  if (changed.has("fluid") && changed.section("fluid").has("solver")) {
    const auto command = with_absolute_files(changed.section("fluid").texts("solver"), folder);
    for (std::size_t word = 0; word < command.size(); ++word)
      paths.emplace_back(fmt::format("fluid.solver[{}]", word), command[word]);
  }
  return changed.with_texts(paths).as_toml();
}

}  // namespace viscontact::case_file
