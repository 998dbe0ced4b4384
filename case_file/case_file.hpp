// A case file (TOML): one sphere in one fluid, and what is to be computed of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"

namespace viscontact {

/// How the force is fitted, or what stands in for tabulation and fitting.
struct FitRequest {
  FitSettings settings;
  std::optional<std::filesystem::path> file;    ///< a fit file to use as it is
  BelowInterval below = BelowInterval::kError;  ///< what the drag is beyond the fit's interval
  AboveInterval above = AboveInterval::kError;
  bool exact = false;  ///< no fit: the exact drag near a plane in a half-space
};

/// A minimal gap from the literature, to be shown beside the computed ones.
struct PublishedGap {
  double minimal_gap = 0;  ///< [L], > 0
  std::string source;
};

/// What `viscontact sweep` varies; its command line may say otherwise.
struct SweepRequest {
  std::vector<std::string> vary;    ///< "KEY=RANGE" each, as on the command line
  std::vector<std::string> models;  ///< names; empty: the command's default
  std::string reference;            ///< empty: the command's default
  std::string x, y;                 ///< keys of the plot's axes; may be empty
  std::vector<std::string> plot;    ///< columns to draw
  std::uint64_t samples = 0;        ///< random samples; 0: the whole grid
};

struct Case {
  std::string title;
  double viscosity = 0;  ///< mu [M/(L T)], > 0
  double radius = 0;     ///< r [L], > 0
  std::string text;      ///< the file as it was read
  // A part is there if the file has its sections; a command that needs it asks with the functions
  // below.
  std::optional<Tabulation> tabulation;
  std::optional<FitRequest> fit;
  std::optional<Motion> motion;     ///< with the settings of the models, or their defaults
  std::vector<std::string> models;  ///< names of the models of motion to run; empty: all
  std::optional<PublishedGap> published;
  std::optional<SweepRequest> sweep;
  std::filesystem::path path;
  std::vector<std::filesystem::path> force_files;  ///< that the external force was read from
};

/// Reads and checks a case file. Throws Error(kBadInput) with file, line, key, value and what is
/// allowed.
Case read_case(const std::filesystem::path& path);

/// A case to be read again and again with other numbers.
class CaseTemplate {
 public:
  /// Reads and parses the file. Throws as read_case.
  explicit CaseTemplate(const std::filesystem::path& path);

  /// The case with these numbers at these keys, such as "fluid.viscosity" or "motion.external_force[0].value". Throws Error(kBadInput) as
  /// read_case does, and for a key that leads nowhere.
  Case with(std::span<const std::pair<std::string, double>> numbers) const;

 private:
  std::filesystem::path path_;
  std::string text_;
  TomlSection root_;
};

/// The parts of a case that a command cannot do without. Throw Error(kBadInput) naming the missing
/// section.
const Tabulation& required_tabulation(const Case& c);
const FitRequest& required_fit(const Case& c);
const Motion& required_motion(const Case& c);

}  // namespace viscontact
