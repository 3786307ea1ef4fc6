#include "io/validate_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include "coupling/tampering.h"
#include "io/checked_file.h"
#include "io/info.h"
#include "io/run_agree.h"
#include "io/validate_cache.h"
#include "io/validate_html.h"
#include "io/validate_judge.h"
#include "io/validate_markdown.h"
#include "io/validate_report.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto patience = std::chrono::seconds(3);

// One run that is going to be made.
struct Planned {
  const CaseSpec* one;
  const ResolutionSpec* resolution;
  Scene scene;
  bool last_of_reference = false;  // no finer run of the case is to meet the same reference
};

// A validation under way. The cache is rank 0's.
struct Validation {
  const ValidateOptions& options;
  const Surroundings& around;
  RunCache cache;
};

std::vector<CaseSpec> read_chosen(const ValidateOptions& options, const Communicator& ranks) {
  std::vector<CaseSpec> cases;
  agree(ranks, "reading the validation cases", [&] {
    const fs::path folder = options.cases ? *options.cases : find_cases_folder(fs::current_path(), program_file());
    cases = select_cases(read_cases(folder), options.words);
  });
  return cases;
}

// Reads every scene, so that a mistake in the last case ends the program before the first is run.
std::vector<Planned> plan(const std::vector<CaseSpec>& cases, const std::string& level, const Communicator& ranks) {
  std::vector<Planned> runs;
  agree(ranks, "reading the scenes", [&] {
    for (const CaseSpec& one : cases) {
      for (const ResolutionSpec& resolution : one.resolutions) {
        if (!belongs_to(resolution, level)) continue;
        runs.push_back({&one, &resolution, read_scene(scene_of(one, resolution), resolution.overrides)});
      }
    }
  });
  for (std::size_t n = 0; n < runs.size(); ++n) {
    const Planned* next = n + 1 < runs.size() ? &runs[n + 1] : nullptr;
    runs[n].last_of_reference =
        !next || next->one != runs[n].one ||
        reference_of(*next->one, *next->resolution) != reference_of(*runs[n].one, *runs[n].resolution);
  }
  return runs;
}

// Only warnings and the live line of a run reach the terminal, with the run's name before them.
Console console_of(const Planned& run, const Console& outer) {
  const std::string prefix = fmt::format("{} {}: ", run.one->name, run.resolution->name);
  Console inner;
  inner.line = [](const std::string&) {};
  inner.warning = [&outer, prefix](const std::string& text) { outer.warning(prefix + text); };
  if (outer.live) inner.live = [&outer, prefix](const std::string& text) { outer.live(prefix + text); };
  return inner;
}

// Rank 0 measures; all ranks get the figures.
Measurement measure_on_root(const MeasureSpec& spec, const fs::path& run, const Communicator& ranks) {
  Measurement result;
  agree_on_root(ranks, "measuring", [&] { result = measure(spec, RunPaths{run}); });
  const std::string text =
      ranks.broadcast(fmt::format("{:a} {:a} {} {:a}", result.value, result.error, int(result.reference.has_value()),
                                  result.reference.value_or(0)));
  const char* at = text.c_str();
  char* end = nullptr;
  const auto next = [&] {
    const double value = std::strtod(at, &end);
    at = end;
    return value;
  };
  result.value = next();
  result.error = next();
  const bool has_reference = next() != 0;
  const double reference = next();
  result.reference = has_reference ? std::optional(reference) : std::nullopt;
  return result;
}

// Whether a run is to be had, and where: an earlier one, or one that is made now.
struct Found {
  ExitCode code = ExitCode::done;
  bool any = true, cached = false;
  fs::path run;
};

