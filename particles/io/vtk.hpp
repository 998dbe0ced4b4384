// Writes and reads frames, the states of a simulation at the output times, as VTK files for
// ParaView. Lengths, masses and times are in the units of the case. Writing throws nothing. run/
// uses this file: it writes the frames, and it reads them again when a run is continued or when its
// HTML pages are made. A change must keep the names of the arrays, and that read_vtp() and
// read_pvd() can read all files that were written before.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particles/current_contacts.hpp"

namespace viscontact::particles {

/// Content of a VTK XML PolyData file (VTK's file formats, "XML file formats"; inline binary).
/// Each particle is a point with the arrays radius [L], velocity [L/T], id and, if any particle has
/// a mass > 0, mass [M]. Particles that turn also have an angle [rad] or, in space, an orientation
/// (a unit quaternion w, x, y, z), and an angular_velocity [1/T]. If there are rigid bodies, the
/// array body has for each particle the number of its body, or -1. In two dimensions z = 0; spheres
/// on an axis are on the axis z.
///
/// Each contact of two particles is a line, and each contact with an obstacle is a vertex at the
/// particle. Both have the arrays gap [L], gamma [M L/T] (minus the impulse that the fluid film has
/// absorbed), normal_force [M L/T^2], i and j, which are the two numbers of ids_of() (a negative
/// one names an obstacle), and, in a periodic domain, image: the number of the periodic image of
/// the second particle, -13 to 13. With `has_friction` they also have friction (0: none, 1: sticks,
/// 2: slides) and tangential_force [M L/T^2]. Numbers of discs in a fluid are per length.
std::string write_vtp(const Particles& particles, std::span<const CurrentContact> contacts,
                      bool has_friction = false);

/// What read_vtp() reads from the file of a frame.
struct VtpContent {
  /// Flat array [L], `dimension` numbers for each particle.
  std::vector<double> positions;
  std::vector<double> radii;      ///< radius of each particle [L]
  std::vector<double> masses;     ///< mass of each particle [M]; empty if the file has none
  std::vector<double> speeds;     ///< speed of each particle [L/T], >= 0
  std::vector<std::int32_t> ids;  ///< id of each particle; empty if the file has none
  // Both are > 0 counter-clockwise, and empty for discs that do not turn and for spheres.
  std::vector<double> angles,  ///< angle of each disc [rad]
      angular_velocities;      ///< angular velocity of each disc [1/T]
  /// Unit quaternions (w, x, y, z) of spheres in space; empty if they do not turn.
  std::vector<double> orientations;
  /// Contacts in the order of contacts_of(): first pairs of particles, then particles at obstacles.
  /// They have the places of particles in `radii`, not their ids. Errors of gamma, normals and
  /// branches are not in the file, and these members keep their defaults.
  std::vector<CurrentContact> contacts;
};

/// Reads a file that write_vtp() wrote for particles of the dimension 1, 2 or 3 (not checked) on a
/// machine with the same byte order. Throws Error(kBadInput), which names the file, if it cannot be
/// read, is not such a file, was cut short, or if lengths of its arrays or numbers of particles,
/// images or kinds of friction do not fit. Values of positions, radii and forces are not checked.
VtpContent read_vtp(const std::filesystem::path& path, int dimension);

/// The beginning of a PVD file, which lists frames for ParaView. A pvd_line() for each frame
/// follows, and kPvdFoot ends the file.
inline constexpr const char* kPvdHead =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
    "byte_order=\"LittleEndian\">\n<Collection>\n";
/// The end of a PVD file.
inline constexpr const char* kPvdFoot = "</Collection>\n</VTKFile>\n";
std::string pvd_line(double time, const std::string& file);  ///< the line of a frame at `time` [T]

/// Times [T] and names of the files of all frames, in the order of a PVD file that consists of
/// kPvdHead, lines of pvd_line() and kPvdFoot. Throws Error(kBadInput), which names the file, if it
/// cannot be read or is not such a file. Whether the files of the frames exist is not checked.
std::vector<std::pair<double, std::string>> read_pvd(const std::filesystem::path& path);

}  // namespace viscontact::particles
