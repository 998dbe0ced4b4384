// Views of the flow and the curves in them, in the half-plane (rho, z) [L] and its mirror image.
#pragma once

#include <string>
#include <vector>

#include "viscontact/report/flow/triangle_fields.hpp"
#include "viscontact/report/pictures/gnuplot.hpp"

namespace viscontact::report {

/// The part of the half-plane that a picture shows, and its size in the picture.
struct PlotView {
  Window window;
  double plot_width = 0, plot_height = 0;  // [pixels]
  /// How many times larger heights are drawn than widths.
  double stretch() const { return plot_height / window.height() / (plot_width / window.width()); }
};

/// A view of the sphere and the fluid around it: the whole fluid if it extends at most 6 radii from
/// the axis and is at most 12 radii high, otherwise the fluid within 3.2 radii of the sphere's
/// centre.
PlotView surroundings(const freefem_axi::CurvedMesh& mesh, double radius, double gap);

/// Half the width of the view of a gap, in units of sqrt(2 gap radius). At one such unit from the
/// axis, the film over a plane is twice as thick as on the axis; at this end it is about 7 times as
/// thick.
inline constexpr double kGapReach = 2.5;

PlotView gap_view(const freefem_axi::CurvedMesh& mesh, double radius, double gap,
                  double reach = kGapReach);

/// The lines in rho >= 0 and their mirror images, as one curve with interruptions.
Curve mirrored(const std::string& legend, const std::string& style,
               const std::vector<Polyline>& lines);

/// The sides of the triangles near the window, each divided into `pieces` straight pieces.
std::vector<Polyline> sides(const freefem_axi::CurvedMesh& mesh, const Window& window, int pieces);

/// The sphere as a filled surface, and the walls and the neighbour as lines.
std::vector<Curve> outlines(const freefem_axi::CurvedMesh& mesh, const PlotView& view,
                            double radius, double gap);

/// Streamlines at equal steps of the stream function.
Curve streamlines(const freefem_axi::Flow& flow, const PlotView& view);

}  // namespace viscontact::report
