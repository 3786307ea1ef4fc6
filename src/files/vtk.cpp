#include "files/vtk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "base/base64.h"
#include "solid/mesh/shape.h"

namespace seiche::vtk {
namespace {

constexpr int vtk_vertex = 1, vtk_line = 3, vtk_triangle = 5, vtk_tetrahedron = 10, vtk_quadratic_triangle = 22,
              vtk_quadratic_tetrahedron = 24;

template <class T>
constexpr const char* type_name();
template <>
constexpr const char* type_name<float>() {
  return "Float32";
}
template <>
constexpr const char* type_name<double>() {
  return "Float64";
}
template <>
constexpr const char* type_name<std::int32_t>() {
  return "Int32";
}
template <>
constexpr const char* type_name<std::int64_t>() {
  return "Int64";
}
template <>
constexpr const char* type_name<std::uint8_t>() {
  return "UInt8";
}

template <class T>
std::string array(const std::string& name, const std::vector<T>& values, int components = 1) {
  const std::uint64_t size = values.size() * sizeof(T);
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
                     type_name<T>(), name, components, encode_base64(bytes));
}

// Texts as their bytes, each ended by a zero.
std::string text_array(const std::string& name, const std::vector<std::string>& texts) {
  std::string codes;
  for (const std::string& text : texts) {
    for (const char c : text) codes += fmt::format("{} ", unsigned(static_cast<unsigned char>(c)));
    codes += "0 ";
  }
  return fmt::format("<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">{}</Array>\n", name,
                     texts.size(), codes);
}

std::string file(const std::string& type, const std::string& body) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n{}</VTKFile>\n",
      type, body);
}

using Cells = std::array<int, 3>;

std::size_t flat(const Cells& cells, int i, int j, int k) {
  return std::size_t(i) + std::size_t(cells[0]) * (std::size_t(j) + std::size_t(cells[1]) * std::size_t(k));
}

// Assembles the blocks of one grid into one array over the domain.
std::vector<float> assemble(const vdb::Grid& grid, const Cells& cells, std::size_t components) {
  std::vector<float> whole(flat(cells, 0, 0, cells[2]) * components, grid.background);
  for (const vdb::Block& block : grid.blocks) {
    const float* from = block.values.data();
    const std::size_t row = std::size_t(std::max(0, block.upper[0] - block.lower[0])) * components;
    for (int k = block.lower[2]; k < block.upper[2]; ++k) {
      for (int j = block.lower[1]; j < block.upper[1] && row > 0; ++j, from += row) {
        std::memcpy(whole.data() + flat(cells, block.lower[0], j, k) * components, from, row * sizeof(float));
      }
    }
  }
  return whole;
}

// u_c = (u_low + u_high) / 2 along each axis; the high face of a cell is the low face of the next one.
std::vector<float> centred(const std::vector<float>& faces, const Cells& cells, int dimension) {
  std::vector<float> result = faces;
  const std::array<std::size_t, 3> stride{1, std::size_t(cells[0]), std::size_t(cells[0]) * std::size_t(cells[1])};
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) {
        const Cells at{i, j, k};
        const std::size_t c = flat(cells, i, j, k);
        for (std::size_t axis = 0; axis < std::size_t(dimension); ++axis) {
          if (at[axis] + 1 < cells[axis])
            result[3 * c + axis] = 0.5f * (faces[3 * c + axis] + faces[3 * (c + stride[axis]) + axis]);
        }
      }
    }
  }
  return result;
}

std::string cell_array(const vdb::Grid& grid, const Cells& cells, int dimension) {
  return array(grid.name, cell_values(grid, cells, dimension), grid.kind == vdb::GridKind::staggered_vector ? 3 : 1);
}

struct Elements {
  std::vector<double> points;
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  std::vector<std::int32_t> solid;
};

template <std::size_t N>
void add(Elements& all, const std::vector<std::array<int, N>>& elements, std::int64_t first_point, int type,
         int solid) {
  for (const auto& element : elements) {
    for (const int point : element) all.connectivity.push_back(first_point + point);
    all.offsets.push_back(std::int64_t(all.connectivity.size()));
    all.types.push_back(std::uint8_t(type));
    all.solid.push_back(solid);
  }
}

Elements collect(const std::vector<SurfaceMesh>& solids) {
  Elements all;
  for (std::size_t n = 0; n < solids.size(); ++n) {
    const std::int64_t first = std::int64_t(all.points.size() / 3);
    for (const Vec3& p : solids[n].points) all.points.insert(all.points.end(), {p[0], p[1], p[2]});
    add(all, solids[n].triangles, first, vtk_triangle, int(n));
    add(all, solids[n].segments, first, vtk_line, int(n));
  }
  return all;
}

void add_vectors(const std::vector<Vec3>& vectors, std::vector<double>& numbers) {
  for (const Vec3& v : vectors) numbers.insert(numbers.end(), {v[0], v[1], v[2]});
}

constexpr int cell_type(int dimension, int order) {
  if (dimension == 2) return order == 1 ? vtk_triangle : vtk_quadratic_triangle;
  return order == 1 ? vtk_tetrahedron : vtk_quadratic_tetrahedron;
}

