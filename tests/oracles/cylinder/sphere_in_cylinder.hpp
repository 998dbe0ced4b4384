// Stokes drag of a sphere on the axis of a closed cylinder, the setting of the tabulation itself.
#pragma once

namespace viscontact {

/// lambda = drag / (6 pi mu r |u|) of a sphere that moves along the axis of a no-slip cylinder of
/// radius radius_ratio * r between a floor and a lid at height_ratio * r, at epsilon = gap to the
/// floor / r. 3 <= radius_ratio <= 80, height_ratio = 2 radius_ratio, 1e-4 <= epsilon <= 10. The
/// relative error, as finer approximations show it, is below 1e-8 while the centre is not above
/// half the height, and below 1e-6 to one radius above. Lower containers do nearly as well, higher
/// ones do not: 5e-4 at height_ratio = 4 radius_ratio. Takes 1 s at epsilon = 1e-4, 0.2 s at 1e-3.
///
/// Least squares on side and lid, with flows that have no slip on floor and sphere: the regular
/// fields of floor_fields.hpp, each with the field in bispherical coordinates (Brenner 1961, Chem.
/// Eng. Sci. 16, 242) that cancels it on the sphere.
double sphere_in_cylinder_drag_factor(double epsilon, double radius_ratio, double height_ratio);

}  // namespace viscontact
