// Detects the format of a mesh file, parses it, and repairs or rejects its surface.
#include "geometry/mesh/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/error.h"
#include "geometry/mesh/extent.h"
#include "geometry/mesh/formats.h"
#include "geometry/mesh/intersections.h"
#include "geometry/mesh/topology.h"

namespace seiche {
namespace mesh {
namespace {

struct Format {
  const char* name;
  const char* extension;
  SurfaceMesh (*parse)(const Source&);
};
constexpr std::array<Format, 3> formats{
    {{"OBJ", ".obj", parse_obj}, {"PLY", ".ply", parse_ply}, {"STL", ".stl", parse_stl}}};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& message) {
  throw Error(ExitCode::bad_input, file.string() + ": " + message);
}

const Format& format_of_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  for (const Format& format : formats) {
    if (extension == format.extension) return format;
  }
  fail(file, "the extension '" + extension + "' is not a mesh of triangles; use .obj, .ply or .stl");
}

bool is_text(std::string_view bytes) {
  return bytes.substr(0, 1024).find('\0') == std::string_view::npos;
}

// The format that the content clearly indicates, or "".
const char* sniff(std::string_view bytes) {
  if (bytes.substr(0, 4) == "ply\n" || bytes.substr(0, 4) == "ply\r") return "PLY";
  if (!is_text(bytes)) return is_binary_stl(bytes) ? "STL" : "";
  const std::size_t line_end = bytes.find('\n');
  const bool facet = line_end != std::string_view::npos && Tokens(bytes.substr(line_end)).next() == "facet";
  return bytes.substr(0, 5) == "solid" && facet ? "STL" : "";
}

void require_content(const Source& source, const Format& format) {
  if (source.bytes.rfind("version https://git-lfs", 0) == 0) {
    fail(source.file, "is a Git LFS pointer, not the mesh itself; fetch it with 'git lfs pull'");
  }
  const std::string found = sniff(source.bytes), expected = format.name;
  const bool is_ply = found == "PLY";
  if ((found.empty() || found == expected) && (expected != "PLY" || is_ply)) return;
  const std::string content = found.empty() ? "not PLY (it does not begin with 'ply')" : "of a " + found + " file";
  fail(source.file,
       fmt::format("the extension says {}, but the content is {}; rename or export it anew", expected, content));
}

SurfaceMesh parse(const std::filesystem::path& file) {
  const Format& format = format_of_extension(file);
  const Source source{file, read_bytes(file)};
  require_content(source, format);
  SurfaceMesh mesh = format.parse(source);
  if (mesh.triangles.empty()) fail(file, "holds no faces; the surface of a solid takes at least 4 triangles");
  return mesh;
}

// Number of a triangle in the file, counted from 1. The triangle may have been reoriented since.
std::size_t number_in(const std::vector<std::array<int, 3>>& as_read, const std::array<int, 3>& t) {
  const auto same = [&](const std::array<int, 3>& r) { return std::is_permutation(r.begin(), r.end(), t.begin()); };
  return 1 + std::size_t(std::find_if(as_read.begin(), as_read.end(), same) - as_read.begin());
}

std::string named(const SurfaceMesh& mesh, const std::array<int, 3>& t,
                  const std::vector<std::array<int, 3>>& as_read) {
  const Vec3 c = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3;
  return fmt::format("{} at ({:.6g}, {:.6g}, {:.6g})", number_in(as_read, t), c[0], c[1], c[2]);
}

void require_simple(const SurfaceMesh& mesh, const std::vector<std::array<int, 3>>& as_read) {
  const auto pairs = self_intersections(mesh);
  if (pairs.empty()) return;
  const auto [first, second] = pairs.front();
  throw Error(
      ExitCode::bad_input,
      fmt::format("the surface intersects itself in {} pairs of triangles, the first {} and {} (triangles in the "
                  "order of the file, from 1); join the parts into one surface or remesh it",
                  pairs.size(), named(mesh, mesh.triangles[first], as_read),
                  named(mesh, mesh.triangles[second], as_read)));
}

SurfaceMesh mend(SurfaceMesh mesh, std::vector<std::string>& notes) {
  weld(mesh);
  const auto as_read = mesh.triangles;
  drop_degenerate_and_duplicate(mesh, notes);
  require_closed(mesh);
  orient(mesh, notes);
  require_simple(mesh, as_read);
  drop_slivers(mesh, notes);
  return mesh;
}

struct Mended {
  SurfaceMesh raw, whole;
  std::vector<std::string> notes;
};

bool same(const SurfaceMesh& a, const SurfaceMesh& b) {
  return a.points == b.points && a.triangles == b.triangles && a.segments == b.segments;
}

}  // namespace

std::string read_bytes(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) fail(file, "is a folder, not a mesh");
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, std::string("cannot be read: ") + std::strerror(errno));
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad()) fail(file, "cannot be read to its end");
  if (bytes.empty()) fail(file, "is empty (0 bytes), not a mesh");
  return bytes;
}

}  // namespace mesh

// The last mesh that was mended is kept: distance, surface and mass of a solid are made from one file, and the search
// for self-intersections takes longer than all else.
SurfaceMesh read_closed_mesh(const std::filesystem::path& file, std::vector<std::string>& notes) {
  static thread_local mesh::Mended last;
  SurfaceMesh raw = mesh::parse(file);
  if (!mesh::same(raw, last.raw)) {
    last = {};
    mesh::Mended now{raw, {}, {}};
    try {
      now.whole = mesh::mend(std::move(raw), now.notes);
    } catch (const Error& e) {
      throw Error(e.code(), file.string() + ": " + e.what());
    }
    last = std::move(now);
  }
  for (const std::string& note : last.notes) notes.push_back(file.string() + ": " + note);
  return last.whole;
}

Vec3 mesh_extent(const std::filesystem::path& file) {
  const SurfaceMesh mesh = mesh::parse(file);
  Vec3 lower = mesh.points[mesh.triangles[0][0]], upper = lower;
  for (const auto& t : mesh.triangles) {
    for (const int corner : t) {
      lower = lower.cwiseMin(mesh.points[corner]);
      upper = upper.cwiseMax(mesh.points[corner]);
    }
  }
  return upper - lower;
}

}  // namespace seiche
