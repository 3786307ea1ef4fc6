#include "files/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

#include "base/agree.h"
#include "base/error.h"
#include "base/scene.h"
#include "base/version.h"
#include "files/checked_file.h"
#include "files/point_cache.h"

namespace seiche {
namespace {

constexpr std::size_t largest_gather = std::size_t(1) << 30;  // bytes in one exchange, below MPI's 2 GiB

std::string pack(const FrameField& field) {
  std::string bytes(sizeof field.lower + sizeof field.upper + field.values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), &field.lower, sizeof field.lower);
  std::memcpy(bytes.data() + sizeof field.lower, &field.upper, sizeof field.upper);
  const std::size_t head = sizeof field.lower + sizeof field.upper;
  if (!field.values.empty()) std::memcpy(bytes.data() + head, field.values.data(), bytes.size() - head);
  return bytes;
}

vdb::Block unpack(const std::string& bytes) {
  vdb::Block block;
  std::memcpy(&block.lower, bytes.data(), sizeof block.lower);
  std::memcpy(&block.upper, bytes.data() + sizeof block.lower, sizeof block.upper);
  const std::size_t head = sizeof block.lower + sizeof block.upper;
  block.values.resize((bytes.size() - head) / sizeof(float));
  if (!block.values.empty()) std::memcpy(block.values.data(), bytes.data() + head, bytes.size() - head);
  return block;
}

// Gathers all ranks' bytes on rank 0, in as many rounds as the limit of an exchange requires.
std::vector<std::string> gather_large(const std::string& bytes, const Communicator& ranks) {
  const std::size_t piece = largest_gather / std::size_t(ranks.size());
  const std::int64_t rounds = ranks.global_max(std::int64_t((bytes.size() + piece - 1) / piece));
  std::vector<std::string> all(ranks.is_root() ? std::size_t(ranks.size()) : 0);
  for (std::int64_t round = 0; round < rounds; ++round) {
    const std::size_t start = std::min(bytes.size(), std::size_t(round) * piece);
    const std::vector<std::string> parts = ranks.gather(bytes.substr(start, piece));
    for (std::size_t rank = 0; rank < parts.size(); ++rank) all[rank] += parts[rank];
  }
  return all;
}

// Drops of all ranks, on rank 0, by id. 2D frames have them in the middle of their layer.
std::vector<vdb::Point> gather_drops(const std::vector<DropPoint>& own, const Scene& scene, const Communicator& ranks) {
  constexpr std::size_t numbers = 8;
  std::vector<double> values;
  for (const DropPoint& d : own) {
    values.insert(values.end(), d.place.begin(), d.place.end());
    values.insert(values.end(), d.velocity.begin(), d.velocity.end());
    values.insert(values.end(), {d.radius, double(d.id)});
  }
  const double middle = scene.dimension == 2 ? scene.domain.lower[2] + scene.domain.cell_size / 2 : 0;
  std::vector<vdb::Point> points;
  const std::string bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  for (const std::string& part : gather_large(bytes, ranks)) {
    std::vector<double> v(part.size() / sizeof(double));
    if (!v.empty()) std::memcpy(v.data(), part.data(), part.size());
    for (auto at = v.begin(); at != v.end(); at += numbers)
      points.push_back({{at[0], at[1], at[2] + middle}, {at[3], at[4], at[5]}, at[6], std::int64_t(at[7])});
  }
  std::sort(points.begin(), points.end(), [](const vdb::Point& a, const vdb::Point& b) { return a.id < b.id; });
  return points;
}

vdb::GridKind grid_kind(FrameField::Kind kind) {
  switch (kind) {
    case FrameField::Kind::level_set:
      return vdb::GridKind::level_set;
    case FrameField::Kind::staggered_vector:
      return vdb::GridKind::staggered_vector;
    default:
      return vdb::GridKind::scalar;
  }
}

std::vector<std::string> names_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const SolidSpec& solid : scene.solids) names.push_back(solid.name);
  return names;
}

