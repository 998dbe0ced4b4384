// The frames of a simulation of many particles: files for ParaView, and the playback that the page
// and the picture show. Lengths, masses and times are in any one consistent system of units.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particles/fluid/fluid_solver.hpp"
#include "viscontact/particles/impacts/rebound.hpp"
#include "viscontact/particles/io/link_file.hpp"
#include "viscontact/particles/io/particle_file.hpp"
#include "viscontact/particles/io/playback.hpp"
#include "viscontact/particles/simulation.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::particles {

/// The times of frames: multiples of an interval after the first time. A frame is written after the
/// first step that reaches such a time.
struct FrameTimes {
  double first = 0;     ///< time of the first frame [T]
  double interval = 0;  ///< [T], at least a time step
  double tiny = 0;      ///< times that differ by less than this count as equal [T], > 0

  /// The time of the frame after the one at `time` [T].
  double after(double time) const;
};

/// The time of a frame [T] and the name of its file.
using FrameFile = std::pair<double, std::string>;

/// The name of the file of the flow of the frame in the file `frame`, particles_NNNNN.vtp:
/// flow_NNNNN.vtu.
std::string flow_name(const std::string& frame);
/// The name of the file of the links of that frame: links_NNNNN.vtp.
std::string links_name(const std::string& frame);

/// Writes frames to files, and keeps those that the page and the picture draw. The memory for the
/// kept frames is bounded: if there are too many, every second of them is dropped.
class ParticleFrames {
 public:
  /// `provenance` must outlive this object.
  ParticleFrames(std::filesystem::path folder, const results::Provenance& provenance,
                 const Setting& setting, const Particles& particles);

  /// Writes a frame of the state. tables() and, with a fluid, motion() and contacts() get its rows.
  /// `link_force_errors` are those of State::link_forces, empty if they are not known.
  void add(const Setting& setting, const State& state, std::span<const double> link_force_errors);

  /// Adds rows to the table of rebounds. Rows beyond a million, which are about 80 MB, are dropped.
  void add_rebounds(const Particles& particles, std::span<const Rebound> rebounds);

  /// True if the flow of the last frame has not been written. The flow around the particles of a
  /// frame is known only in the next step.
  bool lacks_flow(const Setting& setting) const {
    return setting.fluid.has_value() && flows_.size() < files_.size();
  }
  /// Writes the flow of the last frame.
  void add_flow(const particles::FlowField& flow);

  /// Reads the frames that an interrupted run has written until `time` [T], so that they are not
  /// written again.
  /// Throws Error(kBadInput), which names the file, if a frame cannot be read or has other
  /// particles.
  void resume(const std::vector<FrameFile>& files, const Setting& setting, double time);

  /// Reads all frames, and the places of all flows, that a run has written, for its page and
  /// picture. Throws as resume() does.
  void read_all(const Setting& setting);

  /// Adds a frame of the last state, unless the last frame shows it. Does nothing if no frame was
  /// written.
  void end(const Setting& setting, const State& state, std::span<const double> link_force_errors);

  const Playback& playback() const { return playback_; }
  const std::vector<FrameFile>& files() const { return files_; }
  /// The files of flows, in the order of their frames; empty without a fluid.
  const std::vector<FrameFile>& flows() const { return flows_; }
  /// The files of links, in the order of their frames; empty without links.
  std::vector<FrameFile> links() const;
  /// The text of motion.csv; empty without a fluid.
  const std::string& motion() const { return motion_; }
  /// The text of contacts.csv; empty without a fluid.
  const std::string& contacts() const { return contacts_; }
  /// Names and texts of the tables of bodies, links and rebounds that the case has.
  std::vector<std::pair<std::string, std::string>> tables() const;

 private:
  void keep(Frame frame);
  void read_frame(const FrameFile& file, const Setting& setting, bool is_last);
  void add_contact_rows(double time, const std::vector<CurrentContact>& contacts);
  void show_flow(const FrameFile& flow);
  void resume_fluid(double time);
  static std::string rows_until(const std::filesystem::path& table, double time);
  std::string earlier_rows(const std::string& name, std::size_t rows_per_frame) const;

  std::filesystem::path folder_;
  const results::Provenance& provenance_;
  bool has_links_, has_rebounds_;
  Playback playback_;
  std::vector<FrameFile> files_, flows_;
  std::string motion_, contacts_, rebounds_;
  std::size_t rebound_count_ = 0;  // rows in rebounds_
  std::vector<TimeTable> tables_;
  std::vector<std::string> table_rows_;  // of tables_, without headers
  std::size_t every_ = 1, kept_bytes_ = 0;
};

/// The frames that particles.pvd (written by write_pvd) lists up to `time` [T]. Later frames are
/// left out, and so is a frame that was written only because the run was interrupted. Throws
/// Error(kBadInput), which names the file, if it cannot be read or lists no frame.
std::vector<FrameFile> frames_until(const std::filesystem::path& pvd, double time,
                                    const FrameTimes& times);

}  // namespace viscontact::particles
