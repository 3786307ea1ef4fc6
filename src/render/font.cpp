#include "render/font.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace seiche::render {
namespace {

// Seven rows from the top, five bits each; the highest bit is the leftmost.
struct Glyph {
  char character;
  std::array<std::uint8_t, 7> rows;
};

constexpr Glyph glyphs[] = {
    {'0', {14, 17, 19, 21, 25, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},    {'2', {14, 17, 1, 2, 4, 8, 31}},
    {'3', {14, 17, 1, 6, 1, 17, 14}},    {'4', {2, 6, 10, 18, 31, 2, 2}},   {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {14, 16, 16, 30, 17, 17, 14}}, {'7', {31, 1, 2, 4, 4, 4, 4}},     {'8', {14, 17, 17, 14, 17, 17, 14}},
    {'9', {14, 17, 17, 15, 1, 1, 14}},   {'a', {0, 0, 14, 1, 15, 17, 15}},  {'b', {16, 16, 30, 17, 17, 17, 30}},
    {'c', {0, 0, 14, 16, 16, 16, 14}},   {'d', {1, 1, 15, 17, 17, 17, 15}}, {'e', {0, 0, 14, 17, 31, 16, 14}},
    {'f', {6, 9, 8, 28, 8, 8, 8}},       {'g', {0, 15, 17, 17, 15, 1, 14}}, {'h', {16, 16, 30, 17, 17, 17, 17}},
    {'i', {4, 0, 12, 4, 4, 4, 14}},      {'j', {2, 0, 6, 2, 2, 18, 12}},    {'k', {16, 18, 20, 24, 20, 18, 17}},
    {'l', {12, 4, 4, 4, 4, 4, 14}},      {'m', {0, 0, 26, 21, 21, 21, 17}}, {'n', {0, 0, 30, 17, 17, 17, 17}},
    {'o', {0, 0, 14, 17, 17, 17, 14}},   {'p', {0, 0, 30, 17, 30, 16, 16}}, {'q', {0, 0, 15, 17, 15, 1, 1}},
    {'r', {0, 0, 22, 25, 16, 16, 16}},   {'s', {0, 0, 15, 16, 14, 1, 30}},  {'t', {8, 8, 30, 8, 8, 9, 6}},
    {'u', {0, 0, 17, 17, 17, 17, 15}},   {'v', {0, 0, 17, 17, 17, 10, 4}},  {'w', {0, 0, 17, 17, 21, 21, 10}},
    {'x', {0, 0, 17, 10, 4, 10, 17}},    {'y', {0, 0, 17, 17, 15, 1, 14}},  {'z', {0, 0, 31, 2, 4, 8, 31}},
    {'P', {30, 17, 17, 30, 16, 16, 16}}, {'.', {0, 0, 0, 0, 0, 24, 24}},    {',', {0, 0, 0, 0, 24, 24, 8}},
    {':', {0, 12, 12, 0, 6, 6, 0}},      {'-', {0, 0, 0, 31, 0, 0, 0}},     {'+', {0, 4, 4, 31, 4, 4, 0}},
    {'=', {0, 0, 31, 0, 31, 0, 0}},      {'/', {0, 1, 2, 4, 8, 16, 0}},     {'%', {24, 25, 2, 4, 8, 19, 3}},
    {'(', {2, 4, 8, 8, 8, 4, 2}},        {')', {8, 4, 2, 2, 2, 4, 8}},      {'_', {0, 0, 0, 0, 0, 0, 31}},
    {'^', {4, 10, 17, 0, 0, 0, 0}},      {'*', {0, 4, 21, 14, 21, 4, 0}},   {'?', {14, 17, 1, 2, 4, 0, 4}},
};

std::array<std::uint8_t, 7> find_glyph(char character) {
  if (character == ' ') return {};
  for (const Glyph& glyph : glyphs) {
    if (glyph.character == character) return glyph.rows;
  }
  const int lower = std::tolower(static_cast<unsigned char>(character));
  return lower == character ? find_glyph('?') : find_glyph(char(lower));
}

}  // namespace

int text_width(std::string_view text, int scale) {
  return text.empty() ? 0 : scale * (6 * int(text.size()) - 1);
}

int font_scale(int picture_height) {
  return std::max(1, picture_height / 320);
}

void draw_text(Canvas& canvas, int x, int y, std::string_view text, int scale, const Vec3f& color, Anchor anchor) {
  if (anchor == Anchor::middle) x -= text_width(text, scale) / 2;
  if (anchor == Anchor::end) x -= text_width(text, scale);
  for (const char character : text) {
    const auto rows = find_glyph(character);
    for (int k = 0; k < 35; ++k) {
      const int column = k % 5, row = k / 5;
      if ((rows[row] >> (4 - column) & 1) == 0) continue;
      const int px = x + scale * column, py = y + scale * row;
      fill(canvas, {px, py, px + scale, py + scale}, color, 1);
    }
    x += 6 * scale;
  }
}

}  // namespace seiche::render
