#include "files/vtu_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "base/error.h"

namespace seiche::render {
namespace {

constexpr int vtk_line = 3, vtk_triangle = 5;

[[noreturn]] void fail(const std::string& what) {
  throw Error(ExitCode::bad_input, what);
}

// One element <name key="value" ...>text</name>.
struct Element {
  std::map<std::string, std::string> attributes;
  std::string_view text;
  std::string attribute(const std::string& key) const {
    const auto found = attributes.find(key);
    return found == attributes.end() ? "" : found->second;
  }
};

std::map<std::string, std::string> parse_attributes(std::string_view tag) {
  std::map<std::string, std::string> attributes;
  for (std::size_t at = tag.find('='); at != std::string_view::npos; at = tag.find('=', at)) {
    const std::size_t start = tag.find_last_of(" \t\r\n", at) + 1, open = at + 1;
    const std::size_t close = open < tag.size() ? tag.find(tag[open], open + 1) : std::string_view::npos;
    if (close == std::string_view::npos) fail("an attribute without its closing quote");
    attributes[std::string(tag.substr(start, at - start))] = std::string(tag.substr(open + 1, close - open - 1));
    at = close;
  }
  return attributes;
}

// All elements of this name within `xml`.
std::vector<Element> find_elements(std::string_view xml, const std::string& name) {
  std::vector<Element> found;
  const std::string open = "<" + name, close = "</" + name + ">";
  for (std::size_t at = xml.find(open); at != std::string_view::npos; at = xml.find(open, at + 1)) {
    const char next = at + open.size() < xml.size() ? xml[at + open.size()] : '\0';
    const std::size_t end = xml.find('>', at);
    if (end == std::string_view::npos) fail("a tag without its end");
    if (std::strchr(" \t\r\n/>", next) == nullptr) continue;
    Element element{parse_attributes(xml.substr(at + open.size(), end - at - open.size())), {}};
    const std::size_t finish = xml[end - 1] == '/' ? std::string_view::npos : xml.find(close, end);
    if (finish != std::string_view::npos) element.text = xml.substr(end + 1, finish - end - 1);
    found.push_back(element);
  }
  return found;
}

// Decodes base64 up to `limit` bytes, ignoring characters outside of its alphabet.
std::string decode_base64(std::string_view text, std::size_t limit) {
  std::string bytes;
  unsigned group = 0;
  int bits = 0;
  for (const char c : text) {
    int value = -1;
    if (c >= 'A' && c <= 'Z') value = c - 'A';
    if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
    if (c >= '0' && c <= '9') value = c - '0' + 52;
    if (c == '+') value = 62;
    if (c == '/') value = 63;
    if (c == '=') group = 0, bits = 0;  // header and data may be padded separately
    if (value < 0) continue;
    group = group << 6 | unsigned(value);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(char(group >> bits & 0xff));
    if (bytes.size() >= limit) break;
  }
  return bytes;
}

template <class T>
std::vector<double> as_numbers(std::string_view bytes) {
  std::vector<double> numbers;
  numbers.reserve(bytes.size() / sizeof(T));
  for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T)) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof(T));
    numbers.push_back(double(value));
  }
  return numbers;
}

std::vector<double> convert(const std::string& type, std::string_view bytes) {
  if (type == "Float64") return as_numbers<double>(bytes);
  if (type == "Float32") return as_numbers<float>(bytes);
  if (type == "Int64") return as_numbers<std::int64_t>(bytes);
  if (type == "Int32") return as_numbers<std::int32_t>(bytes);
  if (type == "UInt32") return as_numbers<std::uint32_t>(bytes);
  if (type == "Int8") return as_numbers<std::int8_t>(bytes);
  if (type == "UInt8") return as_numbers<std::uint8_t>(bytes);
  fail(fmt::format("numbers of type '{}'", type));
}

