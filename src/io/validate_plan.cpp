#include "io/validate_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/run_agree.h"
#include "io/validate_quantity.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

void mark_last(std::vector<Planned>& runs) {
  for (std::size_t n = 0; n < runs.size(); ++n) {
    const Planned* next = n + 1 < runs.size() ? &runs[n + 1] : nullptr;
    runs[n].last_of_reference =
        !next || next->one != runs[n].one ||
        reference_of(*next->one, *next->resolution) != reference_of(*runs[n].one, *runs[n].resolution);
  }
}

std::string place_of(const CaseSpec& one, const ResolutionSpec& resolution) {
  return fmt::format("{}, resolution '{}'", (one.folder / "case.toml").string(), resolution.name);
}

}  // namespace

std::vector<CaseSpec> read_all_cases(const ValidateOptions& options, const Communicator& ranks) {
  std::vector<CaseSpec> cases;
  agree(ranks, "reading the validation cases", [&] {
    cases = read_cases(options.cases ? *options.cases : find_cases_folder(fs::current_path(), program_file()));
  });
  return cases;
}

std::vector<CaseSpec> choose_cases(const std::vector<CaseSpec>& cases, const ValidateOptions& options,
                                   const Communicator& ranks) {
  std::vector<CaseSpec> chosen;
  agree(ranks, "choosing the validation cases", [&] { chosen = select_cases(cases, options.words); });
  return chosen;
}

std::vector<Planned> plan(const std::vector<CaseSpec>& cases, const ValidateOptions& options,
                          const Communicator& ranks) {
  const std::vector<CaseSpec> chosen = choose_cases(cases, options, ranks);
  std::vector<Planned> runs;
  agree(ranks, "reading the scenes", [&] {
    bool any = false;
    for (const CaseSpec& one : cases) {
      const bool wanted = std::ranges::count(chosen, one.name, &CaseSpec::name) > 0;
      if (!wanted && !options.record) continue;
      for (const ResolutionSpec& resolution : one.resolutions) {
        if (!belongs_to(resolution, options.level)) continue;
        any = any || wanted;
        runs.push_back({&one, &resolution, read_scene(scene_of(one, resolution), resolution.overrides), false, wanted});
        check_names(measure_of(one, resolution), runs.back().scene, place_of(one, resolution));
      }
    }
    if (!any)
      throw Error(ExitCode::bad_input,
                  "the chosen cases have no resolution of level '" + options.level + "'; give --level full");
  });
  mark_last(runs);
  return runs;
}

}  // namespace seiche
