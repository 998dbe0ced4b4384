// A case file (TOML): one sphere in one fluid, and what is to be computed of it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fitting/fit.hpp"
#include "fitting/lubrication_force.hpp"
#include "freefem_axi/tabulation.hpp"
#include "reduced_model/motion.hpp"

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

struct Case {
  std::string title;
  double viscosity = 0;  ///< mu [M/(L T)], > 0
  double radius = 0;     ///< r [L], > 0
  std::string text;      ///< the file as it was read
  // A part is there if the file has its sections; a command that needs it asks with the functions
  // below.
  std::optional<Tabulation> tabulation;
  std::optional<FitRequest> fit;
  std::optional<Motion> motion;
  std::vector<std::string> models;  ///< names of the models of motion to run; empty: all
  std::optional<PublishedGap> published;
  std::filesystem::path path;
  std::vector<std::filesystem::path> force_files;  ///< that the external force was read from
};

/// Reads and checks a case file. Throws Error(kBadInput) with file, line, key, value and what is
/// allowed.
Case read_case(const std::filesystem::path& path);

/// The parts of a case that a command cannot do without. Throw Error(kBadInput) naming the missing
/// section.
const Tabulation& required_tabulation(const Case& c);
const FitRequest& required_fit(const Case& c);
const Motion& required_motion(const Case& c);

}  // namespace viscontact
