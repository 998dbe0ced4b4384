#include "tests/program/sample_files.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/oracles/brenner.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact {

std::string lecture_case_text() {
  return read_file(VISCONTACT_SOURCE_FOLDER "/data/cases/lecture.toml");
}

std::string exact_table_text() {
  constexpr int kRows = 30;
  constexpr double kSmallest = 1e-3;
  constexpr double kLargest = 2;
  lubrication::MotionTable table;
  table.viscosity = 3;
  table.radius = 1;
  table.container = "none: exact drag in a half-space";
  for (int i = 0; i < kRows; ++i) {
    lubrication::MotionRow row;
    row.gap = i + 1 == kRows ? kLargest
                             : kSmallest * std::pow(kLargest / kSmallest,
                                                    static_cast<double>(i) / (kRows - 1));
    row.reference_velocity = -1;
    row.force_factor = brenner_drag_factor(row.gap);
    row.force = 6 * std::numbers::pi * table.viscosity * table.radius * row.force_factor;
    table.rows.push_back(row);
  }
  return lubrication::write_motion_table(table);
}

std::string replaced(std::string text, const std::string& old_part, const std::string& new_part) {
  const auto place = text.find(old_part);
  if (place == std::string::npos) throw std::invalid_argument("no '" + old_part + "' in the text");
  return text.replace(place, old_part.size(), new_part);
}

std::string gentle_case_text() {
  std::string text = lecture_case_text();
  text = replaced(text, "gaps = { from = 1e-3, to = 2.0, count = 40,",
                  "gaps = { from = 0.05, to = 1.5, count = 6,");
  text = replaced(text, "container = { radius = 40.0, height = 80.0 }",
                  "container = { radius = 5.0, height = 10.0 }");
  text = replaced(text, "relative_accuracy = 1e-5", "relative_accuracy = 1e-3");
  for (int i = 0; i < 2; ++i) text = replaced(text, "time_step = 1e-3", "time_step = 1e-2");
  // The impulse, 40, is what the film absorbs between q = 1 and about 0.7.
  text = replaced(text, "value = -200.0", "value = -20.0");
  return replaced(text, "value = 200.0", "value = 20.0");
}

}  // namespace viscontact
