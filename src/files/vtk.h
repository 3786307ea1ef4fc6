#pragma once
// Files for ParaView: VTK's XML formats with inline base64 data.
#include <array>
#include <string>
#include <vector>

#include "coupling/state/simulation.h"
#include "geometry/mesh/mesh.h"
#include "geometry/vdb/openvdb_adapter.h"
#include "solid/mesh/volume_frame.h"

namespace seiche::vtk {

// Values of a grid at the cells of the domain, first axis fastest. Staggered vectors are averaged to cell centres; the
// last cell of an axis uses its low face only, since its high face is not stored.
std::vector<float> cell_values(const vdb::Grid& grid, const std::array<int, 3>& cells, int dimension);

// A .vti with all grids of the frame as cell data over the whole domain.
std::string image(const vdb::Frame& frame, const std::array<int, 3>& cells);

// A .vtu with the surfaces of all solids. The cell array `solid` counts them from 0, the field array `solid_names` has
// their names in that order.
std::string surfaces(const std::vector<SurfaceMesh>& solids, const std::vector<std::string>& names, double time);

// A .vtu with the deformed elements of elastic solids. Point arrays: `displacement` (m), `velocity` (m/s), `von_mises`
// (Pa). The cell array `solid` counts all solids of the scene from 0, the field array `solid_names` has their names.
// Entries without elements are skipped.
std::string volumes(const std::vector<VolumeFrame>& solids, const std::vector<std::string>& names, double time);

// A .vtu with a vertex at each joint. Point arrays: `force` (N), `torque` (N m) on the first solid about that point,
// `coordinate` (rad or m), `broken` (0 or 1). The cell array `joint` counts them from 0, the field array `joint_names`
// has their names in that order.
std::string joints(const std::vector<JointReport>& joints, double time);

// A .vtu with a vertex at each drop. Point arrays: `radius` (m), `velocity` (m/s), `id`. The cell array `drop` is 0.
std::string drops(const std::vector<vdb::Point>& drops, double time);

// A .pvd that lists <stem>.0000.<extension> to <stem>.<last>.<extension> with their times.
std::string series(const std::string& stem, const std::string& extension, int last, double frame_rate);

}  // namespace seiche::vtk
