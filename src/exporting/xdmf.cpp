#include "exporting/xdmf.h"

#include <fmt/format.h>

#include <type_traits>

#include "files/checked_file.h"
#include "files/vtk.h"

namespace seiche::exporting {
namespace {

using Extents = std::vector<std::uint64_t>;

std::filesystem::path beside(const std::filesystem::path& stem, const char* extension) {
  return stem.string() + extension;
}

std::string words(const Extents& extents) {
  std::string text;
  for (const std::uint64_t n : extents) text += fmt::format("{}{}", text.empty() ? "" : " ", n);
  return text;
}

// Nodes of the grid along each axis.
std::array<int, 3> node_counts(const std::array<int, 3>& cells, int dimension) {
  return {cells[0] + 1, cells[1] + 1, dimension == 2 ? 1 : cells[2] + 1};
}

// Slowest index first, as HDF5 and XDMF list extents; in 2D a list, as values of a mesh are.
Extents extents_of(const std::array<int, 3>& n, int dimension, int width) {
  Extents extents{std::uint64_t(n[2]), std::uint64_t(n[1]), std::uint64_t(n[0])};
  if (dimension == 2) extents = {extents[0] * extents[1] * extents[2]};
  if (width > 1) extents.push_back(std::uint64_t(width));
  return extents;
}

// Three numbers in the text; the newer reader of ParaView ends the program where the format is left out.
std::string numbers(double a, double b, double c) {
  return fmt::format(
      "<DataItem Format=\"XML\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"3\">{:.17g} {:.17g} "
      "{:.17g}</DataItem>",
      a, b, c);
}

// A grid of a frame.
std::string grid_text(const char* name, double time, const std::string& content) {
  return fmt::format("<Grid Name=\"{}\" GridType=\"Uniform\">\n<Time Value=\"{:.17g}\"/>\n{}</Grid>\n", name, time,
                     content);
}

// The grids of all frames.
std::string collection(const char* name, const std::string& grids) {
  if (grids.empty()) return "";
  return fmt::format("<Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}</Grid>\n", name,
                     grids);
}

std::string attribute(const std::string& name, int width, const char* center, const std::string& item) {
  return fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", name,
                     width == 3 ? "Vector" : "Scalar", center, item);
}

}  // namespace

std::vector<float> node_values(const std::vector<float>& cells_values, const std::array<int, 3>& cells, int dimension,
                               int width) {
  const std::array<int, 3> nodes = node_counts(cells, dimension);
  std::vector<float> result;
  result.reserve(std::size_t(nodes[0]) * std::size_t(nodes[1]) * std::size_t(nodes[2]) * std::size_t(width));
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i)
        for (int w = 0; w < width; ++w) {
          float sum = 0;
          int count = 0;
          for (int c = std::max(0, k - 1); c <= std::min(k, cells[2] - 1); ++c)
            for (int b = std::max(0, j - 1); b <= std::min(j, cells[1] - 1); ++b)
              for (int a = std::max(0, i - 1); a <= std::min(i, cells[0] - 1); ++a, ++count)
                sum += cells_values[((std::size_t(c) * std::size_t(cells[1]) + std::size_t(b)) * std::size_t(cells[0]) +
                                     std::size_t(a)) *
                                        std::size_t(width) +
                                    std::size_t(w)];
          result.push_back(sum / float(count));
        }
  return result;
}

XdmfWriter::XdmfWriter(const std::filesystem::path& stem) : stem_(stem), arrays_(beside(stem, ".h5")) {}

std::string XdmfWriter::item(const std::string& name, const Extents& extents, const char* type) const {
  return fmt::format(
      "<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"4\" Dimensions=\"{}\">{}.h5:/{}</DataItem>", type,
      words(extents), stem_.filename().string(), name);
}

template <class T>
std::string XdmfWriter::store(const std::string& name, const Extents& extents, const std::vector<T>& values) {
  arrays_.write(name, extents, values);
  return item(name, extents, std::is_same_v<T, float> ? "Float" : "Int");
}

