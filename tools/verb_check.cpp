// The verb check, with its picture of the start.
#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <filesystem>

#include "base/agree.h"
#include "console.h"
#include "files/checked_file.h"
#include "render/run.h"
#include "run/command.h"
#include "verb_options.h"
#include "verbs.h"

namespace seiche {
namespace {

namespace fs = std::filesystem;

// A folder for the frame of a picture, known on all ranks; removed with its content at the end.
class ScratchRun {
 public:
  explicit ScratchRun(const Communicator& ranks) : ranks_(ranks) {
    agree_on_root(ranks_, "making a folder for the picture", [&] {
      std::string name = (fs::temp_directory_path() / "seiche-check-XXXXXX").string();
      if (::mkdtemp(name.data()) == nullptr)
        throw Error(ExitCode::output_failed, describe_failure(name, "make the folder", errno));
      folder_ = name;
    });
    folder_ = ranks_.broadcast(folder_.string());
  }
  ~ScratchRun() {
    std::error_code ignored;
    if (ranks_.is_root()) fs::remove_all(folder_, ignored);
  }
  ScratchRun(const ScratchRun&) = delete;
  ScratchRun& operator=(const ScratchRun&) = delete;
  const fs::path& folder() const { return folder_; }

 private:
  const Communicator& ranks_;
  fs::path folder_;
};

// Draws the frame of t = 0 that the folder of a run holds.
void draw_start(const fs::path& folder, const fs::path& picture) {
  render::RenderOptions options;
  options.run = folder;
  options.frames = "0";
  options.color = "none";
  render::render_run(options, [](const std::string&) {});
  if (picture.has_parent_path()) make_folder(picture.parent_path());
  write_file(picture, read_whole_file(folder / "pictures" / "frame.0000.png"));
}

ExitCode check_and_draw(CheckOptions options, const fs::path& picture, const Surroundings& around) {
  const ScratchRun scratch(around.ranks);
  options.frame_folder = scratch.folder();
  const ExitCode code = check_command(options, around);
  agree_on_root(around.ranks, "drawing the scene", [&] { draw_start(scratch.folder(), picture); });
  if (around.ranks.is_root() && !options.json) fmt::print("picture {}\n", picture.string());
  return code;
}

}  // namespace

void add_check(CLI::App& program, VerbContext& context) {
  CLI::App* verb = program.add_subcommand("check", "Read and verify a scene, show what it holds and will cost");
  const auto options = std::make_shared<CheckOptions>();
  const auto picture = std::make_shared<std::string>();
  verb->add_option("scene", options->scene, "Scene file")->required();
  add_set_option(*verb, options->overrides);
  verb->add_option("--picture", *picture, "Also draw the start, t = 0, to this PNG file")->type_name("FILE.png");
  verb->add_option("--measure", options->trial_steps, "Make so many steps, keep nothing, and estimate by them")
      ->check(CLI::Range(1, 100'000));
  verb->add_option("--threads", options->threads, "Threads a rank that the estimated run would have")
      ->check(CLI::Range(1, 4096));
  verb->add_flag("--json", options->json, "Print one JSON object in place of the table");
  verb->callback([options, picture, &context] {
    context.action = [options, picture, &context] {
      const Surroundings around = surroundings(context);
      if (picture->empty()) return check_command(*options, around);
      return check_and_draw(*options, *picture, around);
    };
  });
}

}  // namespace seiche
