#pragma once
// Embeds a case's README in another page.
#include <string>

namespace seiche {

// Makes headings one level deeper and rewrites links as seen from a page such as "docs/validation/fsi3.md": links to
// files of `folder`, such as "validation/fsi3", become "../../validation/fsi3/...". Code blocks are unchanged.
std::string embed_readme(const std::string& text, const std::string& folder);

// "../../validation/fsi1/scene.toml" from "validation/fsi3" and "../fsi1/scene.toml".
std::string link_from_page(const std::string& folder, const std::string& file);

}  // namespace seiche
