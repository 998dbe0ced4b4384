// Reads the section [motion] and the sections with the parameters of models (docs/case-file.md).
// Lengths, masses and times are in the units of the case. A new parameter of a model needs no
// change here, because the registry of models names them.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <vector>

#include "viscontact/case_file/sections.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact::case_file {
namespace {

/// Reads an entry of external_force with `until`: a piece of a force, which begins at the time at
/// which the piece before it ends.
reduced_model::ExternalForce::Piece read_piece(const TomlSection& entry) {
  reduced_model::ExternalForce::Piece piece{entry.number("until", kPositive), 0};
  if (entry.has("polynomial")) {
    if (entry.has("value"))
      entry.fail("value", "must be left out, because the first coefficient of polynomial gives it");
    auto coefficients = entry.numbers("polynomial", kFinite);
    piece.value = coefficients.front();
    piece.higher.assign(coefficients.begin() + 1, coefficients.end());
  } else {
    piece.value = entry.number("value", kFinite);
  }
  return piece;
}

reduced_model::ExternalForce::Sinusoid read_sinusoid(const TomlSection& entry) {
  return {entry.number("amplitude", kFinite), entry.number("angular_frequency", kPositive),
          entry.has("phase") ? entry.number("phase", kFinite) : 0};
}

/// The path of a file that the case names relative to its folder. If there is no such file, but the
/// folder of the case itself has a file of this name, the path of that file: a run keeps copies of
/// the case and of the files that it names side by side.
std::filesystem::path force_file(const std::filesystem::path& folder,
                                 const std::filesystem::path& file) {
  const auto copy = folder / file.filename();
  // An error means that no file can have this name; reading the file reports it.
  std::error_code ignored;
  return !std::filesystem::exists(folder / file, ignored) && std::filesystem::exists(copy, ignored)
             ? copy
             : folder / file;
}

/// Reads `external_force` [M L/T^2]. The entries with `until` follow each other and make one force.
/// Every other entry, a sinusoid or a file, is added to this force.
reduced_model::ExternalForce read_forces(const TomlSection& motion, double end_time,
                                         const std::filesystem::path& case_folder,
                                         std::vector<std::filesystem::path>& files) {
  std::vector<reduced_model::ExternalForce::Piece> pieces;
  std::vector<reduced_model::ExternalForce> summands;
  for (const auto& entry : motion.sections("external_force")) {
    if (entry.has("file")) {
      files.push_back(force_file(case_folder, entry.text("file")));
      summands.push_back(reduced_model::read_external_force(files.back(), end_time));
    } else if (entry.has("amplitude")) {
      summands.push_back(reduced_model::ExternalForce::sinusoidal(read_sinusoid(entry)));
    } else {
      pieces.push_back(read_piece(entry));
    }
    entry.finish();
  }
  if (!pieces.empty()) {
    summands.push_back(
        at_key(motion, "external_force", [&] { return reduced_model::ExternalForce(pieces); }));
    if (pieces.back().until < end_time)
      motion.fail("external_force", fmt::format("ends at {}; it must reach motion.end_time, {}",
                                                pieces.back().until, end_time));
  }
  reduced_model::ExternalForce force = summands.front();
  for (std::size_t i = 1; i < summands.size(); ++i) force += summands[i];
  return force;
}

/// Reads a parameter of a model.
double read_parameter(const TomlSection& section, const reduced_model::ModelParameter& parameter,
                      double end_time) {
  const double value = section.number(parameter.name(), parameter.allowed);
  if (parameter.is_time_step && value > end_time)
    section.fail(parameter.name(),
                 fmt::format("is {}; it must be a number > 0 and at most motion.end_time, {}",
                             value, end_time));
  return value;
}

/// Reads `roughness`: the heights of the roughness of sphere and plane [L]. Their sum must be less
/// than the radius.
std::array<double, 2> read_roughness(const TomlSection& contact, double radius) {
  constexpr auto kName = reduced_model::name_of(reduced_model::kRoughnessKey);
  const auto roughness = contact.numbers(kName, kNotNegative);
  if (roughness.size() != 2)
    contact.fail(kName,
                 fmt::format("contains {} number(s); it must be two numbers >= 0, the heights on "
                             "the sphere and on the plane",
                             roughness.size()));
  if (!(roughness[0] + roughness[1] < radius))
    contact.fail(kName, fmt::format("adds up to {}; it must be less than the sphere's radius, {}",
                                    roughness[0] + roughness[1], radius));
  return {roughness[0], roughness[1]};
}

/// Reads the sections of the models' parameters. A section that exists is checked even if no model
/// uses it.
void read_model_sections(const TomlSection& root, double radius, reduced_model::Motion& motion) {
  const auto parameters = reduced_model::model_parameters();
  for (const auto& parameter : parameters)
    motion.set(parameter, parameter.fallback(motion, radius));
  for (const auto& name : reduced_model::model_sections()) {
    if (!root.has(name)) continue;
    const auto section = root.section(name);
    for (const auto& parameter : parameters)
      if (parameter.section() == name && section.has(parameter.name()))
        motion.set(parameter, read_parameter(section, parameter, motion.end_time));
    // The roughness is a property of the surfaces, so it is stored with the motion and not as a
    // parameter of one model.
    if (name == reduced_model::section_of(reduced_model::kRoughnessKey) &&
        section.has(reduced_model::name_of(reduced_model::kRoughnessKey)))
      motion.roughness = read_roughness(section, radius);
    if (name == reduced_model::kRestitution.section() && motion.restitution() > 0 &&
        motion.roughness[0] + motion.roughness[1] == 0)
      section.fail(reduced_model::kRestitution.name(),
                   fmt::format("is {}; it is the coefficient of solids that touch, which needs a "
                               "roughness whose heights together are > 0",
                               motion.restitution()));
    section.finish();
  }
}

/// Reads `time_scale` and multiplies all times of the motion by it.
void stretch(const TomlSection& section, reduced_model::Motion& motion) {
  const double scale = section.number("time_scale", kPositive);
  bool representable = std::isnormal(motion.end_time);
  const auto stretched = [&](double time) {
    representable = representable && std::isnormal(time * scale);
    return time * scale;
  };
  motion.external_force = motion.external_force.stretched(scale);
  motion.end_time = stretched(motion.end_time);
  for (const auto& parameter : reduced_model::model_parameters())
    if (parameter.is_time_step) motion.set(parameter, stretched(motion.parameter(parameter)));
  if (!representable)
    section.fail(
        "time_scale",
        fmt::format("is {}; every time multiplied by it must stay within the range of a double",
                    scale));
}

}  // namespace

reduced_model::Motion read_motion(const TomlSection& root, const TomlSection& section, double mass,
                                  double radius, const std::filesystem::path& case_folder,
                                  std::vector<std::filesystem::path>& force_files) {
  const double end_time = section.number("end_time", kPositive);
  reduced_model::Motion motion{mass, section.number("initial_gap", kPositive),
                               section.number("initial_velocity", kFinite), end_time,
                               read_forces(section, end_time, case_folder, force_files)};

  read_model_sections(root, radius, motion);
  if (section.has("rows")) motion.output_rows = section.count("rows", 2, 100'000'000);
  if (section.has("time_scale")) stretch(section, motion);
  return motion;
}

}  // namespace viscontact::case_file
