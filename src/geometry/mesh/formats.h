#pragma once
// The readers behind read_closed_mesh(). They turn bytes into points and triangles and validate everything they read.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace seiche::mesh {

// A file being read: its bytes and its name for messages.
struct Source {
  std::filesystem::path file;
  std::string bytes;
};

// The whole contents of a file. Throws Error(bad_input) if it cannot be read or is empty.
std::string read_bytes(const std::filesystem::path& file);

// Parse the points and triangles of a file. Polygons become fans of triangles. Throw Error(bad_input) naming the
// offending line or byte.
SurfaceMesh parse_obj(const Source& source);
SurfaceMesh parse_ply(const Source& source);
SurfaceMesh parse_stl(const Source& source);

// Parse closed polylines in the plane z = 0: the lines (l) of an OBJ file, or rows of x and y.
SurfaceMesh parse_obj_lines(const Source& source);
SurfaceMesh parse_rows_of_points(const Source& source);

// True for binary STL: the length agrees with its count of triangles, or the bytes are not text that begins with
// "solid".
bool is_binary_stl(std::string_view bytes);

// Throw Error(bad_input) "bunny.obj:12: message" or "bunny.stl: byte 84: message".
[[noreturn]] void fail_at_line(const Source& source, std::size_t line, const std::string& message);
[[noreturn]] void fail_at_byte(const Source& source, std::size_t byte, const std::string& message);

// Numbers that make up the whole token, independent of the locale. Empty if the token is no number or out of range.
std::optional<double> to_double(std::string_view token);
std::optional<long long> to_integer(std::string_view token);

// Parts of a row of a table between commas, semicolons and white space; several of these count as one.
std::vector<std::string_view> parts_of_row(std::string_view row);

// Splits text into tokens at white space, counting lines from 1.
class Tokens {
 public:
  explicit Tokens(std::string_view text, std::size_t first_line = 1) : rest_(text), line_(first_line) {}
  // The next token; empty at the end.
  std::string_view next();
  // The rest of the current line; consumes the end of the line.
  std::string_view rest_of_line();
  bool at_end() const { return rest_.empty(); }
  std::size_t line() const { return line_; }
  std::size_t bytes_left() const { return rest_.size(); }

 private:
  std::string_view rest_;
  std::size_t line_;
};

// Largest number of points, since indices are int.
constexpr std::size_t max_points = 2147483647;

}  // namespace seiche::mesh
