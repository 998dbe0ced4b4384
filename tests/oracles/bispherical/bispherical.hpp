// Exact Stokes drag of a sphere that moves along its line of centres with a second surface of
// revolution: a plane, a shear-free plane, another sphere, a spherical cavity around it.
//
// All of them are one solution, in bispherical coordinates (Stimson & Jeffery 1926, Proc. R. Soc.
// A 111, 110; Brenner 1961, Chem. Eng. Sci. 16, 242; Maude 1961, Br. J. Appl. Phys. 12, 293).
// Drag factors are drag / (6 pi mu r U), dimensionless, r and U radius and velocity of the sphere;
// epsilon = gap / r, the gap being the smallest distance to the second surface. Unless a function
// says otherwise: 1e-6 <= epsilon <= 1e3, relative error below 1e-14.
#pragma once

namespace viscontact {

/// Fixed no-slip plane. Brenner 1961, first problem; Maude 1961.
double bispherical_plane_factor(double epsilon);

/// Flat surface without shear stress that stays flat. Brenner 1961, second problem.
double free_surface_drag_factor(double epsilon);

/// Sphere 1 when sphere 2, of radius radius_ratio * r in [0.01, 100] * r, moves in the same
/// direction at velocity_ratio * U: -F1 / (6 pi mu r U). Stimson & Jeffery 1926 (equal velocities);
/// Maude 1961. The resistance functions of Jeffrey & Onishi 1984 (J. Fluid Mech. 139, 261) are
/// X11A = f(0) and (1 + radius_ratio)/2 X12A = f(1) - f(0), f being this as function of
/// velocity_ratio. The error is below 1e-14 of the larger of |f(0)| and |f| (f has a zero); large
/// spheres next to small ones take long, 0.3 s at the far end of the range.
double two_sphere_drag_factor(double epsilon, double radius_ratio, double velocity_ratio);

/// Fixed spherical cavity of radius cavity_radius_ratio * r in [1.001, 1e6] * r around the sphere;
/// 0 < epsilon <= cavity_radius_ratio - 1, which is concentric. Maude 1961.
double cavity_drag_factor(double epsilon, double cavity_radius_ratio);

/// The same in the middle of the cavity, in closed form, to rounding. Haberman & Sayre 1958 (David
/// Taylor Model Basin report 1143); Happel & Brenner 1983, section 4-22.
double concentric_cavity_drag_factor(double cavity_radius_ratio);

}  // namespace viscontact
