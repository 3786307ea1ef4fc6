// With openvdb_points.cpp the only file that includes OpenVDB.
#include "geometry/vdb/openvdb_adapter.h"

#include <fmt/format.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <cmath>
#include <ios>
#include <new>
#include <sstream>

#include "base/error.h"
#include "geometry/mesh/formats.h"
#include "geometry/vdb/closing.h"
#include "geometry/vdb/frame_checks.h"
#include "geometry/vdb/frame_header.h"
#include "geometry/vdb/openvdb_points.h"
#include "geometry/vdb/sampled_distance.h"
#include "grid/serial.h"

namespace seiche::vdb {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using openvdb::Vec3SGrid;

void initialize() {
  static const bool once = (openvdb::initialize(), true);
  (void)once;
}

// Trilinear interpolation of a grid with voxel i at origin + i * spacing. Values are limited to +-band.
class GridDistance : public SampledDistance {
 public:
  GridDistance(FloatGrid::ConstPtr grid, const Vec3& origin, double spacing, double band)
      : grid_(std::move(grid)), accessor_(grid_->getConstAccessor()), origin_(origin), spacing_(spacing), band_(band) {}

  double operator()(const Vec3& x) const override {
    const Vec3 index = (x - origin_) / spacing_;
    if (index.cwiseAbs().maxCoeff() > 1e9) return band_;
    const Vec3 floor = index.array().floor();
    const Vec3 t = index - floor;
    const Coord base{int(floor[0]), int(floor[1]), int(floor[2])};
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Coord step{corner & 1, (corner >> 1) & 1, corner >> 2};
      double weight = 1;
      for (int a = 0; a < 3; ++a) weight *= step[a] ? t[a] : 1 - t[a];
      if (weight > 0) sum += weight * std::clamp(double(accessor_.getValue(base + step)), -band_, band_);
    }
    return sum;
  }

 private:
  FloatGrid::ConstPtr grid_;
  FloatGrid::ConstAccessor accessor_;
  Vec3 origin_;
  double spacing_, band_;
};

// Calls visit(voxel, values) for each voxel of a block, in its order.
template <class Visit>
void for_each_voxel(const Block& block, int width, Visit&& visit) {
  const float* value = block.values.data();
  Coord ijk;
  for (ijk[2] = block.lower[2]; ijk[2] < block.upper[2]; ++ijk[2]) {
    for (ijk[1] = block.lower[1]; ijk[1] < block.upper[1]; ++ijk[1]) {
      for (ijk[0] = block.lower[0]; ijk[0] < block.upper[0]; ++ijk[0], value += width) visit(ijk, value);
    }
  }
}

// Voxels beyond the band become inactive with the value +-background. Every voxel of the domain gets its sign
// explicitly. A flood fill from the active voxels could leak out of the domain or, in 2D, out of its layer.
FloatGrid::Ptr level_set_grid(const Frame& frame, const Grid& grid) {
  const float band = grid.background;
  FloatGrid::Ptr result = FloatGrid::create(band);
  FloatGrid::Accessor accessor = result->getAccessor();
  for (const Block& block : grid.blocks) {
    for_each_voxel(grid.closed ? closed_at_sides(block, domain_cells(frame), frame.dimension, frame.cell_size) : block,
                   1, [&](const Coord& ijk, const float* value) {
                     if (std::abs(*value) < band) {
                       accessor.setValueOn(ijk, *value);
                     } else if (*value < 0) {
                       accessor.setValueOff(ijk, -band);
                     }
                   });
  }
  result->setGridClass(openvdb::GRID_LEVEL_SET);
  openvdb::tools::prune(result->tree());
  return result;
}

FloatGrid::Ptr scalar_grid(const Grid& grid) {
  FloatGrid::Ptr result = FloatGrid::create(grid.background);
  auto accessor = result->getAccessor();
  for (const Block& block : grid.blocks) {
    for_each_voxel(block, 1, [&](const Coord& ijk, const float* value) {
      if (*value != grid.background) accessor.setValueOn(ijk, *value);
    });
  }
  result->setGridClass(openvdb::GRID_UNKNOWN);
  return result;
}

