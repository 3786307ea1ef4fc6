#include "solid/mesh/file.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/error.h"

namespace seiche {
namespace elastic {
namespace {

struct Format {
  const char* extension;
  RawMesh (*parse)(const mesh::Source&);
};
constexpr std::array<Format, 3> formats{{{".msh", parse_msh}, {".vtu", parse_vtu}, {".mesh", parse_medit}}};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& message) {
  throw Error(ExitCode::bad_input, file.string() + ": " + message);
}

const Format* format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const auto format = std::find_if(formats.begin(), formats.end(), [&](auto& f) { return extension == f.extension; });
  return format == formats.end() ? nullptr : &*format;
}

RawMesh parse(const std::filesystem::path& file) {
  if (const Format* format = format_of(file)) {
    const mesh::Source source{file, mesh::read_bytes(file)};
    if (source.bytes.rfind("version https://git-lfs", 0) == 0) {
      fail(file, "is a Git LFS pointer, not the mesh itself; fetch it with 'git lfs pull'");
    }
    return format->parse(source);
  }
  fail(file, "the extension '" + file.extension().string() + "' is not a mesh of elements; use .msh, .vtu or .mesh");
}

template <int Dim>
ElasticMesh<Dim> select(const RawMesh& raw, const std::filesystem::path& file, std::vector<std::string>& notes) {
  const auto linear = Dim == 2 ? CellKind::triangle : CellKind::tetrahedron;
  const auto quadratic = Dim == 2 ? CellKind::quadratic_triangle : CellKind::quadratic_tetrahedron;
  const char* name = Dim == 2 ? "triangles" : "tetrahedra";
  const auto &first = raw.cells[int(linear)], &second = raw.cells[int(quadratic)];
  if (first.empty() && second.empty()) fail(file, std::string("holds no ") + name);
  if (!first.empty() && !second.empty())
    fail(file, std::string("holds linear and quadratic ") + name + "; only one can be");
  long long others = raw.others;
  for (int kind = 0; kind < 4; ++kind) {
    if (kind != int(linear) && kind != int(quadratic)) others += raw.cells[kind].size() / nodes_of(CellKind(kind));
  }
  if (others > 0)
    notes.push_back(file.string() + ": left out " + std::to_string(others) + " elements that are no " + name);
  ElasticMesh<Dim> mesh{second.empty() ? 1 : 2, {}, second.empty() ? first : second};
  for (size_t n = 0; n < raw.points.size(); ++n) {
    if (Dim == 2 && raw.points[n][2] != 0)
      fail(file, "node " + std::to_string(n) + " (counted from 0) has z other than 0");
    mesh.nodes.push_back(truncate<Dim>(raw.points[n]));
  }
  return mesh;
}

}  // namespace

double number_token(const mesh::Source& source, mesh::Tokens& tokens) {
  const auto token = tokens.next();
  const auto value = mesh::to_double(token);
  if (value) return *value;
  mesh::fail_at_line(source, tokens.line(),
                     token.empty() ? "the file ends early" : "no number: " + std::string(token.substr(0, 40)));
}

long long integer_token(const mesh::Source& source, mesh::Tokens& tokens) {
  const auto token = tokens.next();
  const auto value = mesh::to_integer(token);
  if (value) return *value;
  mesh::fail_at_line(source, tokens.line(),
                     token.empty() ? "the file ends early" : "no integer: " + std::string(token.substr(0, 40)));
}

long long count_token(const mesh::Source& source, mesh::Tokens& tokens, const char* what) {
  const long long count = integer_token(source, tokens);
  if (count >= 0 && count <= (long long)(tokens.bytes_left() / 2)) return count;
  mesh::fail_at_line(
      source, tokens.line(),
      std::to_string(count) + " " + what + " do not fit into the rest of the file; it is truncated or damaged");
}

}  // namespace elastic

bool holds_elements(const std::filesystem::path& file) {
  return elastic::format_of(file) != nullptr;
}

template <int Dim>
ElasticMesh<Dim> read_elastic_mesh(const std::filesystem::path& file, std::vector<std::string>& notes) {
  ElasticMesh<Dim> mesh = elastic::select<Dim>(elastic::parse(file), file, notes);
  check_mesh(mesh, file.string(), notes);
  return mesh;
}

template ElasticMesh<2> read_elastic_mesh<2>(const std::filesystem::path&, std::vector<std::string>&);
template ElasticMesh<3> read_elastic_mesh<3>(const std::filesystem::path&, std::vector<std::string>&);

}  // namespace seiche
