#pragma once
// Frames of a run: fields of all ranks, gathered on rank 0 into one OpenVDB file, with solid surfaces and, on request,
// fluid fields for ParaView.
#include <filesystem>
#include <string>
#include <vector>

#include "coupling/state/simulation.h"
#include "files/run_directory.h"
#include "files/vtk.h"
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche {

struct Scene;

struct FrameLabel {
  int number = 0;
  double time = 0, dt = 0;  // s
};

std::string frame_file(const std::string& stem, int number, const std::string& extension);  // "frame.0012.vdb"

// Name of a field in the simulation and the frames for a name of `output.frames` ("velocity" -> "vel"); "" for
// "solids", which is not a field.
std::string field_of_output(const std::string& name);

// "field at cell (i, j, k)" for the first non-finite value, or "".
std::string first_not_finite(const FrameField& field);

class FrameWriter {
 public:
  FrameWriter(const Scene& scene, const RunPaths& paths, const Communicator& ranks);

  // Writes frame `label` with all its files. Collective. Throws on all ranks: Error(output_failed), or
  // Error(cannot_continue) naming field and cell if a value is not finite; then nothing of that frame is written.
  void write(const FrameLabel& label, const Simulation& simulation, PhaseFault fault);

 private:
  vdb::Frame gather(const FrameLabel& label, const Simulation& simulation, PhaseFault fault) const;
  vdb::Grid gather(const FrameLabel& label, FrameField field, PhaseFault fault) const;
  void write_solids(const FrameLabel& label, const Simulation& simulation);
  std::vector<VolumeFrame> elastic_volumes(const FrameLabel& label, const Simulation& simulation) const;
  void write_elastic(const FrameLabel& label, std::vector<VolumeFrame> volumes) const;
  void write_joints(const FrameLabel& label, const Simulation& simulation) const;
  void write_fluid(const vdb::Frame& frame) const;
  bool wants(const std::vector<std::string>& list, const std::string& name) const;

  const Scene& scene_;
  RunPaths paths_;
  const Communicator& ranks_;
  std::vector<SurfaceMesh> surfaces_;  // as last written; reused for solids that never move (rank 0)
};

}  // namespace seiche