Vec3SGrid::Ptr staggered_grid(const Grid& grid) {
  Vec3SGrid::Ptr result = Vec3SGrid::create(openvdb::Vec3s(0));
  Vec3SGrid::Accessor accessor = result->getAccessor();
  for (const Block& block : grid.blocks) {
    for_each_voxel(block, 3, [&](const Coord& ijk, const float* value) {
      const openvdb::Vec3s v(value[0], value[1], value[2]);
      if (v != openvdb::Vec3s(0)) accessor.setValueOn(ijk, v);
    });
  }
  result->setGridClass(openvdb::GRID_STAGGERED);
  result->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
  return result;
}

openvdb::GridBase::Ptr to_openvdb(const Frame& frame, const Grid& grid) {
  switch (grid.kind) {
    case GridKind::level_set:
      return level_set_grid(frame, grid);
    case GridKind::staggered_vector:
      return staggered_grid(grid);
    default:
      return scalar_grid(grid);
  }
}

// A transform of the type of cell-centred grids. Its numbers are written later by with_transforms().
openvdb::math::Transform::Ptr scale_and_translation() {
  auto transform = openvdb::math::Transform::createLinearTransform(2);
  transform->postTranslate(openvdb::Vec3d(1));
  return transform;
}

openvdb::MetaMap metadata_of(const Frame& frame) {
  const std::array<int, 3> cells = domain_cells(frame);
  openvdb::MetaMap meta;
  meta.insertMeta("time", openvdb::DoubleMetadata(frame.time));
  meta.insertMeta("frame", openvdb::Int32Metadata(frame.number));
  meta.insertMeta("dt", openvdb::DoubleMetadata(frame.dt));
  meta.insertMeta("dimension", openvdb::Int32Metadata(frame.dimension));
  meta.insertMeta("cell_size", openvdb::DoubleMetadata(frame.cell_size));
  meta.insertMeta("lower", openvdb::Vec3DMetadata({frame.lower[0], frame.lower[1], frame.lower[2]}));
  meta.insertMeta("cells", openvdb::Vec3IMetadata({cells[0], cells[1], cells[2]}));
  meta.insertMeta("creator", openvdb::StringMetadata(frame.creator));
  return meta;
}

// Archives to a string. openvdb::io::Stream writes no offsets, so that readers could not open single grids.
class StringArchive : public openvdb::io::Archive {
 public:
  std::string bytes(const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& meta) {
    setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
    std::ostringstream out(std::ios::binary);
    openvdb::io::Archive::write(out, grids, true, meta);
    return std::move(out).str();
  }
};

struct OpenFrame {
  Frame frame;  // without grids
  std::array<int, 3> cells{0, 0, 0};
  openvdb::GridPtrVecPtr grids;
};

void read_frame_metadata(const openvdb::MetaMap& meta, OpenFrame& open) {
  Frame& frame = open.frame;
  frame.time = meta.metaValue<double>("time");
  frame.number = meta.metaValue<openvdb::Int32>("frame");
  frame.dt = meta.metaValue<double>("dt");
  frame.dimension = meta.metaValue<openvdb::Int32>("dimension");
  frame.cell_size = meta.metaValue<double>("cell_size");
  frame.creator = meta.metaValue<std::string>("creator");
  const auto lower = meta.metaValue<openvdb::Vec3d>("lower");
  const auto cells = meta.metaValue<openvdb::Vec3i>("cells");
  for (int a = 0; a < 3; ++a) {
    frame.lower[a] = lower[a];
    open.cells[a] = cells[a];
  }
}

// Reads from memory with exceptions enabled, because OpenVDB itself ignores a premature end of the file.
OpenFrame read_archive(const std::filesystem::path& file) {
  std::string bytes = mesh::read_bytes(file);
  require_sound_header(file, bytes);
  require_checksum(file, bytes);
  std::istringstream in(std::move(bytes), std::ios::binary);
  in.exceptions(std::ios::failbit | std::ios::badbit);
  openvdb::io::Stream archive(in, false);
  OpenFrame open;
  read_frame_metadata(*archive.getMetadata(), open);
  require_sane(file, open.frame, open.cells);
  open.grids = archive.getGrids();
  return open;
}

