// Element meshes in VTK's XML format in each of its encodings; lying and damaged ones refused in words.
#include <catch2/catch.hpp>

#include <cstring>
#include <limits>
#include <random>

#include "base/base64.h"
#include "base/error.h"
#include "solid/mesh/file.h"

namespace elastic_mesh_vtu_tests {
using namespace seiche;
using Catch::Matchers::Contains;

namespace {

enum class Encoding { ascii, base64, base64_apart, appended_raw, appended_base64 };
enum class Header { uint32, uint64 };
constexpr Encoding encodings[] = {Encoding::ascii, Encoding::base64, Encoding::base64_apart, Encoding::appended_raw,
                                  Encoding::appended_base64};

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// Writes two tetrahedra, (0 1 2 3) and (1 2 3 4).
struct Writer {
  Encoding encoding;
  Header header = Header::uint64;
  std::string root{}, appended{};  // further attributes of the root; appended data

  std::string length(std::size_t bytes) const {
    if (header == Header::uint32) return bytes_of<std::uint32_t>({std::uint32_t(bytes)});
    return bytes_of<std::uint64_t>({bytes});
  }

  // Text of an array in the file, or its bytes appended.
  template <class T>
  std::string array(const std::string& name, const std::string& type, const std::vector<T>& values) {
    const std::string bytes = bytes_of(values), front = length(bytes.size());
    std::string text = "<DataArray type=\"" + type + "\" Name='" + name + "' format=";
    if (encoding == Encoding::ascii) {
      text += "\"ascii\">\n";
      for (const T& value : values) text += std::to_string(value) + "\n";
    } else if (encoding == Encoding::base64) {
      text += "\"binary\">\n  " + encode_base64(front + bytes) + "\n  <InformationKey name=\"note\"/>\n";
    } else if (encoding == Encoding::base64_apart) {
      text += "\"binary\">" + encode_base64(front) + encode_base64(bytes);
    } else {
      text += "\"appended\" offset=\"" + std::to_string(appended.size()) + "\">";
      appended += encoding == Encoding::appended_raw ? front + bytes : encode_base64(front + bytes);
    }
    return text + "</DataArray>\n";
  }

  std::string file(const std::string& points, const std::string& cells) const {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" " + root;
    if (header == Header::uint64) text += " header_type=\"UInt64\"";
    text += " byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n";
    text += "<!-- two tetrahedra -->\n<Points>" + points + "</Points>\n<Cells>" + cells +
            "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
    if (!appended.empty()) {
      const char* name = encoding == Encoding::appended_raw ? "raw" : "base64";
      text += std::string("<AppendedData encoding=\"") + name + "\">\n  _" + appended + "\n</AppendedData>\n";
    }
    return text + "</VTKFile>\n";
  }

