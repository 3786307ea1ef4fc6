#pragma once
// Scenes that include others.
#include "scene/context.h"
#include "scene/toml.h"

namespace seiche {

// Puts the files that `include` names below the scene: the scene's values take the place of theirs, tables are joined,
// and lists of tables go on from theirs. Files include others likewise, by paths from their own folder. Lines of their
// nodes tell the file (SceneContext::where). Throws Error(bad_input) for files that cannot be read, that lie outside
// the scene's folder without leave, or that include themselves.
void merge_includes(SceneContext& context, TomlNode& root);

}  // namespace seiche
