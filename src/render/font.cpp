#include "render/font.h"

#include <fmt/format.h>
#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <memory>

#include "base/error.h"

namespace seiche::render {
namespace {

constexpr const char* usual_family = "DejaVu Sans";

using Pattern = std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)>;

[[noreturn]] void refuse_font(const std::string& why) {
  throw Error(ExitCode::bad_input,
              why +
                  "; install one (Debian: fonts-dejavu-core), or give --font a family or a file (`fc-list` lists "
                  "those there are)");
}

// The scalable font that fontconfig takes for a family; null without any.
Pattern match(const std::string& family) {
  Pattern wanted(FcPatternCreate(), FcPatternDestroy);
  FcPatternAddString(wanted.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>(family.c_str()));
  FcPatternAddBool(wanted.get(), FC_SCALABLE, FcTrue);
  FcConfigSubstitute(nullptr, wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  FcResult result = FcResultNoMatch;
  return {FcFontMatch(nullptr, wanted.get(), &result), FcPatternDestroy};
}

bool has_family(FcPattern* font, const std::string& family) {
  FcChar8* name = nullptr;
  for (int n = 0; FcPatternGetString(font, FC_FAMILY, n, &name) == FcResultMatch; ++n) {
    if (FcStrCmpIgnoreCase(name, reinterpret_cast<const FcChar8*>(family.c_str())) == 0) return true;
  }
  return false;
}

}  // namespace

FontFile find_font(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    int faces = 0;
    const Pattern font(FcFreeTypeQuery(reinterpret_cast<const FcChar8*>(name.c_str()), 0, nullptr, &faces),
                       FcPatternDestroy);
    if (!font) refuse_font(fmt::format("--font: '{}' is not a font file", name));
    return {name, 0};
  }
  const Pattern font = match(name.empty() ? usual_family : name);
  FontFile found;
  FcChar8* file = nullptr;
  FcBool scalable = FcFalse;
  if (!font || FcPatternGetString(font.get(), FC_FILE, 0, &file) != FcResultMatch ||
      FcPatternGetBool(font.get(), FC_SCALABLE, 0, &scalable) != FcResultMatch || !scalable)
    refuse_font("there is no font for the texts of pictures");
  if (!name.empty() && !has_family(font.get(), name)) refuse_font(fmt::format("--font: there is no font '{}'", name));
  found.file = reinterpret_cast<const char*>(file);
  FcPatternGetInteger(font.get(), FC_INDEX, 0, &found.index);
  return found;
}

float text_size(int width, int height) {
  return std::max(9.0f, 0.0235f * std::min(float(height), 0.7f * float(width)));
}

}  // namespace seiche::render
