#include "exporting/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "base/scene.h"
#include "base/version.h"
#include "exporting/axes.h"
#include "exporting/usd.h"
#include "exporting/xdmf.h"
#include "files/frames.h"
#include "files/point_cache.h"
#include "files/vtu_reader.h"
#include "render/frame.h"
#include "render/palette.h"
#include "render/run.h"
#include "scene/reader.h"

namespace seiche::exporting {
namespace {

namespace fs = std::filesystem;
using Say = std::function<void(const std::string&)>;

struct Job {
  ExportOptions options;
  RunPaths paths;
  fs::path out;
  Scene scene;
  std::vector<int> frames;
  std::vector<std::string> names;  // of the solids
  std::unique_ptr<PoseTable> poses;
  Turn turn;
  char up = 'Y';

  std::string comment() const { return fmt::format("seiche {}: {}", version(), scene.title); }
};

std::string frames_text(const Job& job) {
  return fmt::format("{} frame{}", job.frames.size(), job.frames.size() == 1 ? "" : "s");
}

// Liquid and solids of a frame, turned.
struct Contents {
  double time = 0;
  AttributedMesh liquid;
  std::vector<SurfaceMesh> solids;
};

// USD knows stages with y or z up. Other formats keep the scene's axes unless told otherwise.
void choose_axes(Job& job) {
  const Vec3 up = up_of(job.scene);
  const bool is_z = up == Vec3::UnitZ();
  if (job.options.up != "scene") {
    job.up = char(std::toupper(job.options.up[0]));
    job.turn = Turn(up, job.up == 'Z' ? Vec3::UnitZ() : Vec3::UnitY());
  } else if (is_z || up == Vec3::UnitY() || job.options.format != "usd") {
    job.up = is_z ? 'Z' : 'Y';
  } else {
    job.turn = Turn(up, Vec3::UnitY());
  }
}

Job prepare(const ExportOptions& options) {
  Job job{options, {options.run}, options.out.empty() ? options.run / "export" : options.out, {}, {}, {}, {}, {}};
  const std::vector<int> available = render::list_frames(job.paths.frames());
  if (available.empty())
    throw Error(ExitCode::bad_input, fmt::format("{}: there are no frames (frames/frame.0000.vdb and on) to export; "
                                                 "give the directory of a run",
                                                 options.run.string()));
  job.frames = render::choose_frames(options.frames, available);
  job.scene = read_scene(job.paths.scene(), {});
  if (job.scene.dimension == 2 && options.format != "xdmf")
    throw Error(ExitCode::bad_input,
                fmt::format("{}: is a run in 2D; {} files hold surfaces of 3D runs; --format xdmf holds both",
                            options.run.string(), options.format));
  for (const SolidSpec& solid : job.scene.solids) job.names.push_back(solid.name);
  if (options.format == "usd") job.poses = std::make_unique<PoseTable>(job.paths.solids(), job.names);
  if (job.options.up.empty()) job.options.up = job.scene.output.up;
  choose_axes(job);
  return job;
}

Contents read_contents(const Job& job, int number) {
  const vdb::Frame frame = vdb::decode(job.paths.frames() / frame_file("frame", number, "vdb"));
  Contents contents{frame.time, liquid_mesh(frame), {}};
  job.turn.apply(contents.liquid);
  const fs::path solids = job.paths.frames() / frame_file("solids", number, "vtu");
  if (job.names.empty()) return contents;
  contents.solids = split(render::read_solids(solids), job.names.size());
  for (SurfaceMesh& mesh : contents.solids) job.turn.apply(mesh);
  return contents;
}

void write_meshes(const Job& job, const Say& say) {
  const std::string& format = job.options.format;
  const std::vector<std::string> stems = point_cache::stems(job.names);
  const auto encode = [&](const AttributedMesh& mesh, const std::string& name) {
    return format == "ply" ? mesh::encode_ply(mesh.mesh, mesh.attributes, job.comment())
                           : mesh::encode_obj(mesh.mesh, name, job.comment());
  };
  for (const int number : job.frames) {
    const Contents contents = read_contents(job, number);
    write_file(job.out / frame_file("liquid", number, format), encode(contents.liquid, "liquid"));
    for (std::size_t k = 0; k < contents.solids.size(); ++k) {
      const bool moves = job.scene.solids[k].kind.moves();
      if (!moves && number != job.frames.front()) continue;
      write_file(job.out / (moves ? frame_file(stems[k], number, format) : stems[k] + "." + format),
                 encode({contents.solids[k], {}}, stems[k]));
    }
    say(fmt::format("frame {}: liquid of {} triangles", number, contents.liquid.mesh.triangles.size()));
  }
  say(fmt::format("{} in {}", frames_text(job), job.out.string()));
}

bool has_pose(const SolidSpec& solid) {
  return solid.kind.moves() && !solid.kind.deforms();
}

SurfaceMesh in_body_frame(SurfaceMesh mesh, const Pose& pose) {
  for (Vec3& x : mesh.points) x = pose.orientation.conjugate() * (x - pose.position);
  return mesh;
}

void add_solids(const Job& job, int number, const Contents& contents, const std::vector<std::string>& prims,
                UsdWriter& writer) {
  const std::vector<Eigen::Vector3f> colors = render::solid_colors(job.scene.solids);
  const bool is_first = number == job.frames.front();
  for (std::size_t k = 0; k < contents.solids.size(); ++k) {
    const SolidSpec& solid = job.scene.solids[k];
    const Vec3 color = colors[k].cast<double>();
    if (has_pose(solid)) {
      const Pose pose = job.turn(job.poses->at(k, contents.time));
      if (is_first) writer.add_body(prims[k], in_body_frame(contents.solids[k], pose), color);
      writer.add_pose(prims[k], number, pose);
    } else if (solid.kind.moves()) {
      writer.add_sample(prims[k], number, {contents.solids[k], {}}, color);
    } else if (is_first) {
      writer.add_body(prims[k], contents.solids[k], color);
    }
  }
}

// Name of the run directory.
std::string stem_of(const Job& job) {
  return fs::absolute(job.options.run / "").lexically_normal().parent_path().filename().string();
}

void write_xdmf(const Job& job, const Say& say) {
  XdmfWriter writer(job.out / stem_of(job));
  for (const int number : job.frames) {
    const fs::path solids = job.paths.frames() / frame_file("solids", number, "vtu");
    writer.add_frame(vdb::decode(job.paths.frames() / frame_file("frame", number, "vdb")),
                     job.names.empty() ? render::SolidMesh{} : render::read_solids(solids));
    say(fmt::format("frame {}", number));
  }
  writer.finish();
  if (job.options.up != "scene") say("note: XDMF files keep the scene's axes, whatever up says");
  say(fmt::format("{} in {}.xdmf and .h5", frames_text(job), (job.out / stem_of(job)).string()));
}

void write_usd(const Job& job, const Say& say) {
  std::vector<std::string> texts{"liquid"};
  texts.insert(texts.end(), job.names.begin(), job.names.end());
  std::vector<std::string> prims = prim_names(texts);
  prims.erase(prims.begin());
  const std::string stem = stem_of(job);
  const fs::path file = job.out / (stem + ".usda");
  const StageFacts facts{job.comment(),     prim_names({stem})[0],     job.frames.front(),
                         job.frames.back(), job.scene.time.frame_rate, job.up};
  UsdWriter writer(file, facts);
  for (const int number : job.frames) {
    const Contents contents = read_contents(job, number);
    writer.add_sample("liquid", number, contents.liquid, {0.16, 0.4, 0.6});
    add_solids(job, number, contents, prims, writer);
    say(fmt::format("frame {}: liquid of {} triangles", number, contents.liquid.mesh.triangles.size()));
  }
  writer.finish();
  say(fmt::format("{} in {} ({:.1f} MB)", frames_text(job), file.string(), double(fs::file_size(file)) / 1e6));
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& formats() {
  static const std::vector<std::pair<std::string, std::string>> table{
      {"ply", "a mesh of the liquid and of each solid a frame, with velocities"},
      {"obj", "the same without velocities"},
      {"usd", "one .usda file with the liquid, the solids and their motion"},
      {"xdmf", "one .xdmf file with an .h5 for ParaView, 2D and 3D: fields at cells and nodes, solids"}};
  return table;
}

void export_run(const ExportOptions& options, const Say& say) {
  const Job job = prepare(options);
  make_folder(job.out);
  if (options.format == "usd")
    write_usd(job, say);
  else if (options.format == "xdmf")
    write_xdmf(job, say);
  else
    write_meshes(job, say);
}

}  // namespace seiche::exporting