// "displacement at node 3" for the first non-finite value, or "".
std::string first_not_finite(const VolumeFrame& solid) {
  for (std::size_t n = 0; n < solid.rest.size(); ++n) {
    if (!solid.displacement[n].allFinite()) return fmt::format("displacement at node {}", n);
    if (!solid.velocity[n].allFinite()) return fmt::format("velocity at node {}", n);
  }
  for (std::size_t n = 0; n < solid.rest.size(); ++n) {
    if (!std::isfinite(solid.von_mises[n])) return fmt::format("von Mises stress at node {}", n);
  }
  return {};
}

void check_finite(const FrameField& field, const FrameLabel& label, const Communicator& ranks) {
  agree(ranks, "checking a frame", [&] {
    const std::string where = first_not_finite(field);
    if (where.empty()) return;
    throw Error(ExitCode::cannot_continue,
                fmt::format("frame {} at t = {:g} s: {} is not a number; the frame was not written", label.number,
                            label.time, where));
  });
}

}  // namespace

std::string frame_file(const std::string& stem, int number, const std::string& extension) {
  return fmt::format("{}.{:04d}.{}", stem, number, extension);
}

std::string field_of_output(const std::string& name) {
  if (name == "velocity") return "vel";
  return name == "solids" ? std::string() : name;
}

std::string first_not_finite(const FrameField& field) {
  const auto bad = std::find_if_not(field.values.begin(), field.values.end(), [](float v) { return std::isfinite(v); });
  if (bad == field.values.end()) return {};
  const int components = field.kind == FrameField::Kind::staggered_vector ? 3 : 1;
  const std::int64_t n = (bad - field.values.begin()) / components;
  const std::int64_t nx = std::max(1, field.upper[0] - field.lower[0]),
                     ny = std::max(1, field.upper[1] - field.lower[1]);
  return fmt::format("{} at cell ({}, {}, {})", field.name, field.lower[0] + n % nx, field.lower[1] + n / nx % ny,
                     field.lower[2] + n / (nx * ny));
}

FrameWriter::FrameWriter(const Scene& scene, const RunPaths& paths, const Communicator& ranks)
    : scene_(scene), paths_(paths), ranks_(ranks), surfaces_(scene.solids.size()) {}

bool FrameWriter::wants(const std::vector<std::string>& list, const std::string& name) const {
  return std::find(list.begin(), list.end(), name) != list.end();
}

vdb::Frame FrameWriter::gather(const FrameLabel& label, const Simulation& simulation, PhaseFault fault) const {
  vdb::Frame frame;
  frame.dimension = scene_.dimension;
  frame.lower = scene_.domain.lower;
  frame.cell_size = scene_.domain.cell_size;
  frame.time = label.time;
  frame.dt = label.dt;
  frame.number = label.number;
  frame.creator = "seiche " + version();
  for (const std::string& output : scene_.output.frames) {
    const std::string name = field_of_output(output);
    if (name.empty()) continue;
    const bool both = name == "surface" && scene_.output.surface == "closed";
    if (both) frame.grids.push_back(gather(label, simulation.frame_field("closed_surface"), fault));
    frame.grids.push_back(gather(label, simulation.frame_field(name), fault));
    if (!both) continue;
    vdb::Grid &closed = *std::prev(frame.grids.end(), 2), &open = frame.grids.back();
    closed.name = "surface";
    closed.closed = true;
    open.name = "free_surface";
  }
  if (const auto drops = simulation.drops())
    frame.has_drops = true, frame.points = gather_drops(*drops, scene_, ranks_);
  return frame;
}

vdb::Grid FrameWriter::gather(const FrameLabel& label, FrameField field, PhaseFault fault) const {
  if (fault == PhaseFault::poison && !field.values.empty()) field.values[0] = std::numeric_limits<float>::quiet_NaN();
  check_finite(field, label, ranks_);
  vdb::Grid grid{field.name, grid_kind(field.kind), 0, {}};
  if (field.kind == FrameField::Kind::level_set) grid.background = float(3 * scene_.domain.cell_size);
  for (const std::string& bytes : gather_large(pack(field), ranks_)) grid.blocks.push_back(unpack(bytes));
  return grid;
}

