#pragma once
// Meshes of one topology that follow each other in time.
#include <vector>

#include "base/shape_spec.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/shapes.h"

namespace seiche {

struct SequenceSpec;

// The way of the points from one mesh to the next, a cubic in time.
class MeshPassage {
 public:
  MeshPassage(const std::vector<Vec3>& from, std::vector<Vec3> slopes, const std::vector<Vec3>& to,
              std::vector<Vec3> next_slopes)
      : from_(from), to_(to), slopes_(std::move(slopes)), next_slopes_(std::move(next_slopes)) {}
  // Places at a share of the way, 0 to 1.
  std::vector<Vec3> at(double share) const;

 private:
  const std::vector<Vec3>&from_, &to_;
  std::vector<Vec3> slopes_, next_slopes_;  // m a mesh
};

class MeshSequence {
 public:
  // Reads and checks all meshes, transformed as the shape. Throws Error(bad_input) naming shape.where and the file:
  // it is no closed mesh (2D: outline), has other facets than the first, or the surface crosses itself on the way to
  // the next.
  MeshSequence(int dimension, const ShapeSpec& shape, const SequenceSpec& spec, const ShapeOptions& options);

  const SurfaceMesh& first() const { return first_; }
  int count() const { return int(points_.size()); }
  bool loops() const { return loops_; }
  const std::vector<Vec3>& points_of(int mesh) const { return points_[std::size_t(mesh)]; }
  // Time of a mesh, counted from 0, or between two, s.
  double time_of(double mesh) const { return start_ + mesh / rate_; }
  // Places of the points at time t, m: a cubic spline in time through the meshes, so velocities and accelerations have
  // no jumps. Without a loop the points rest before the first mesh and after the last.
  std::vector<Vec3> points_at(double t) const;
  // Between a mesh and the next one. The sequence must outlive it.
  MeshPassage passage_after(int mesh) const;

 private:
  int index(int k) const;
  std::vector<Vec3> slopes_at(int k) const;

  SurfaceMesh first_;
  std::vector<std::vector<Vec3>> points_;  // of each mesh, m
  double rate_, start_;
  bool loops_;
};

}  // namespace seiche