Elements collect(const std::vector<VolumeFrame>& solids) {
  Elements all;
  for (std::size_t n = 0; n < solids.size(); ++n) {
    const VolumeFrame& solid = solids[n];
    const std::int64_t first = std::int64_t(all.points.size() / 3);
    for (std::size_t i = 0; i < solid.rest.size(); ++i)
      add_vectors({Vec3(solid.rest[i] + solid.displacement[i])}, all.points);
    const std::size_t size = std::size_t(elastic::nodes_per_simplex(solid.dimension, solid.order));
    for (std::size_t at = 0; at + size <= solid.elements.size(); at += size) {
      for (std::size_t a = 0; a < size; ++a) all.connectivity.push_back(first + solid.elements[at + a]);
      all.offsets.push_back(std::int64_t(all.connectivity.size()));
      all.types.push_back(std::uint8_t(cell_type(solid.dimension, solid.order)));
      all.solid.push_back(std::int32_t(n));
    }
  }
  return all;
}

// `what`: "solid" or "joint", to which the elements belong.
std::string grid(const Elements& all, const std::string& point_data, const std::string& what,
                 const std::vector<std::string>& names, double time) {
  std::string body = fmt::format(
      "<UnstructuredGrid>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
      "NumberOfTuples=\"1\" format=\"ascii\">{:.17g}</DataArray>\n{}</FieldData>\n",
      time, text_array(what + "_names", names));
  body += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n{}<CellData>\n", all.points.size() / 3,
                      all.offsets.size(), point_data);
  body += array(what, all.solid) + "</CellData>\n<Points>\n" + array("Points", all.points, 3) + "</Points>\n<Cells>\n";
  body += array("connectivity", all.connectivity) + array("offsets", all.offsets) + array("types", all.types);
  return file("UnstructuredGrid", body + "</Cells>\n</Piece>\n</UnstructuredGrid>\n");
}

}  // namespace

std::vector<float> cell_values(const vdb::Grid& grid, const std::array<int, 3>& cells, int dimension) {
  if (grid.kind != vdb::GridKind::staggered_vector) return assemble(grid, cells, 1);
  return centred(assemble(grid, cells, 3), cells, dimension);
}

std::string image(const vdb::Frame& frame, const std::array<int, 3>& cells) {
  const std::string extent = fmt::format("0 {} 0 {} 0 {}", cells[0], cells[1], cells[2]);
  const double h = frame.cell_size;
  std::string body = fmt::format(
      "<ImageData WholeExtent=\"{}\" Origin=\"{:.17g} {:.17g} {:.17g}\" Spacing=\"{:.17g} {:.17g} "
      "{:.17g}\">\n<FieldData>\n",
      extent, frame.lower[0], frame.lower[1], frame.lower[2], h, h, h);
  body += fmt::format(
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{:.17g}</DataArray>\n",
      frame.time);
  body += fmt::format("</FieldData>\n<Piece Extent=\"{}\">\n<CellData>\n", extent);
  for (const vdb::Grid& grid : frame.grids) body += cell_array(grid, cells, frame.dimension);
  return file("ImageData", body + "</CellData>\n</Piece>\n</ImageData>\n");
}

std::string surfaces(const std::vector<SurfaceMesh>& solids, const std::vector<std::string>& names, double time) {
  return grid(collect(solids), "", "solid", names, time);
}

std::string volumes(const std::vector<VolumeFrame>& solids, const std::vector<std::string>& names, double time) {
  std::vector<double> displacement, velocity, von_mises;
  for (const VolumeFrame& solid : solids) {
    add_vectors(solid.displacement, displacement);
    add_vectors(solid.velocity, velocity);
    von_mises.insert(von_mises.end(), solid.von_mises.begin(), solid.von_mises.end());
  }
  const std::string fields = "<PointData>\n" + array("displacement", displacement, 3) + array("velocity", velocity, 3) +
                             array("von_mises", von_mises) + "</PointData>\n";
  return grid(collect(solids), fields, "solid", names, time);
}

std::string joints(const std::vector<JointReport>& joints, double time) {
  Elements all;
  std::vector<double> force, torque, coordinate;
  std::vector<std::int32_t> broken;
  std::vector<std::string> names;
  for (std::size_t n = 0; n < joints.size(); ++n) {
    const JointReport& joint = joints[n];
    add_vectors({joint.point}, all.points);
    add(all, std::vector<std::array<int, 1>>{{0}}, std::int64_t(n), vtk_vertex, int(n));
    add_vectors({joint.force}, force);
    add_vectors({joint.torque}, torque);
    coordinate.push_back(joint.q);
    broken.push_back(joint.broken);
    names.push_back(joint.name);
  }
  const std::string fields = "<PointData>\n" + array("force", force, 3) + array("torque", torque, 3) +
                             array("coordinate", coordinate) + array("broken", broken) + "</PointData>\n";
  return grid(all, fields, "joint", names, time);
}

std::string drops(const std::vector<vdb::Point>& drops, double time) {
  Elements all;
  std::vector<double> radius, velocity;
  std::vector<std::int64_t> id;
  for (std::size_t n = 0; n < drops.size(); ++n) {
    add_vectors({drops[n].place}, all.points);
    add(all, std::vector<std::array<int, 1>>{{0}}, std::int64_t(n), vtk_vertex, 0);
    add_vectors({drops[n].velocity}, velocity);
    radius.push_back(drops[n].radius);
    id.push_back(drops[n].id);
  }
  const std::string fields =
      "<PointData>\n" + array("radius", radius) + array("velocity", velocity, 3) + array("id", id) + "</PointData>\n";
  return grid(all, fields, "drop", {"drops"}, time);
}

std::string series(const std::string& stem, const std::string& extension, int last, double frame_rate) {
  std::string body = "<Collection>\n";
  for (int n = 0; n <= last; ++n) {
    body += fmt::format("<DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}.{:04d}.{}\"/>\n", n / frame_rate, stem, n,
                        extension);
  }
  return file("Collection", body + "</Collection>\n");
}

}  // namespace seiche::vtk
