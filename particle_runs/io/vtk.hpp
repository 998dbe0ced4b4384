// Frames, the states of a simulation at the output times, as VTK files for ParaView.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {

/// Content of a VTK XML PolyData file (VTK's file formats, "XML file formats"; inline binary), in
/// the units of the case. Each particle is a point with the arrays radius [L], velocity [L/T], id
/// and, if any particle has a mass > 0, mass [M]. Particles that turn also have an angle [rad] or,
/// in space, an orientation (a unit quaternion w, x, y, z), and an angular_velocity [1/T]. If there
/// are rigid bodies, the array body has for each particle the number of its body, or -1. In two
/// dimensions z = 0; spheres on an axis are on the axis z.
///
/// Each contact of two particles is a line, and each contact with an obstacle is a vertex at the
/// particle. Both have the arrays gap [L], gamma [M L/T] (minus the impulse that the fluid film has
/// absorbed), normal_force [M L/T^2], > 0 if it pushes, i and j, which are the two numbers of
/// ids_of() (a negative one names an obstacle), and, in a periodic domain, image: the number of the
/// periodic image of the second particle, -13 to 13. With `has_friction` they also have friction
/// (0: none, 1: sticks, 2: slides), tangential_force and solid_force [M L/T^2]. Numbers of discs in
/// a fluid are per length. The field data of a cell of a suspension (PeriodicCell::offset or
/// vectors) have the array periods: three vectors [L], 0 along an axis without a period.
std::string write_vtp(const Particles& particles, std::span<const CurrentContact> contacts,
                      bool has_friction = false);

struct VtpContent {
  /// Flat array [L], `dimension` numbers for each particle.
  std::vector<double> positions;
  std::vector<double> radii;   ///< [L]
  std::vector<double> masses;  ///< [M]; empty if the file has none
  std::vector<double> speeds;  ///< [L/T], the lengths of the velocities
  std::vector<std::int32_t> ids;
  // Both are > 0 counter-clockwise, and empty for discs that do not turn and for spheres.
  std::vector<double> angles,  ///< [rad]
      angular_velocities;      ///< [1/T]
  /// Unit quaternions (w, x, y, z) of spheres in space; empty if they do not turn.
  std::vector<double> orientations;
  /// Contacts in the order of contacts_of(): first pairs of particles, then particles at obstacles.
  /// They have the places of particles in `radii`, not their ids. Errors of gamma, normals and
  /// branches, which no picture shows, are not in the file and keep their defaults.
  std::vector<CurrentContact> contacts;
  std::optional<std::array<Vector, 3>> periods{};  ///< of a suspension [L]
};

/// Reads a file that write_vtp() wrote for particles of the dimension 1, 2 or 3 on a machine with
/// the same byte order. Throws Error(kBadInput), which names the file, if it cannot be read, is not
/// such a file, was cut short, or if lengths of its arrays or numbers of particles, images or kinds
/// of friction do not fit. Positions, radii and forces may have any value.
VtpContent read_vtp(const std::filesystem::path& path, int dimension);

/// The beginning of a PVD file, ParaView's list of frames. A pvd_line() for each frame and kPvdFoot
/// follow.
inline constexpr const char* kPvdHead =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
    "byte_order=\"LittleEndian\">\n<Collection>\n";
inline constexpr const char* kPvdFoot = "</Collection>\n</VTKFile>\n";
std::string pvd_line(double time, const std::string& file);  ///< of a frame at `time` [T]

/// Times [T] and names of the files of all frames, in the order of the PVD file. The files may be
/// missing. Throws Error(kBadInput), which names the PVD file, if it cannot be read or does not
/// consist of kPvdHead, lines of pvd_line() and kPvdFoot.
std::vector<std::pair<double, std::string>> read_pvd(const std::filesystem::path& path);

}  // namespace viscontact::particles
