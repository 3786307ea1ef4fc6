#pragma once
// The only interface to OpenVDB: contouring, writing and reading of frames.
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "geometry/vdb/sampled_distance.h"

namespace seiche::vdb {

// The level set of a frame written by Seiche, as level_set_name() chooses. Outside the frame's domain it is at least
// the distance from the domain. 2D frames ignore z. Throws Error(bad_input) if the file is not such a frame or has
// another dimension.
std::unique_ptr<SampledDistance> read_distance(const std::filesystem::path& file, int dimension = 3);

// The zero contour of values at the nodes lower + i*spacing, 0 <= i < nodes, first axis fastest (3D). Triangles face
// the positive side. The surface is open where the negative side reaches the outermost nodes. Independent of the number
// of threads.
SurfaceMesh contour(const std::vector<float>& values, const std::array<int, 3>& nodes, const Vec3& lower,
                    double spacing);

enum class GridKind { level_set, scalar, staggered_vector };

// Values of the voxels lower <= index < upper, first axis fastest; vectors as x, y, z triples.
struct Block {
  std::array<int, 3> lower{0, 0, 0}, upper{0, 0, 0};
  std::vector<float> values;
};

struct Grid {
  std::string name;
  GridKind kind = GridKind::scalar;
  float background = 0;       // level sets: 3 h; voxels with |value| >= background are inactive
  std::vector<Block> blocks;  // pieces from ranks; disjoint
  bool closed = false;        // level sets: encode() closes them at the sides of the domain
};

// A drop of liquid.
struct Point {
  Vec3 place{0, 0, 0}, velocity{0, 0, 0};  // m, m/s; in 2D in the middle of the layer
  double radius = 0;                       // m; in 2D that of a disc
  std::int64_t id = 0;
};
inline const std::string point_grid_name = "drops";

struct Frame {
  int dimension = 3;    // 2D frames are one voxel thick at k = 0
  Vec3 lower{0, 0, 0};  // low corner of voxel (0,0,0), m
  double cell_size = 0;
  double time = 0, dt = 0;
  int number = 0;
  std::string creator;
  std::vector<Grid> grids;
  std::vector<Point> points;  // by id; a grid of points in the file if there are any
  bool has_drops = false;     // true if liquid may fly as such points
};

inline const std::string velocity_grid = "vel";  // in frames; in files also "velocity"

// "free_surface", the level set as the solver has it, if there is one, else "surface".
std::string level_set_name(const Frame& frame);

// Serialises a frame to the bytes of a .vdb file (Blosc, active mask, statistics metadata, cell-centre transform).
// The domain is the box from voxel 0 to the highest upper of all blocks. Throws Error(cannot_continue) naming grid and
// voxel on a value that is not finite. Points have the attributes P, pscale (radius, m), v (m/s) and id.
// `velocity`: name in the file of the grid velocity_grid.
std::string encode(const Frame& frame, const std::string& velocity = velocity_grid);
// Reads a frame written by encode(), each grid as one dense block over the frame's domain. The velocity is named
// velocity_grid, whatever its name in the file. Throws Error(bad_input).
Frame decode(const std::filesystem::path& file);

}  // namespace seiche::vdb
