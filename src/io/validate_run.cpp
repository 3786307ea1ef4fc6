#include "io/validate_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include "base/version.h"
#include "coupling/tampering.h"
#include "io/checked_file.h"
#include "io/info.h"
#include "io/run_agree.h"
#include "io/validate_cache.h"
#include "io/validate_html.h"
#include "io/validate_judge.h"
#include "io/validate_markdown.h"
#include "io/validate_plan.h"
#include "io/validate_report.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto patience = std::chrono::seconds(3);

// A validation under way. The cache is rank 0's, the record is read by all ranks.
struct Validation {
  const ValidateOptions& options;
  const Surroundings& around;
  RunCache cache;
  std::optional<ValidationRecord> record;

  void say(const std::string& text) const {
    if (around.ranks.is_root()) around.console.line(text);
  }
};

Validation start(const ValidateOptions& options, const Surroundings& around) {
  Validation v{options, around, RunCache(options.out, around.ranks.is_root() ? options.earlier : Earlier::ignore), {}};
  agree(around.ranks, "reading the record", [&] {
    if (options.record) v.record.emplace(*options.record);
  });
  return v;
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

std::string identity_of(const Planned& run) {
  return measured_identity(run.scene, measure_of(*run.one, *run.resolution));
}

// Absent, where the record has no such figures either.
void take_recorded(const Planned& run, const Validation& v, CaseResult& result) {
  result.verdict = Verdict::absent;
  if (!v.record) return;
  const auto recorded = v.record->find(run.one->name, run.resolution->name, identity_of(run));
  if (!recorded) return;
  result.verdict = Verdict::missed;  // until judged
  result.recorded = true;
  result.run.clear();
  result.measured = recorded->measured;
  result.origin = recorded->origin;
  result.wall_seconds = recorded->seconds;
}

ExitCode run_and_measure(const Planned& run, Validation& v, CaseResult& result) {
  const Found found = obtain_run(run, v);
  result.run = found.run;
  result.cached = found.cached;
  if (!found.any) take_recorded(run, v, result);
  if (!found.any || found.code != ExitCode::done) return found.code;
  result.measured = measure_on_root(measure_of(*run.one, *run.resolution), result.run, v.around.ranks);
  result.origin = {build_digest(), date_of(RunPaths{result.run}.summary()), v.around.ranks.size()};
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

// Brings the record up to date with a run that was made or found. It is read again, as another validation may have
// written to it since.
void put_on_record(const Planned& run, Validation& v, const CaseResult& result) {
  if (!v.record || result.recorded || !is_measured(result)) return;
  agree(v.around.ranks, "reading the record", [&] { v.record.emplace(*v.options.record); });
  v.record->put(run.one->name, run.resolution->name, identity_of(run),
                {result.origin, result.wall_seconds, result.measured});
  agree_on_root(v.around.ranks, "writing the record", [&] { v.record->write(); });
}

ExitCode run_one(const Planned& run, Validation& v, Report& report) {
  CaseResult result;
  result.cell_size = run.scene.domain.cell_size;
  result.run = v.options.out / run.one->name / run.resolution->name;
  const auto began = Clock::now();
  if (const ExitCode code = attempt(run, v, result); code != ExitCode::done) return code;
  if (result.cached)
    result.wall_seconds = seconds_of(result.run);
  else if (!result.recorded)
    result.wall_seconds = std::chrono::duration<double>(Clock::now() - began).count();
  if (result.verdict == Verdict::missed) judge_by_all(run, report, result);
  put_on_record(run, v, result);
  report.results.push_back({*run.one, *run.resolution, result});
  return ExitCode::done;
}

// One that was not chosen: for the page of all cases.
void take_one(const Planned& run, const Validation& v, Report& whole) {
  CaseResult result;
  result.cell_size = run.scene.domain.cell_size;
  take_recorded(run, v, result);
  if (result.verdict == Verdict::missed) judge_by_all(run, whole, result);
  whole.results.push_back({*run.one, *run.resolution, result});
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

// The pages for people: of the chosen cases with pictures, of the whole level as Markdown.
void write_pages(const Report& report, const Report& whole, const ValidateOptions& options, const Communicator& ranks) {
  agree_on_root(ranks, "writing the report", [&] {
    write_file(options.out / "report.html", format_html(report));
    if (options.docs) write_file(*options.docs, format_markdown(whole));
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
  const std::vector<CaseSpec> cases = choose_cases(read_all_cases(options, around.ranks), options, around.ranks);
  if (!around.ranks.is_root()) return ExitCode::done;
  for (const CaseSpec& one : cases) {
    around.console.line(fmt::format("{}: {}", one.name, one.title));
    around.console.line(fmt::format("    quick: {}; full: {}; tags: {}", resolutions_of(one, "quick"),
                                    resolutions_of(one, "full"), fmt::join(one.tags, ", ")));
  }
  return ExitCode::done;
}

ExitCode validate_command(const ValidateOptions& options, const Surroundings& around) {
  const std::vector<CaseSpec> all = read_all_cases(options, around.ranks);
  const std::vector<Planned> runs = plan(all, options, around.ranks);
  agree(around.ranks, "reading the options", [&] { parse_tampering(options.tampering); });
  Validation v = start(options, around);
  Report report{options.level, around.ranks.size(), std::size_t(std::ranges::count(runs, true, &Planned::chosen)), {}};
  Report whole{options.level, around.ranks.size(), runs.size(), {}};
  const TableWidths widths = widths_of(runs);
  write_report(report, options, around.ranks);
  v.say(table_header(widths));
  for (const Planned& run : runs) {
    if (!run.chosen) take_one(run, v, whole);
    if (!run.chosen) continue;
    if (const ExitCode code = run_one(run, v, report); code != ExitCode::done) {
      v.say(fmt::format("stopped in {} {}; validate again to run it anew", run.one->name, run.resolution->name));
      return code;
    }
    whole.results.push_back(report.results.back());
    v.say(table_row(widths, report.results.back()));
    write_report(report, options, around.ranks);
  }
  write_pages(report, whole, options, around.ranks);
  v.say(fmt::format("{}; figures in {}, plots and pictures in {}", table_summary(report),
                    (options.out / "validation.json").string(), (options.out / "report.html").string()));
  return code_of(report);
}

}  // namespace seiche
