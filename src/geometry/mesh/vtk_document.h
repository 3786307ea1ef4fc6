#pragma once
// Arrays of VTK's XML files for unstructured grids (VTK file formats), for frames and for meshes of users: ASCII,
// inline base64, appended raw or base64; not compressed, little-endian. The adapter of pugixml.
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh/formats.h"

namespace seiche::mesh {

// An array where it stands, not decoded.
struct VtkArray {
  std::string section;                     // Points, Cells, PointData, CellData or FieldData
  std::string name, type, format, offset;  // as the attributes say; "ascii" without a format
  std::size_t byte = 0, text_byte = 0;     // of its tag and of its text in the file
  std::string_view text{};                 // between its tags
};

enum class VtkEncoding { raw, base64 };

// A view of the bytes of `source`, which must outlive it.
struct VtkDocument {
  const Source& source;
  std::string_view appended{};  // after the underscore
  VtkEncoding appended_encoding = VtkEncoding::base64;
  std::size_t header_bytes = 4;  // of the length before each binary array
  std::string compressor{};      // "" for none
  bool big_endian = false;
  std::size_t piece_byte = 0;
  std::vector<VtkArray> arrays{};
};

// Throws Error(bad_input) that names the file and the line of this byte.
[[noreturn]] void fail_in_line_of(const Source& source, std::size_t byte, const std::string& message);
std::size_t line_of(const Source& source, std::size_t byte);

// Lists the arrays of an unstructured grid of one piece. Throws Error(bad_input) naming file and line, as all below.
VtkDocument parse_vtk(const Source& source);

// First array of this section and name ("" for any name); null without one.
const VtkArray* find_array(const VtkDocument& document, const std::string& section, const std::string& name);

// Numbers of an array, which never take more memory than its bytes in the file justify. Integers are exact.
std::vector<double> read_numbers(const VtkDocument& document, const VtkArray& array);
std::vector<long long> read_integers(const VtkDocument& document, const VtkArray& array);

}  // namespace seiche::mesh
