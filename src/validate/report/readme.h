#pragma once
// Embeds a case's README in another page.
#include <string>

namespace seiche {

// Headings one level deeper, and links to files as seen from a page such as "docs/validation/fsi3.md": those of
// `folder`, such as "validation/fsi3", become "../../validation/fsi3/...". Blocks of code stay as they are.
std::string embed_readme(const std::string& text, const std::string& folder);

// "../../validation/fsi1/scene.toml" from "validation/fsi3" and "../fsi1/scene.toml".
std::string link_from_page(const std::string& folder, const std::string& file);

}  // namespace seiche
