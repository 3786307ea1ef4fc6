#include "render/pictures.h"

#include <fmt/format.h>

#include <cmath>

#include <Eigen/Geometry>

#include "base/error.h"
#include "base/gravity.h"
#include "files/checked_file.h"
#include "render/drops.h"
#include "render/exr_writer.h"
#include "render/foam.h"
#include "render/font.h"
#include "render/outline.h"
#include "render/palette.h"
#include "render/png_writer.h"
#include "render/streamlines.h"
#include "render/trace.h"

namespace seiche::render {
namespace {

const Vec3f ink{0.05f, 0.06f, 0.08f};

int axis_upwards(const Job& job) {
  if (job.options.up != "auto") return job.options.up[0] - 'x';
  int axis = 1;
  const Vec3 g = Gravity(job.scene.gravity).at(0);
  if (g.norm() > 0) g.cwiseAbs().maxCoeff(&axis);
  return axis;
}

const LiquidLook& look_of(const Job& job) {
  return liquid_look(job.options.material == "auto" ? material_of(job.scene.liquid) : job.options.material);
}

std::string label_of_frame(const LoadedFrame& frame) {
  return fmt::format("frame {}   t = {:.3f} s", frame.number, frame.time);
}

void draw_label(Painter& painter, const std::string& label) {
  const float size = text_size(painter.width(), painter.height());
  painter.text(0.7f * size, 0.7f * size + cap_height(size), label, size, ink);
}

// Speed at which water is taken for fast: that of a fall over half of the domain's height.
float fast_speed(const Job& job, const Stage& stage) {
  const auto g = float(Gravity(job.scene.gravity).at(0).norm());
  return std::sqrt((g > 0 ? g : 9.81f) * stage.domain.size()[stage.up_axis]);
}

// Streamlines in the liquid of a 2D frame, or in all fluid where gas flows, and outside of solids.
std::vector<Polygon> streamlines_of(const Job& job, const LoadedFrame& frame) {
  const std::vector<std::vector<Polygon>> solids = solid_outlines(frame.solids, frame.domain);
  const bool everywhere = job.scene.gas.flows() || !frame.phi;
  const auto flows = [&](const Vec2f& x) {
    const Vec3f at(x.x(), x.y(), frame.phi ? frame.phi->lower[2] + 0.5f * frame.phi->h : 0.0f);
    return (everywhere || frame.phi->sample(at) < 0) && !is_inside(solids, x);
  };
  return streamlines(*frame.velocity, frame.domain.size().head<2>().norm() / 45, flows);
}

}  // namespace

std::vector<Shot> shots_of(const Job& job) {
  std::vector<Shot> shots;
  const int turn = job.options.turntable;
  const bool still = turn > 0 && job.chosen.size() == 1;
  const std::size_t count = still ? std::size_t(turn) : job.chosen.size();
  for (std::size_t n = 0; n < count; ++n)
    shots.push_back({job.chosen[still ? 0 : n], turn > 0 ? 360.0f * float(n) / float(turn) : 0.0f});
  return shots;
}

Studio::Studio(const Job& job) : job_(job), refiner_(job.scene.solids) {
  const RenderOptions& o = job.options;
  if (o.camera_path.empty()) return;
  path_ = read_camera_path(o.camera_path, o.camera_steps == "linear" ? CurveForm::linear : CurveForm::smooth);
}

void Studio::load(int number) {
  if (frame_ && frame_->number == number) return;
  frame_ = load_frame(job_.frames, number, job_.wants);
  if (frame_->dimension != job_.dimension) {
    throw Error(ExitCode::bad_input, fmt::format("frame {} is {}D, and the first one {}D; render them one by one",
                                                 number, frame_->dimension, job_.dimension));
  }
  if (frame_->dimension == 3) set_stage();
}

Studio::Result Studio::draw(const Shot& shot, const std::filesystem::path& file) {
  load(shot.frame);
  return job_.dimension == 2 ? draw_flat(file) : draw_solid(shot, file);
}

Plot Studio::plot_of_frame() {
  LoadedFrame& frame = *frame_;
  if (!frame.phi) {  // no surface in the frame: the whole domain counts as liquid
    frame.phi = frame.quantity;
    if (!frame.phi)
      throw Error(
          ExitCode::bad_input,
          "the frames have neither a surface nor the field given by --color; render other frames or another --color");
    std::fill(frame.phi->values.begin(), frame.phi->values.end(), -frame.phi->h);
  }
  refiner_.refine(frame);
  Plot plot;
  plot.domain = frame.domain;
  plot.phi = *frame.phi;
  plot.quantity = frame.quantity;
  plot.scale = scale_of(job_, frame);
  plot.solids = frame.solids;
  plot.colors = solid_colors(job_.scene.solids);
  if (frame.velocity) plot.streamlines = streamlines_of(job_, frame);
  plot.liquid = look_of(job_).flat;
  plot.drops = discs_of(frame.drops, plot.quantity ? job_.wants.quantity : "none", plot.scale, plot.liquid);
  plot.plain = job_.options.plain;
  return plot;
}

Studio::Result Studio::draw_flat(const std::filesystem::path& file) {
  const RenderOptions& o = job_.options;
  Painter painter(o.width, o.height, o.format, o.font);
  draw_plot(painter, plot_of_frame());
  Result result{label_of_frame(*frame_), {}};
  if (!o.plain) draw_label(painter, result.label);
  if (o.format != Format::png) return write_file(file, painter.page()), result;
  result.image = painter.image();
  write_png(file, result.image);
  return result;
}

void Studio::set_stage() {
  LoadedFrame& frame = *frame_;
  refiner_.refine(frame);
  clip_to_containers(frame, job_.scene.solids);
  stage_ = Stage{};
  stage_.domain = frame.domain;
  stage_.up_axis = axis_upwards(job_);
  stage_.look = look_of(job_);
  stage_.transparent = job_.options.transparent;
  stage_.scale = scale_of(job_, frame);
  if (frame.phi && frame.velocity)
    stage_.foam = foam_of(*frame.phi, *frame.velocity, fast_speed(job_, stage_), *job_.options.foam);
  if (frame.phi) stage_.liquid = std::make_unique<LiquidSurface>(std::move(*frame.phi));
  stage_.quantity = std::move(frame.quantity);
  stage_.colors = solid_colors(job_.scene.solids);
  for (const SolidSpec& solid : job_.scene.solids) stage_.containers.push_back(solid.shape.invert);
  if (!frame.drops.empty()) {
    add_spheres(frame.drops, int(stage_.colors.size()), frame.solids);
    stage_.colors.push_back(drop_color(stage_.look));
    stage_.containers.push_back(false);
  }
  stage_.solids = Bvh(smooth_triangles(frame.solids));
  if (!toward_eye_) toward_eye_ = -camera_of({frame.number, 0}).forward;
  light_stage(stage_, *toward_eye_);
}

Camera Studio::camera_of(const Shot& shot) const {
  const RenderOptions& o = job_.options;
  Camera camera = frame_box(stage_.domain, stage_.up_axis, o.width, o.height);
  if (!path_.empty()) camera = make_camera(path_.at(frame_->time), stage_.up(), o.width, o.height);
  if (o.camera) camera = make_camera(*o.camera, stage_.up(), o.width, o.height);
  if (shot.degrees == 0) return camera;
  const Eigen::AngleAxisf turn(shot.degrees * float(M_PI) / 180, stage_.up());
  const Vec3f center = o.camera ? o.camera->look : stage_.domain.center();
  camera.eye = center + turn * (camera.eye - center);
  for (Vec3f* direction : {&camera.forward, &camera.side, &camera.up}) *direction = turn * *direction;
  return camera;
}

Studio::Result Studio::draw_solid(const Shot& shot, const std::filesystem::path& file) {
  const RenderOptions& o = job_.options;
  const bool exr = o.format == Format::exr, plain = o.plain || o.transparent;
  const Canvas canvas = trace_picture(stage_, camera_of(shot), {!plain, !exr});
  Result result{label_of_frame(*frame_), {}};
  if (exr) return write_exr(file, canvas), result;
  result.image = to_image(canvas);
  if (!plain) {
    Painter painter(result.image, o.font);
    const PlotStyle style{text_size(o.width, o.height)};
    const float bar = 0.5f * float(o.height), y = 0.5f * (float(o.height) - bar);
    const float x = float(o.width) - room_of_color_bar(painter, stage_.scale, bar, style) - 1.5f * style.size;
    if (stage_.quantity) draw_color_bar(painter, {x, y, x + style.size, y + bar}, stage_.scale, style);
    draw_label(painter, result.label);
    result.image = painter.image();
  }
  write_png(file, result.image);
  return result;
}

}  // namespace seiche::render
