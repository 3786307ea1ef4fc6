// PLY: text, little and big endian. Skips elements other than points and faces.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "geometry/mesh/formats.h"

namespace seiche::mesh {
namespace {

enum class Encoding { text, little_endian, big_endian };
enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct TypeName {
  std::string_view name;
  Type type;
};
constexpr std::array<TypeName, 16> type_names{{{"char", Type::int8},
                                               {"int8", Type::int8},
                                               {"uchar", Type::uint8},
                                               {"uint8", Type::uint8},
                                               {"short", Type::int16},
                                               {"int16", Type::int16},
                                               {"ushort", Type::uint16},
                                               {"uint16", Type::uint16},
                                               {"int", Type::int32},
                                               {"int32", Type::int32},
                                               {"uint", Type::uint32},
                                               {"uint32", Type::uint32},
                                               {"float", Type::float32},
                                               {"float32", Type::float32},
                                               {"double", Type::float64},
                                               {"float64", Type::float64}}};

constexpr std::size_t size_of(Type type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[std::size_t(type)];
}

struct Property {
  std::string name;
  Type type = Type::float32;
  std::optional<Type> count;  // set for lists
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  std::optional<Encoding> encoding;
  std::vector<Element> elements;
  std::size_t lines = 0;
  std::size_t bytes = 0;
};

Type read_type(const Source& source, std::size_t line, std::string_view word) {
  for (const TypeName& t : type_names) {
    if (word == t.name) return t.type;
  }
  fail_at_line(source, line,
               fmt::format("'{}' is not a PLY type (int, uchar, float, double, ...)", word.substr(0, 20)));
}

Encoding read_encoding(const Source& source, std::size_t line, std::string_view word) {
  if (word == "ascii") return Encoding::text;
  if (word == "binary_little_endian") return Encoding::little_endian;
  if (word == "binary_big_endian") return Encoding::big_endian;
  fail_at_line(source, line, fmt::format("'{}' is not a PLY format", word.substr(0, 30)));
}

Element read_element(const Source& source, std::size_t line, Tokens words) {
  Element element;
  element.name = words.next();
  const std::string_view word = words.next();
  const std::optional<long long> count = to_integer(word);
  if (!count || *count < 0) {
    fail_at_line(source, line, fmt::format("'{}' is not a count of elements", word.substr(0, 30)));
  }
  element.count = std::uint64_t(*count);
  return element;
}

Property read_property(const Source& source, std::size_t line, Tokens words) {
  Property property;
  std::string_view word = words.next();
  if (word == "list") {
    property.count = read_type(source, line, words.next());
    word = words.next();
  }
  property.type = read_type(source, line, word);
  property.name = words.next();
  return property;
}

// Returns false at the end of the header.
bool read_header_line(const Source& source, std::size_t line, Tokens words, Header& header) {
  const std::string_view key = words.next();
  if (key == "end_header") return false;
  if (key == "format") {
    header.encoding = read_encoding(source, line, words.next());
  } else if (key == "element") {
    header.elements.push_back(read_element(source, line, words));
  } else if (key == "property" && !header.elements.empty()) {
    header.elements.back().properties.push_back(read_property(source, line, words));
  } else if (key != "comment" && key != "obj_info" && key != "ply" && !key.empty()) {
    fail_at_line(source, line, fmt::format("'{}' does not belong in a PLY header", key.substr(0, 20)));
  }
  return true;
}

Header read_header(const Source& source) {
  Header header;
  Tokens text(source.bytes);
  bool more = true;
  while (more) {
    if (text.at_end()) fail_at_line(source, text.line(), "the file ends before 'end_header'; it is truncated");
    const std::size_t line = text.line();
    more = read_header_line(source, line, Tokens(text.rest_of_line()), header);
  }
  if (!header.encoding) fail_at_line(source, 2, "the PLY header has no 'format' line");
  header.lines = text.line();
  header.bytes = source.bytes.size() - text.bytes_left();
  return header;
}

// Reads the numbers of the body one by one, in any of the encodings.
class Body {
 public:
  Body(const Source& source, const Header& header)
      : source_(source),
        encoding_(*header.encoding),
        at_(header.bytes),
        words_(std::string_view(source.bytes).substr(header.bytes), header.lines) {}

  double next(Type type) { return encoding_ == Encoding::text ? next_word() : next_bytes(type); }

  // Fails unless `count` items of `size` bytes (in text: at least two characters) fit in the rest of the file.
  void require(std::uint64_t count, std::size_t size, std::string_view what) const {
    const bool text = encoding_ == Encoding::text;
    const std::size_t left = text ? words_.bytes_left() + 1 : source_.bytes.size() - at_;
    if (count <= left / (text ? 2 : std::max<std::size_t>(size, 1))) return;
    fail(fmt::format("{} {} do not fit in the {} bytes left; the file is truncated or damaged", count, what, left));
  }