void FrameWriter::write(const FrameLabel& label, const Simulation& simulation, PhaseFault fault) {
  const vdb::Frame frame = gather(label, simulation, fault);
  agree_on_root(ranks_, fmt::format("writing frame {}", label.number), [&] {
    std::vector<VolumeFrame> volumes = elastic_volumes(label, simulation);
    if (wants(scene_.output.formats, "vdb")) {
      write_file(paths_.frames() / frame_file("frame", label.number, "vdb"),
                 vdb::encode(frame, scene_.output.velocity_name));
    }
    if (wants(scene_.output.formats, "vtk")) write_fluid(frame);
    if (!scene_.solids.empty()) write_solids(label, simulation);
    if (!volumes.empty()) write_elastic(label, std::move(volumes));
    if (!scene_.joints.empty()) write_joints(label, simulation);
  });
}

void FrameWriter::write_joints(const FrameLabel& label, const Simulation& simulation) const {
  write_file(paths_.frames() / frame_file("joints", label.number, "vtu"), vtk::joints(simulation.joints(), label.time));
  write_file(paths_.frames() / "joints.pvd", vtk::series("joints", "vtu", label.number, scene_.time.frame_rate));
}

void FrameWriter::write_fluid(const vdb::Frame& frame) const {
  write_file(paths_.frames() / frame_file("fluid", frame.number, "vti"), vtk::image(frame, scene_.domain.cells));
  write_file(paths_.frames() / "fluid.pvd", vtk::series("fluid", "vti", frame.number, scene_.time.frame_rate));
  if (!frame.has_drops) return;
  write_file(paths_.frames() / frame_file("drops", frame.number, "vtu"), vtk::drops(frame.points, frame.time));
  write_file(paths_.frames() / "drops.pvd", vtk::series("drops", "vtu", frame.number, scene_.time.frame_rate));
}

void FrameWriter::write_solids(const FrameLabel& label, const Simulation& simulation) {
  for (std::size_t n = 0; n < scene_.solids.size(); ++n) {
    if (scene_.solids[n].kind.moves() || surfaces_[n].points.empty()) surfaces_[n] = simulation.solid_surface(n);
  }
  write_file(paths_.frames() / frame_file("solids", label.number, "vtu"),
             vtk::surfaces(surfaces_, names_of(scene_), label.time));
  write_file(paths_.frames() / "solids.pvd", vtk::series("solids", "vtu", label.number, scene_.time.frame_rate));
}

// One entry a solid of the scene; empty if no solid deforms. Values are checked before anything is written.
std::vector<VolumeFrame> FrameWriter::elastic_volumes(const FrameLabel& label, const Simulation& simulation) const {
  std::vector<VolumeFrame> volumes(scene_.solids.size());
  bool any = false;
  for (std::size_t n = 0; n < volumes.size(); ++n) {
    volumes[n] = simulation.solid_volume(n);
    any = any || !volumes[n].rest.empty();
    const std::string bad = first_not_finite(volumes[n]);
    if (bad.empty()) continue;
    throw Error(ExitCode::cannot_continue,
                fmt::format("frame {} at t = {:g} s: {} of solid '{}' is not a number; the frame was not written",
                            label.number, label.time, bad, scene_.solids[n].name));
  }
  return any ? volumes : std::vector<VolumeFrame>{};
}

void FrameWriter::write_elastic(const FrameLabel& label, std::vector<VolumeFrame> volumes) const {
  const std::vector<std::string> stems = point_cache::stems(names_of(scene_));
  bool any = false;
  for (std::size_t n = 0; n < volumes.size(); ++n) {
    if (volumes[n].rest.empty()) continue;
    const std::filesystem::path stem = paths_.frames() / stems[n];
    const std::filesystem::path mesh = stem.string() + ".obj";
    if (label.number == 0 || !std::filesystem::exists(mesh))
      write_file(mesh, point_cache::rest_surface(volumes[n], surfaces_[n]));
    point_cache::add_sample(stem.string() + ".pc2", label.number, point_cache::surface_points(volumes[n]));
    any = any || !volumes[n].elements.empty();
    if (volumes[n].elements.empty()) volumes[n] = {};
  }
  if (!any) return;
  write_file(paths_.frames() / frame_file("elastic", label.number, "vtu"),
             vtk::volumes(volumes, names_of(scene_), label.time));
  write_file(paths_.frames() / "elastic.pvd", vtk::series("elastic", "vtu", label.number, scene_.time.frame_rate));
}

}  // namespace seiche
