#pragma once
// Files for ParaView: VTK's XML formats with the numbers base64-coded inline.
#include <array>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "geometry/vdb/openvdb_adapter.h"
#include "solid/mesh/volume_frame.h"

namespace seiche::vtk {

// A .vti with every grid of the frame as cell data over the whole domain; staggered vectors are averaged to cell
// centres (on the last cell of an axis, where the high face is not stored, the low face stands for both).
std::string image(const vdb::Frame& frame, const std::array<int, 3>& cells);

// A .vtu with the surfaces of all solids; the cell array `solid` counts them from 0, the field array `solid_names` has
// their names in that order.
std::string surfaces(const std::vector<SurfaceMesh>& solids, const std::vector<std::string>& names, double time);

// A .vtu with the elements of elastic solids, deformed; point arrays `displacement` (m), `velocity` (m/s) and
// `von_mises` (Pa), the cell array `solid` counts all solids of the scene from 0, the field array `solid_names` has
// their names. Entries without elements are left out.
std::string volumes(const std::vector<VolumeFrame>& solids, const std::vector<std::string>& names, double time);

// A .pvd that names the files <stem>.0000.<extension> to <stem>.<last>.<extension> with their times.
std::string series(const std::string& stem, const std::string& extension, int last, double frame_rate);

std::string base64(const std::string& bytes);

}  // namespace seiche::vtk