// A file's parts that its arrays refer to.
struct Document {
  std::string_view xml;       // without appended data
  std::string_view appended;  // after the underscore
  bool appended_raw = false;
  std::size_t header = 4;  // bytes of the length field before each binary array
};

Document open_document(std::string_view bytes) {
  Document document{bytes, {}, false, 4};
  const std::size_t at = bytes.find("<AppendedData");
  if (at != std::string_view::npos) {
    const std::size_t end = bytes.find('>', at), start = end == std::string_view::npos ? end : bytes.find('_', end);
    if (start == std::string_view::npos) fail("appended data without its underscore");
    document.xml = bytes.substr(0, at);
    document.appended = bytes.substr(start + 1);
    document.appended_raw = bytes.substr(at, end - at).find("raw") != std::string_view::npos;
  }
  const auto roots = find_elements(document.xml, "VTKFile");
  if (roots.empty() || roots[0].attribute("type") != "UnstructuredGrid") fail("this is no VTK unstructured grid");
  if (roots[0].attribute("byte_order") == "BigEndian") fail("big-endian numbers");
  if (!roots[0].attribute("compressor").empty()) fail("compressed arrays");
  if (roots[0].attribute("header_type") == "UInt64") document.header = 8;
  return document;
}

std::uint64_t payload_length(std::string_view bytes, std::size_t header) {
  if (bytes.size() < header) fail("an array is cut short");
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), header);
  return length;
}

std::vector<double> read_base64(std::string_view text, std::size_t header, const std::string& type) {
  const std::uint64_t length = payload_length(decode_base64(text, header), header);
  if (length > text.size()) fail("an array is cut short");
  const std::string bytes = decode_base64(text, header + length);
  if (bytes.size() != header + length) fail("an array is cut short");
  return convert(type, std::string_view(bytes).substr(header));
}

std::vector<double> read_array(const Document& document, const Element& array) {
  const std::string type = array.attribute("type"), format = array.attribute("format");
  if (format == "binary") return read_base64(array.text, document.header, type);
  if (format == "appended") {
    const std::size_t offset = std::strtoull(array.attribute("offset").c_str(), nullptr, 10);
    if (offset >= document.appended.size()) fail("an array lies beyond the end of the file");
    const std::string_view from = document.appended.substr(offset);
    if (!document.appended_raw) return read_base64(from, document.header, type);
    const std::uint64_t length = payload_length(from, document.header);
    if (length > from.size() - document.header) fail("an array is cut short");
    return convert(type, from.substr(document.header, length));
  }
  std::istringstream words{std::string(array.text)};
  words.imbue(std::locale::classic());
  std::vector<double> numbers;
  for (double number; words >> number;) numbers.push_back(number);
  return numbers;
}

// Values of the array with this name (the first one for an empty name) in the first element `section`; empty if there
// is none.
std::vector<double> find_array(const Document& document, const std::string& section, const std::string& name) {
  const auto sections = find_elements(document.xml, section);
  if (sections.empty()) return {};
  for (const Element& array : find_elements(sections[0].text, "DataArray")) {
    if (name.empty() || array.attribute("Name") == name) return read_array(document, array);
  }
  return {};
}

SolidMesh assemble(const Document& document) {
  SolidMesh solids;
  const auto xyz = find_array(document, "Points", "");
  for (std::size_t i = 0; i + 3 <= xyz.size(); i += 3) solids.mesh.points.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  const auto corners = find_array(document, "Cells", "connectivity"), ends = find_array(document, "Cells", "offsets");
  const auto types = find_array(document, "Cells", "types"), numbers = find_array(document, "CellData", "solid");
  if (types.size() != ends.size() || (!numbers.empty() && numbers.size() != ends.size())) {
    fail("the arrays of the cells differ in length");
  }
  for (const double corner : corners) {
    if (!(corner >= 0 && corner < double(solids.mesh.points.size()))) fail(fmt::format("there is no point {}", corner));
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const int size = types[i] == vtk_triangle ? 3 : types[i] == vtk_line ? 2 : 0;
    if (size == 0) continue;
    if (!(ends[i] >= size && ends[i] <= double(corners.size()))) fail(fmt::format("cell {} has no corners", i));
    const double* last = corners.data() + std::size_t(ends[i]);
    if (size == 3) solids.mesh.triangles.push_back({int(last[-3]), int(last[-2]), int(last[-1])});
    if (size == 2) solids.mesh.segments.push_back({int(last[-2]), int(last[-1])});
    solids.solid.push_back(numbers.empty() ? 0 : int(numbers[i]));
  }
  return solids;
}

