#include <fmt/format.h>

#include "base/agree.h"
#include "exporting/run.h"
#include "verbs.h"

namespace seiche {

void add_export(CLI::App& program, VerbContext& context) {
  auto* verb = program.add_subcommand("export", "Write the frames of a run as meshes or scenes for other programs");
  auto options = std::make_shared<exporting::ExportOptions>();
  auto words = std::make_shared<std::array<std::string, 2>>();
  std::vector<std::string> names;
  std::string help = "Form of the files:";
  for (const auto& [name, doc] : exporting::formats()) {
    names.push_back(name);
    help += fmt::format("{} {}: {}", names.size() > 1 ? ";" : "", name, doc);
  }
  verb->add_option("directory", (*words)[0], "The directory of a run")->required();
  verb->add_option("--format", options->format, help)->required()->check(CLI::IsMember(names));
  verb->add_option("--frames", options->frames, "all, 0-24, or 0,10,20")->capture_default_str();
  verb->add_option("--out", (*words)[1], "Folder for the files; default: export in the directory");
  verb->add_option("--up", options->up,
                   "Axis that points up in the files: scene (as in the scene), y, z; default: the scene's output.up")
      ->check(CLI::IsMember({"scene", "y", "z"}));
  verb->callback([options, words, &context] {
    context.action = [options, words, &context] {
      options->run = (*words)[0];
      options->out = (*words)[1];
      agree_on_root(context.ranks, "exporting " + (*words)[0], [&] {
        exporting::export_run(*options, [](const std::string& line) {
          fmt::print("{}\n", line);
          std::fflush(stdout);
        });
      });
      return ExitCode::done;
    };
  });
}

}  // namespace seiche
