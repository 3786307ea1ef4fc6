#pragma once
// A 5 x 7 bitmap font: digits, lower-case letters (capitals look the same, except P), common signs.
#include <string_view>

#include "render/image.h"

namespace seiche::render {

enum class Anchor { start, middle, end };

// Draws the text with its top at y and its start, middle or end at x. A font pixel is scale x scale pixels. Characters
// without a glyph become '?'.
void draw_text(Canvas& canvas, int x, int y, std::string_view text, int scale, const Vec3f& color,
               Anchor anchor = Anchor::start);

// Width of the text in pixels; its height is 7 scale.
int text_width(std::string_view text, int scale);

// Font scale for a picture of this height.
int font_scale(int picture_height);

}  // namespace seiche::render