// Texts as text_array() of vtk.cpp writes them: codes of bytes, each text ended by a zero.
std::vector<std::string> read_texts(const Document& document, const std::string& name) {
  std::vector<std::string> texts{""};
  for (const Element& array : find_elements(document.xml, "Array")) {
    if (array.attribute("Name") != name) continue;
    std::istringstream codes{std::string(array.text)};
    codes.imbue(std::locale::classic());
    for (int code = 0; codes >> code;) {
      if (code == 0) {
        texts.emplace_back();
      } else {
        texts.back() += char(code);
      }
    }
  }
  return texts;
}

double length_at(const std::vector<double>& vectors, std::size_t point) {
  if (3 * point + 3 > vectors.size()) return 0;
  return std::hypot(vectors[3 * point], vectors[3 * point + 1], vectors[3 * point + 2]);
}

GridSummary summarize(const Document& document) {
  const auto corners = find_array(document, "Cells", "connectivity"), ends = find_array(document, "Cells", "offsets");
  const auto numbers = find_array(document, "CellData", "solid"), time = find_array(document, "FieldData", "TimeValue");
  const auto displacement = find_array(document, "PointData", "displacement"),
             velocity = find_array(document, "PointData", "velocity"),
             stress = find_array(document, "PointData", "von_mises");
  const auto names = read_texts(document, "solid_names");
  if (numbers.size() != ends.size()) fail("the arrays of the cells differ in length");
  std::map<int, std::pair<SolidSummary, std::set<std::size_t>>> found;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double start = i > 0 ? ends[i - 1] : 0;
    if (!(start >= 0 && ends[i] >= start && ends[i] <= double(corners.size())))
      fail(fmt::format("cell {} has no corners", i));
    auto& [solid, points] = found[int(numbers[i])];
    ++solid.cells;
    for (auto c = std::size_t(start); c < std::size_t(ends[i]); ++c) {
      if (!(corners[c] >= 0)) fail(fmt::format("there is no point {}", corners[c]));
      points.insert(std::size_t(corners[c]));
    }
  }
  GridSummary summary{time.empty() ? 0 : time[0], !stress.empty(), {}};
  for (auto& [number, entry] : found) {
    auto& [solid, points] = entry;
    if (number >= 0 && std::size_t(number) < names.size()) solid.name = names[std::size_t(number)];
    solid.points = points.size();
    for (const std::size_t p : points) {
      solid.largest_displacement = std::max(solid.largest_displacement, length_at(displacement, p));
      solid.largest_speed = std::max(solid.largest_speed, length_at(velocity, p));
      if (p < stress.size()) solid.largest_stress = std::max(solid.largest_stress, stress[p]);
    }
    summary.solids.push_back(solid);
  }
  return summary;
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) fail(fmt::format("{}: cannot be read", file.string()));
  return text.str();
}

}  // namespace

SolidMesh read_solids(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  try {
    return assemble(open_document(bytes));
  } catch (const Error& error) {
    fail(fmt::format("{}: {}; expected surfaces as 'seiche run' writes them", file.string(), error.what()));
  }
}

GridSummary summarize_grid(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  try {
    return summarize(open_document(bytes));
  } catch (const Error& error) {
    fail(fmt::format("{}: {}; expected solids as 'seiche run' writes them", file.string(), error.what()));
  }
}

}  // namespace seiche::render
