#include "validate/run/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/agree.h"
#include "coupling/state/operator_perturbation.h"
#include "files/checked_file.h"
#include "validate/measure/quantity.h"
#include "validate/record/files.h"
#include "validate/record/machine.h"
#include "validate/report/html.h"
#include "validate/report/pages.h"
#include "validate/report/report.h"
#include "validate/run/judge.h"
#include "validate/run/obtain.h"
#include "validate/run/plan.h"

namespace seiche {
namespace {

// Prints rows during a validation.
struct Table {
  const Validation& v;
  TableWidths widths;
  void say(const ReportedResult& row) const { v.say(table_row(widths, row)); }
};

ExitCode run_one(const Planned& run, Validation& v, Report& report, const Table& table) {
  CaseResult result;
  if (const ExitCode code = obtain(run, v, result); code != ExitCode::done) return code;
  if (is_measured(result)) judge_by_all(run, report, result);
  put_on_record(run, v, result);
  report.results.push_back({*run.one, *run.resolution, result, unit_of(run.one->measure, *run.scene)});
  table.say(report.results.back());
  const ReportedResult* changed = run.last_of_series ? judge_last_measured(report) : nullptr;
  if (changed) table.say(*changed);
  return ExitCode::done;
}

Report begin_report(const ValidateOptions& options, const Communicator& ranks, std::size_t planned) {
  return {options.level, ranks.size(), planned, {}, options.perturbation, describe_machine()};
}

// Selected runs and the recorded others, judged together.
Report whole_of(const std::vector<Planned>& runs, const Report& report, const std::optional<ValidationRecord>& record) {
  Report whole = report;
  whole.planned = runs.size();
  whole.results.clear();
  std::size_t chosen = 0;
  for (const Planned& run : runs) {
    CaseResult result = run.chosen ? report.results.at(chosen++).result : recorded_result(run, record);
    if (is_measured(result)) judge_by_all(run, whole, result);
    whole.results.push_back({*run.one, *run.resolution, result, unit_of(run.one->measure, *run.scene)});
    if (run.last_of_series) judge_last_measured(whole);
  }
  return whole;
}

// Writes the whole level as Markdown, including rows that concurrent validations have added to the record.
void write_docs(const std::vector<Planned>& runs, const Report& report, const ValidateOptions& options) {
  std::optional<FolderLock> lock;
  std::optional<ValidationRecord> record;
  if (options.record) {
    lock.emplace(folder_of(*options.record));
    record.emplace(*options.record, read_record(*options.record));
  }
  write_pages(*options.docs, whole_of(runs, report, record));
}

TableWidths widths_of(const std::vector<Planned>& runs) {
  TableWidths widths;
  for (const Planned& run : runs) {
    if (!run.chosen) continue;
    widths.name = std::max(widths.name, run.one->name.size());
    widths.resolution = std::max(widths.resolution, run.resolution->name.size());
  }
  return widths;
}

void write_report(const Report& report, const ValidateOptions& options, const Communicator& ranks) {
  agree_on_root(ranks, "writing the report", [&] {
    make_folder(options.out);
    replace_file(options.out / "validation.json", format_report(report));
  });
}

// The page of an earlier validation must not remain beside the figures of an interrupted one.
void remove_html(const ValidateOptions& options, const Communicator& ranks) {
  agree_on_root(ranks, "removing an earlier report", [&] {
    std::error_code ignored;  // if it remains, write_html() reports it
    std::filesystem::remove(options.out / "report.html", ignored);
  });
}

// Writes the HTML page: the selected cases with pictures.
void write_html(const Report& report, const ValidateOptions& options, const Communicator& ranks) {
  agree_on_root(ranks, "writing the report", [&] { replace_file(options.out / "report.html", format_html(report)); });
}

// Refuses two outputs with the same file.
void refuse_shared_targets(const ValidateOptions& options) {
  std::vector<std::filesystem::path> targets{target_of(options.out / "validation.json"),
                                             target_of(options.out / "report.html")};
  for (const auto& file : {options.record, options.docs}) {
    if (!file) continue;
    if (std::ranges::count(targets, target_of(*file)) > 0)
      throw Error(ExitCode::bad_input,
                  fmt::format("{} would be written twice: give each output its own file", file->string()));
    targets.push_back(target_of(*file));
  }
}

std::vector<std::string> names_of(const std::vector<Planned>& runs) {
  std::vector<std::string> names;
  for (const Planned& run : runs) names.push_back(run.one->name);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// Checks options and output files before hours of runs. Throws Error(bad_input, output_failed). Collective.
void check_options(const ValidateOptions& options, const std::vector<Planned>& runs, const Communicator& ranks) {
  agree(ranks, "reading the options", [&] {
    parse_perturbation(options.perturbation);
    if (!options.perturbation.empty() && (options.record || options.docs))
      throw Error(ExitCode::bad_input,
                  "--break makes wrong figures on purpose: give it without --record and --write-docs");
  });
  agree_on_root(ranks, "trying the files to be written", [&] {
    refuse_shared_targets(options);
    for (const auto& file : {options.record, options.docs})
      if (file) check_writable(*file);
    for (const char* report : {"validation.json", "report.html"})
      if (std::filesystem::exists(options.out / report)) check_writable(options.out / report);
    if (options.docs) check_pages(*options.docs, names_of(runs));
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
  const std::vector<CaseSpec> cases = choose_cases(read_all_cases(options, around), options, around.ranks);
  if (!around.ranks.is_root()) return ExitCode::done;
  for (const CaseSpec& one : cases) {
    around.console.line(fmt::format("{}: {}", one.name, one.title));
    around.console.line(fmt::format("    quick: {}; full: {}; tags: {}", resolutions_of(one, "quick"),
                                    resolutions_of(one, "full"), fmt::join(one.tags, ", ")));
  }
  return ExitCode::done;
}

ExitCode validate_command(const ValidateOptions& options, const Surroundings& around) {
  const std::vector<CaseSpec> all = read_all_cases(options, around);
  const std::vector<Planned> runs = plan(all, options, around.ranks);
  check_options(options, runs, around.ranks);
  Validation v = start(options, around);
  Report report = begin_report(options, around.ranks, std::size_t(std::ranges::count(runs, true, &Planned::chosen)));
  const Table table{v, widths_of(runs)};
  remove_html(options, around.ranks);
  write_report(report, options, around.ranks);
  v.say(table_header(table.widths));
  for (const Planned& run : runs) {
    if (!run.chosen) continue;
    if (const ExitCode code = run_one(run, v, report, table); code != ExitCode::done) {
      v.say(fmt::format("stopped in {} {}; validate again{} to go on with it", run.one->name, run.resolution->name,
                        options.earlier == Earlier::ignore ? " without --fresh" : ""));
      return code;
    }
    write_report(report, options, around.ranks);
  }
  write_html(report, options, around.ranks);
  if (options.docs) agree_on_root(around.ranks, "writing the page", [&] { write_docs(runs, report, options); });
  v.say(fmt::format("{}; figures in {}, plots and pictures in {}", table_summary(report),
                    (options.out / "validation.json").string(), (options.out / "report.html").string()));
  return code_of(report);
}

}  // namespace seiche
