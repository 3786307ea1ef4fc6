#include <fmt/format.h>

#include "base/agree.h"
#include "base/program_file.h"
#include "info/examples.h"
#include "verbs.h"

namespace seiche {
namespace {

struct InitWords {
  std::string scene = "scene.toml", example = "dam_break_2d";
  bool lists = false;
  Existing existing = Existing::keep;
};

void start_scene(const InitWords& words) {
  const std::filesystem::path folder = installed_folder("scenes");
  if (folder.empty())
    throw Error(ExitCode::bad_input, "the example scenes are not beside the program (share/seiche/scenes)");
  if (words.lists) {
    for (const Example& example : list_examples(folder)) fmt::print("{:30} {}\n", example.name, example.title);
    return;
  }
  for (const auto& file : copy_example(folder, words.example, words.scene, words.existing))
    fmt::print("written: {}\n", file.string());
  fmt::print("next: seiche check {0}; seiche run {0}\n", words.scene);
}

}  // namespace

void add_init(CLI::App& program, VerbContext& context) {
  auto* verb = program.add_subcommand("init", "Start a scene from an example");
  auto words = std::make_shared<InitWords>();
  verb->add_option("scene", words->scene, "Scene file to write")->capture_default_str();
  verb->add_option("--example", words->example, "Example that it starts from")->capture_default_str();
  verb->add_flag_callback(
      "--list", [words] { words->lists = true; }, "Show the examples and write nothing");
  verb->add_flag_callback(
      "--overwrite", [words] { words->existing = Existing::replace; }, "Replace files that are there");
  verb->callback([words, &context] {
    context.action = [words, &context] {
      agree_on_root(context.ranks, "starting a scene", [&] { start_scene(*words); });
      return ExitCode::done;
    };
  });
}

}  // namespace seiche
