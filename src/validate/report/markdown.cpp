#include "validate/report/markdown.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "base/version.h"
#include "validate/report/section.h"

namespace seiche {
namespace {

constexpr const char* how_to =
    R"(## How to make these figures again

In a clone of the repository:

    cmake --preset release && cmake --build build/release --target seiche
    build/release/seiche validate NAME --level full

[Building](building.md) lists the packages; `./check` installs them, builds and tests everything. The page of each case
has its command, its scene, the keys that its runs set (as after `seiche run --set`) and the measure; the `case.toml` of
its folder has all of it. The same build gives the same figures on as many ranks. `seiche validate fsi1/90` makes one
run alone. `seiche --version` prints the build's number. [Validating](validating.md) explains how cases are run and
judged.

On the pages of cases, "order" compares a run with the one before in its series: runs that differ in the grid and are to
meet the same reference. "Fit" is the least-squares order over the whole series, at its last run. "Time" is that of the
run, or of the one it shares, on a machine that did other things as well: it may be off by a factor of two.

)";

// "; 12 of them made by other builds"
std::string words_on_builds(const Report& report) {
  const auto others = std::ranges::count_if(report.results, [](const ReportedResult& row) {
    return is_measured(row.result) && row.result.origin.build != build_digest();
  });
  return others == 0 ? "" : fmt::format("; {} of them made by other builds", others);
}

bool has_run(const ReportedResult& row) {
  return row.result.verdict != Verdict::absent;
}

std::vector<std::string> machines_of(const Report& report) {
  std::vector<std::string> machines;
  for (const ReportedResult& row : report.results) {
    const std::string& machine = row.result.origin.machine;
    if (has_run(row) && !machine.empty() && std::ranges::count(machines, machine) == 0) machines.push_back(machine);
  }
  return machines;
}

std::string list_of_machines(const PageContext& page) {
  const auto runs_on = [&](const std::string& machine) {
    return std::ranges::count_if(page.report.results, [&](const ReportedResult& row) {
      return has_run(row) && row.result.origin.machine == machine;
    });
  };
  std::string text = "Machines:\n\n";
  for (std::size_t n = 0; n < page.machines.size(); ++n)
    text += fmt::format("- machine {}, of {} runs: {}\n", n + 1, runs_on(page.machines[n]), page.machines[n]);
  if (const auto unknown = runs_on(""); unknown > 0) text += fmt::format("- of {} runs it was not kept\n", unknown);
  return text + fmt::format("- this page was written on {}\n\n", page.report.machine);
}

// The most informative run of a case: of those with the smallest cells, the one with the largest error relative to its
// bar.
const ReportedResult& finest_of(const std::vector<ReportedResult>& rows) {
  return *std::ranges::max_element(rows, {}, [](const ReportedResult& row) {
    const bool measured = is_measured(row.result);
    const double bar = max_error_of(row.one, row.resolution).value_or(0);
    const double error = measured ? row.result.measured.error : 0;
    return std::tuple(measured, -row.result.cell_size, bar > 0 ? error / bar : error);
  });
}

bool has_miss(const std::vector<ReportedResult>& rows) {
  return std::ranges::any_of(rows, [](const ReportedResult& row) {
    return row.result.verdict == Verdict::missed || row.result.verdict == Verdict::failed;
  });
}

std::string row_of_case(const std::vector<ReportedResult>& rows, const std::string& folder) {
  const ReportedResult& finest = finest_of(rows);
  Report part;
  part.results = rows;
  const std::string runs = table_summary(part);
  return fmt::format("| [{0}]({1}/{0}.md) | {2} | {3} | {4} | {5} |\n", rows[0].one.name, folder,
                     markdown_cell(rows[0].one.title),
                     is_measured(finest.result) ? figure(finest.result.measured.error) : "-",
                     figure(max_error_of(finest.one, finest.resolution)), has_miss(rows) ? "**" + runs + "**" : runs);
}

// "Of 3 cases 2 meet all their bars, 1 some of them, 0 none."
std::string words_on_cases(const Report& report) {
  int all = 0, some = 0, none = 0;
  for (const auto& rows : by_case(report)) {
    const auto passed =
        std::ranges::count_if(rows, [](const ReportedResult& row) { return row.result.verdict == Verdict::passed; });
    ++(passed == std::ssize(rows) ? all : passed > 0 ? some : none);
  }
  return fmt::format("Of {} cases {} meet all their bars, {} some of them, {} none.", all + some + none, all, some,
                     none);
}

std::string list_of_cases(const Report& report, const std::string& folder) {
  std::string text =
      words_on_cases(report) +
      " Error and bar are those of the finest run; of several as fine, the one\n"
      "that comes nearest to its bar. An error is relative where there is a reference, else the measured "
      "figure itself.\n\n| case | compared | error | bar | runs |\n|---|---|---|---|---|\n";
  for (const auto& rows : by_case(report)) text += row_of_case(rows, folder);
  return text + "\n";
}

std::string list_of_misses(const Report& report, const std::string& folder) {
  std::string text;
  for (const ReportedResult& row : report.results)
    if (row.result.verdict == Verdict::missed || row.result.verdict == Verdict::failed)
      text += fmt::format(
          "- [{0} {1}]({4}/{0}.md): {2}{3}\n", row.one.name, row.resolution.name, verdict_name(row.result.verdict),
          is_measured(row.result) ? fmt::format(", error {} where {} passes", figure(row.result.measured.error),
                                                figure(max_error_of(row.one, row.resolution)))
                                  : "",
          folder);
  return text.empty() ? ""
                      : "## Runs that miss their bars\n\nThe pages of the cases give the causes, as far as known.\n\n" +
                            text + "\n";
}

}  // namespace