  template <class Coordinate, class Index, class Type>
  std::string tetrahedra(const char* coordinate, const char* index, const char* type) {
    const std::string points =
        array<Coordinate>("Points", coordinate, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, Coordinate(1.5)});
    return file(points, array<Index>("connectivity", index, {0, 1, 2, 3, 1, 2, 3, 4}) +
                            array<Index>("offsets", index, {4, 8}) + array<Type>("types", type, {10, 10}));
  }
  std::string tetrahedra() { return tetrahedra<double, std::int64_t, std::uint8_t>("Float64", "Int64", "UInt8"); }
};

elastic::RawMesh parse(const std::string& bytes) {
  return elastic::parse_vtu({"mesh.vtu", bytes});
}

void expect_tetrahedra(const elastic::RawMesh& mesh) {
  REQUIRE(mesh.points.size() == 5);
  CHECK(mesh.points[2] == Vec3(0, 1, 0));
  CHECK(mesh.points[4] == Vec3(1, 1, 1.5));
  CHECK(mesh.cells[int(elastic::CellKind::tetrahedron)] == std::vector<int>{0, 1, 2, 3, 1, 2, 3, 4});
  CHECK(mesh.others == 0);
}

void expect_refused(const std::string& bytes, const std::string& words) {
  INFO(words);
  try {
    parse(bytes);
    FAIL("not refused");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::bad_input);
    CHECK_THAT(error.what(), Contains("mesh.vtu:") && Contains(words));
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

// The base64 mesh with another text in its array of types.
std::string with_types(const std::string& letters) {
  Writer writer{Encoding::base64};
  const std::string types = encode_base64(writer.length(2) + bytes_of<std::uint8_t>({10, 10}));
  return replaced(writer.tetrahedra(), types, letters);
}

}  // namespace

TEST_CASE("Meshes of VTK are read in every encoding, with numbers of any type", "[elastic]") {
  for (const Encoding encoding : encodings) {
    for (const Header header : {Header::uint32, Header::uint64}) {
      INFO(int(encoding) << " " << int(header));
      const Writer writer{encoding, header};
      expect_tetrahedra(parse(Writer(writer).tetrahedra()));
      expect_tetrahedra(parse(Writer(writer).tetrahedra<float, std::int32_t, int>("Float32", "Int32", "Int32")));
      expect_tetrahedra(
          parse(Writer(writer).tetrahedra<double, std::uint64_t, std::uint16_t>("Float64", "UInt64", "UInt16")));
    }
  }
}

TEST_CASE("Text arrays are read whatever the file says of binary ones, and raw data may look like XML", "[elastic]") {
  expect_tetrahedra(
      parse(Writer{Encoding::ascii, Header::uint32, "compressor=\"vtkZLibDataCompressor\""}.tetrahedra()));
  Writer writer{Encoding::appended_raw};
  std::string bytes = writer.tetrahedra();
  bytes.insert(bytes.rfind("</AppendedData>"), "<Piece> </VTKFile> <<< & \"");
  expect_tetrahedra(parse(bytes));
}

TEST_CASE("Compressed and big-endian meshes, and other data sets, are refused", "[elastic]") {
  const std::string compressor = "compressor=\"vtkZLibDataCompressor\"";
  for (const Encoding encoding : encodings) {
    if (encoding == Encoding::ascii) continue;
    const std::string bytes = Writer{encoding, Header::uint64, compressor}.tetrahedra();
    expect_refused(bytes, ":6: array 'Points' is compressed (vtkZLibDataCompressor); save without compression");
    expect_refused(replaced(Writer{encoding}.tetrahedra(), "LittleEndian", "BigEndian"), "save as little-endian");
  }
  const std::string good = Writer{Encoding::base64}.tetrahedra();
  expect_refused(replaced(good, "UnstructuredGrid", "PolyData"), ":2: is no VTK unstructured grid");
  expect_refused(replaced(good, "\"UInt64\"", "\"UInt16\""), "header_type 'UInt16'");
  expect_refused(replaced(good, "\"binary\"", "\"hex\""), "unknown format 'hex'");
  expect_refused(replaced(good, "</Piece>", "</Piece>\n<Piece></Piece>"), "has several pieces");
  expect_refused(replaced(good, "'offsets'", "'ends'"), ":4: <Cells> has no array 'offsets'");
  expect_refused(replaced(good, "\"Int64\"", "\"Float64\""), "array 'connectivity' has numbers of type 'Float64'");
  expect_refused(replaced(Writer{Encoding::appended_raw}.tetrahedra(), "\"raw\"", "\"hex\""), "encoding 'hex'");
}

TEST_CASE("Binary arrays of a mesh that are damaged or lie are refused", "[elastic]") {
  const auto types = [](std::uint64_t length, const std::string& bytes) {
    return with_types(encode_base64(bytes_of<std::uint64_t>({length}) + bytes));
  };
  expect_tetrahedra(parse(types(2, "\n\n")));
  expect_refused(types(3, "\n\n"), "array 'types' is ");
  expect_refused(types(std::numeric_limits<std::uint64_t>::max(), "\n\n"), "array 'types' is cut short");
  expect_refused(types(std::uint64_t(1) << 40, "\n\n"), "array 'types' is cut short");
  expect_refused(types(2, std::string(8, '\n')), "is longer than its header says");
  expect_refused(types(1, "\n"), "there are not as many types as offsets");
  for (const char* letters :
       {"", "AgAA", "Ag*AAAAAAAAKCg==", "AgAAAAAAAAAK-g==", "AgAAAAAAAAAKCg=", "====AAAAAAAAAAAA"})
    expect_refused(with_types(letters), "array 'types' is ");
  const std::string raw = Writer{Encoding::appended_raw}.tetrahedra();
  expect_refused(replaced(raw, "offset=\"0\"", "offset=\"9999\""), "array 'Points' lies beyond the end of the file");
  expect_refused(replaced(raw, "offset=\"0\"", "offset=\"-1\""), "lies beyond the end of the file");
  expect_refused(replaced(raw, "offset=\"0\"", "offset=\"1\""), "there is no node 0");
  expect_refused(replaced(raw, "\n  _", "\n  "), "do not begin with an underscore");
  expect_refused(raw.substr(0, raw.find("  _") + 50), "array 'Points' is cut short");
  expect_refused(raw.substr(0, raw.find("<AppendedData") + 5), "is cut short");
  const std::string far = replaced(Writer{Encoding::ascii}.tetrahedra(), "</Cells>", "</Cells>\n");
  expect_refused(replaced(far, "4\n</DataArray>", "5\n</DataArray>"), "there is no node 5");
  expect_refused(replaced(far, "1.500000", "1.5 x"), ":21: no number: x");
  expect_refused(replaced(far, "1.500000", ""), ":6: three numbers a point are wanted");
}

TEST_CASE("Numbers that are too large for an index are refused", "[elastic]") {
  Writer writer{Encoding::base64};
  const std::string points = writer.array<double>("Points", "Float64", std::vector<double>(15, 0.0));
  const auto with = [&](std::uint64_t node, std::uint64_t end) {
    return writer.file(points, writer.array<std::uint64_t>("connectivity", "UInt64", {0, 1, 2, node}) +
                                   writer.array<std::uint64_t>("offsets", "UInt64", {end}) +
                                   writer.array<std::uint8_t>("types", "UInt8", {10}));
  };
  CHECK(parse(with(4, 4)).cells[int(elastic::CellKind::tetrahedron)].size() == 4);
  expect_refused(with(std::uint64_t(1) << 63, 4), "array 'connectivity' has a number that is too large");
  expect_refused(with(std::uint64_t(1) << 32, 4), "there is no node 4294967296");
  expect_refused(with(4, std::uint64_t(1) << 40), "an offset is out of range");
}

// Cut anywhere and with bytes changed anywhere: read or refused in words, and nothing else.
TEST_CASE("Mutated binary meshes are read or refused", "[elastic]") {
  std::mt19937 random(11);
  int refused = 0, tried = 0;
  for (const Encoding encoding : encodings) {
    const std::string bytes = Writer{encoding}.tetrahedra();
    for (int i = 0; i < 400; ++i, ++tried) {
      std::string wrong = i % 2 ? bytes : bytes.substr(0, random() % bytes.size());
      for (int k = 0; i % 2 && k < 3; ++k) wrong[random() % wrong.size()] = char(random());
      try {
        parse(wrong);
      } catch (const Error& e) {
        CHECK(e.code() == ExitCode::bad_input);
        ++refused;
      }
    }
  }
  WARN("binary meshes cut or changed: " << refused << " of " << tried << " refused");
  CHECK(2 * refused > tried);
}

}  // namespace elastic_mesh_vtu_tests