// Axes are listed as z, y, x.
std::string XdmfWriter::lattice(const vdb::Frame& frame, const std::array<int, 3>& cells) {
  const std::array<int, 3> nodes = node_counts(cells, frame.dimension);
  const double h = frame.cell_size;
  if (frame.dimension != 2)
    return fmt::format(
        "<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"{}\"/>\n"
        "<Geometry GeometryType=\"ORIGIN_DXDYDZ\">{}{}</Geometry>\n",
        words(extents_of(nodes, 3, 1)), numbers(frame.lower[2], frame.lower[1], frame.lower[0]), numbers(h, h, h));
  if (!plane_.empty()) return plane_;
  std::vector<float> points;
  for (int j = 0; j < nodes[1]; ++j)
    for (int i = 0; i < nodes[0]; ++i)
      points.insert(points.end(), {float(frame.lower[0] + i * h), float(frame.lower[1] + j * h), 0.0f});
  std::vector<std::int32_t> corners;
  for (int j = 0; j < cells[1]; ++j)
    for (int i = 0; i < cells[0]; ++i) {
      const std::int32_t at = j * nodes[0] + i;
      corners.insert(corners.end(), {at, at + 1, at + 1 + nodes[0], at + nodes[0]});
    }
  const std::uint64_t count = corners.size() / 4;
  plane_ = fmt::format(
      "<Topology TopologyType=\"Quadrilateral\" NumberOfElements=\"{}\">{}</Topology>\n"
      "<Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
      count, store("grid/corners", {count, 4}, corners), store("grid/points", {points.size() / 3, 3}, points));
  return plane_;
}

std::string XdmfWriter::fluid(const vdb::Frame& frame, const std::string& group) {
  std::array<int, 3> cells{};
  for (const vdb::Grid& grid : frame.grids) cells = grid.blocks.at(0).upper;
  const std::array<int, 3> nodes = node_counts(cells, frame.dimension);
  std::string text = lattice(frame, cells);
  for (const vdb::Grid& grid : frame.grids) {
    const int width = grid.kind == vdb::GridKind::staggered_vector ? 3 : 1;
    const std::string name = grid.name == "vel" ? "velocity" : grid.name;
    const std::vector<float> values = vtk::cell_values(grid, cells, frame.dimension);
    text += attribute(name, width, "Cell",
                      store(group + "cells/" + name, extents_of(cells, frame.dimension, width), values));
    text += attribute(name + "_at_nodes", width, "Node",
                      store(group + "nodes/" + name, extents_of(nodes, frame.dimension, width),
                            node_values(values, cells, frame.dimension, width)));
  }
  return text;
}

std::string XdmfWriter::surfaces(const render::SolidMesh& solids, const std::string& group) {
  std::vector<float> points;
  for (const Vec3& p : solids.mesh.points)
    for (int a = 0; a < 3; ++a) points.push_back(float(p[a]));
  std::vector<std::int32_t> corners;
  for (const auto& t : solids.mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  for (const auto& s : solids.mesh.segments) corners.insert(corners.end(), s.begin(), s.end());
  const bool flat = solids.mesh.triangles.empty();
  const std::uint64_t width = flat ? 2 : 3, count = corners.size() / width;
  const std::vector<std::int32_t> solid(solids.solid.begin(), solids.solid.end());
  return fmt::format(
      "<Topology TopologyType=\"{}\" NumberOfElements=\"{}\">{}</Topology>\n"
      "<Geometry GeometryType=\"XYZ\">{}</Geometry>\n{}",
      flat ? "Polyline\" NodesPerElement=\"2" : "Triangle", count,
      store(group + "solids/corners", {count, width}, corners),
      store(group + "solids/points", {points.size() / 3, 3}, points),
      attribute("solid", 1, "Cell", store(group + "solids/solid", {count}, solid)));
}

void XdmfWriter::add_frame(const vdb::Frame& frame, const render::SolidMesh& solids) {
  const std::string group = fmt::format("frame{:04d}/", frame.number);
  fluid_ += grid_text("fluid", frame.time, fluid(frame, group));
  if (!solids.solid.empty()) solids_ += grid_text("solids", frame.time, surfaces(solids, group));
}

// A collection for each of fluid and solids: with both in one for each frame, the older reader numbers their names, so
// that they change from frame to frame.
void XdmfWriter::finish() {
  arrays_.close();
  write_file(beside(stem_, ".xdmf"),
             fmt::format("<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n{}{}</Domain>\n</Xdmf>\n",
                         collection("fluid", fluid_), collection("solids", solids_)));
}

}  // namespace seiche::exporting