// Checks that the domain in each grid's metadata agrees with the frame's, which detects damaged counts.
void require_one_domain(const std::filesystem::path& file, const OpenFrame& open) {
  for (const auto& grid : *open.grids) {
    OpenFrame other;
    read_frame_metadata(*grid, other);
    if (other.cells == open.cells && other.frame.cell_size == open.frame.cell_size) continue;
    refuse(file, "is damaged: grid '" + readable_start(grid->getName()) + "' has another domain than the frame");
  }
}

OpenFrame open_frame(const std::filesystem::path& file) {
  initialize();
  require_readable(file);
  try {
    OpenFrame open = read_archive(file);
    require_one_domain(file, open);
    return open;
  } catch (const Error&) {
    throw;
  } catch (const std::ios::failure&) {
    refuse(file, "is damaged or cut off: it ends within a grid");
  } catch (const std::bad_alloc&) {
    refuse(file, "is damaged, or too large for the memory left: its grids ask for more than there is");
  } catch (const std::exception& e) {
    refuse(file, "cannot be read as a frame of Seiche: " + readable_start(e.what()));
  }
}

GridKind kind_of(const openvdb::GridBase& grid) {
  if (grid.isType<Vec3SGrid>()) return GridKind::staggered_vector;
  return grid.getGridClass() == openvdb::GRID_LEVEL_SET ? GridKind::level_set : GridKind::scalar;
}

void require_within(const std::filesystem::path& file, const OpenFrame& open, const openvdb::GridBase& grid) {
  openvdb::CoordBBox domain(Coord(0), Coord(open.cells[0] - 1, open.cells[1] - 1, open.cells[2] - 1));
  if (kind_of(grid) == GridKind::level_set) domain.expand(closing_layers);
  const openvdb::CoordBBox active = grid.evalActiveVoxelBoundingBox();
  if (!active.empty() && !domain.isInside(active)) refuse(file, "grid '" + grid.getName() + "' leaves the domain");
}

template <class GridType, class Store>
void copy_voxels(const GridType& grid, Block& block, Store&& store) {
  const auto accessor = grid.getConstAccessor();
  float* value = block.values.data();
  Coord ijk;
  for (ijk[2] = 0; ijk[2] < block.upper[2]; ++ijk[2]) {
    for (ijk[1] = 0; ijk[1] < block.upper[1]; ++ijk[1]) {
      for (ijk[0] = 0; ijk[0] < block.upper[0]; ++ijk[0]) value = store(accessor.getValue(ijk), value);
    }
  }
}

Grid to_dense(const OpenFrame& open, const openvdb::GridBase& source) {
  Grid grid;
  grid.name = source.getName() == "velocity" ? velocity_grid : source.getName();
  grid.kind = kind_of(source);
  Block block;
  block.upper = open.cells;
  block.values.resize(voxel_count(block.lower, block.upper) * components(grid.kind));
  if (grid.kind == GridKind::staggered_vector) {
    copy_voxels(static_cast<const Vec3SGrid&>(source), block,
                [](const openvdb::Vec3s& v, float* to) { return std::copy_n(v.asPointer(), 3, to); });
  } else {
    const auto& floats = static_cast<const FloatGrid&>(source);
    grid.background = floats.background();
    copy_voxels(floats, block, [](float v, float* to) { return *to = v, to + 1; });
  }
  grid.blocks.push_back(std::move(block));
  return grid;
}

FloatGrid::ConstPtr find_level_set(const OpenFrame& open) {
  FloatGrid::ConstPtr found;
  for (const auto& grid : *open.grids) {
    if (!grid->isType<FloatGrid>() || grid->getGridClass() != openvdb::GRID_LEVEL_SET) continue;
    const auto rank = [](const std::string& name) { return name == "free_surface" ? 2 : name == "surface" ? 1 : 0; };
    if (!found || rank(grid->getName()) > rank(found->getName())) found = openvdb::gridConstPtrCast<FloatGrid>(grid);
  }
  return found;
}

FloatGrid::Ptr node_grid(const std::vector<float>& values, const std::array<int, 3>& nodes) {
  FloatGrid::Ptr grid = FloatGrid::create(1);
  FloatGrid::Accessor accessor = grid->getAccessor();
  const float* value = values.data();
  Coord ijk;
  for (ijk[2] = 0; ijk[2] < nodes[2]; ++ijk[2]) {
    for (ijk[1] = 0; ijk[1] < nodes[1]; ++ijk[1]) {
      for (ijk[0] = 0; ijk[0] < nodes[0]; ++ijk[0]) accessor.setValueOn(ijk, *value++);
    }
  }
  return grid;
}

