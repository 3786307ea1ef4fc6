#include "validate/report/markdown.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/version.h"
#include "validate/report/section.h"

namespace seiche {
namespace {

constexpr const char* how_to =
    R"(## How to make these figures again

In a clone of the repository:

    cmake --preset release && cmake --build build/release --target seiche
    build/release/seiche validate NAME --level full

[Building](building.md) has the packages that this takes; `./check` installs them, builds all and tests all. Each case
below has its own command, the scene, what its runs set in that (as after `seiche run --set`), and what is measured; the
`case.toml` of its folder has all of it. The same build gives the same figures on as many ranks.
[Validating](validating.md) tells how cases are run and judged.

In the tables "order" is that from the run before in a series (runs of a case that differ in the grid and are to meet
the same reference), "fit" the least-squares order over all of a series, at its last run; "time" is that of the run, or
of the one that it shares, on a machine that did other things as well: it may be off by a factor of two.
`seiche --version` has the build's number. One run alone is made by its case and name: `seiche validate fsi1/90`.

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

std::string list_of_cases(const Report& report) {
  std::string text = "## Cases\n\n| case | | runs |\n|---|---|---|\n";
  for (const auto& rows : by_case(report)) {
    Report part;
    part.results = rows;
    text += fmt::format("| [{0}](#{0}) | {1} | {2} |\n", rows[0].one.name, markdown_cell(rows[0].one.title),
                        table_summary(part));
  }
  return text + "\n";
}

std::string list_of_misses(const Report& report) {
  std::string text;
  for (const ReportedResult& row : report.results)
    if (row.result.verdict == Verdict::missed || row.result.verdict == Verdict::failed)
      text += fmt::format(
          "- [{0} {1}](#{0}): {2}{3}\n", row.one.name, row.resolution.name, verdict_name(row.result.verdict),
          is_measured(row.result) ? fmt::format(", error {} where {} passes", figure(row.result.measured.error),
                                                figure(max_error_of(row.one, row.resolution)))
                                  : "");
  return text.empty() ? "" : "Not passed:\n\n" + text + "\n";
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

std::string format_markdown(const Report& report) {
  const PageContext page{report, machines_of(report)};
  std::string text = fmt::format(
      "{}\nWritten by `seiche validate --level {} --write-docs`, version {}, build {}: {}{}.\n\n", page_title,
      report.level, version(), build_digest().substr(0, short_digest), table_summary(report), words_on_builds(report));
  text += list_of_misses(report) + how_to + list_of_machines(page) + list_of_cases(report);
  for (const auto& rows : by_case(report)) text += markdown_section(page, rows);
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace seiche
