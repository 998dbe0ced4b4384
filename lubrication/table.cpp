// Names of motions, and the lines "# key: value" at the head of a table (docs/file-formats.md).
#include "viscontact/lubrication/table.hpp"

#include <array>
#include <cassert>
#include <limits>
#include <sstream>

#include "viscontact/common/named.hpp"
#include "viscontact/lubrication/table_codec.hpp"

namespace viscontact::lubrication {
namespace {

// The order is that of MotionKind.
constexpr std::array kMotions = {NamedMotion{"approach", MotionKind::kApproach},
                                 NamedMotion{"slide", MotionKind::kSlide},
                                 NamedMotion{"roll", MotionKind::kRoll},
                                 NamedMotion{"spin", MotionKind::kSpin},
                                 NamedMotion{"axial_strain", MotionKind::kAxialStrain},
                                 NamedMotion{"shear_strain", MotionKind::kShearStrain},
                                 NamedMotion{"twofold_strain", MotionKind::kTwofoldStrain}};

}  // namespace

bool is_strain(MotionKind motion) {
  return motion == MotionKind::kAxialStrain || motion == MotionKind::kShearStrain ||
         motion == MotionKind::kTwofoldStrain;
}

bool is_axial(MotionKind motion) {
  return motion == MotionKind::kApproach || motion == MotionKind::kAxialStrain;
}

std::span<const NamedMotion> all_motions() { return kMotions; }

std::string_view to_string(MotionKind motion) {
  return kMotions.at(static_cast<std::size_t>(motion)).name;
}

MotionKind parse_motion(std::string_view name) {
  return require_named(kMotions, name, "motion").kind;
}

std::string motions_in_words(const std::vector<MotionKind>& motions) {
  std::string words;
  for (const auto motion : motions)
    words += (words.empty() ? "" : ", ") + std::string(to_string(motion));
  return words;
}

std::vector<MotionKind> parse_motions_in_words(const std::string& words) {
  std::vector<MotionKind> motions;
  std::istringstream stream(words);
  for (std::string word; std::getline(stream >> std::ws, word, ',');)
    motions.push_back(parse_motion(word));
  return motions;
}

namespace {

constexpr std::string_view kVersionOf = "version of ", kFailedRow = "failed row, ";
const std::string kMotionTable = "motion table";

/// A line "# key: number" of the head.
struct OptionalNumber {
  std::string key;
  std::optional<double> TableHead::*number;
  bool is_positive;
};
const std::array kOptionalNumbers = {
    OptionalNumber{"leading_coefficient", &TableHead::leading_coefficient, true},
    OptionalNumber{"leading_force_factor", &TableHead::leading_force_factor, false},
    OptionalNumber{"leading_torque_factor", &TableHead::leading_torque_factor, false},
    OptionalNumber{"leading_stresslet_factor", &TableHead::leading_stresslet_factor, false},
    OptionalNumber{"neighbour_leading_force_factor", &TableHead::neighbour_leading_force_factor,
                   false},
    OptionalNumber{"neighbour_leading_torque_factor", &TableHead::neighbour_leading_torque_factor,
                   false},
    OptionalNumber{"neighbour_leading_stresslet_factor",
                   &TableHead::neighbour_leading_stresslet_factor, false}};

/// A line "# key: text" of the head, whose text may be empty.
struct Text {
  std::string key;
  std::string TableHead::*text;
  bool is_written_if_empty;
};
const std::array kTexts = {Text{"geometry", &TableHead::geometry, true},
                           Text{"container", &TableHead::container, true},
                           Text{"case", &TableHead::case_hash, false}};

/// The radii [L] in the line "# radii:" of a head. Throws Error(kBadInput) for a word that is no
/// number > 0, and for too few or too many.
std::vector<double> radii_in(const std::string& text, const std::string& file) {
  std::vector<double> radii;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const auto radius = parse_number(word);
    if (!radius || !(*radius > 0))
      throw_bad_input({file, 0, "radii"}, "# radii: contains '{}'; each must be a number > 0",
                      word);
    radii.push_back(*radius);
  }
  if (radii.size() < kFewestSpheres || radii.size() > kMostSpheres)
    throw_bad_input({file, 0, "radii"}, "# radii: has {} numbers; it must have {} to {}",
                    radii.size(), kFewestSpheres, kMostSpheres);
  return radii;
}

}  // namespace

