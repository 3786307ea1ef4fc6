#pragma once
// A run as one XDMF file for ParaView, with its arrays in one HDF5 file beside it.
#include <filesystem>
#include <string>
#include <vector>

#include "files/hdf5_adapter.h"
#include "files/solid_mesh.h"
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche::exporting {

// Values of cells as the mean at each node of the cells around it; `width` floats a cell. A layer of 2D has one layer
// of nodes.
std::vector<float> node_values(const std::vector<float>& cells_values, const std::array<int, 3>& cells, int dimension,
                               int width);

class XdmfWriter {
 public:
  // Files <stem>.xdmf and <stem>.h5. All throw Error(output_failed).
  explicit XdmfWriter(const std::filesystem::path& stem);

  // The fields of the frame as data of cells and of nodes, and the solids' surfaces; may be empty.
  void add_frame(const vdb::Frame& frame, const render::SolidMesh& solids);
  void finish();

 private:
  // Topology and geometry of the grid. 2D is a mesh of quadrilaterals, stored once: on layers of one cell, ParaView's
  // older reader fails, and grids of two axes lie in the plane of y and z.
  std::string lattice(const vdb::Frame& frame, const std::array<int, 3>& cells);
  std::string fluid(const vdb::Frame& frame, const std::string& group);
  std::string surfaces(const render::SolidMesh& solids, const std::string& group);
  std::string item(const std::string& name, const std::vector<std::uint64_t>& extents, const char* type) const;
  template <class T>
  std::string store(const std::string& name, const std::vector<std::uint64_t>& extents, const std::vector<T>& values);

  std::filesystem::path stem_;
  Hdf5Writer arrays_;
  std::string plane_, fluid_, solids_;  // of the .xdmf: the grid of a 2D run; grids of all frames
};

}  // namespace seiche::exporting
