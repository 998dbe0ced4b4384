// What a run of a swimmer has computed. Lengths, masses and times are in the units of the case.
#pragma once

#include <optional>
#include <vector>

#include "viscontact/case_file/swimmer/swimmer_case.hpp"
#include "viscontact/lubrication/resistance/resistance_fit.hpp"
#include "viscontact/lubrication/resistance/resistance_table.hpp"
#include "viscontact/reduced_model/swimmer/optimal_stroke.hpp"
#include "viscontact/reduced_model/swimmer/swim.hpp"
#include "viscontact/reduced_model/swimmer/swim_errors.hpp"

namespace viscontact::report {

/// A stroke and what it does.
struct StrokeResult {
  double period = 0;  ///< [T]
  reduced_model::SwimSums sums;
  reduced_model::SwimErrors errors;
  std::vector<reduced_model::SwimRow> rows;
};

struct SwimmerResults {
  case_file::SwimmerCase c;
  lubrication::ResistanceTable table;
  lubrication::ResistanceFit fit;
  std::optional<StrokeResult> stroke;   ///< of the case's section [stroke]
  std::optional<StrokeResult> optimal;  ///< of the case's section [optimal]
  /// How the optimal stroke was found; exists if `optimal` does.
  std::optional<reduced_model::OptimalStroke> search;
};

}  // namespace viscontact::report
