// The file of a ResistanceFit (JSON, docs/file-formats.md), and the scaling of a fit.

#include <algorithm>
#include <cassert>
#include <functional>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/json_fields.hpp"
#include "viscontact/lubrication/scaling.hpp"
#include "viscontact/swimmer/resistance/resistance_fit.hpp"

namespace viscontact::swimmer {
namespace {

using Eigen::Index;

/// Throws Error(kBadInput), which names the key, unless all numbers are > 0.
void check_positive(const JsonFields& json, const std::string& key,
                    const std::vector<double>& numbers) {
  for (const double number : numbers)
    if (!(number > 0)) json.fail(key, "contains {}; each number must be > 0", number);
}

/// Throws Error(kBadInput) unless fit.gaps has at least two rising numbers > 0 for each gap.
void check_gaps(const JsonFields& json, const ResistanceFit& fit) {
  for (const auto& nodes : fit.gaps) {
    check_positive(json, "gaps", nodes);
    if (nodes.size() < 2 || std::ranges::adjacent_find(nodes, std::greater_equal()) != nodes.end())
      json.fail("gaps", "must have at least two rising numbers for each gap");
  }
  if (fit.gaps.size() + 1 != fit.radii.size())
    json.fail("gaps", "has {} arrays; it must have {}, one less than there are radii",
              fit.gaps.size(), fit.radii.size() - 1);
}

/// Writes or reads the key `logarithms`: the entries on and above the diagonal of each matrix of
/// ResistanceFit::logarithms, row by row.
void logarithms(JsonFields& json, ResistanceFit& fit) {
  const std::size_t spheres = fit.radii.size();
  std::vector<std::vector<double>> all;
  for (const auto& matrix : fit.logarithms) {
    auto& entries = all.emplace_back();
    for (Index i = 0; i < matrix.rows(); ++i)
      for (Index j = i; j < matrix.cols(); ++j) entries.push_back(matrix(i, j));
  }
  json("logarithms", all);
  if (!json.reads()) return;
  for (const auto& entries : all) {
    if (entries.size() != entry_count(spheres))
      json.fail("logarithms", "must have arrays of {} numbers", entry_count(spheres));
    auto& matrix = fit.logarithms.emplace_back(spheres, spheres);
    for (std::size_t i = 0; i < spheres; ++i)
      for (std::size_t j = 0; j < spheres; ++j)
        matrix(static_cast<Index>(i), static_cast<Index>(j)) =
            entries[entry_position(i, j, spheres)];
  }
  std::size_t count = 1;
  for (const auto& nodes : fit.gaps) count *= nodes.size();
  if (all.size() != count)
    json.fail("logarithms", "has {} matrices; it must have {}, one for each combination of gaps",
              all.size(), count);
}

}  // namespace

void fields_of(JsonFields& json, ResistanceFit& fit) {
  json.constant("viscontact", "resistance fit");
  json("viscosity", fit.viscosity, kPositive);
  json("radii", fit.radii);
  if (json.reads()) {
    check_positive(json, "radii", fit.radii);
    if (fit.radii.size() < kFewestSpheres || fit.radii.size() > kMostSpheres)
      json.fail("radii", "has {} numbers; it must have {} to {}", fit.radii.size(), kFewestSpheres,
                kMostSpheres);
  }
  json("container", fit.container);
  auto terms = static_cast<std::size_t>(fit.lubrication_terms);
  json("lubrication_terms", terms);
  if (json.reads() && terms > static_cast<std::size_t>(kLubricationTerms))
    json.fail("lubrication_terms", "is {}; it must be at most {}", terms, kLubricationTerms);
  fit.lubrication_terms = static_cast<int>(terms);
  json("largest_relative_residual", fit.largest_relative_residual, kNotNegative);
  json("largest_left_one_out_error", fit.largest_left_one_out_error, kNotNegative);
  json("rms_left_one_out_error", fit.rms_left_one_out_error, kNotNegative);
  json("table_sha256", fit.table_sha256);
  json("versions", fit.versions);
  json("gaps", fit.gaps);
  if (json.reads()) check_gaps(json, fit);
  logarithms(json, fit);
  json.foreign_object("provenance");
}

ResistanceFit scaled_to(ResistanceFit fit, double viscosity, const std::vector<double>& radii) {
  assert(viscosity > 0);
  const double ratio = ratio_of_radii(radii, fit.radii, "fit");
  fit.viscosity = viscosity;
  if (radii == fit.radii) return fit;
  // Gaps grow with the radii; S, the logarithm of the scaled matrices, stays the same.
  for (auto& nodes : fit.gaps)
    for (auto& gap : nodes) gap *= ratio;
  fit.radii = radii;
  fit.container = lubrication::with_lengths_scaled(fit.container, ratio);
  return fit;
}

std::string write_resistance_fit(const ResistanceFit& fit) { return JsonFields::text_of(fit, 1); }

ResistanceFit read_resistance_fit(const std::filesystem::path& path) {
  return JsonFields::read<ResistanceFit>(read_file(path), path.string());
}

}  // namespace viscontact::swimmer
