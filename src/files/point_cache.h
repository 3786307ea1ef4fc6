#pragma once
// Deforming surfaces for Blender and other programs: the surface at rest as .obj, and its points in each frame as a PC2
// point cache in the same order (Blender: modifier "Mesh Cache"). Coordinates are the scene's, y up.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "solid/mesh/volume_frame.h"

namespace seiche::point_cache {

// Distinct file names for solids: letters, digits, '-', '_' and '.' stay, other characters become '_'.
std::vector<std::string> stems(const std::vector<std::string>& names);

// Surface of an elastic solid at rest as .obj: triangles in 3D, edges in 2D. `surface` is the present one.
std::string rest_surface(const VolumeFrame& solid, const SurfaceMesh& surface);

// Present positions of the surface's points.
std::vector<Vec3> surface_points(const VolumeFrame& solid);

// Stores the points as the sample of frame `number`: appends them after removing this and later frames, as after a
// resume. A file without the earlier frames is started anew, its header naming the first frame. Throws
// Error(output_failed).
void add_sample(const std::filesystem::path& file, int number, const std::vector<Vec3>& points);

struct Facts {
  int points = 0, samples = 0, first_frame = 0;
};

// Contents of a cache's header; empty if the file is not a cache.
std::optional<Facts> read_facts(const std::filesystem::path& file);

}  // namespace seiche::point_cache
