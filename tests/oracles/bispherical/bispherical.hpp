// Exact Stokes drag of a sphere that moves along its line of centres with a second surface of
// revolution: a plane, a shear-free plane, another sphere, a spherical cavity around it.
#pragma once

namespace viscontact {

// One series in bispherical coordinates solves all these problems (Stimson & Jeffery 1926, Proc. R.
// Soc. A 111, 110; Brenner 1961, Chem. Eng. Sci. 16, 242; Maude 1961, Br. J. Appl. Phys. 12, 293).
// All numbers are dimensionless. A drag factor is drag / (6 pi mu r U) with the viscosity mu and
// the radius r and velocity U of the sphere; epsilon = gap / r, where the gap is the smallest
// distance to the second surface. Unless a function says otherwise, 1e-6 <= epsilon <= 1e3, and the
// relative error is below 1e-14.

/// Fixed no-slip plane. Brenner 1961, first problem; Maude 1961.
double bispherical_plane_factor(double epsilon);

/// Flat surface without shear stress that stays flat. Brenner 1961, second problem.
double free_surface_drag_factor(double epsilon);

/// Drag factor of sphere 1, with the radius r and the velocity U, if sphere 2 moves in the same
/// direction at velocity_ratio * U. The radius of sphere 2 is radius_ratio * r, radius_ratio in
/// [0.01, 100]. Stimson & Jeffery 1926 (equal velocities); Maude 1961. If f(velocity_ratio) is this
/// factor, the resistance functions of Jeffrey & Onishi 1984 (J. Fluid Mech. 139, 261) are X11A =
/// f(0) and (1 + radius_ratio)/2 X12A = f(1) - f(0). The error is below 1e-14 of the larger of
/// |f(0)| and |f|, because f has a zero. Large spheres next to small ones take up to 0.3 s.
double two_sphere_drag_factor(double epsilon, double radius_ratio, double velocity_ratio);

/// Fixed spherical cavity of radius cavity_radius_ratio * r around the sphere, cavity_radius_ratio
/// in [1.001, 1e6]; 0 < epsilon <= cavity_radius_ratio - 1, at which both are concentric. Maude
/// 1961.
double cavity_drag_factor(double epsilon, double cavity_radius_ratio);

/// cavity_drag_factor() in the middle of the cavity, in closed form, to rounding errors. Haberman &
/// Sayre 1958 (David Taylor Model Basin report 1143); Happel & Brenner 1983, section 4-22.
double concentric_cavity_drag_factor(double cavity_radius_ratio);

}  // namespace viscontact
