#include "render/job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "files/frames.h"
#include "scene/reader.h"

namespace seiche::render {
namespace {

using Say = std::function<void(const std::string&)>;

// The scene gives the up axis, the containers and the frame rate; pictures are possible without it.
Scene scene_of_run(const std::filesystem::path& run, const Say& say) {
  try {
    return read_scene(run / "scene.toml", {});
  } catch (const Error& error) {
    say(fmt::format("note: the scene cannot be read, so up is y unless --up says otherwise ({})", error.what()));
    return {};
  }
}

struct Range {
  float low = 1e30f, high = -1e30f;
};

// Widens the range by the values in the liquid of one frame, but for half a percent at either end. So single cells do
// not determine the colours.
void widen(Range& range, const LoadedFrame& frame) {
  std::vector<float> values;
  for (std::size_t c = 0; c < frame.quantity->values.size(); ++c) {
    if (!frame.phi || frame.phi->values[c] < 0) values.push_back(frame.quantity->values[c]);
  }
  if (values.empty()) return;
  const auto rank = std::ptrdiff_t(0.005 * double(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  range.low = std::min(range.low, values[std::size_t(rank)]);
  std::nth_element(values.begin(), values.end() - 1 - rank, values.end());
  range.high = std::max(range.high, *(values.end() - 1 - rank));
}

// Quantities with a sign are shown about zero; others from zero, unless they fall below it.
void set_range(ColorScale& scale, const Range& range, bool about_zero) {
  scale.low = std::min(0.0f, range.low), scale.high = std::max(0.0f, range.high);
  if (about_zero) scale.high = std::max(-scale.low, scale.high), scale.low = -scale.high;
  if (!(scale.high > scale.low)) scale.low = about_zero ? -1.0f : scale.low, scale.high = scale.low + 1;
}

ColorScale scale_of_job(const Job& job) {
  const std::string& quantity = job.wants.quantity;
  const bool about_zero = has_sign(quantity, job.dimension);
  const std::string& map = job.options.color_map;
  ColorScale scale{0, 1, label_of(quantity), &color_map(map != "auto" ? map : about_zero ? "coolwarm" : "viridis")};
  if (job.options.range) {
    scale.low = (*job.options.range)[0], scale.high = (*job.options.range)[1];
  } else if (!job.options.per_frame) {
    Range range;
    for (const int number : job.chosen) widen(range, load_frame(job.frames, number, {quantity, ""}));
    set_range(scale, range, about_zero);
  }
  return scale;
}

std::string quantity_of_job(const RenderOptions& options, const vdb::Frame& first) {
  if (options.color != "auto") return options.color;
  const bool has_speed =
      std::any_of(first.grids.begin(), first.grids.end(), [](const auto& g) { return g.name == "vel"; });
  return first.dimension == 2 && has_speed ? "speed" : "none";
}

// The option that needs the frames' velocity; "" if none does.
std::string needs_velocity(const RenderOptions& options) {
  return options.streamlines ? "--streamlines" : options.foam ? "--foam" : "";
}

}  // namespace

Job prepare_job(const RenderOptions& options, const Say& say) {
  Job job;
  job.options = options;
  job.frames = RunPaths{options.run}.frames();
  job.out = options.out.empty() ? options.run / "pictures" : options.out;
  const std::vector<int> available = list_frames(job.frames);
  if (available.empty()) {
    throw Error(ExitCode::bad_input,
                fmt::format("{}: there are no frames (frames/frame.0000.vdb and on) to render; give the "
                            "directory of a run",
                            options.run.string()));
  }
  job.chosen = choose_frames(options.frames, available);
  const vdb::Frame first = vdb::decode(job.frames / frame_file("frame", job.chosen.front(), "vdb"));
  job.dimension = first.dimension;
  job.wants = {quantity_of_job(options, first), needs_velocity(options)};
  require_fitting_options(options, job.dimension, job.wants.quantity != "none");
  job.scene = scene_of_run(options.run, say);
  if (job.wants.quantity != "none") job.scale = scale_of_job(job);
  return job;
}

ColorScale scale_of(const Job& job, const LoadedFrame& frame) {
  ColorScale scale = job.scale;
  if (!job.options.per_frame || !frame.quantity) return scale;
  Range range;
  widen(range, frame);
  set_range(scale, range, has_sign(job.wants.quantity, job.dimension));
  return scale;
}

void require_fitting_options(const RenderOptions& o, int dimension, bool has_quantity) {
  const bool pages = o.format == Format::svg || o.format == Format::pdf;
  const std::string format = extension_of(o.format);
  const bool flat = dimension == 2;
  struct Rule {
    bool broken;
    std::string text;
  };
  const Rule rules[] = {
      {flat && o.camera, "--camera is for 3D runs, and this one is 2D; leave it out"},
      {flat && !o.camera_path.empty(), "--camera-path is for 3D runs, and this one is 2D; leave it out"},
      {flat && o.turntable > 0, "--turntable is for 3D runs, and this one is 2D; leave it out"},
      {flat && o.foam, "--foam is for 3D runs, and this one is 2D; leave it out"},
      {flat && o.transparent, "--transparent is for 3D runs, and this one is 2D; leave it out"},
      {flat && o.format == Format::exr, "--format exr is for 3D runs, and this one is 2D; take svg, pdf or png"},
      {!flat && o.streamlines, "--streamlines is for 2D runs, and this one is 3D; take --color speed or vorticity"},
      {!flat && pages, "--format " + format + " is for 2D runs, and pictures of this one are pixels; take png or exr"},
      {o.camera && !o.camera_path.empty(), "--camera and --camera-path exclude each other; leave one out"},
      {o.turntable > 0 && !o.camera_path.empty(), "--turntable and --camera-path exclude each other; leave one out"},
      {o.range && o.per_frame, "--range and --per-frame exclude each other; leave one out"},
      {!has_quantity && o.range, "--range needs a field to colour by; add --color speed, for instance"},
      {!has_quantity && o.per_frame, "--per-frame needs a field to colour by; add --color speed, for instance"},
      {!has_quantity && o.color_map != "auto", "--colors needs a field to colour by; add --color speed, for instance"},
      {has_quantity && o.foam, "--foam is for liquid in its own colour; leave out --color or --foam"},
      {o.format != Format::png && o.animation, "--animation is made of PNG pictures; leave out --format " + format},
      {o.format != Format::png && o.contact_sheet,
       "--contact-sheet is made of PNG pictures; leave out --format " + format},
  };
  for (const Rule& rule : rules)
    if (rule.broken) throw Error(ExitCode::bad_input, rule.text);
}

}  // namespace seiche::render