// Rank 0 looks; all ranks get the answer. `identity` is filled on rank 0.
Found look_for_run(const Planned& run, const Validation& v, std::string& identity) {
  Found found;
  agree_on_root(v.around.ranks, "looking for earlier runs", [&] {
    identity = run_identity(run.scene, v.around.ranks.size(), v.options.tampering);
    const auto earlier = v.cache.find(run.scene, identity);
    found.cached = earlier.has_value();
    found.run = earlier.value_or(v.options.out / run.one->name / run.resolution->name);
  });
  const std::string text = v.around.ranks.broadcast((found.cached ? "1" : "0") + found.run.string());
  found.cached = text[0] == '1';
  found.run = text.substr(1);
  found.any = found.cached || v.options.making == Making::runs;
  return found;
}

Found obtain_run(const Planned& run, Validation& v) {
  std::string identity;
  Found found = look_for_run(run, v, identity);
  if (found.cached || !found.any) return found;
  v.cache.forget(found.run);
  RunOptions own;
  own.scene = scene_of(*run.one, *run.resolution);
  own.out = found.run;
  own.overrides = run.resolution->overrides;
  own.existing = ExistingOutput::overwrite;
  own.session.threads = v.options.threads;
  own.session.tampering = v.options.tampering;
  found.code = run_command(own, {v.around.ranks, v.around.emergency, console_of(run, v.around.console)});
  if (found.code == ExitCode::done)
    agree_on_root(v.around.ranks, "keeping the run", [&] { v.cache.keep(found.run, identity); });
  return found;
}

// A measure of this resolution.
MeasureSpec measure_of(const CaseSpec& one, const ResolutionSpec& resolution) {
  MeasureSpec spec = one.measure;
  spec.reference = reference_of(one, resolution);
  return spec;
}

ExitCode run_and_measure(const Planned& run, Validation& v, CaseResult& result) {
  const Found found = obtain_run(run, v);
  result.run = found.run;
  result.cached = found.cached;
  if (!found.any) result.verdict = Verdict::absent;
  if (!found.any || found.code != ExitCode::done) return found.code;
  result.measured = measure_on_root(measure_of(*run.one, *run.resolution), result.run, v.around.ranks);
  result.verdict = Verdict::missed;  // until judged
  return found.code;
}

// As run_and_measure, but a simulation that could not go on, on all ranks together, is a result.
ExitCode attempt(const Planned& run, Validation& v, CaseResult& result) {
  try {
    return run_and_measure(run, v, result);
  } catch (const Error& error) {
    const bool together =
        error.code() == ExitCode::cannot_continue && v.around.emergency.meet(int(error.code()), patience).has_value();
    if (!together) throw;
    result.message = error.what();
    return ExitCode::done;
  }
}

// Of an earlier run as it was when it was made; rank 0's answer counts.
double seconds_of(const fs::path& run) {
  try {
    return std::strtod(json_value(read_whole_file(RunPaths{run}.summary()), "wall_seconds").c_str(), nullptr);
  } catch (const Error&) {
    return 0;
  }
}

// The results of the same case before this one that are to meet the same reference, coarse to fine.
std::vector<CaseResult> coarser(const Report& report, const Planned& run) {
  std::vector<CaseResult> found;
  for (auto row = report.results.rbegin(); row != report.results.rend(); ++row) {
    const bool same = row->one.name == run.one->name &&
                      reference_of(*run.one, row->resolution) == reference_of(*run.one, *run.resolution);
    if (!same) break;
    const bool measured = row->result.verdict == Verdict::passed || row->result.verdict == Verdict::missed;
    if (measured) found.insert(found.begin(), row->result);
  }
  return found;
}

void judge_by_all(const Planned& run, const Report& report, CaseResult& result) {
  std::vector<CaseResult> all = coarser(report, run);
  if (!all.empty()) result.order = observed_order(all.back(), result);
  all.push_back(result);
  if (run.last_of_reference) result.fitted_order = fitted_order(all);
  result.verdict = judge(*run.one, *run.resolution, result);
}

