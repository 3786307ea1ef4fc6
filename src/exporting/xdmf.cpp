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

// Slowest index first, as HDF5 and XDMF list extents.
Extents extents_of(const std::array<int, 3>& n, int width) {
  Extents extents{std::uint64_t(n[2]), std::uint64_t(n[1]), std::uint64_t(n[0])};
  if (width > 1) extents.push_back(std::uint64_t(width));
  return extents;
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
std::string XdmfWriter::fluid(const vdb::Frame& frame, const std::string& group) {
  std::array<int, 3> cells{};
  for (const vdb::Grid& grid : frame.grids) cells = grid.blocks.at(0).upper;
  const std::array<int, 3> nodes = node_counts(cells, frame.dimension);
  std::string text = fmt::format(
      "<Grid Name=\"fluid\" GridType=\"Uniform\">\n<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"{}\"/>\n"
      "<Geometry GeometryType=\"ORIGIN_DXDYDZ\"><DataItem Dimensions=\"3\">{:.9g} {:.9g} {:.9g}</DataItem>"
      "<DataItem Dimensions=\"3\">{:.9g} {:.9g} {:.9g}</DataItem></Geometry>\n",
      words(extents_of(nodes, 1)), frame.lower[2], frame.lower[1], frame.lower[0], frame.cell_size, frame.cell_size,
      frame.cell_size);
  for (const vdb::Grid& grid : frame.grids) {
    const int width = grid.kind == vdb::GridKind::staggered_vector ? 3 : 1;
    const std::string name = grid.name == "vel" ? "velocity" : grid.name;
    const std::vector<float> values = vtk::cell_values(grid, cells, frame.dimension);
    text += attribute(name, width, "Cell", store(group + "cells/" + name, extents_of(cells, width), values));
    text += attribute(
        name + "_at_nodes", width, "Node",
        store(group + "nodes/" + name, extents_of(nodes, width), node_values(values, cells, frame.dimension, width)));
  }
  return text + "</Grid>\n";
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
      "<Grid Name=\"solids\" GridType=\"Uniform\">\n<Topology TopologyType=\"{}\" "
      "NumberOfElements=\"{}\">{}</Topology>\n<Geometry GeometryType=\"XYZ\">{}</Geometry>\n{}</Grid>\n",
      flat ? "Polyline\" NodesPerElement=\"2" : "Triangle", count,
      store(group + "solids/corners", {count, width}, corners),
      store(group + "solids/points", {points.size() / 3, 3}, points),
      attribute("solid", 1, "Cell", store(group + "solids/solid", {count}, solid)));
}

void XdmfWriter::add_frame(const vdb::Frame& frame, const render::SolidMesh& solids) {
  const std::string group = fmt::format("frame{:04d}/", frame.number);
  frames_ += fmt::format(
      "<Grid Name=\"frame {}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
      "<Time Value=\"{:.17g}\"/>\n",
      frame.number, frame.time);
  frames_ += fluid(frame, group);
  if (!solids.solid.empty()) frames_ += surfaces(solids, group);
  frames_ += "</Grid>\n";
}

void XdmfWriter::finish() {
  arrays_.close();
  write_file(beside(stem_, ".xdmf"),
             fmt::format("<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"run\" "
                         "GridType=\"Collection\" CollectionType=\"Temporal\">\n{}</Grid>\n</Domain>\n</Xdmf>\n",
                         frames_));
}

}  // namespace seiche::exporting
