#pragma once
// The readers behind read_closed_mesh(): bytes of a file to points and triangles, trusting nothing the file says.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "geometry/mesh/mesh.h"

namespace seiche::mesh {

// A file being read: its bytes and its name for messages.
struct Source {
  std::filesystem::path file;
  std::string bytes;
};

// All of a file. Throws Error(bad_input) if it cannot be read or is empty.
std::string read_bytes(const std::filesystem::path& file);

// Each throws Error(bad_input) naming the line or byte where the file is wrong. Polygons become fans of triangles.
SurfaceMesh parse_obj(const Source& source);
SurfaceMesh parse_ply(const Source& source);
SurfaceMesh parse_stl(const Source& source);

// Whether these are the bytes of a binary STL: no text, or exactly as long as its count of triangles says.
bool is_binary_stl(std::string_view bytes);

// "bunny.obj:12: message" and "bunny.stl: byte 84: message".
[[noreturn]] void fail_at_line(const Source& source, std::size_t line, const std::string& message);
[[noreturn]] void fail_at_byte(const Source& source, std::size_t byte, const std::string& message);

// Whole-token numbers, whatever the locale; empty if the token is something else or does not fit.
std::optional<double> to_double(std::string_view token);
std::optional<long long> to_integer(std::string_view token);

// Splits text into tokens at white space, counting lines from 1.
class Tokens {
 public:
  explicit Tokens(std::string_view text, std::size_t first_line = 1) : rest_(text), line_(first_line) {}
  // The next token; empty at the end.
  std::string_view next();
  // The rest of the current line, whose end is consumed.
  std::string_view rest_of_line();
  bool at_end() const { return rest_.empty(); }
  std::size_t line() const { return line_; }
  std::size_t bytes_left() const { return rest_.size(); }

 private:
  std::string_view rest_;
  std::size_t line_;
};

// Points as indices take at most this many.
constexpr std::size_t max_points = 2147483647;

}  // namespace seiche::mesh
