#include <fmt/format.h>

#include "base/agree.h"
#include "info/info.h"
#include "verbs.h"

namespace seiche {

void add_info(CLI::App& program, VerbContext& context) {
  auto* verb = program.add_subcommand("info", "Tell what a frame, checkpoint or run directory holds");
  auto path = std::make_shared<std::string>();
  verb->add_option("path", *path, "A .vdb frame, a folder of checkpoints/, or a run directory")->required();
  verb->callback([path, &context] {
    context.action = [path, &context] {
      agree_on_root(context.ranks, "reading " + *path, [&] {
        for (const std::string& line : describe_path(*path)) fmt::print("{}\n", line);
      });
      return ExitCode::done;
    };
  });
}

}  // namespace seiche
