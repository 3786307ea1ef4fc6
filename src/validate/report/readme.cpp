#include "validate/report/readme.h"

#include <filesystem>

namespace seiche {
namespace {

bool is_file_link(const std::string& target) {
  return !target.empty() && target[0] != '#' && target[0] != '/' && target.find("://") == std::string::npos &&
         !target.starts_with("mailto:");
}

// Rewrites "](target)" as seen from another folder.
std::string with_links(const std::string& line, const std::string& folder) {
  std::string text;
  std::size_t at = 0;
  for (std::size_t open; (open = line.find("](", at)) != std::string::npos;) {
    const std::size_t begin = open + 2, end = line.find(')', begin);
    if (end == std::string::npos) break;
    const std::string target = line.substr(begin, end - begin);
    text += line.substr(at, begin - at) + (is_file_link(target) ? link_from_page(folder, target) : target);
    at = end;
  }
  return text + line.substr(at);
}

}  // namespace

std::string link_from_page(const std::string& folder, const std::string& file) {
  return (std::filesystem::path("../..") / (std::filesystem::path(folder) / file).lexically_normal()).generic_string();
}

std::string embed_readme(const std::string& text, const std::string& folder) {
  std::string page;
  bool code = false;
  std::string code_begin;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    const bool fence = code ? line.starts_with(code_begin) : line.starts_with("```") || line.starts_with("~~~");
    if (fence) code = !code;
    if (fence && code) code_begin = line.substr(0, 3);
    const bool plain = code || fence || line.starts_with("    ");
    page += plain ? line : (line.starts_with('#') ? "#" : "") + with_links(line, folder);
    page += '\n';
  }
  while (page.ends_with("\n\n")) page.pop_back();
  // Unclosed code blocks and HTML comments would swallow the following pages.
  if (code) page += code_begin + "\n";
  const std::size_t comment = page.rfind("<!--");
  if (comment != std::string::npos && page.find("-->", comment) == std::string::npos) page += "-->\n";
  return page;
}

}  // namespace seiche