// Marks points beyond the outermost nodes. Their polygons only close the surface there.
std::vector<char> points_beyond(const std::vector<openvdb::Vec3s>& points, const std::array<int, 3>& nodes) {
  std::vector<char> beyond(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int a = 0; a < 3; ++a) beyond[i] |= char(points[i][a] < 0 || points[i][a] > float(nodes[a] - 1));
  }
  return beyond;
}

}  // namespace

std::unique_ptr<SampledDistance> read_distance(const std::filesystem::path& file, int dimension) {
  const OpenFrame open = open_frame(file);
  if (open.frame.dimension != dimension) {
    refuse(file, fmt::format("is a frame in {} dimensions, the scene has {}", open.frame.dimension, dimension));
  }
  const FloatGrid::ConstPtr grid = find_level_set(open);
  if (!grid) refuse(file, "holds no level set; use a frame written with \"surface\"");
  require_within(file, open, *grid);
  const Vec3 first = open.frame.lower + Vec3::Constant(open.frame.cell_size / 2);
  return within_domain(std::make_unique<GridDistance>(grid, first, open.frame.cell_size, grid->background()),
                       open.frame, open.cells);
}

SurfaceMesh contour(const std::vector<float>& values, const std::array<int, 3>& nodes, const Vec3& lower,
                    double spacing) {
  initialize();
  std::vector<openvdb::Vec3s> points;  // in index space
  std::vector<openvdb::Vec4I> quads;
  run_serially([&] { openvdb::tools::volumeToMesh(*node_grid(values, nodes), points, quads, 0.0); });
  const std::vector<char> beyond = points_beyond(points, nodes);
  SurfaceMesh mesh;
  for (const auto& p : points) mesh.points.push_back(lower + spacing * Vec3(p[0], p[1], p[2]));
  for (const auto& q : quads) {
    if (beyond[q[0]] || beyond[q[1]] || beyond[q[2]] || beyond[q[3]]) continue;
    mesh.triangles.push_back({int(q[0]), int(q[1]), int(q[2])});
    mesh.triangles.push_back({int(q[0]), int(q[2]), int(q[3])});
  }
  return mesh;
}

std::string encode(const Frame& frame, const std::string& velocity) {
  initialize();
  const openvdb::MetaMap meta = metadata_of(frame);
  openvdb::GridCPtrVec grids;
  for (const Grid& grid : frame.grids) {
    for (const Block& block : grid.blocks) {
      require_block(grid, block);
      require_finite(grid, block);
    }
    const openvdb::GridBase::Ptr result = to_openvdb(frame, grid);
    result->insertMeta(meta);
    result->setName(grid.name == velocity_grid ? velocity : grid.name);
    result->setTransform(scale_and_translation());
    result->addStatsMetadata();
    grids.push_back(result);
  }
  if (!frame.points.empty()) {
    const openvdb::GridBase::Ptr points = point_grid(frame, scale_and_translation());
    points->insertMeta(meta);
    points->addStatsMetadata();
    grids.push_back(points);
  }
  // Voxel (i, j, k) lies at lower + (i + 1/2) h.
  const Vec3 first = frame.lower + Vec3::Constant(frame.cell_size / 2);
  return with_checksum(with_transforms(StringArchive().bytes(grids, meta), first, frame.cell_size));
}

Frame decode(const std::filesystem::path& file) {
  const OpenFrame open = open_frame(file);
  Frame frame = open.frame;
  for (const auto& source : *open.grids) {
    if (holds_points(*source)) {
      require_within(file, open, *source);
      frame.points = read_points(file, frame, *source);
      continue;
    }
    if (!source->isType<FloatGrid>() && !source->isType<Vec3SGrid>()) {
      refuse(file,
             "grid '" + source->getName() + "' has the type " + source->type() + "; Seiche does not write such grids");
    }
    require_within(file, open, *source);
    frame.grids.push_back(to_dense(open, *source));
    require_finite(file, frame.grids.back());
  }
  return frame;
}

}  // namespace seiche::vdb
