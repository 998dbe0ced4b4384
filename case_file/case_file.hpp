// A case file (TOML, docs/case-file.md): one sphere in a fluid, and what is to be computed for it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/case_file/case_template.hpp"
#include "viscontact/case_file/keys.hpp"
#include "viscontact/common/text/units.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"

namespace viscontact::case_file {

/// The kinds of cases, for commands that take several of them.
enum class CaseKind {
  kSphere,     ///< one sphere; read_case() reads it
  kParticles,  ///< has the section [space]; read_particles_case() reads it
  kRolling,    ///< has the section [rolling]; read_rolling_case() reads it
  kSwimmer     ///< has the section [swimmer]; read_swimmer_case() reads it
};

/// The kind by the sections of the file, which are looked for in the order [space], [swimmer],
/// [rolling]; kSphere if the case has none of these. Throws Error(kBadInput) if the file cannot be
/// read or is not valid TOML, and for a pipe, because the caller reads the file a second time.
CaseKind kind_of_case(const std::filesystem::path& path);

/// How the drag is fitted, or what replaces the fit: at most one of `file` and `exact`.
struct FitRequest {
  fitting::FitSettings settings;  ///< not used with `file` or `exact`
  /// A fit file that replaces the table and its fit.
  std::optional<std::filesystem::path> file;
  lubrication::OutsideInterval outside;
  /// The exact drag near a plane replaces the fit.
  bool exact = false;
};

/// A gap from the literature, which is shown beside the computed ones.
struct PublishedGap {
  double minimal_gap = 0;  ///< [L], > 0
  std::string source;      ///< in words; may be empty
};

/// The content of a case file, after all checks, in any consistent units.
struct Case {
  std::string title;         ///< for the report; the key is required, the text may be empty
  Units units{};             ///< words for pages and axes; may be empty
  double viscosity = 0;      ///< [M/(L T)], > 0
  double radius = 0;         ///< of the sphere [L], > 0
  double density = 0;        ///< of the sphere [M/L^3], >= 0; 0: the mass is given
  double fluid_density = 0;  ///< [M/L^3], >= 0; 0: no buoyancy
  /// Acceleration of gravity [L/T^2], < 0 towards the wall. The external force contains the weight.
  std::optional<double> gravity{};
  std::string text;  ///< content of the file
  // Each of these parts exists only if the file has its section.
  std::optional<freefem_axi::Tabulation> tabulation;
  std::optional<FitRequest> fit;
  /// The motion with the parameters of the models (defaults if the case does not give them).
  std::optional<reduced_model::Motion> motion;
  /// Names; if there are none, reduced_model::default_models() run.
  std::vector<std::string> models;
  std::optional<PublishedGap> published;
  std::optional<SweepRequest> sweep;
  std::filesystem::path path;                      ///< the case file, as read_case() was given it
  std::vector<std::filesystem::path> force_files;  ///< files from which the external force was read
};

/// Throws Error(kBadInput) with file, line, key, value and what is allowed if a value is wrong or
/// missing, and with the path if the file, or a file with the external force, cannot be read.
Case read_case(const std::filesystem::path& path);

/// Reads all members of a case but `text` and `path` from the root table of its file
/// (case_template.hpp). `c.path` must be set before, because paths in the case are relative to its
/// folder. Throws the errors of read_case().
void read_root(const TomlSection& root, Case& c);

/// The sections with parameters of models, which all have defaults.
template <>
std::vector<std::string_view> sections_with_defaults<Case>();

/// The fit, scaled to radius and viscosity of the case (lubrication/scaling.hpp). Throws
/// Error(kBadInput), which names `file`, if the fit was made for another radius and the lengths of
/// its geometry or container, divided by its radius, differ from those in the section [tabulation]
/// of the case, if there is one.
lubrication::Fit fit_for(const Case& c, lubrication::Fit fit, const std::filesystem::path& file);

/// The sections in the order of docs/case-file.md.
std::vector<KeyTable> tables_of_sphere_case();

/// This function and the two functions below throw Error(kBadInput), which names the missing
/// section, if the case does not have it.
const freefem_axi::Tabulation& required_tabulation(const Case& c);
const FitRequest& required_fit(const Case& c);
const reduced_model::Motion& required_motion(const Case& c);

}  // namespace viscontact::case_file
