#include <fmt/format.h>

#include "base/agree.h"
#include "render/color_maps.h"
#include "render/run.h"
#include "verbs.h"

namespace seiche {
namespace {

// Options as typed.
struct RenderWords {
  std::string run, out, size = "1280x720", format = "png", camera, camera_path, range, sheet, animation;
  float foam = 1;
  render::RenderOptions options;
};

void render_pictures(RenderWords words, const CLI::App& verb) {
  render::RenderOptions& options = words.options;
  options.run = words.run;
  options.out = words.out;
  options.camera_path = words.camera_path;
  options.format = render::parse_format(words.format, "--format");
  const auto [width, height] = render::parse_size(words.size);
  options.width = width;
  options.height = height;
  if (verb.count("--camera") > 0) options.camera = render::parse_camera(words.camera);
  if (verb.count("--range") > 0) options.range = render::parse_color_range(words.range);
  if (verb.count("--foam") > 0) options.foam = words.foam;
  if (verb.count("--contact-sheet") > 0) options.contact_sheet = words.sheet;
  if (verb.count("--animation") > 0) options.animation = words.animation;
  render::render_run(options, [](const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  });
}

void add_color_options(CLI::App& verb, RenderWords& words) {
  verb.add_option("--color", words.options.color,
                  "none, speed, velocity_x, velocity_y, velocity_z, vorticity, divergence, or a field of the frames; "
                  "auto: speed in 2D, none in 3D")
      ->capture_default_str();
  verb.add_option("--colors", words.options.color_map,
                  fmt::format("Colour map: {}; auto: coolwarm for quantities with a sign, else viridis",
                              fmt::join(render::color_map_names(), ", ")))
      ->capture_default_str();
  verb.add_option("--range", words.range, "LOW,HIGH of the colours; default: from all frames that are drawn");
  verb.add_flag("--per-frame", words.options.per_frame, "Each frame has a range of colours of its own");
  verb.add_flag("--streamlines", words.options.streamlines, "2D: draws streamlines");
}

void add_camera_options(CLI::App& verb, RenderWords& words) {
  verb.add_option("--camera", words.camera,
                  "3D: eye_x,eye_y,eye_z,look_x,look_y,look_z[,degrees]; default: all of the domain");
  verb.add_option("--camera-path", words.camera_path,
                  "3D: CSV with rows time,eye_x,eye_y,eye_z,look_x,look_y,look_z[,degrees]");
  verb.add_option("--camera-steps", words.options.camera_steps, "Way of the camera between rows: smooth, linear")
      ->check(CLI::IsMember({"smooth", "linear"}))
      ->capture_default_str();
  verb.add_option("--turntable", words.options.turntable,
                  "3D: the camera turns round in this number of pictures, of one frame or along the frames")
      ->check(CLI::Range(2, 100000));
  verb.add_option("--up", words.options.up, "Axis that points up: auto (against gravity), x, y, z")
      ->check(CLI::IsMember({"auto", "x", "y", "z"}))
      ->capture_default_str();
}

void add_look_options(CLI::App& verb, RenderWords& words) {
  verb.add_option("--material", words.options.material,
                  "The liquid looks like water, honey, milk, ...; auto: by the scene's density and viscosity")
      ->capture_default_str();
  verb.add_option("--foam", words.foam, "3D: white foam and spray where the surface bends and is fast; amount")
      ->expected(0, 1)
      ->default_str("1")
      ->check(CLI::Range(0.0, 100.0));
  verb.add_flag("--transparent", words.options.transparent, "3D: no ground and no sky, but alpha; plain");
  verb.add_flag("--plain", words.options.plain, "No texts, axes, colour bar, edges of the domain");
  verb.add_option("--font", words.options.font, "Font of the texts, a family or a file; default: DejaVu Sans");
}

}  // namespace

void add_render(CLI::App& program, VerbContext& context) {
  auto* verb = program.add_subcommand("render", "Turn the frames of a run into pictures");
  auto words = std::make_shared<RenderWords>();
  verb->add_option("directory", words->run, "The directory of a run")->required();
  verb->add_option("--frames", words->options.frames, "all, 0-24, or 0,10,20")->capture_default_str();
  verb->add_option("--size", words->size, "Width and height in pixels")->capture_default_str();
  verb->add_option("--format", words->format, "png; 2D also svg, pdf; 3D also exr (linear light)")
      ->capture_default_str();
  verb->add_option("--out", words->out, "Folder for the pictures; default: pictures in the directory");
  add_color_options(*verb, *words);
  add_camera_options(*verb, *words);
  add_look_options(*verb, *words);
  verb->add_option("--contact-sheet", words->sheet,
                   "Also one PNG with up to 12 frames; without a name: contact_sheet.png in --out")
      ->expected(0, 1);
  verb->add_option("--animation", words->animation, "Film of the frames, such as film.mp4; needs ffmpeg");
  verb->callback([words, verb, &context] {
    context.action = [words, verb, &context] {
      agree_on_root(context.ranks, "rendering " + words->run, [&] { render_pictures(*words, *verb); });
      return ExitCode::done;
    };
  });
}

}  // namespace seiche
