#include "validate/run/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/agree.h"
#include "base/program_file.h"
#include "base/scene.h"
#include "validate/case/checks.h"
#include "validate/case/selection.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

void mark_last(std::vector<Planned>& runs) {
  for (auto run = runs.begin(); run != runs.end(); ++run)
    run->last_of_series = std::none_of(run + 1, runs.end(), [&](const Planned& later) {
      return later.one == run->one && same_series(*run->one, *run->resolution, *later.resolution);
    });
}

std::string place_of(const CaseSpec& one, const ResolutionSpec& resolution) {
  return fmt::format("{}, resolution '{}'", (one.folder / "case.toml").string(), resolution.name);
}

Scene scene_for(const CaseSpec& one, const ResolutionSpec& resolution) {
  try {
    return read_scene(scene_of(one, resolution), resolution.overrides);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", place_of(one, resolution), error.what()));
  }
}

}  // namespace

std::vector<CaseSpec> read_all_cases(const ValidateOptions& options, const Surroundings& around) {
  std::vector<CaseSpec> cases;
  std::vector<fs::path> left_out;
  agree(around.ranks, "reading the validation cases", [&] {
    const fs::path folder = options.cases ? *options.cases : find_cases_folder(fs::current_path(), program_file());
    cases = read_cases(folder);
    left_out = folders_without_case(folder);
  });
  for (const fs::path& one : left_out)
    if (around.ranks.is_root())
      around.console.warning(fmt::format("{} holds no case.toml: it is no case, and left out", one.string()));
  return cases;
}

std::vector<CaseSpec> choose_cases(const std::vector<CaseSpec>& cases, const ValidateOptions& options,
                                   const Communicator& ranks) {
  std::vector<CaseSpec> chosen;
  agree(ranks, "choosing the validation cases", [&] {
    const Selection selection(cases, options.words);
    std::ranges::copy_if(cases, std::back_inserter(chosen), [&](const CaseSpec& one) { return selection.takes(one); });
  });
  return chosen;
}

std::vector<Planned> plan(const std::vector<CaseSpec>& cases, const ValidateOptions& options,
                          const Communicator& ranks) {
  std::vector<Planned> runs;
  agree(ranks, "reading the scenes", [&] {
    const Selection selection(cases, options.words);
    for (const CaseSpec& one : cases) {
      for (const ResolutionSpec& resolution : one.resolutions) {
        const bool wanted = selection.takes(one, resolution, options.level);
        if (!wanted && !(options.record && belongs_to(resolution, options.level))) continue;
        runs.push_back({&one, &resolution, std::make_shared<const Scene>(scene_for(one, resolution)), false, wanted});
        check_measure(measure_of(one, resolution), *runs.back().scene, place_of(one, resolution));
      }
      if (!runs.empty() && runs.back().one == &one) check_plot(one.plot, (one.folder / "case.toml").string());
    }
    if (std::ranges::count(runs, true, &Planned::chosen) == 0)
      throw Error(ExitCode::bad_input, fmt::format("the chosen cases have no resolution of level '{}'{}", options.level,
                                                   options.level == "full" ? "" : "; give --level full"));
  });
  mark_last(runs);
  return runs;
}

}  // namespace seiche
