#include <fmt/format.h>

#include "base/agree.h"
#include "render/run.h"
#include "verbs.h"

namespace seiche {
namespace {

// Options as typed.
struct RenderWords {
  std::string run, out, size = "1280x720", camera, sheet, animation;
  render::RenderOptions options;
};

void render_pictures(RenderWords words, const CLI::App& verb) {
  render::RenderOptions& options = words.options;
  options.run = words.run;
  options.out = words.out;
  const auto [width, height] = render::parse_size(words.size);
  options.width = width;
  options.height = height;
  if (verb.count("--camera") > 0) options.camera = render::parse_camera(words.camera);
  if (verb.count("--contact-sheet") > 0) options.contact_sheet = words.sheet;
  if (verb.count("--animation") > 0) options.animation = words.animation;
  render::render_run(options, [](const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  });
}

}  // namespace

void add_render(CLI::App& program, VerbContext& context) {
  auto* verb = program.add_subcommand("render", "Turn the frames of a run into PNG pictures");
  auto words = std::make_shared<RenderWords>();
  verb->add_option("directory", words->run, "The directory of a run")->required();
  verb->add_option("--frames", words->options.frames, "all, 0-24, or 0,10,20")->capture_default_str();
  verb->add_option("--size", words->size, "Width and height in pixels")->capture_default_str();
  verb->add_option("--out", words->out, "Folder for the pictures; default: pictures in the directory");
  verb->add_option("--camera", words->camera,
                   "eye_x,eye_y,eye_z,look_x,look_y,look_z[,degrees]; default: all of the domain");
  verb->add_option("--up", words->options.up, "Axis that points up: auto (against gravity), x, y, z")
      ->check(CLI::IsMember({"auto", "x", "y", "z"}))
      ->capture_default_str();
  verb->add_option("--color", words->options.color,
                   "none, speed, or a field of the frames; auto: speed in 2D, none in 3D")
      ->capture_default_str();
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
