#include "viscontact/report/comparison_table.hpp"

#include <fmt/format.h>

namespace viscontact {

std::string comparison_table(const Comparison& comparison) {
  constexpr std::string_view kLine = "{:<30} {:>12} {:>9} {:>15} {:>16} {:>10}\n";
  std::string text = fmt::format(kLine, "model", "smallest gap", "at time", "film from gamma",
                                 "in contact", "sup |dq|");
  for (const auto& model : comparison.models)
    text += fmt::format(
        kLine, model.model, fmt::format("{:.6g}", model.minimal_gap),
        fmt::format("{:.6g}", model.minimal_gap_time),
        model.recovered_minimal_gap ? fmt::format("{:.6g}", *model.recovered_minimal_gap) : "-",
        model.contact_interval ? fmt::format("[{:.4g}, {:.4g}]", (*model.contact_interval)[0],
                                             (*model.contact_interval)[1])
                               : "-",
        fmt::format("{:.3g}", model.sup_gap_distance));
  for (const auto& failed : comparison.failed_models)
    text += fmt::format("{:<30} failed: {}\n", failed.model, failed.reason);
  return text;
}

}  // namespace viscontact
