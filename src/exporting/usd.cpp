#include "exporting/usd.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

namespace seiche::exporting {
namespace {

namespace fs = std::filesystem;

// "[a, b]" of "[a, b, ".
std::string closed(std::string text) {
  if (text.ends_with(", ")) text.resize(text.size() - 2);
  return text + "]";
}

std::string points_text(const std::vector<Vec3>& points) {
  std::string text = "[";
  for (const Vec3& p : points) fmt::format_to(std::back_inserter(text), "({:.7g}, {:.7g}, {:.7g}), ", p[0], p[1], p[2]);
  return closed(std::move(text));
}

// The box around points, as its two corners.
std::string extent_text(const std::vector<Vec3>& points) {
  Vec3 lower = points.front(), upper = lower;
  for (const Vec3& p : points) lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
  return points_text({lower, upper});
}

std::string values_text(const mesh::PointAttribute& attribute) {
  std::string text = "[";
  const auto out = std::back_inserter(text);
  const std::vector<float>& v = attribute.values;
  if (attribute.components == 3)
    for (std::size_t n = 0; n + 3 <= v.size(); n += 3)
      fmt::format_to(out, "({:.6g}, {:.6g}, {:.6g}), ", v[n], v[n + 1], v[n + 2]);
  else
    for (const float value : v) fmt::format_to(out, "{:.6g}, ", value);
  return closed(std::move(text));
}

std::string indices_text(const std::vector<std::array<int, 3>>& triangles) {
  std::string text = "[";
  for (const auto& t : triangles) fmt::format_to(std::back_inserter(text), "{}, {}, {}, ", t[0], t[1], t[2]);
  return closed(std::move(text));
}

std::string counts_text(std::size_t triangles) {
  std::string text = "[";
  for (std::size_t n = 0; n < triangles; ++n) text += "3, ";
  return closed(std::move(text));
}

// Row vectors: the translation is the last row.
std::string matrix_text(const Pose& pose) {
  const Eigen::Matrix3d r = pose.orientation.toRotationMatrix();
  std::string text = "( ";
  for (int row = 0; row < 3; ++row)
    text += fmt::format("({:.9g}, {:.9g}, {:.9g}, 0), ", r(0, row), r(1, row), r(2, row));
  return text + fmt::format("({:.9g}, {:.9g}, {:.9g}, 1) )", pose.position[0], pose.position[1], pose.position[2]);
}

// Declaration of an attribute of a mesh.
std::string declaration(const mesh::PointAttribute& attribute) {
  if (attribute.name == "velocity") return "vector3f[] velocities";
  return fmt::format("{} primvars:{}", attribute.components == 3 ? "vector3f[]" : "float[]", attribute.name);
}

}  // namespace

std::vector<std::string> prim_names(const std::vector<std::string>& texts) {
  std::set<std::string> used;
  std::vector<std::string> names;
  for (const std::string& text : texts) {
    std::string name = text;
    for (char& c : name) c = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ? c : '_';
    if (name.empty() || (name[0] >= '0' && name[0] <= '9')) name = "_" + name;
    const std::string stem = name;
    for (int n = 2; !used.insert(name).second; ++n) name = fmt::format("{}_{}", stem, n);
    names.push_back(name);
  }
  return names;
}

UsdWriter::UsdWriter(fs::path file, StageFacts facts) : file_(std::move(file)), facts_(std::move(facts)) {}

UsdWriter::~UsdWriter() {
  std::error_code ignored;
  for (auto& [name, prim] : prims_)
    for (auto& [attribute, part] : prim.parts) fs::remove(part->path(), ignored);
}

void UsdWriter::put(Prim& prim, const std::string& name, const std::string& attribute, int frame,
                    const std::string& value) {
  constexpr std::uint64_t piece = 1 << 22;  // bytes kept before they are written
  auto& part = prim.parts[attribute];
  if (!part) {
    prim.order.push_back(attribute);
    part = std::make_unique<AppendFile>(fmt::format("{}.{}.{}.part", file_.string(), name, prim.order.size()), 0);
  }
  part->append(fmt::format("            {}: {},\n", frame, value));
  if (value.size() > piece || part->size() % piece < value.size()) part->flush();
}

void UsdWriter::add_sample(const std::string& name, int frame, const AttributedMesh& sample, const Vec3& color) {
  if (!prims_.contains(name)) order_.push_back(name);
  Prim& prim = prims_[name];
  prim.color = color;
  put(prim, name, "point3f[] points", frame, points_text(sample.mesh.points));
  if (prim.parts.size() == 1 || prim.triangles != sample.mesh.triangles) {
    prim.triangles = sample.mesh.triangles;
    put(prim, name, "int[] faceVertexCounts", frame, counts_text(prim.triangles.size()));
    put(prim, name, "int[] faceVertexIndices", frame, indices_text(prim.triangles));
  }
  if (!sample.mesh.points.empty()) put(prim, name, "float3[] extent", frame, extent_text(sample.mesh.points));
  for (const mesh::PointAttribute& attribute : sample.attributes)
    put(prim, name, declaration(attribute), frame, values_text(attribute));
}

void UsdWriter::add_body(const std::string& name, const SurfaceMesh& mesh, const Vec3& color) {
  order_.push_back(name);
  Prim& prim = prims_[name];
  prim.is_body = true;
  prim.color = color;
  put(prim, name, "point3f[] points", facts_.first, points_text(mesh.points));
  put(prim, name, "int[] faceVertexCounts", facts_.first, counts_text(mesh.triangles.size()));
  put(prim, name, "int[] faceVertexIndices", facts_.first, indices_text(mesh.triangles));
  if (!mesh.points.empty()) put(prim, name, "float3[] extent", facts_.first, extent_text(mesh.points));
}

void UsdWriter::add_pose(const std::string& name, int frame, const Pose& pose) {
  put(prims_.at(name), name, "matrix4d xformOp:transform", frame, matrix_text(pose));
}

std::string UsdWriter::opening(const std::string& name, const Prim& prim) const {
  const bool moves = prim.parts.contains("matrix4d xformOp:transform");
  return fmt::format(
      "    def Mesh \"{}\"\n    {{\n        uniform token subdivisionScheme = \"none\"\n"
      "        color3f[] primvars:displayColor = [({:.4g}, {:.4g}, {:.4g})]\n{}",
      name, prim.color[0], prim.color[1], prim.color[2],
      moves ? "        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n" : "");
}

void UsdWriter::finish() {
  for (auto& [name, prim] : prims_)
    for (auto& [attribute, part] : prim.parts) part->flush();
  write_file(file_, [&](const ByteSink& write) {
    write(
        fmt::format("#usda 1.0\n(\n    doc = \"{}\"\n    defaultPrim = \"{}\"\n    startTimeCode = {}\n"
                    "    endTimeCode = {}\n    timeCodesPerSecond = {:g}\n    framesPerSecond = {:g}\n"
                    "    metersPerUnit = 1\n    upAxis = \"{}\"\n)\n\ndef Xform \"{}\"\n{{\n",
                    facts_.comment, facts_.name, facts_.first, facts_.last, facts_.frame_rate, facts_.frame_rate,
                    facts_.up, facts_.name));
    for (const std::string& name : order_) {
      const Prim& prim = prims_.at(name);
      write(opening(name, prim));
      for (const std::string& attribute : prim.order) {
        // Without this, values of a primvar count for the whole mesh.
        if (attribute.find("primvars:") != std::string::npos)
          write(fmt::format("        {} ( interpolation = \"vertex\" )\n", attribute));
        write(fmt::format("        {}.timeSamples = {{\n", attribute));
        std::ifstream in(prim.parts.at(attribute)->path(), std::ios::binary);
        std::string piece(1 << 20, '\0');
        while (in.read(piece.data(), std::streamsize(piece.size())), in.gcount() > 0)
          write(std::string_view(piece).substr(0, std::size_t(in.gcount())));
        write("        }\n");
      }
      write("    }\n\n");
    }
    write("}\n");
  });
}

}  // namespace seiche::exporting
