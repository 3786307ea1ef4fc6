#pragma once
// Deforming surfaces for Blender and other programs: the surface at rest as .obj and its points in each frame as a PC2
// point cache in the same order (Blender: modifier "Mesh Cache"). Coordinates are those of the scene, y up.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "solid/mesh/volume_frame.h"

namespace seiche::point_cache {

// Names of solids as names of files, each different: letters, digits, '-', '_' and '.' stay, the rest becomes '_'.
std::vector<std::string> stems(const std::vector<std::string>& names);

// The surface of an elastic solid at rest: triangles in 3D, edges in 2D. `surface` is that of the present time.
std::string rest_surface(const VolumeFrame& solid, const SurfaceMesh& surface);

// Where the points of its surface are now.
std::vector<Vec3> surface_points(const VolumeFrame& solid);

// Makes the points the sample of frame `number`: appended, whatever the file has of this and later frames being cut
// off, as after a resume. A file that lacks earlier frames is begun anew, its header naming the first frame it holds.
// Throws Error(output_failed).
void add_sample(const std::filesystem::path& file, int number, const std::vector<Vec3>& points);

struct Facts {
  int points = 0, samples = 0, first_frame = 0;
};

// What the header of a cache says; nothing if it is none.
std::optional<Facts> read_facts(const std::filesystem::path& file);

}  // namespace seiche::point_cache
