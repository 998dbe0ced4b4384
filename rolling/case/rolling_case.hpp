// The case of a sphere that moves along a plane in a viscous fluid and turns (docs/case-file.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/case_file/case_template.hpp"
#include "viscontact/case_file/keys.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"
#include "viscontact/motions/pair_fit.hpp"
#include "viscontact/rolling/rolling_motion.hpp"

namespace viscontact::rolling {

/// A case of a sphere that rolls along a plane. Lengths, masses and times are in any consistent
/// units.
struct RollingCase {
  std::string title;         ///< a title for pages; may be empty
  Units units{};             ///< units of the numbers, in words for pages; may be empty
  double viscosity = 0,      ///< mu of the fluid [M/(L T)], > 0
      radius = 0,            ///< r of the sphere [L], > 0
      fluid_density = 0;     ///< rho_f [M/L^3], >= 0; only buoyancy depends on it
  bool has_gravity = false;  ///< true: the forces follow from gravity, less the buoyancy
  double gravity = 0;        ///< acceleration [L/T^2] if has_gravity, < 0 towards a level plane
  /// The motion that the models compute. roughness < radius, roughness <= initial_gap, time_step <=
  /// end_time, and relative_tolerance is from 1e-13 to 0.01.
  RollingMotion motion;
  std::vector<std::string> models;  ///< models that are run (rolling_models()), each at most once
  // Exactly one of the next two exists.
  /// The tables of the drag on the sphere near the plane that are to be computed and then fitted.
  std::optional<freefem_axi::Tabulation> tabulation;
  /// File with a fit of that drag that was made before (motions/pair_fit.hpp).
  std::optional<std::filesystem::path> fit;
  /// What the section [sweep] asks for; nothing if the case has no such section.
  std::optional<case_file::SweepRequest> sweep;
  std::string text;
  std::filesystem::path path;
};

/// Reads a case file. Throws Error(kBadInput) that names the file, the line, the key, the value and
/// what is allowed. The file of a fit is not read.
RollingCase read_rolling_case(const std::filesystem::path& path);

/// Reads a case from the root table of its file. Throws the errors of read_rolling_case(), and
/// Error(kBadInput) unless exactly one of [tabulation] and [fit] is there.
void read_root(const case_file::TomlSection& root, RollingCase& c);

/// Returns `fit`, scaled to radius and viscosity of the case. Messages name `file`, from which the
/// fit was read. Throws Error(kBadInput) if the fit says that the sphere is beside another body
/// than a plane; a fit that does not name the body is accepted.
motions::PairFit fit_for(const RollingCase& c, motions::PairFit fit,
                         const std::filesystem::path& file);

/// The tables in docs/case-file.md with the keys of those sections that differ from other kinds of
/// cases: [sphere], [rolling], [fit] and [sweep].
std::vector<case_file::KeyTable> tables_of_rolling_case();

}  // namespace viscontact::rolling
