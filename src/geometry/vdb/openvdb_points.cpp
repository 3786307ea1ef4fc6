#include "geometry/vdb/openvdb_points.h"

#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>

#include <algorithm>
#include <cmath>

#include "geometry/vdb/frame_checks.h"
#include "grid/serial.h"

namespace seiche::vdb {
namespace {

namespace points = openvdb::points;
using openvdb::tools::PointIndexGrid;

// Names that Houdini gives a radius, a velocity and a number of a particle.
constexpr const char *radius_name = "pscale", *velocity_name = "v", *id_name = "id";

template <class T>
void add_attribute(points::PointDataGrid& grid, const PointIndexGrid& index, const char* name,
                   const std::vector<T>& values) {
  points::appendAttribute<T>(grid.tree(), name);
  points::populateAttribute(grid.tree(), index.tree(), name, points::PointAttributeVector<T>(values));
}

// Centre of voxel 0, m.
Vec3 first_voxel(const Frame& frame) {
  return frame.lower + Vec3::Constant(frame.cell_size / 2);
}

points::PointDataGrid::Ptr make_grid(const Frame& frame, const openvdb::math::Transform& transform) {
  std::vector<openvdb::Vec3d> places;
  std::vector<float> radii;
  std::vector<openvdb::Vec3f> velocities;
  std::vector<std::int64_t> ids;
  for (const Point& p : frame.points) {
    const Vec3 voxel = (p.place - first_voxel(frame)) / frame.cell_size;
    places.push_back(transform.indexToWorld(openvdb::Vec3d(voxel[0], voxel[1], voxel[2])));
    radii.push_back(float(p.radius));
    velocities.emplace_back(float(p.velocity[0]), float(p.velocity[1]), float(p.velocity[2]));
    ids.push_back(p.id);
  }
  const points::PointAttributeVector<openvdb::Vec3d> wrapped(places);
  const auto index = openvdb::tools::createPointIndexGrid<PointIndexGrid>(wrapped, transform);
  auto grid = points::createPointDataGrid<points::NullCodec, points::PointDataGrid>(*index, wrapped, transform);
  add_attribute(*grid, *index, radius_name, radii);
  add_attribute(*grid, *index, velocity_name, velocities);
  add_attribute(*grid, *index, id_name, ids);
  return grid;
}

template <class Leaf>
void read_leaf(const Frame& frame, const Leaf& leaf, std::vector<Point>& to) {
  const points::AttributeHandle<openvdb::Vec3f> places(leaf.constAttributeArray("P"));
  const points::AttributeHandle<float> radii(leaf.constAttributeArray(radius_name));
  const points::AttributeHandle<openvdb::Vec3f> velocities(leaf.constAttributeArray(velocity_name));
  const points::AttributeHandle<std::int64_t> ids(leaf.constAttributeArray(id_name));
  for (auto i = leaf.beginIndexOn(); i; ++i) {
    const openvdb::Vec3d voxel = i.getCoord().asVec3d() + openvdb::Vec3d(places.get(*i));
    const openvdb::Vec3f v = velocities.get(*i);
    const Vec3 place = first_voxel(frame) + frame.cell_size * Vec3(voxel[0], voxel[1], voxel[2]);
    to.push_back({place, Vec3(v[0], v[1], v[2]), radii.get(*i), ids.get(*i)});
  }
}

bool has_attributes(const points::PointDataGrid& grid) {
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf)
    for (const char* name : {"P", radius_name, velocity_name, id_name})
      if (!leaf->hasAttribute(name)) return false;
  return true;
}

}  // namespace

openvdb::GridBase::Ptr point_grid(const Frame& frame, const openvdb::math::Transform::Ptr& transform) {
  points::PointDataGrid::Ptr grid;
  run_serially([&] { grid = make_grid(frame, *transform); });
  grid->setName(point_grid_name);
  return grid;
}

bool holds_points(const openvdb::GridBase& grid) {
  return grid.isType<points::PointDataGrid>();
}

std::vector<Point> read_points(const std::filesystem::path& file, const Frame& frame, const openvdb::GridBase& grid) {
  const auto& data = static_cast<const points::PointDataGrid&>(grid);
  if (!has_attributes(data)) refuse(file, "grid '" + grid.getName() + "' lacks a value of points that Seiche writes");
  std::vector<Point> all;
  for (auto leaf = data.tree().cbeginLeaf(); leaf; ++leaf) read_leaf(frame, *leaf, all);
  for (const Point& p : all)
    if (!p.place.allFinite() || !p.velocity.allFinite() || !std::isfinite(p.radius))
      refuse(file, "grid '" + grid.getName() + "' holds a value that is not a number");
  std::sort(all.begin(), all.end(), [](const Point& a, const Point& b) { return a.id < b.id; });
  return all;
}

}  // namespace seiche::vdb
