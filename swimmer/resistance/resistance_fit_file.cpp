// Reads and writes the file of a ResistanceFit (docs/file-formats.md). Lengths, masses and times
// are in the units of the table. A change must keep earlier files readable.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/lubrication/fit/json_object.hpp"
#include "viscontact/swimmer/resistance/pair_lubrication.hpp"
#include "viscontact/swimmer/resistance/resistance_fit.hpp"

namespace viscontact::swimmer {
namespace {

std::vector<double> read_positive(const lubrication::JsonObject& root, const std::string& key,
                                  const Json& array) {
  std::vector<double> numbers;
  if (!array.is_array()) root.fail(key, "must be an array of numbers");
  for (const Json& value : array) {
    numbers.push_back(root.finite(key, value));
    if (!(numbers.back() > 0))
      root.fail(key, fmt::format("contains {}; each number must be > 0", numbers.back()));
  }
  return numbers;
}

/// The nodes of each gap.
std::vector<std::vector<double>> read_gaps(const lubrication::JsonObject& root, std::size_t count) {
  std::vector<std::vector<double>> gaps;
  for (const Json& nodes : root.array("gaps")) {
    gaps.push_back(read_positive(root, "gaps", nodes));
    if (gaps.back().size() < 2 ||
        std::ranges::adjacent_find(gaps.back(), std::greater_equal()) != gaps.back().end())
      root.fail("gaps", "must have at least two rising numbers for each gap");
  }
  if (gaps.size() != count)
    root.fail("gaps", fmt::format("has {} arrays; it must have {}, one less than there are radii",
                                  gaps.size(), count));
  return gaps;
}

/// The matrices from their entries on and above the diagonal.
std::vector<Eigen::MatrixXd> read_logarithms(const lubrication::JsonObject& root,
                                             const ResistanceFit& fit) {
  const std::size_t spheres = fit.radii.size();
  std::size_t count = 1;
  for (const auto& nodes : fit.gaps) count *= nodes.size();
  std::vector<Eigen::MatrixXd> logarithms;
  for (const Json& entries : root.array("logarithms")) {
    if (!entries.is_array() || entries.size() != entry_count(spheres))
      root.fail("logarithms", fmt::format("must have arrays of {} numbers", entry_count(spheres)));
    auto& matrix = logarithms.emplace_back(spheres, spheres);
    for (std::size_t i = 0; i < spheres; ++i)
      for (std::size_t j = i; j < spheres; ++j) {
        const double entry = root.finite("logarithms", entries.at(entry_position(i, j, spheres)));
        matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = entry;
        matrix(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = entry;
      }
  }
  if (logarithms.size() != count)
    root.fail("logarithms", fmt::format("has {} matrices; it must have {}, one for each "
                                        "combination of gaps",
                                        logarithms.size(), count));
  return logarithms;
}

}  // namespace

std::string write_resistance_fit(const ResistanceFit& fit) {
  nlohmann::ordered_json json = {{"viscontact", "resistance fit"},
                                 {"viscosity", fit.viscosity},
                                 {"radii", fit.radii},
                                 {"container", fit.container},
                                 {"lubrication_terms", fit.lubrication_terms},
                                 {"largest_relative_residual", fit.largest_relative_residual},
                                 {"largest_left_one_out_error", fit.largest_left_one_out_error},
                                 {"rms_left_one_out_error", fit.rms_left_one_out_error},
                                 {"table_sha256", fit.table_sha256},
                                 {"versions", fit.versions},
                                 {"gaps", fit.gaps}};
  auto& logarithms = json["logarithms"] = nlohmann::ordered_json::array();
  for (const auto& matrix : fit.logarithms) {
    std::vector<double> entries;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (Eigen::Index j = i; j < matrix.cols(); ++j) entries.push_back(matrix(i, j));
    logarithms.push_back(entries);
  }
  return json.dump(1) + "\n";
}

ResistanceFit read_resistance_fit(const std::filesystem::path& path) {
  const auto document = JsonDocument::parse(read_file(path), path.string());
  const lubrication::JsonObject root(document);
  ResistanceFit fit;
  fit.viscosity = root.number_above("viscosity", 0, false);
  fit.radii = read_positive(root, "radii", root.array("radii"));
  if (fit.radii.size() < kFewestSpheres || fit.radii.size() > kMostSpheres)
    root.fail("radii", fmt::format("has {} numbers; it must have {} to {}", fit.radii.size(),
                                   kFewestSpheres, kMostSpheres));
  fit.container = root.text("container");
  const auto terms = root.count("lubrication_terms");
  if (terms > static_cast<std::size_t>(kLubricationTerms))
    root.fail("lubrication_terms",
              fmt::format("is {}; it must be at most {}", terms, kLubricationTerms));
  fit.lubrication_terms = static_cast<int>(terms);
  fit.largest_relative_residual = root.number_above("largest_relative_residual", 0, true);
  fit.largest_left_one_out_error = root.number_above("largest_left_one_out_error", 0, true);
  fit.rms_left_one_out_error = root.number_above("rms_left_one_out_error", 0, true);
  fit.table_sha256 = root.text("table_sha256");
  fit.gaps = read_gaps(root, fit.radii.size() - 1);
  fit.logarithms = read_logarithms(root, fit);
  return fit;
}

}  // namespace viscontact::swimmer