std::string markdown_cell(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
  return safe;
}

std::string command_of(const Report& report, const CaseSpec& one) {
  return fmt::format("seiche validate {} --level {}", one.name, report.level);
}

std::string figure(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "-";
}

std::string whole_figure(const std::optional<double>& value) {
  return value ? fmt::format("{:.7g}", *value) : "-";
}

std::string words_on_misses(const std::vector<ReportedResult>& rows) {
  const auto any = [&](Verdict verdict) {
    return std::ranges::any_of(rows, [&](const ReportedResult& row) { return row.result.verdict == verdict; });
  };
  const std::string& known = rows[0].one.known;
  const std::string cause = known.empty() ? "the cause is not known." : known;
  if (any(Verdict::missed)) return known.empty() ? "Misses its bar; " + cause : "Misses its bar: " + cause;
  if (any(Verdict::failed)) return known.empty() ? "Failed; " + cause : "Failed: " + cause;
  if (known.empty()) return {};
  return (any(Verdict::absent) ? "Not run in full; known: " : "Known: ") + known;
}

std::string format_markdown(const Report& report, const std::string& folder) {
  const PageContext page{report, machines_of(report)};
  std::string text = fmt::format(
      "{}\nExact flows, experiments and benchmarks of other codes, run from the scenes in `validation/` and compared.\n"
      "Written by `seiche validate --level {} --write-docs`, version {}, build {}: {}{}.\n\n",
      page_title, report.level, version(), build_digest().substr(0, short_digest), table_summary(report),
      words_on_builds(report));
  text += list_of_cases(report, folder) + list_of_misses(report, folder) + how_to + list_of_machines(page);
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

std::vector<CasePage> case_pages(const Report& report, const std::string& summary) {
  const PageContext page{report, machines_of(report)};
  std::vector<CasePage> pages;
  for (const auto& rows : by_case(report))
    pages.push_back({rows[0].one.name + ".md",
                     fmt::format("{}{}\n[All cases](../{}), with the machines and how to make these figures again.\n",
                                 case_page_title, markdown_section(page, rows), summary)});
  return pages;
}

}  // namespace seiche
