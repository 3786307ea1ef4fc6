#pragma once
// Draws shapes and texts into pixels, or onto a page of vectors: the only interface to cairo.
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "render/image.h"

namespace seiche::render {

enum class Format { png, svg, pdf, exr };

// "png" -> Format::png. Throws Error(bad_input) that lists the formats; `option` names what gave the text.
Format parse_format(const std::string& text, const std::string& option);
std::string extension_of(Format format);

enum class Anchor { start, middle, end };

// Coordinates are pixels from the top left, y downwards; colours are linear light. One thread at a time.
class Painter {
 public:
  // A white sheet: pixels for png, vectors for svg and pdf, where a pixel is a CSS pixel or a point. `font` as
  // find_font() takes it. Throws Error(bad_input) if there is no such font.
  Painter(int width, int height, Format format, const std::string& font = "");
  // Pixels, over a picture.
  explicit Painter(const Image& backdrop, const std::string& font = "");
  ~Painter();
  Painter(Painter&&) noexcept;

  int width() const;
  int height() const;

  void rectangle(float x0, float y0, float x1, float y1, const Vec3f& color, float alpha = 1);
  // Inside by the even-odd rule.
  void fill(const std::vector<Polygon>& outlines, const Vec3f& color, float alpha = 1);
  // A line with round joints through points; `dash` > 0: dashes of that length.
  void stroke(const Polygon& line, float width, const Vec3f& color, bool closed = false, float dash = 0);
  // Cuts off what `draw` draws outside of the outlines.
  void within(const std::vector<Polygon>& outlines, const std::function<void()>& draw);
  // The picture stretched over a rectangle, smooth between pixels.
  void picture(const Image& image, float x0, float y0, float x1, float y1);

  // UTF-8 text with its baseline at y, `size` pixels high; `turned`: read upwards, with its baseline at x.
  void text(float x, float y, std::string_view text, float size, const Vec3f& color, Anchor anchor = Anchor::start,
            bool turned = false);
  float text_width(std::string_view text, float size) const;

  // The pixels drawn so far; for png alone.
  Image image() const;
  // The file of vectors; ends the drawing. For svg and pdf alone.
  std::string page();

 private:
  struct Sheet;
  std::unique_ptr<Sheet> sheet_;
};

// Height of digits and capitals above the baseline, for texts of this size.
inline float cap_height(float size) {
  return 0.72f * size;
}

}  // namespace seiche::render
