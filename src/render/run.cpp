#include "render/run.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "base/gravity.h"
#include "base/scene.h"
#include "files/checked_file.h"
#include "files/frames.h"
#include "render/extras.h"
#include "render/font.h"
#include "render/frame.h"
#include "render/palette.h"
#include "render/plot.h"
#include "render/png_writer.h"
#include "render/trace.h"
#include "scene/reader.h"

namespace seiche::render {
namespace {

using Say = std::function<void(const std::string&)>;

// Settings shared by all pictures of a run.
struct Job {
  RenderOptions options;
  Scene scene;
  std::filesystem::path frames, out;
  std::vector<int> chosen;
  std::string quantity = "none";
  ColorScale scale;
};

// The scene gives the up axis, the containers and the frame rate; pictures are possible without it.
Scene scene_of_run(const std::filesystem::path& run, const Say& say) {
  try {
    return read_scene(run / "scene.toml", {});
  } catch (const Error& error) {
    say(fmt::format("note: the scene cannot be read, so up is y unless --up says otherwise ({})", error.what()));
    return {};
  }
}

int axis_upwards(const Job& job) {
  if (job.options.up != "auto") return job.options.up[0] - 'x';
  int axis = 1;
  const Vec3 g = Gravity(job.scene.gravity).at(0);
  if (g.norm() > 0) g.cwiseAbs().maxCoeff(&axis);
  return axis;
}

// Scale from the quantity's values in the liquid of all chosen frames: zero or the lowest half percent, to the highest
// half percent. So single cells do not determine the scale.
ColorScale measure_scale(const Job& job) {
  ColorScale scale{0, 0, label_of(job.quantity)};
  for (const int number : job.chosen) {
    const LoadedFrame frame = load_frame(job.frames, number, job.quantity);
    std::vector<float> values;
    for (std::size_t c = 0; c < frame.quantity->values.size(); ++c) {
      if (!frame.phi || frame.phi->values[c] < 0) values.push_back(frame.quantity->values[c]);
    }
    if (values.empty()) continue;
    const auto rank = std::ptrdiff_t(0.005 * double(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    scale.low = std::min(scale.low, values[rank]);
    std::nth_element(values.begin(), values.end() - 1 - rank, values.end());
    scale.high = std::max(scale.high, *(values.end() - 1 - rank));
  }
  if (scale.high <= scale.low) scale.high = scale.low + 1;
  return scale;
}

Canvas picture_2d(const Job& job, LoadedFrame& frame) {
  if (!frame.phi) {  // no surface in the frame: the whole domain counts as liquid
    frame.phi = frame.quantity;
    if (!frame.phi)
      throw Error(
          ExitCode::bad_input,
          "the frames have neither a surface nor the field given by --color; render other frames or another --color");
    std::fill(frame.phi->values.begin(), frame.phi->values.end(), -frame.phi->h);
  }
  const Plot plot{frame.domain, *frame.phi, frame.quantity, job.scale, frame.solids, solid_colors(job.scene.solids)};
  return plot_picture(plot, job.options.width, job.options.height);
}

Canvas picture_3d(const Job& job, LoadedFrame& frame) {
  clip_to_containers(frame, job.scene.solids);
  Stage stage;
  stage.domain = frame.domain;
  stage.up_axis = axis_upwards(job);
  if (frame.phi) stage.liquid = std::make_unique<LiquidSurface>(std::move(*frame.phi));
  stage.quantity = std::move(frame.quantity);
  stage.scale = job.scale;
  stage.solids = Bvh(smooth_triangles(frame.solids));
  stage.colors = solid_colors(job.scene.solids);
  for (const SolidSpec& solid : job.scene.solids) stage.containers.push_back(solid.shape.invert);
  const auto& [width, height] = std::array{job.options.width, job.options.height};
  const Camera camera = job.options.camera ? make_camera(*job.options.camera, stage.up(), width, height)
                                           : frame_box(stage.domain, stage.up_axis, width, height);
  light_stage(stage, -camera.forward);
  Canvas canvas = trace_picture(stage, camera);
  const int font = font_scale(height), bar = height / 2;
  const int x = width - 60 * font, y = (height - bar) / 2;
  if (stage.quantity) draw_color_bar(canvas, {x, y, x + 10 * font, y + bar}, job.scale, font, {0.05f, 0.06f, 0.08f});
  return canvas;
}

struct LabelledPicture {
  Image image;
  std::string label;
};

LabelledPicture make_picture(const Job& job, int number) {
  LoadedFrame frame = load_frame(job.frames, number, job.quantity);
  Canvas canvas = frame.dimension == 2 ? picture_2d(job, frame) : picture_3d(job, frame);
  const int font = font_scale(canvas.height);
  const std::string label = fmt::format("frame {}   t = {:.3f} s", number, frame.time);
  draw_text(canvas, 6 * font, 6 * font, label, font, {0.05f, 0.06f, 0.08f});
  return {to_image(canvas), label};
}

Job prepare(const RenderOptions& options, const Say& say) {
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
  job.scene = scene_of_run(options.run, say);
  const vdb::Frame first = vdb::decode(job.frames / frame_file("frame", job.chosen.front(), "vdb"));
  const bool has_speed =
      std::any_of(first.grids.begin(), first.grids.end(), [](const auto& g) { return g.name == "vel"; });
  job.quantity = options.color;
  if (options.color == "auto") job.quantity = first.dimension == 2 && has_speed ? "speed" : "none";
  if (job.quantity != "none") job.scale = measure_scale(job);
  return job;
}

}  // namespace

RenderReport render_run(const RenderOptions& options, const Say& say) {
  const Job job = prepare(options, say);
  make_folder(job.out);
  RenderReport report;
  std::vector<std::filesystem::path> pictures;
  ContactSheet sheet(int(job.chosen.size()), options.width, options.height);
  for (const int number : job.chosen) {
    const LabelledPicture picture = make_picture(job, number);
    pictures.push_back(job.out / frame_file("frame", number, "png"));
    write_png(pictures.back(), picture.image);
    sheet.offer(report.pictures++, picture.image, picture.label);
    say(pictures.back().string());
  }
  if (options.contact_sheet) {
    const auto file = options.contact_sheet->empty() ? job.out / "contact_sheet.png" : *options.contact_sheet;
    write_png(file, sheet.image());
    report.files.push_back(file);
  }
  if (options.animation) {
    const double rate = job.scene.time.frame_rate;
    const std::string trouble = encode_animation(pictures, rate <= 60 ? rate : 30, *options.animation);
    if (trouble.empty())
      report.files.push_back(*options.animation);
    else
      say(trouble);
  }
  for (const auto& file : report.files) say(file.string());
  return report;
}

}  // namespace seiche::render