  [[noreturn]] void fail(const std::string& message) const {
    if (encoding_ == Encoding::text) fail_at_line(source_, words_.line(), message);
    fail_at_byte(source_, at_, message);
  }

 private:
  double next_word() {
    const std::string_view word = words_.next();
    if (word.empty()) fail("the file ends within its data; it is truncated");
    const std::optional<double> value = to_double(word);
    if (!value) fail(fmt::format("'{}' is not a number", word.substr(0, 20)));
    return *value;
  }

  double next_bytes(Type type) {
    const std::size_t size = size_of(type);
    if (source_.bytes.size() - at_ < size) fail("the file ends within its data; it is truncated");
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t place = encoding_ == Encoding::little_endian ? i : size - 1 - i;
      bits |= std::uint64_t(static_cast<unsigned char>(source_.bytes[at_ + i])) << (8 * place);
    }
    at_ += size;
    return value_of(type, bits);
  }

  static double value_of(Type type, std::uint64_t bits) {
    switch (type) {
      case Type::int8:
        return std::int8_t(bits);
      case Type::int16:
        return std::int16_t(bits);
      case Type::int32:
        return std::int32_t(bits);
      case Type::float32:
        return std::bit_cast<float>(std::uint32_t(bits));
      case Type::float64:
        return std::bit_cast<double>(bits);
      default:
        return double(bits);
    }
  }

  const Source& source_;
  Encoding encoding_;
  std::size_t at_;
  Tokens words_;
};

// Smallest size of an element in bytes: its scalars and the counts of its lists.
std::size_t least_size(const Element& element) {
  std::size_t size = 0;
  for (const Property& p : element.properties) size += size_of(p.count.value_or(p.type));
  return size;
}

std::vector<double> read_list(Body& body, const Property& property) {
  const double count = body.next(*property.count);
  if (!(count >= 0 && count <= 1e9)) body.fail(fmt::format("a list of {:g} entries", count));
  body.require(std::uint64_t(count), size_of(property.type), "list entries");
  std::vector<double> list(static_cast<std::size_t>(count));
  for (double& entry : list) entry = body.next(property.type);
  return list;
}

void read_point(Body& body, const Element& element, SurfaceMesh& mesh) {
  Vec3 p = Vec3::Constant(std::nan(""));
  for (const Property& property : element.properties) {
    if (property.count) {
      read_list(body, property);
      continue;
    }
    const double value = body.next(property.type);
    const std::size_t axis = std::string_view("xyz").find(property.name);
    if (property.name.size() == 1 && axis < 3) p[Eigen::Index(axis)] = value;
  }
  if (!p.allFinite()) body.fail(fmt::format("point {} has no three finite coordinates x, y, z", mesh.points.size()));
  mesh.points.push_back(p);
}

void add_face(const Body& body, const std::vector<double>& corners, std::uint64_t points, SurfaceMesh& mesh) {
  if (corners.size() < 3) body.fail(fmt::format("a face of {} points; it takes 3 or more", corners.size()));
  for (const double corner : corners) {
    if (corner >= 0 && corner < double(points) && corner == std::floor(corner)) continue;
    body.fail(fmt::format("a face uses point {:.0f}; the file has the points 0 to {}", corner, points - 1));
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    mesh.triangles.push_back({int(corners[0]), int(corners[i - 1]), int(corners[i])});
  }
}

void read_elements(Body& body, const Element& element, std::uint64_t points, SurfaceMesh& mesh) {
  body.require(element.count, least_size(element), "elements '" + element.name + "'");
  if (element.name == "vertex" && element.count > max_points) body.fail("more than 2^31-1 points");
  for (std::uint64_t i = 0; i < element.count; ++i) {
    if (element.name == "vertex") {
      read_point(body, element, mesh);
      continue;
    }
    for (const Property& property : element.properties) {
      if (!property.count) {
        body.next(property.type);
        continue;
      }
      const std::vector<double> list = read_list(body, property);
      const bool is_face = property.name == "vertex_indices" || property.name == "vertex_index";
      if (element.name == "face" && is_face) add_face(body, list, points, mesh);
    }
  }
}

}  // namespace

SurfaceMesh parse_ply(const Source& source) {
  const Header header = read_header(source);
  std::uint64_t points = 0;
  for (const Element& e : header.elements) points = e.name == "vertex" ? e.count : points;
  Body body(source, header);
  SurfaceMesh mesh;
  for (const Element& element : header.elements) read_elements(body, element, points, mesh);
  if (mesh.points.size() != points) fail_at_line(source, 1, "the header lists the points twice");
  return mesh;
}

}  // namespace seiche::mesh
