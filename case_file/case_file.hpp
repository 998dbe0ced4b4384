// A case file (TOML, docs/case-file.md): one sphere in a fluid, and what is to be computed for it.
// Lengths, masses and times are in any consistent units. Keys are declared in case_file.cpp
// (keys.hpp). The commands of app/ and the parts pipeline/, sweep/, report/, results/ and python/
// read it. Every fault of a case throws Error(kBadInput), with the line and the key if the fault
// belongs to one. New keys may be added if they have a default; a change must keep accepting the
// cases that users have written.
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

/// The kind of a case by its sections, which are looked for in the order [space], [swimmer],
/// [rolling]; kSphere if the case has none of these. Throws Error(kBadInput) if the file cannot be
/// read or is not valid TOML, and for a pipe, because the caller reads the file a second time.
CaseKind kind_of_case(const std::filesystem::path& path);

/// How the drag is fitted, or what replaces the table and its fit. At most one of `file` and
/// `exact` is given.
struct FitRequest {
  fitting::FitSettings settings;  ///< how the table is fitted; not used with `file` or `exact`
  /// Path of a fit file that replaces the table and its fit; nothing: a table is fitted, or the
  /// drag is exact.
  std::optional<std::filesystem::path> file;
  lubrication::OutsideInterval outside;  ///< drag outside the interval of the fit
  /// True: the exact drag near a plane replaces the fit.
  bool exact = false;
};

/// A minimal gap from the literature, shown beside the computed ones.
struct PublishedGap {
  double minimal_gap = 0;  ///< [L], > 0
  std::string source;      ///< where it was published, in words; may be empty
};

/// The content of a case file, after all checks.
struct Case {
  std::string title;         ///< for the report; the key is required, the text may be empty
  Units units{};             ///< words for pages and axes; may be empty
  double viscosity = 0;      ///< [M/(L T)], > 0
  double radius = 0;         ///< of the sphere [L], > 0
  double density = 0;        ///< of the sphere [M/L^3], >= 0; 0: the mass is given
  double fluid_density = 0;  ///< [M/L^3], >= 0; 0: no buoyancy
  /// Acceleration of gravity [L/T^2], < 0 towards the wall; nothing: not given. The external force
  /// in `motion` contains the weight already.
  std::optional<double> gravity{};
  std::string text;  ///< content of the file
  // Each of these parts exists only if the file has its section. A command that needs a part calls
  // a required_... function below.
  std::optional<freefem_axi::Tabulation> tabulation;  ///< section [tabulation]
  std::optional<FitRequest> fit;                      ///< section [fit]
  /// Section [motion], with the parameters of the models (defaults if the case does not give them).
  std::optional<reduced_model::Motion> motion;
  /// Names of the models to run; empty: reduced_model::default_models().
  std::vector<std::string> models;
  std::optional<PublishedGap> published;           ///< section [published]
  std::optional<SweepRequest> sweep;               ///< section [sweep]
  std::filesystem::path path;                      ///< the case file, as read_case() was given it
  std::vector<std::filesystem::path> force_files;  ///< files from which the external force was read
};

/// Reads and checks a case file. Throws Error(kBadInput) with the file, the line, the key, its
/// value and what is allowed if a value is wrong or missing; throws it with the path if the file,
/// or a file with the external force, cannot be read.
Case read_case(const std::filesystem::path& path);

/// Reads all members of a case but `text` and `path` from the root table of its file
/// (case_template.hpp). `c.path` must be set before, because paths in the case are relative to its
/// folder. Throws the errors of read_case().
void read_root(const TomlSection& root, Case& c);

/// Names of the sections with parameters of models, which all have defaults.
template <>
std::vector<std::string_view> sections_with_defaults<Case>();

/// The fit, scaled to radius and viscosity of the case (lubrication/scaling.hpp). `file`, from
/// which it was read, is named in messages. Throws Error(kBadInput) if the fit has an unknown term,
/// or if it was made for another radius and the lengths of its geometry or container, divided by
/// its radius, differ from those in the section [tabulation] of the case. Without this section they
/// are not compared.
lubrication::Fit fit_for(const Case& c, lubrication::Fit fit, const std::filesystem::path& file);

/// What docs/case-file.md says about the keys of each section, in the order of the page. This
/// function does not throw.
std::vector<KeyTable> tables_of_sphere_case();

/// The section [tabulation] of a case. This function and the two functions below throw
/// Error(kBadInput), which names the missing section, if the case does not have it.
const freefem_axi::Tabulation& required_tabulation(const Case& c);
/// The section [fit] of a case.
const FitRequest& required_fit(const Case& c);
/// The section [motion] of a case.
const reduced_model::Motion& required_motion(const Case& c);

}  // namespace viscontact::case_file
