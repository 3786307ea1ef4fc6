// STL, text and binary. Ignores the file's normals: the order of the corners and later checks determine orientation.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "geometry/mesh/formats.h"

namespace seiche::mesh {
namespace {

constexpr std::size_t header_size = 84, record_size = 50;

std::uint32_t little_endian(const char* bytes) {
  std::array<unsigned char, 4> b;
  std::memcpy(b.data(), bytes, 4);
  return std::uint32_t(b[0]) | std::uint32_t(b[1]) << 8 | std::uint32_t(b[2]) << 16 | std::uint32_t(b[3]) << 24;
}

void add_triangle(SurfaceMesh& mesh) {
  const int n = int(mesh.points.size());
  mesh.triangles.push_back({n - 3, n - 2, n - 1});
}

SurfaceMesh parse_binary(const Source& source) {
  const std::size_t size = source.bytes.size();
  if (size < header_size) {
    fail_at_byte(source, size, fmt::format("the file ends within the STL header of {} bytes", header_size));
  }
  const std::uint64_t count = little_endian(source.bytes.data() + 80);
  const std::uint64_t needed = header_size + count * record_size;
  if (needed > size) {
    fail_at_byte(source, 80,
                 fmt::format("{} triangles take {} bytes, but the file has {}; it is truncated or damaged", count,
                             needed, size));
  }
  if (count * 3 > max_points) fail_at_byte(source, 80, "more than 2^31-1 points");
  SurfaceMesh mesh;
  for (std::uint64_t t = 0; t < count; ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t at = header_size + t * record_size + 12 + corner * 12;
      Vec3 p;
      for (std::size_t a = 0; a < 3; ++a) p[a] = std::bit_cast<float>(little_endian(&source.bytes[at + 4 * a]));
      if (!p.allFinite()) fail_at_byte(source, at, fmt::format("a point of triangle {} is not finite", t));
      mesh.points.push_back(p);
    }
    add_triangle(mesh);
  }
  return mesh;
}

struct TextReader {
  const Source& source;
  Tokens words;
};

void expect(TextReader& reader, std::string_view keyword) {
  const std::string_view word = reader.words.next();
  if (word == keyword) return;
  fail_at_line(reader.source, reader.words.line(),
               word.empty() ? fmt::format("the file ends where '{}' belongs; it is truncated", keyword)
                            : fmt::format("'{}' stands where '{}' belongs", word.substr(0, 20), keyword));
}

double read_number(TextReader& reader) {
  const std::string_view word = reader.words.next();
  const std::optional<double> value = to_double(word);
  if (!value || !std::isfinite(*value)) {
    fail_at_line(reader.source, reader.words.line(),
                 fmt::format("'{}' stands where a finite coordinate belongs", word.substr(0, 20)));
  }
  return *value;
}

void read_facet(TextReader& reader, SurfaceMesh& mesh) {
  expect(reader, "normal");
  for (int a = 0; a < 3; ++a) reader.words.next();
  expect(reader, "outer");
  expect(reader, "loop");
  for (int corner = 0; corner < 3; ++corner) {
    expect(reader, "vertex");
    Vec3 p;
    for (int a = 0; a < 3; ++a) p[a] = read_number(reader);
    mesh.points.push_back(p);
  }
  add_triangle(mesh);
  expect(reader, "endloop");
  expect(reader, "endfacet");
}

void read_solid(TextReader& reader, SurfaceMesh& mesh) {
  for (std::string_view word = reader.words.next(); word != "endsolid"; word = reader.words.next()) {
    if (word != "facet") {
      fail_at_line(reader.source, reader.words.line(),
                   word.empty() ? "the file ends before 'endsolid'; it is truncated"
                                : fmt::format("'{}' stands where 'facet' or 'endsolid' belongs", word.substr(0, 20)));
    }
    read_facet(reader, mesh);
  }
}

SurfaceMesh parse_text(const Source& source) {
  TextReader reader{source, Tokens(source.bytes)};
  SurfaceMesh mesh;
  for (std::string_view word = reader.words.next(); !word.empty(); word = reader.words.next()) {
    if (word != "solid") fail_at_line(source, reader.words.line(), "'solid' belongs here");
    reader.words.rest_of_line();  // the name
    read_solid(reader, mesh);
    reader.words.rest_of_line();
  }
  return mesh;
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() >= header_size) {
    const std::uint64_t count = little_endian(bytes.data() + 80);
    if (bytes.size() == header_size + count * record_size) return true;
  }
  return bytes.substr(0, 5) != "solid" || bytes.substr(0, 1024).find('\0') != std::string_view::npos;
}

SurfaceMesh parse_stl(const Source& source) {
  return is_binary_stl(source.bytes) ? parse_binary(source) : parse_text(source);
}

}  // namespace seiche::mesh
