#include "validate/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/version.h"
#include "files/json.h"

namespace seiche {
namespace {

std::string number(double value) {
  return fmt::format("{:.4g}", value);
}

std::string number(const std::optional<double>& value) {
  return value ? number(*value) : "-";
}

std::string json(double value) {
  return std::isfinite(value) ? fmt::format("{:.17g}", value) : "null";
}

std::string json(const std::optional<double>& value) {
  return value ? json(*value) : "null";
}

using Members = std::vector<std::pair<std::string, std::string>>;

std::string object(const Members& members, const std::string& indent) {
  std::string text;
  for (const auto& [name, value] : members) {
    text += fmt::format("{}\n{}  {}: {}", text.empty() ? "" : ",", indent, json_string(name), value);
  }
  return "{" + text + "\n" + indent + "}";
}

std::string array(const std::vector<std::string>& items, const std::string& indent) {
  if (items.empty()) return "[]";
  return fmt::format("[\n{0}  {1}\n{0}]", indent, fmt::join(items, ",\n" + indent + "  "));
}

std::string json_result(const ReportedResult& row, const std::string& indent) {
  const CaseResult& r = row.result;
  const bool measured = is_measured(r);
  const auto if_measured = [&](double value) { return measured ? json(value) : "null"; };
  return object({{"resolution", json_string(row.resolution.name)},
                 {"result", json_string(verdict_name(r.verdict))},
                 {"cell_size", json(r.cell_size)},
                 {"unit", json_string(row.unit)},
                 {"measured", if_measured(r.measured.value)},
                 {"reference", json(r.measured.reference)},
                 {"error", if_measured(r.measured.error)},
                 {"max_error", json(max_error_of(row.one, row.resolution))},
                 {"order", json(r.order)},
                 {"fitted_order", json(r.fitted_order)},
                 {"min_order", json(row.one.min_order)},
                 {"others", json_string(row.resolution.others)},
                 {"wall_seconds", json(r.wall_seconds)},
                 {"cached", r.cached ? "true" : "false"},
                 {"recorded", r.recorded ? "true" : "false"},
                 {"build", json_string(r.origin.build)},
                 {"date", json_string(r.origin.date)},
                 {"ranks", std::to_string(r.origin.ranks)},
                 {"threads", r.origin.threads > 0 ? std::to_string(r.origin.threads) : "null"},
                 {"machine", json_string(r.origin.machine)},
                 {"run", json_string(r.run.string())},
                 {"message", json_string(r.message)}},
                indent);
}

std::string json_case(const CaseSpec& one, const std::vector<std::string>& results) {
  std::vector<std::string> tags;
  for (const std::string& tag : one.tags) tags.push_back(json_string(tag));
  return object({{"name", json_string(one.name)},
                 {"title", json_string(one.title)},
                 {"tags", fmt::format("[{}]", fmt::join(tags, ", "))},
                 {"measure", json_string(one.measure.kind)},
                 {"others", json_string(one.others)},
                 {"known", json_string(one.known)},
                 {"results", array(results, "      ")}},
                "    ");
}

std::vector<std::string> json_cases(const Report& report) {
  std::vector<std::string> cases;
  for (const auto& rows : by_case(report)) {
    std::vector<std::string> results;
    for (const ReportedResult& row : rows) results.push_back(json_result(row, "        "));
    cases.push_back(json_case(rows[0].one, results));
  }
  return cases;
}

// "12.3"; "(12.3)" for an earlier run.
std::string seconds(const CaseResult& r) {
  if (r.verdict == Verdict::absent) return "-";
  return r.cached || r.recorded ? fmt::format("({:.1f})", r.wall_seconds) : fmt::format("{:.1f}", r.wall_seconds);
}

std::ptrdiff_t count(const Report& report, Verdict verdict) {
  return std::count_if(report.results.begin(), report.results.end(),
                       [&](const ReportedResult& row) { return row.result.verdict == verdict; });
}

}  // namespace

std::string verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "pass";
    case Verdict::missed:
      return "MISS";
    case Verdict::absent:
      return "not run";
    default:
      return "FAILED";
  }
}

bool is_measured(const CaseResult& result) {
  return result.verdict == Verdict::passed || result.verdict == Verdict::missed;
}

std::vector<std::vector<ReportedResult>> by_case(const Report& report) {
  std::vector<std::vector<ReportedResult>> cases;
  for (const ReportedResult& row : report.results) {
    if (cases.empty() || cases.back()[0].one.name != row.one.name) cases.emplace_back();
    cases.back().push_back(row);
  }
  return cases;
}

std::string table_header(const TableWidths& w) {
  return fmt::format("{:<{}}  {:<{}}  {:>10}  {:>10}  {:>10}  {:>10}  {:>5}  {:>5}  {:>5}  {:<7}  {:>8}  {}", "case",
                     w.name, "resolution", w.resolution, "measured", "reference", "error", "bar", "order", "fit", "bar",
                     "", "seconds", "others report");
}

std::string table_row(const TableWidths& w, const ReportedResult& row) {
  const CaseResult& r = row.result;
  const bool measured = is_measured(r);
  const auto short_number = [](const std::optional<double>& v) { return v ? fmt::format("{:.2f}", *v) : "-"; };
  const std::string& why = r.message;
  return fmt::format("{:<{}}  {:<{}}  {:>10}  {:>10}  {:>10}  {:>10}  {:>5}  {:>5}  {:>5}  {:<7}  {:>8}  {}",
                     row.one.name, w.name, row.resolution.name, w.resolution, measured ? number(r.measured.value) : "-",
                     number(r.measured.reference), measured ? number(r.measured.error) : "-",
                     number(max_error_of(row.one, row.resolution)), short_number(r.order), short_number(r.fitted_order),
                     r.order ? short_number(row.one.min_order) : "-", verdict_name(r.verdict), seconds(r),
                     measured ? row.resolution.others : why.substr(0, why.find('\n')));
}

std::string table_summary(const Report& report) {
  std::string text = fmt::format("{} pass", count(report, Verdict::passed));
  for (const Verdict verdict : {Verdict::missed, Verdict::failed, Verdict::absent}) {
    if (const auto n = count(report, verdict)) text += fmt::format(", {} {}", n, verdict_name(verdict));
  }
  return text;
}

std::string format_report(const Report& report) {
  const bool complete = report.results.size() == report.planned;
  const bool passed = count(report, Verdict::passed) == std::ptrdiff_t(report.planned);
  return object({{"version", json_string(version())},
                 {"build", json_string(build_digest())},
                 {"level", json_string(report.level)},
                 {"ranks", std::to_string(report.ranks)},
                 {"machine", json_string(report.machine)},
                 {"broken_on_purpose", report.perturbation.empty() ? "null" : json_string(report.perturbation)},
                 {"complete", complete ? "true" : "false"},
                 {"passed", passed ? "true" : "false"},
                 {"cases", array(json_cases(report), "  ")}},
                "") +
         "\n";
}

}  // namespace seiche
