// Stokes drag of a sphere on the axis of a closed cylinder, which is the geometry of most
// tabulations. Tests compare FreeFEM with it; all numbers are dimensionless.
#pragma once

namespace viscontact {

/// Drag factor lambda = drag / (6 pi mu r |u|) of a sphere of radius r and velocity u that moves
/// along the axis of a no-slip cylinder of radius radius_ratio * r, between a floor and a lid at
/// height_ratio * r, at epsilon = (gap to the floor) / r. 3 <= radius_ratio <= 80, height_ratio =
/// 2 radius_ratio, 1e-4 <= epsilon <= 10. The relative error, estimated from finer approximations,
/// is below 1e-8 if the centre is not above half the height, and below 1e-6 up to one radius above
/// it. In lower containers it is nearly as small; in higher ones it is larger: 5e-4 at height_ratio
/// = 4 radius_ratio. A call takes 1 s at epsilon = 1e-4, and 0.2 s at 1e-3.
///
/// The velocity on side and lid is fitted by least squares with flows that have no slip on floor
/// and sphere: the regular fields of floor_fields.hpp, each with the field in bispherical
/// coordinates (Brenner 1961, Chem. Eng. Sci. 16, 242) that cancels it on the sphere.
double sphere_in_cylinder_drag_factor(double epsilon, double radius_ratio, double height_ratio);

}  // namespace viscontact
