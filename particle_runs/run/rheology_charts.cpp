// Curves of the viscosity and of the pair distribution.
#include "viscontact/particle_runs/run/rheology_charts.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "viscontact/particle_runs/picture/line_charts.hpp"
#include "viscontact/report/pictures/colours.hpp"

namespace viscontact::particles {
namespace {

struct RheologyChartTuning {
  // The share of the largest values, of the first contacts after the start, that may be cut off.
  static constexpr double kCut = 0.01;
  static constexpr double kAbove = 1.15;  // top of the axis over the largest of the others
  // Top of the axis of the pair distribution. Its peak at contact is far higher and tells less.
  static constexpr double kTopOfPairs = 6;
};

ChartCurve over_strain(const std::vector<Rheology>& rows, double Rheology::*member,
                       const std::string& legend, const char* colour, bool is_dashed = false) {
  ChartCurve curve{legend, colour, is_dashed, {}};
  for (const auto& row : rows) curve.points.emplace_back(row.strain, row.*member);
  return curve;
}

LineChart viscosity_chart(const ParticlesCase& c, const SuspensionCurves& curves) {
  LineChart chart{"Viscosity", "strain", "viscosity over that of the fluid", {}, {}};
  const bool has_films = c.setting.lubrication->pairs != PairTerms::kNone;
  const auto& rows = curves.rheology;
  chart.curves = {over_strain(rows, &Rheology::viscosity, has_films ? "all" : "viscous contact",
                              report::kBlack),
                  over_strain(rows, &Rheology::viscosity_film,
                              has_films ? "drag and films" : "drag", report::kSkyBlue),
                  over_strain(rows, &Rheology::viscosity_contact, "contacts", report::kVermilion)};
  if (c.setting.laws.friction)
    chart.curves.push_back(
        over_strain(rows, &Rheology::viscosity_friction, "friction", report::kBluishGreen));
  if (!curves.compared.empty())
    chart.curves.push_back(over_strain(curves.compared, &Rheology::viscosity,
                                       "viscous contact alone", report::kReddishPurple, true));
  std::vector<double> values;
  for (const auto& curve : chart.curves)
    for (const auto& [strain, value] : curve.points)
      if (std::isfinite(value)) values.push_back(value);
  if (values.empty()) return chart;
  std::ranges::sort(values);
  const auto cut =
      static_cast<std::size_t>(RheologyChartTuning::kCut * static_cast<double>(values.size()));
  const double top = RheologyChartTuning::kAbove * values[values.size() - 1 - cut];
  if (top > 0) chart.top = top;
  return chart;
}

ChartCurve over_distance(const std::vector<PairDistributionRow>& rows,
                         double PairDistributionRow::*member, const std::string& legend,
                         const char* colour, bool is_dashed = false) {
  ChartCurve curve{legend, colour, is_dashed, {}};
  for (const auto& row : rows) curve.points.emplace_back(row.distance, row.*member);
  return curve;
}

LineChart pair_chart(const SuspensionCurves& curves) {
  LineChart chart{
      "Pairs", "distance of the centres over the sum of the radii", "pair distribution g", {}, {}};
  using Row = PairDistributionRow;
  chart.curves = {over_distance(curves.pairs, &Row::all, "all", report::kBlack),
                  over_distance(curves.pairs, &Row::compression, "compression", report::kVermilion),
                  over_distance(curves.pairs, &Row::extension, "extension", report::kSkyBlue)};
  if (!curves.compared_pairs.empty())
    chart.curves.push_back(over_distance(curves.compared_pairs, &Row::all, "viscous contact alone",
                                         report::kReddishPurple, true));
  double top = 0;
  for (const auto& curve : chart.curves)
    for (const auto& [distance, g] : curve.points) top = std::max(top, g);
  if (top > RheologyChartTuning::kTopOfPairs) chart.top = RheologyChartTuning::kTopOfPairs;
  return chart;
}

}  // namespace

std::string suspension_charts(const ParticlesCase& c, const SuspensionCurves& curves) {
  // Without a box there are no stresses and no density of pairs.
  if (std::holds_alternative<std::monostate>(c.setting.domain)) return "";
  std::vector<LineChart> charts;
  if (curves.rheology.size() > 1) charts.push_back(viscosity_chart(c, curves));
  charts.push_back(pair_chart(curves));
  return line_charts(charts);
}

}  // namespace viscontact::particles
