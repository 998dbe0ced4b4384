// Dimensions of keys and columns by their names.
#include "viscontact/report/pictures/sweep_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace viscontact::report {
namespace {

/// Powers of mass, length and time.
using Dimension = std::array<int, 3>;

/// The dimension of keys and columns with a name after the last dot.
struct Known {
  std::string_view name;
  Dimension dimension;
};

// Names whose dimension is another one in the plane or in another kind of case are not here.
constexpr auto kKnown = std::to_array<Known>({
    {"radius", {0, 1, 0}},
    {"viscosity", {1, -1, -1}},
    {"gravity", {0, 1, -2}},
    {"initial_gap", {0, 1, 0}},
    {"initial_velocity", {0, 1, -1}},
    {"end_time", {0, 0, 1}},
    {"time_step", {0, 0, 1}},
    {"threshold_gap", {0, 1, 0}},
    {"roughness", {0, 1, 0}},
    {"restitution", {0, 0, 0}},
    {"coefficient", {0, 0, 0}},
    {"area_fraction", {0, 0, 0}},
    {"volume_fraction", {0, 0, 0}},
    {"shear_rate", {0, 0, -1}},
    {"strain_rate", {0, 0, -1}},
    {"time_scale", {0, 0, 0}},
    {"minimal_gap", {0, 1, 0}},
    {"minimal_gap_time", {0, 0, 1}},
    {"film_from_gamma", {0, 1, 0}},
    {"contact_from", {0, 0, 1}},
    {"contact_until", {0, 0, 1}},
    {"contact_time", {0, 0, 1}},
    {"sup_gap_distance", {0, 1, 0}},
    {"l1_gap_distance", {0, 1, 1}},
    {"l1_velocity_distance", {0, 1, 0}},
    {"film_ratio", {0, 0, 0}},
    {"solid_contact_from", {0, 0, 1}},
    {"solid_contact_velocity", {0, 1, -1}},
    {"gap", {0, 1, 0}},
    {"smallest_gap", {0, 1, 0}},
    {"position", {0, 1, 0}},
    {"velocity", {0, 1, -1}},
    {"angular_velocity", {0, 0, -1}},
    {"slip", {0, 1, -1}},
    {"displacement", {0, 1, 0}},
    {"efficiency", {0, 0, 0}},
    {"to_time", {0, 0, 1}},
    {"apparent_viscosity", {1, -1, -1}},
    {"mean_apparent_viscosity", {1, -1, -1}},
    {"largest_overlap", {0, 1, 0}},
    {"final_overlap", {0, 1, 0}},
    {"contacts", {0, 0, 0}},
    {"glued", {0, 0, 0}},
    {"particles", {0, 0, 0}},
    {"steps", {0, 0, 0}},
});

/// The part of a name after the last dot, without the index of a list.
std::string_view unqualified(std::string_view name) {
  // A gap in the name of a column, such as 0.001, has a dot of its own.
  if (const auto gap = name.find("time_to_gap"); gap != std::string_view::npos)
    return name.substr(gap);
  name = name.substr(0, name.find('['));
  const auto dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

std::optional<Dimension> dimension_of(std::string_view name) {
  if (const auto slash = name.find('/'); slash != std::string_view::npos) {
    auto above = dimension_of(name.substr(0, slash));
    const auto below = dimension_of(name.substr(slash + 1));
    if (!above || !below) return {};
    for (std::size_t k = 0; k < above->size(); ++k) (*above)[k] -= (*below)[k];
    return above;
  }
  if (name == "sphere.mass") return Dimension{1, 0, 0};
  if (name == "sphere.density") return Dimension{1, -3, 0};
  if (unqualified(name).starts_with("time_to_gap")) return Dimension{0, 0, 1};
  const auto known = std::ranges::find(kKnown, unqualified(name), &Known::name);
  if (known == kKnown.end()) return {};
  return known->dimension;
}

/// " [UNIT]"; empty for a quantity without a dimension or of an unknown one.
std::string unit_of(std::string_view name, const Units& units) {
  const auto dimension = dimension_of(name);
  if (!dimension || *dimension == Dimension{}) return "";
  return units.in_brackets((*dimension)[0], (*dimension)[1], (*dimension)[2]);
}

}  // namespace

std::string axis_label(std::string_view name, const Units& units) {
  return fmt::format("{}{}", name, unit_of(name, units));
}

std::string common_axis_label(const std::vector<std::string>& columns, const Units& units) {
  if (columns.size() == 1) return axis_label(columns[0], units);
  const auto agree = [&](const auto& property) {
    return std::ranges::all_of(
        columns, [&](const auto& one) { return property(one) == property(columns[0]); });
  };
  const auto unit = [&](const std::string& column) { return unit_of(column, units); };
  std::string label;
  if (agree([](const std::string& column) { return unqualified(column); }))
    label = unqualified(columns[0]);
  if (!agree(unit)) return label;
  label += unit(columns[0]);
  return label.starts_with(' ') ? label.substr(1) : label;
}

}  // namespace viscontact::report
