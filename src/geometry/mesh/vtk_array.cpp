// Decodes the arrays of a VTK document.
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/base64.h"
#include "base/error.h"
#include "geometry/mesh/vtk_document.h"

namespace seiche::mesh {
namespace {

[[noreturn]] void fail(const VtkDocument& document, const VtkArray& array, const std::string& message) {
  const std::string& name = array.name.empty() ? array.section : array.name;
  fail_in_line_of(document.source, array.byte, "array '" + name + "' " + message);
}

constexpr const char* beyond_length = "is longer than its header says";

std::string without_white_space(std::string_view text) {
  std::string rest;
  rest.reserve(text.size());
  for (const char c : text) {
    if (c != ' ' && c != '\t' && c != '\r' && c != '\n') rest += c;
  }
  return rest;
}

// Length of the data, in bytes, that the header announces.
std::uint64_t announced(std::string_view header) {
  std::uint64_t length = 0;
  std::memcpy(&length, header.data(), header.size());
  return length;
}

std::string decode(const VtkDocument& document, const VtkArray& array, std::string_view text) {
  auto bytes = decode_base64(text);
  if (!bytes) fail(document, array, "is no base64, or is cut short");
  return *std::move(bytes);
}

// Bytes of an array from the start of `text`, which may go on behind it. Header and data are encoded together, or each
// with padding of its own.
std::string bytes_of_base64(const VtkDocument& document, const VtkArray& array, std::string_view& text) {
  const std::size_t header = document.header_bytes, letters = base64_length(header);
  if (text.size() < letters) fail(document, array, "is cut short");
  const std::string start = decode(document, array, text.substr(0, letters));
  if (start.size() < header) fail(document, array, "is cut short");
  const bool apart = start.size() == header;  // padded: neither 4 nor 8 bytes fill their letters
  const std::uint64_t length = announced(std::string_view(start).substr(0, header));
  if (length > text.size()) fail(document, array, "is cut short");
  const std::uint64_t expected = length + (apart ? 0 : header);
  const std::size_t first = apart ? letters : 0, total = base64_length(expected);
  if (total > text.size() - first) fail(document, array, "is cut short");
  const std::string bytes = decode(document, array, text.substr(first, total));
  text.remove_prefix(first + total);
  if (bytes.size() < expected) fail(document, array, "is shorter than its header says");
  if (bytes.size() > expected) fail(document, array, beyond_length);
  return apart ? bytes : bytes.substr(header);
}

std::string bytes_inline(const VtkDocument& document, const VtkArray& array) {
  const std::string letters = without_white_space(array.text);
  std::string_view rest = letters;
  std::string bytes = bytes_of_base64(document, array, rest);
  if (!rest.empty()) fail(document, array, beyond_length);
  return bytes;
}

std::string bytes_appended(const VtkDocument& document, const VtkArray& array) {
  const auto offset = to_integer(array.offset);
  if (!offset || *offset < 0 || std::uint64_t(*offset) >= document.appended.size()) {
    fail(document, array, "lies beyond the end of the file");
  }
  std::string_view rest = document.appended.substr(std::size_t(*offset));
  if (document.appended_encoding == VtkEncoding::base64) return bytes_of_base64(document, array, rest);
  const std::size_t header = document.header_bytes;
  if (rest.size() < header) fail(document, array, "is cut short");
  const std::uint64_t length = announced(rest.substr(0, header));
  if (length > rest.size() - header) fail(document, array, "is cut short");
  return std::string(rest.substr(header, length));
}

std::string bytes_of(const VtkDocument& document, const VtkArray& array) {
  if (!document.compressor.empty()) {
    fail(document, array, "is compressed (" + document.compressor + "); save without compression");
  }
  if (document.big_endian) fail(document, array, "has big-endian numbers; save as little-endian");
  if (array.format == "binary") return bytes_inline(document, array);
  if (array.format == "appended") return bytes_appended(document, array);
  fail(document, array, "has the unknown format '" + array.format + "'");
}

// Numbers of type T, as type Number; those that it cannot hold are refused.
template <class T, class Number>
std::vector<Number> convert(const VtkDocument& document, const VtkArray& array, const std::string& bytes) {
  if (bytes.size() % sizeof(T) != 0) fail(document, array, "ends within a number");
  std::vector<Number> numbers(bytes.size() / sizeof(T));
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    T value;
    std::memcpy(&value, bytes.data() + n * sizeof(T), sizeof(T));
    if constexpr (std::is_integral_v<Number>) {
      if (!std::in_range<Number>(value)) fail(document, array, "has a number that is too large");
    }
    numbers[n] = Number(value);
  }
  return numbers;
}

// Integers of the type that the array names.
template <class Number>
std::vector<Number> convert_integers(const VtkDocument& document, const VtkArray& array, const std::string& bytes) {
  const std::string& type = array.type;
  if (type == "Int64") return convert<std::int64_t, Number>(document, array, bytes);
  if (type == "Int32") return convert<std::int32_t, Number>(document, array, bytes);
  if (type == "Int16") return convert<std::int16_t, Number>(document, array, bytes);
  if (type == "Int8") return convert<std::int8_t, Number>(document, array, bytes);
  if (type == "UInt64") return convert<std::uint64_t, Number>(document, array, bytes);
  if (type == "UInt32") return convert<std::uint32_t, Number>(document, array, bytes);
  if (type == "UInt16") return convert<std::uint16_t, Number>(document, array, bytes);
  if (type == "UInt8" || type == "String") return convert<std::uint8_t, Number>(document, array, bytes);
  fail(document, array, "has numbers of type '" + type + "'");
}

template <class Number>
std::vector<Number> parse(const VtkDocument& document, const VtkArray& array,
                          std::optional<Number> (*number_of)(std::string_view), const char* kind) {
  Tokens tokens(array.text, line_of(document.source, array.text_byte));
  std::vector<Number> numbers;
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    const auto value = number_of(token);
    if (!value) {
      fail_at_line(document.source, tokens.line(), std::string("no ") + kind + ": " + std::string(token.substr(0, 40)));
    }
    numbers.push_back(*value);
  }
  return numbers;
}

}  // namespace

std::vector<double> read_numbers(const VtkDocument& document, const VtkArray& array) {
  if (array.format == "ascii") return parse<double>(document, array, to_double, "number");
  const std::string bytes = bytes_of(document, array);
  if (array.type == "Float64") return convert<double, double>(document, array, bytes);
  if (array.type == "Float32") return convert<float, double>(document, array, bytes);
  return convert_integers<double>(document, array, bytes);
}

std::vector<long long> read_integers(const VtkDocument& document, const VtkArray& array) {
  if (array.format == "ascii") return parse<long long>(document, array, to_integer, "integer");
  return convert_integers<long long>(document, array, bytes_of(document, array));
}

}  // namespace seiche::mesh
