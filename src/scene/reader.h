#pragma once
// Scene files: TOML to seiche::Scene and back.
#include <filesystem>
#include <string>
#include <vector>

#include "scene/writer.h"

namespace seiche {

struct Scene;

// --set key.path=value. The value is TOML; bare words and formulas count as text. Array entries count from 0
// (solid.0.radius).
struct Override {
  std::string path, value;
};

// Splits "key.path=value" at the first '='. Throws Error(bad_input) if there is none.
Override parse_override(const std::string& text);

// Reads and checks a scene. Throws Error(bad_input) with all problems, one line each ("scene.toml:14: ..."). Syntax
// errors and unreadable files are reported alone.
Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides = {});

// Bytes of a scene's file, at most one more than most_scene_bytes. Throws Error(bad_input).
std::string read_scene_text(const std::filesystem::path& file);

// The same from text. `name` replaces the file in messages; paths in the scene are relative to `folder`.
Scene parse_scene(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                  const std::vector<Override>& overrides = {});

}  // namespace seiche
