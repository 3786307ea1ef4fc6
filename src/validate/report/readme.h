#pragma once
// Embeds a case's README in another page.
#include <string>

namespace seiche {

// Moves headings two levels deeper. Rewrites links to files as seen from a folder beside that of the cases: links
// relative to `folder`, such as "validation/fsi3", become "../validation/fsi3/...". Blocks of code are unchanged.
std::string embed_readme(const std::string& text, const std::string& folder);

// "../validation/fsi1/scene.toml" from "validation/fsi3" and "../fsi1/scene.toml".
std::string link_from_page(const std::string& folder, const std::string& file);

}  // namespace seiche
