#include "io/validate_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include "io/checked_file.h"
#include "io/run_agree.h"
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
  double cell_size = 0;  // m
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
        const Scene scene = read_scene(scene_of(one, resolution), resolution.overrides);
        runs.push_back({&one, &resolution, scene.domain.cell_size});
      }
    }
  });
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

ExitCode run_and_measure(const Planned& run, const ValidateOptions& options, const Surroundings& around,
                         CaseResult& result) {
  RunOptions own;
  own.scene = scene_of(*run.one, *run.resolution);
  own.out = result.run;
  own.overrides = run.resolution->overrides;
  own.existing = ExistingOutput::overwrite;
  own.session.threads = options.threads;
  const ExitCode code = run_command(own, {around.ranks, around.emergency, console_of(run, around.console)});
  MeasureSpec spec = run.one->measure;
  spec.reference = reference_of(*run.one, *run.resolution);
  if (code == ExitCode::done) result.measured = measure_on_root(spec, result.run, around.ranks);
  return code;
}

// As run_and_measure, but a simulation that could not go on, on all ranks together, is a result.
ExitCode attempt(const Planned& run, const ValidateOptions& options, const Surroundings& around, CaseResult& result) {
  try {
    const ExitCode code = run_and_measure(run, options, around, result);
    if (code == ExitCode::done) result.verdict = Verdict::missed;  // until judged
    return code;
  } catch (const Error& error) {
    const bool together =
        error.code() == ExitCode::cannot_continue && around.emergency.meet(int(error.code()), patience).has_value();
    if (!together) throw;
    result.message = error.what();
    return ExitCode::done;
  }
}

// The result before this one in the report, if it is of the same case and is to meet the same reference.
const CaseResult* coarser(const Report& report, const CaseSpec& one, const ResolutionSpec& resolution) {
  if (report.results.empty() || report.results.back().one.name != one.name) return nullptr;
  const ReportedResult& last = report.results.back();
  if (reference_of(one, last.resolution) != reference_of(one, resolution)) return nullptr;
  return last.result.verdict == Verdict::failed ? nullptr : &last.result;
}

ExitCode run_one(const Planned& run, const ValidateOptions& options, const Surroundings& around, Report& report) {
  CaseResult result;
  result.cell_size = run.cell_size;
  result.run = options.out / run.one->name / run.resolution->name;
  const auto began = Clock::now();
  const ExitCode code = attempt(run, options, around, result);
  if (code != ExitCode::done) return code;
  result.wall_seconds = std::chrono::duration<double>(Clock::now() - began).count();
  if (result.verdict != Verdict::failed) {
    const CaseResult* before = coarser(report, *run.one, *run.resolution);
    if (run.one->min_order && before) result.order = observed_order(*before, result);
    result.verdict = judge(*run.one, *run.resolution, result);
  }
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

ExitCode code_of(const Report& report) {
  const auto any = [&](Verdict verdict) {
    return std::any_of(report.results.begin(), report.results.end(),
                       [&](const ReportedResult& row) { return row.result.verdict == verdict; });
  };
  if (any(Verdict::failed)) return ExitCode::cannot_continue;
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

std::optional<double> observed_order(const CaseResult& coarse, const CaseResult& fine) {
  const double cells = coarse.cell_size / fine.cell_size, errors = coarse.measured.error / fine.measured.error;
  if (cells == 1 || !(errors > 0) || !std::isfinite(errors)) return std::nullopt;
  return std::log(errors) / std::log(cells);
}

Verdict judge(const CaseSpec& one, const ResolutionSpec& resolution, const CaseResult& result) {
  const std::optional<double> bar = max_error_of(one, resolution);
  const bool small = bar && result.measured.error <= *bar;
  const bool steep = !result.order || !one.min_order || *result.order >= *one.min_order;
  return small && steep ? Verdict::passed : Verdict::missed;
}

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
  Report report{options.level, around.ranks.size(), runs.size(), {}};
  write_report(report, options, around.ranks);
  say(table_header(widths));
  for (const Planned& run : runs) {
    const ExitCode code = run_one(run, options, around, report);
    if (code != ExitCode::done) {
      say(fmt::format("stopped in {} {}; validate again to run it anew", run.one->name, run.resolution->name));
      return code;
    }
    say(table_row(widths, report.results.back()));
    write_report(report, options, around.ranks);
  }
  say(fmt::format("{}; figures in {}", table_summary(report), (options.out / "validation.json").string()));
  return code_of(report);
}

}  // namespace seiche
