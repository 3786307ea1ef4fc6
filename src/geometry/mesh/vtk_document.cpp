#include "geometry/mesh/vtk_document.h"

#include <pugixml.hpp>

#include <algorithm>
#include <cstdint>
#include <new>

#include "base/error.h"

namespace seiche::mesh {
namespace {

constexpr std::string_view white_space = " \t\r\n";

std::size_t byte_of(const pugi::xml_node& node) {
  return std::size_t(std::max<std::ptrdiff_t>(0, node.offset_debug()));
}

[[noreturn]] void fail_at(const Source& source, const pugi::xml_node& node, const std::string& message) {
  fail_in_line_of(source, byte_of(node), message);
}

// A file without and behind its appended data, which may be raw and then is no XML.
struct Parts {
  std::string xml;
  std::string_view appended;
};

Parts cut_appended(const Source& source) {
  const std::string_view bytes = source.bytes;
  const std::size_t tag = bytes.find("<AppendedData");
  if (tag == std::string_view::npos) return {source.bytes, {}};
  const std::size_t end = std::min(bytes.find('>', tag), bytes.size());
  const std::size_t start = bytes.find_first_not_of(white_space, std::min(end + 1, bytes.size()));
  if (start == std::string_view::npos || bytes[start] != '_') {
    fail_in_line_of(source, tag, "the appended data do not begin with an underscore");
  }
  return {std::string(bytes.substr(0, end)) + "/></VTKFile>", bytes.substr(start + 1)};
}

// Parses in place, without entities and conversions: texts are as long as in the file.
void parse_xml(const Source& source, std::string& xml, pugi::xml_document& document) {
  const auto result = document.load_buffer_inplace(xml.data(), xml.size(), pugi::parse_minimal, pugi::encoding_utf8);
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!result) {
    fail_in_line_of(source, std::size_t(result.offset),
                    std::string("is not XML, or is cut short: ") + result.description());
  }
}

VtkArray array_of(const Source& source, const pugi::xml_node& section, const pugi::xml_node& node) {
  VtkArray array{section.name(),
                 node.attribute("Name").value(),
                 node.attribute("type").value(),
                 node.attribute("format").as_string("ascii"),
                 node.attribute("offset").value(),
                 byte_of(node),
                 byte_of(node)};
  for (const pugi::xml_node& child : node.children()) {
    if (child.type() != pugi::node_pcdata) continue;  // notes on the array, as ParaView writes them
    if (!array.text.empty()) fail_at(source, child, "the text of array '" + array.name + "' is interrupted");
    array.text_byte = byte_of(child);
    array.text = std::string_view(source.bytes).substr(array.text_byte, std::string_view(child.value()).size());
  }
  return array;
}

void add_arrays(const pugi::xml_node& parent, VtkDocument& document) {
  for (const pugi::xml_node& section : parent.children()) {
    for (const pugi::xml_node& node : section.children()) {
      const std::string_view name = node.name();
      if (name == "DataArray" || name == "Array") document.arrays.push_back(array_of(document.source, section, node));
    }
  }
}

void read_header(const pugi::xml_node& root, VtkDocument& document) {
  if (std::string_view(root.attribute("type").value()) != "UnstructuredGrid") {
    fail_at(document.source, root, "is no VTK unstructured grid");
  }
  const std::string header = root.attribute("header_type").as_string("UInt32");
  if (header != "UInt32" && header != "UInt64") {
    fail_at(document.source, root, "header_type '" + header + "' is neither UInt32 nor UInt64");
  }
  document.header_bytes = header == "UInt64" ? 8 : 4;
  document.compressor = root.attribute("compressor").value();
  document.big_endian = std::string_view(root.attribute("byte_order").value()) == "BigEndian";
  const pugi::xml_node appended = root.child("AppendedData");
  const std::string encoding = appended.attribute("encoding").as_string("base64");
  if (encoding != "raw" && encoding != "base64") {
    fail_at(document.source, appended, "encoding '" + encoding + "' is neither raw nor base64");
  }
  document.appended_encoding = encoding == "raw" ? VtkEncoding::raw : VtkEncoding::base64;
}

}  // namespace

std::size_t line_of(const Source& source, std::size_t byte) {
  const std::string_view before = std::string_view(source.bytes).substr(0, byte);
  return 1 + std::size_t(std::count(before.begin(), before.end(), '\n'));
}

void fail_in_line_of(const Source& source, std::size_t byte, const std::string& message) {
  fail_at_line(source, line_of(source, byte), message);
}

VtkDocument parse_vtk(const Source& source) {
  Parts parts = cut_appended(source);
  pugi::xml_document xml;
  parse_xml(source, parts.xml, xml);
  VtkDocument document{source, parts.appended};
  const pugi::xml_node root = xml.child("VTKFile"), grid = root.child("UnstructuredGrid"), piece = grid.child("Piece");
  read_header(root, document);
  if (!piece) fail_at(source, root, "<Piece> is missing");
  if (const auto second = piece.next_sibling("Piece")) fail_at(source, second, "has several pieces; save as one");
  document.piece_byte = byte_of(piece);
  add_arrays(grid, document);
  add_arrays(piece, document);
  return document;
}

const VtkArray* find_array(const VtkDocument& document, const std::string& section, const std::string& name) {
  const auto found = std::find_if(document.arrays.begin(), document.arrays.end(), [&](const VtkArray& array) {
    return array.section == section && (name.empty() || array.name == name);
  });
  return found == document.arrays.end() ? nullptr : &*found;
}

}  // namespace seiche::mesh
