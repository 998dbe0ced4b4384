#include "viscontact/motions/job/motion_tables.hpp"

#include <algorithm>

#include "viscontact/freefem_axi/force_table_plan.hpp"

namespace viscontact::motions {

std::vector<pipeline::CaseTable> case_tables(const std::filesystem::path& case_path,
                                             const std::string& case_text,
                                             const freefem_axi::Tabulation& tabulation,
                                             const TablePath& path_of) {
  using lubrication::MotionKind;
  std::vector<pipeline::CaseTable> tables;
  if (std::ranges::find(tabulation.motions, MotionKind::kApproach) != tabulation.motions.end())
    tables.push_back({case_path,
                      case_text,
                      path_of(MotionKind::kApproach),
                      freefem_axi::force_table_plan(tabulation),
                      tabulation,
                      {{MotionKind::kApproach, path_of(MotionKind::kApproach)}}});
  for (const auto group : motion_groups(tabulation)) {
    const auto asked = asked_motions(tabulation, group);
    auto& one =
        tables.emplace_back(pipeline::CaseTable{case_path,
                                                case_text,
                                                path_of(asked.front()),
                                                motion_table_plan(tabulation, group, path_of),
                                                tabulation,
                                                {}});
    for (const auto motion : asked) one.motions.emplace_back(motion, path_of(motion));
  }
  return tables;
}

}  // namespace viscontact::motions