ExitCode run_one(const Planned& run, Validation& v, Report& report) {
  CaseResult result;
  result.cell_size = run.scene.domain.cell_size;
  result.run = v.options.out / run.one->name / run.resolution->name;
  const auto began = Clock::now();
  const ExitCode code = attempt(run, v, result);
  if (code != ExitCode::done) return code;
  result.wall_seconds =
      result.cached ? seconds_of(result.run) : std::chrono::duration<double>(Clock::now() - began).count();
  if (result.verdict == Verdict::missed) judge_by_all(run, report, result);
  report.results.push_back({*run.one, *run.resolution, result});
  return ExitCode::done;
}

TableWidths widths_of(const std::vector<Planned>& runs) {
  TableWidths widths;
  for (const Planned& run : runs) {
    widths.name = std::max(widths.name, run.one->name.size());
    widths.resolution = std::max(widths.resolution, run.resolution->name.size());
  }
  return widths;
}

void write_report(const Report& report, const ValidateOptions& options, const Communicator& ranks) {
  agree_on_root(ranks, "writing the report", [&] {
    make_folder(options.out);
    write_file(options.out / "validation.json", format_report(report));
  });
}

// The pages for people.
void write_pages(const Report& report, const ValidateOptions& options, const Communicator& ranks) {
  agree_on_root(ranks, "writing the report", [&] {
    write_file(options.out / "report.html", format_html(report));
    if (options.docs) write_file(*options.docs, format_markdown(report));
  });
}

ExitCode code_of(const Report& report) {
  const auto any = [&](Verdict verdict) {
    return std::any_of(report.results.begin(), report.results.end(),
                       [&](const ReportedResult& row) { return row.result.verdict == verdict; });
  };
  if (any(Verdict::failed) || any(Verdict::absent)) return ExitCode::cannot_continue;
  return any(Verdict::missed) ? ExitCode::bug : ExitCode::done;
}

std::string resolutions_of(const CaseSpec& one, const std::string& level) {
  std::vector<std::string> names;
  for (const ResolutionSpec& resolution : one.resolutions) {
    if (belongs_to(resolution, level)) names.push_back(resolution.name);
  }
  return names.empty() ? "-" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

ExitCode list_cases(const ValidateOptions& options, const Surroundings& around) {
  const std::vector<CaseSpec> cases = read_chosen(options, around.ranks);
  if (!around.ranks.is_root()) return ExitCode::done;
  for (const CaseSpec& one : cases) {
    around.console.line(fmt::format("{}: {}", one.name, one.title));
    around.console.line(fmt::format("    quick: {}; full: {}; tags: {}", resolutions_of(one, "quick"),
                                    resolutions_of(one, "full"), fmt::join(one.tags, ", ")));
  }
  return ExitCode::done;
}

ExitCode validate_command(const ValidateOptions& options, const Surroundings& around) {
  const std::vector<CaseSpec> cases = read_chosen(options, around.ranks);
  const std::vector<Planned> runs = plan(cases, options.level, around.ranks);
  const TableWidths widths = widths_of(runs);
  const auto say = [&](const std::string& text) {
    if (around.ranks.is_root()) around.console.line(text);
  };
  if (runs.empty()) {
    throw Error(ExitCode::bad_input,
                fmt::format("the chosen cases have no resolution of level '{}'; give --level full", options.level));
  }
  agree(around.ranks, "reading the options", [&] { parse_tampering(options.tampering); });
  Validation validation{options, around,
                        RunCache(options.out, around.ranks.is_root() ? options.earlier : Earlier::ignore)};
  Report report{options.level, around.ranks.size(), runs.size(), {}};
  write_report(report, options, around.ranks);
  say(table_header(widths));
  for (const Planned& run : runs) {
    const ExitCode code = run_one(run, validation, report);
    if (code != ExitCode::done) {
      say(fmt::format("stopped in {} {}; validate again to run it anew", run.one->name, run.resolution->name));
      return code;
    }
    say(table_row(widths, report.results.back()));
    write_report(report, options, around.ranks);
  }
  write_pages(report, options, around.ranks);
  say(fmt::format("{}; figures in {}, plots and pictures in {}", table_summary(report),
                  (options.out / "validation.json").string(), (options.out / "report.html").string()));
  return code_of(report);
}

}  // namespace seiche
