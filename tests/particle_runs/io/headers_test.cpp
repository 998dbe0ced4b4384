// The names of columns in files are a contract with users: here are those of all files.
#include <gmock/gmock.h>

#include <map>
#include <string>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/particle_runs/io/contact_file.hpp"
#include "viscontact/particle_runs/io/link_file.hpp"
#include "viscontact/particle_runs/io/particle_file.hpp"
#include "viscontact/particle_runs/io/step_columns.hpp"

namespace viscontact::particles {
namespace {

/// The line of names of a table without rows that begins with "# rows: 0".
std::string header_of(const std::string& table) { return table.substr(table.find('\n') + 1); }

std::map<std::string, std::string> headers_of(const std::vector<TimeTable>& tables) {
  std::map<std::string, std::string> headers;
  for (const auto& table : tables) headers[table.name] = table.header;
  return headers;
}

TEST(Headers, OfFinalContacts) {
  const auto of = [](int dimension, bool has_friction) {
    return header_of(write_contacts(no_particles(dimension).particles, {}, has_friction));
  };
  EXPECT_EQ(of(1, false), "i,j,gap,gamma,gamma_error,normal_force\n");
  EXPECT_EQ(of(2, false),
            "i,j,gap,gamma,gamma_error,normal_force,tangential_force_x,tangential_force_y\n");
  EXPECT_EQ(of(3, true),
            "i,j,gap,gamma,gamma_error,normal_force,tangential_force_x,tangential_force_y,"
            "tangential_force_z,solid_force\n");
}

TEST(Headers, OfFinalParticles) {
  const auto of = [](int dimension, bool turn, const std::optional<FluidForces>& forces = {},
                     std::span<const GivenParticleLoad> loads = {}, bool is_ellipse = false) {
    State state = no_particles(dimension);
    add_particle(state, {}, 1, 1);
    if (turn) add_rotation(state.particles);
    if (is_ellipse) state.particles.shapes = {Shape::ellipse(1, 0.5)};
    const auto text = header_of(write_particles(state.particles, forces, loads));
    return text.substr(0, text.find('\n'));
  };
  EXPECT_EQ(of(2, false), "id,x,y,vx,vy,radius,mass");
  EXPECT_EQ(of(2, true), "id,x,y,vx,vy,radius,mass,angle,angular_velocity");
  EXPECT_EQ(of(3, false), "id,x,y,z,vx,vy,vz,radius,mass");
  EXPECT_EQ(of(3, true),
            "id,x,y,z,vx,vy,vz,radius,mass,angular_velocity_x,angular_velocity_y,"
            "angular_velocity_z");
  const std::string of_discs =
      "id,x,y,vx,vy,radius,mass,angle,angular_velocity,fluid_force_x,fluid_force_y,fluid_torque,"
      "fluid_force_error_estimate,fluid_torque_error_estimate";
  EXPECT_EQ(of(2, true, FluidForces{}), of_discs);
  EXPECT_EQ(of(2, true, FluidForces{}, {}, true), of_discs + ",semi_axis_1,semi_axis_2");
  EXPECT_EQ(of(1, false, FluidForces{}),
            "id,z,vz,radius,mass,fluid_force_z,fluid_force_error_estimate");
  const std::vector<GivenParticleLoad> loads = {{0, {}, {}}};
  EXPECT_EQ(of(2, true, {}, loads),
            "id,x,y,vx,vy,radius,mass,angle,angular_velocity,contact_force_x,contact_force_y,"
            "contact_torque");
  EXPECT_EQ(of(3, true, {}, loads),
            "id,x,y,z,vx,vy,vz,radius,mass,angular_velocity_x,angular_velocity_y,"
            "angular_velocity_z,contact_force_x,contact_force_y,contact_force_z,contact_torque_x,"
            "contact_torque_y,contact_torque_z");
}

TEST(Headers, OfMotions) {
  EXPECT_EQ(motion_header(1, false), "time,id,z,vz\n");
  EXPECT_EQ(motion_header(2, false), "time,id,x,y,vx,vy\n");
  EXPECT_EQ(motion_header(2, true), "time,id,x,y,angle,vx,vy,angular_velocity\n");
  EXPECT_EQ(motion_header(2, true, true),
            "time,id,x,y,angle,vx,vy,angular_velocity,contact_force_x,contact_force_y,"
            "contact_torque\n");
  EXPECT_EQ(motion_header(3, false), "time,id,x,y,z,vx,vy,vz\n");
  EXPECT_EQ(motion_header(3, true),
            "time,id,x,y,z,vx,vy,vz,angular_velocity_x,angular_velocity_y,angular_velocity_z\n");
}

TEST(Headers, OfTablesOfContacts) {
  const std::vector<std::string> names = {"contacts", "walls", "stress"};
  const auto of = [&](int dimension, bool has_friction) {
    Setting setting;
    setting.planes.resize(1);
    setting.planes[0].load.emplace();
    if (has_friction) setting.laws.friction = FrictionLaw{0.3};
    return headers_of(asked_tables(setting, no_particles(dimension).particles, names));
  };
  auto headers = of(2, false);
  EXPECT_EQ(headers["contacts.csv"],
            "time,i,j,gap,gamma,normal_force,tangential_force_x,tangential_force_y\n");
  EXPECT_EQ(headers["walls.csv"],
            "time,wall,force_x,force_y,point_x,point_y,velocity_x,velocity_y\n");
  EXPECT_EQ(headers["stress.csv"], "time,stress_xx,stress_xy,stress_yx,stress_yy\n");
  EXPECT_EQ(headers["planes.csv"], "time,wall,displacement,velocity,load,contact_force\n");
  headers = of(3, true);
  EXPECT_EQ(headers["contacts.csv"],
            "time,i,j,gap,gamma,normal_force,tangential_force_x,tangential_force_y,"
            "tangential_force_z,solid_force\n");
  EXPECT_EQ(headers["stress.csv"],
            "time,stress_xx,stress_xy,stress_xz,stress_yx,stress_yy,stress_yz,stress_zx,stress_zy,"
            "stress_zz\n");
  headers = of(1, false);
  EXPECT_EQ(headers["contacts.csv"], "time,i,j,gap,gamma,normal_force\n");
  EXPECT_EQ(headers["walls.csv"], "time,wall,force_z,point_z,velocity_z\n");
  EXPECT_EQ(headers["stress.csv"], "time,stress_zz\n");
  EXPECT_EQ(rebounds_header(), "time,first,second,approach_velocity,solid_impulse,velocity\n");
}

TEST(Headers, OfBodiesAndLinks) {
  const auto of = [](int dimension, bool in_fluid) {
    Setting setting;
    if (in_fluid) setting.fluid.emplace();
    auto particles = no_particles(dimension).particles;
    particles.bodies.bodies.resize(1);
    setting.links.hinges.resize(1);
    setting.links.springs.resize(1);
    setting.links.arms.resize(1);
    if (in_fluid)
      setting.fluid->membranes.resize(1);
    else
      setting.links.membranes.resize(1);
    return headers_of(time_tables(setting, particles));
  };
  for (const bool in_fluid : {false, true}) {
    const std::string error = in_fluid ? ",force_error_estimate" : "";
    auto headers = of(2, in_fluid);
    EXPECT_EQ(headers["bodies.csv"], "time,id,x,y,angle,vx,vy,angular_velocity\n");
    EXPECT_EQ(headers["hinges.csv"], "time,id,force_x,force_y,torque" + error +
                                         (in_fluid ? ",torque_error_estimate" : "") +
                                         ",angle,angular_velocity\n");
    EXPECT_EQ(headers["springs.csv"], "time,id,length,force" + error + "\n");
    EXPECT_EQ(headers["arms.csv"], "time,id,length,force,power" + error + "\n");
    EXPECT_EQ(headers["membranes.csv"],
              "time,id,x,y,inclination,area,perimeter,membrane_speed,tank_treading_frequency\n");
  }
  auto headers = of(3, false);
  EXPECT_EQ(headers["bodies.csv"],
            "time,id,x,y,z,vx,vy,vz,orientation_w,orientation_x,orientation_y,orientation_z,"
            "angular_velocity_x,angular_velocity_y,angular_velocity_z\n");
  EXPECT_EQ(headers["hinges.csv"], "time,id,force_x,force_y,force_z\n");
}

TEST(Headers, OfSteps) {
  const std::string dry =
      "step,time,contacts,glued,iterations,residual,largest_overlap,converged,impulse_residual,"
      "parts,unresolved";
  EXPECT_EQ(steps_header({}), dry + "\n");
  Fluid fluid;
  EXPECT_EQ(steps_header(fluid), dry + ",dissipation,apparent_viscosity,fluid_seconds\n");
  fluid.density = 1;
  EXPECT_EQ(steps_header(fluid),
            dry +
                ",dissipation,apparent_viscosity,fluid_seconds,kinetic_energy_fluid,"
                "reynolds_number,courant_number,given_force_x,given_force_y\n");
  EXPECT_EQ(probes_header(), "time,name,flow,pressure\n");
}

}  // namespace
}  // namespace viscontact::particles
