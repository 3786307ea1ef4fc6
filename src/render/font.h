#pragma once
// A 5 x 7 bitmap font of our own: digits, lower case letters (capitals look the same, but for P), common signs.
#include <string_view>

#include "render/image.h"

namespace seiche::render {

enum class Anchor { start, middle, end };

// Prints the text with its top at y and its start, middle or end at x; one font pixel is scale x scale pixels.
// Characters without a drawing come out as '?'.
void draw_text(Canvas& canvas, int x, int y, std::string_view text, int scale, const Vec3f& color,
               Anchor anchor = Anchor::start);

// The width of the text in pixels; its height is 7 scale.
int text_width(std::string_view text, int scale);

// The font scale that suits a picture of this height.
int font_scale(int picture_height);

}  // namespace seiche::render
