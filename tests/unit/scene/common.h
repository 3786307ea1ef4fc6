#pragma once
// Scenes for the tests of the reader.
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/reader.h"
#include "unit/files/scratch.h"

namespace seiche::testing {

using Overrides = std::vector<Override>;

// The smallest scene.
inline const std::string small_scene = "[domain]\nupper = [1, 1, 1]\ncell_size = 0.125\n[time]\nend = 1\n";
inline const std::string flat_scene = "dimension = 2\n[domain]\nupper = [1, 1]\ncell_size = 0.125\n[time]\nend = 1\n";

// Reads `text` as scene.toml in `folder`.
Scene parse(const std::string& text, const Overrides& overrides = {}, const std::filesystem::path& folder = ".");

// Message of the reader about an invalid text; fails the test if there is none or the exit code is not 2.
std::string fault(const std::string& text, const Overrides& overrides = {}, const std::filesystem::path& folder = ".");

// Checks that the reader refuses the text, with this in its message.
void check_refused(const std::string& text, const std::string& expected);

// A scene with every table and the given shape, side type and probe kind; 2D or 3D. Files: s.obj, s.png and s.vdb.
std::string rich_scene(int dimension, const std::string& shape, const std::string& side, const std::string& probe);

std::size_t count_lines(const std::string& text);

}  // namespace seiche::testing
