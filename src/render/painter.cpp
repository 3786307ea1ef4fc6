#include "render/painter.h"

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include <cstring>

#include "base/error.h"
#include "base/suggest.h"
#include "render/font.h"

namespace seiche::render {
namespace {

struct FormatName {
  const char* name;
  Format format;
};

constexpr FormatName format_names[] = {
    {"png", Format::png}, {"svg", Format::svg}, {"pdf", Format::pdf}, {"exr", Format::exr}};

cairo_status_t append_bytes(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Face = std::unique_ptr<cairo_font_face_t, decltype(&cairo_font_face_destroy)>;

void require_drawn(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw Error(status == CAIRO_STATUS_NO_MEMORY ? ExitCode::machine : ExitCode::output_failed,
              fmt::format("a picture cannot be drawn: {}; try a smaller --size", cairo_status_to_string(status)));
}

Surface make_surface(int width, int height, Format format, std::string& bytes) {
  Surface surface(nullptr, cairo_surface_destroy);
  if (format == Format::svg) {
    surface.reset(cairo_svg_surface_create_for_stream(append_bytes, &bytes, width, height));
    cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  } else if (format == Format::pdf) {
    surface.reset(cairo_pdf_surface_create_for_stream(append_bytes, &bytes, width, height));
  } else {
    surface.reset(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height));
  }
  require_drawn(cairo_surface_status(surface.get()));
  return surface;
}

Face make_face(const std::string& name) {
  const FontFile font = find_font(name);
  FcPattern* pattern = FcPatternCreate();
  FcPatternAddString(pattern, FC_FILE, reinterpret_cast<const FcChar8*>(font.file.c_str()));
  FcPatternAddInteger(pattern, FC_INDEX, font.index);
  Face face(cairo_ft_font_face_create_for_pattern(pattern), cairo_font_face_destroy);
  FcPatternDestroy(pattern);
  require_drawn(cairo_font_face_status(face.get()));
  return face;
}

// cairo's pixels: native 32-bit words 0xAARRGGBB, colours multiplied by alpha.
std::uint32_t packed(const Image& image, std::size_t i) {
  const std::uint32_t alpha = image.alpha.empty() ? 255 : image.alpha[i];
  std::uint32_t word = alpha << 24;
  for (int c = 0; c < 3; ++c) word |= (image.rgb[3 * i + std::size_t(c)] * alpha + 127) / 255 << (16 - 8 * c);
  return word;
}

void copy_pixels(const Image& image, cairo_surface_t* surface) {
  unsigned char* data = cairo_image_surface_get_data(surface);
  const auto stride = std::size_t(cairo_image_surface_get_stride(surface));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint32_t word = packed(image, std::size_t(y) * image.width + x);
      std::memcpy(data + y * stride + 4 * std::size_t(x), &word, 4);
    }
  }
  cairo_surface_mark_dirty(surface);
}

Surface surface_of(const Image& image) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height), cairo_surface_destroy);
  require_drawn(cairo_surface_status(surface.get()));
  copy_pixels(image, surface.get());
  return surface;
}

void trace_path(cairo_t* cairo, const std::vector<Polygon>& outlines) {
  cairo_new_path(cairo);
  for (const Polygon& outline : outlines) {
    cairo_new_sub_path(cairo);
    for (const Vec2f& x : outline) cairo_line_to(cairo, x.x(), x.y());
    cairo_close_path(cairo);
  }
}

}  // namespace

Format parse_format(const std::string& text, const std::string& option) {
  std::vector<std::string> names;
  for (const FormatName& row : format_names) {
    if (text == row.name) return row.format;
    names.emplace_back(row.name);
  }
  const auto near = suggest(text, names);
  throw Error(ExitCode::bad_input, fmt::format("{}: there is no format '{}'{}; formats are {}", option, text,
                                               near ? "; did you mean '" + *near + "'?" : "", fmt::join(names, ", ")));
}

std::string extension_of(Format format) {
  return format_names[std::size_t(format)].name;
}

struct Painter::Sheet {
  int width, height;
  Format format;
  std::string bytes;
  Face face;
  Surface surface;
  cairo_t* cairo;