TableHead read_head(const std::string& text, const std::string& file, bool is_of_line) {
  std::set<std::string> contradictions;
  auto lines = read_csv_comments(text, &contradictions);
  for (const auto& key : contradictions)
    if (key == "motion" || key == "viscosity" || key.starts_with("radi") ||
        key.starts_with("leading_") || key.starts_with("neighbour_leading_"))
      throw_bad_input({file, 0, key},
                      "# {}: stands twice with different values; it must stand once", key);
  const auto number = [&](const std::string& key, bool is_positive) {
    const double value = csv_comment_number(lines, key, file);
    if (is_positive && !(value > 0))
      throw_bad_input({file, 0, key}, "# {}: is {}; it must be > 0", key, value);
    return value;
  };
  TableHead head;
  if (is_of_line && !lines.contains("radii"))
    throw_bad_input({file, 0, "radii"}, "the line '# radii: NUMBER NUMBER ...' is missing");
  if (is_of_line) head.radii = radii_in(lines["radii"], file);
  if (lines.contains("motion"))
    head.motion = in_file(file, [&] {
      return with_place("# motion", [&] { return parse_motion(lines["motion"]); });
    });
  else if (lines["viscontact"] == kMotionTable)
    throw_bad_input({file, 0, "motion"}, "has no line '# motion: ...'; it must name one of {}",
                    motions_in_words({MotionKind::kSlide, MotionKind::kRoll, MotionKind::kSpin,
                                      MotionKind::kAxialStrain, MotionKind::kShearStrain,
                                      MotionKind::kTwofoldStrain}));
  head.viscosity = number("viscosity", true);
  if (!is_of_line) head.radius = number("radius", true);
  for (const auto& [key, member, is_positive] : kOptionalNumbers)
    if (lines.contains(key)) head.*member = number(key, is_positive);
  for (const auto& [key, member, is_written_if_empty] : kTexts) head.*member = lines[key];
  head.neighbour_moves = lines["neighbour_moves"] == "yes";
  head.tabulated_motions = in_file(file, [&] {
    return with_place("# motions", [&] { return parse_motions_in_words(lines["motions"]); });
  });
  for (const auto& [key, value] : lines) {
    if (key.starts_with(kFailedRow)) head.failed_rows[key.substr(kFailedRow.size())] = value;
    if (key.starts_with(kVersionOf)) head.versions[key.substr(kVersionOf.size())] = value;
  }
  return head;
}

CsvComments lines_of(const TableHead& head, std::size_t rows) {
  CsvComments lines = {{"viscosity", format_number(head.viscosity)},
                       {"rows", std::to_string(rows)}};
  for (const auto& [key, text, is_written_if_empty] : kTexts)
    if (is_written_if_empty || !(head.*text).empty()) lines[key] = head.*text;
  if (head.radii.empty()) {
    lines["viscontact"] = "force table";
    lines["radius"] = format_number(head.radius);
  } else {
    lines["viscontact"] = "resistance table";
    for (const double radius : head.radii)
      lines["radii"] += (lines["radii"].empty() ? "" : " ") + format_number(radius);
    lines.erase("geometry");
  }
  if (head.motion != MotionKind::kApproach) {
    lines["viscontact"] = kMotionTable;
    lines["motion"] = to_string(head.motion);
  }
  if (head.neighbour_moves) lines["neighbour_moves"] = "yes";
  for (const auto& [key, number, is_positive] : kOptionalNumbers)
    if (head.*number) lines[key] = format_number(*(head.*number));
  if (!head.tabulated_motions.empty()) lines["motions"] = motions_in_words(head.tabulated_motions);
  for (const auto& [row, reason] : head.failed_rows) lines[std::string(kFailedRow) + row] = reason;
  for (const auto& [program, version] : head.versions)
    lines[std::string(kVersionOf) + program] = version;
  return lines;
}

void set_numbers(const std::vector<Column>& columns, std::span<const std::optional<double>> fields,
                 const FilePosition& here) {
  assert(fields.size() == columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto& [name, number, if_absent, allowed] = columns[i];
    if (!fields[i] && if_absent == IfAbsent::kRefused)
      throw_bad_input({here.file, here.line, name}, name + " is empty; it must be a number");
    *number = fields[i].value_or(
        if_absent == IfAbsent::kZero ? 0 : std::numeric_limits<double>::quiet_NaN());
    if (fields[i] && !allowed.test(*number))
      throw_bad_input({here.file, here.line, name}, "{} is {}; it must be {}", name, *number,
                      allowed.words);
  }
}

}  // namespace viscontact::lubrication