  Sheet(int w, int h, Format f, const std::string& font)
      : width(w),
        height(h),
        format(f),
        face(make_face(font)),
        surface(make_surface(w, h, f, bytes)),
        cairo(cairo_create(surface.get())) {
    cairo_set_font_face(cairo, face.get());
    cairo_font_options_t* plain = cairo_font_options_create();  // the same widths at any size and on any screen
    cairo_font_options_set_hint_style(plain, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(plain, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(plain, CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(cairo, plain);
    cairo_font_options_destroy(plain);
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_BEST);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_EVEN_ODD);
  }
  ~Sheet() { cairo_destroy(cairo); }
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  void use(const Vec3f& light, float alpha) const {
    const Vec3f color = to_srgb(light);
    cairo_set_source_rgba(cairo, color[0], color[1], color[2], alpha);
  }
};

Painter::Painter(int width, int height, Format format, const std::string& font)
    : sheet_(std::make_unique<Sheet>(width, height, format, font)) {
  rectangle(0, 0, float(width), float(height), Vec3f::Ones());
}

Painter::Painter(const Image& backdrop, const std::string& font)
    : sheet_(std::make_unique<Sheet>(backdrop.width, backdrop.height, Format::png, font)) {
  copy_pixels(backdrop, sheet_->surface.get());
}

Painter::~Painter() = default;
Painter::Painter(Painter&&) noexcept = default;

int Painter::width() const {
  return sheet_->width;
}

int Painter::height() const {
  return sheet_->height;
}

void Painter::rectangle(float x0, float y0, float x1, float y1, const Vec3f& color, float alpha) {
  sheet_->use(color, alpha);
  cairo_new_path(sheet_->cairo);
  cairo_rectangle(sheet_->cairo, x0, y0, x1 - x0, y1 - y0);
  cairo_fill(sheet_->cairo);
}

void Painter::fill(const std::vector<Polygon>& outlines, const Vec3f& color, float alpha) {
  sheet_->use(color, alpha);
  trace_path(sheet_->cairo, outlines);
  cairo_fill(sheet_->cairo);
}

void Painter::stroke(const Polygon& line, float width, const Vec3f& color, bool closed, float dash) {
  sheet_->use(color, 1);
  const double length = dash;
  cairo_set_dash(sheet_->cairo, &length, dash > 0 ? 1 : 0, 0);
  cairo_set_line_width(sheet_->cairo, width);
  cairo_new_path(sheet_->cairo);  // a text leaves its end as a point
  for (const Vec2f& x : line) cairo_line_to(sheet_->cairo, x.x(), x.y());
  if (closed) cairo_close_path(sheet_->cairo);
  cairo_stroke(sheet_->cairo);
}

void Painter::within(const std::vector<Polygon>& outlines, const std::function<void()>& draw) {
  cairo_save(sheet_->cairo);
  trace_path(sheet_->cairo, outlines);
  cairo_clip(sheet_->cairo);
  draw();
  cairo_restore(sheet_->cairo);
}

void Painter::picture(const Image& image, float x0, float y0, float x1, float y1) {
  const Surface surface = surface_of(image);
  cairo_t* cairo = sheet_->cairo;
  cairo_save(cairo);
  cairo_new_path(cairo);
  cairo_rectangle(cairo, x0, y0, x1 - x0, y1 - y0);
  cairo_clip(cairo);
  cairo_translate(cairo, x0, y0);
  cairo_scale(cairo, (x1 - x0) / float(image.width), (y1 - y0) / float(image.height));
  cairo_set_source_surface(cairo, surface.get(), 0, 0);
  cairo_pattern_set_extend(cairo_get_source(cairo), CAIRO_EXTEND_PAD);
  cairo_paint(cairo);
  cairo_restore(cairo);
}

void Painter::text(float x, float y, std::string_view text, float size, const Vec3f& color, Anchor anchor,
                   bool turned) {
  const float share = anchor == Anchor::start ? 0.0f : anchor == Anchor::middle ? 0.5f : 1.0f;
  const float back = share > 0 ? share * text_width(text, size) : 0.0f;
  cairo_t* cairo = sheet_->cairo;
  cairo_save(cairo);
  cairo_translate(cairo, x, y);
  if (turned) cairo_rotate(cairo, -M_PI / 2);
  cairo_move_to(cairo, -back, 0);
  sheet_->use(color, 1);
  cairo_set_font_size(cairo, size);
  cairo_show_text(cairo, std::string(text).c_str());
  cairo_restore(cairo);
}

float Painter::text_width(std::string_view text, float size) const {
  cairo_text_extents_t extents{};
  cairo_set_font_size(sheet_->cairo, size);
  cairo_text_extents(sheet_->cairo, std::string(text).c_str(), &extents);
  return float(extents.x_advance);
}

Image Painter::image() const {
  require_drawn(cairo_status(sheet_->cairo));
  cairo_surface_flush(sheet_->surface.get());
  const unsigned char* data = cairo_image_surface_get_data(sheet_->surface.get());
  const auto stride = std::size_t(cairo_image_surface_get_stride(sheet_->surface.get()));
  Image image{sheet_->width, sheet_->height, {}};
  image.rgb.reserve(std::size_t(3) * std::size_t(image.width) * std::size_t(image.height));
  bool opaque = true;
  for (int k = 0; k < image.width * image.height; ++k) {
    std::uint32_t word = 0;
    std::memcpy(&word, data + std::size_t(k / image.width) * stride + 4 * std::size_t(k % image.width), 4);
    const std::uint32_t alpha = word >> 24;
    for (int shift = 16; shift >= 0; shift -= 8) {
      const std::uint32_t value = word >> shift & 255;
      image.rgb.push_back(std::uint8_t(alpha == 0 ? 0 : std::min((value * 255 + alpha / 2) / alpha, 255U)));
    }
    image.alpha.push_back(std::uint8_t(alpha));
    opaque = opaque && alpha == 255;
  }
  if (opaque) image.alpha.clear();
  return image;
}

std::string Painter::page() {
  cairo_show_page(sheet_->cairo);
  require_drawn(cairo_status(sheet_->cairo));
  cairo_surface_finish(sheet_->surface.get());
  require_drawn(cairo_surface_status(sheet_->surface.get()));
  return std::move(sheet_->bytes);
}

}  // namespace seiche::render
