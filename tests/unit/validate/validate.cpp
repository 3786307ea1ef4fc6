// Case folders: read, chosen, run and judged.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/version.h"
#include "files/json.h"
#include "unit/validate/cases.h"
#include "validate/case/selection.h"
#include "validate/report/charts.h"
#include "validate/report/html.h"
#include "validate/report/markdown.h"
#include "validate/report/readme.h"
#include "validate/report/report.h"
#include "validate/run/judge.h"
#include "validate/run/run.h"

namespace validate_tests {
using namespace seiche;

namespace {

CaseResult result_of(double h, double error) {
  CaseResult result;
  result.cell_size = h;
  result.measured.error = error;
  return result;
}

}  // namespace

TEST_CASE("a case is read with its defaults, and its mistakes are all reported") {
  const ScratchFolder folder;
  put_case(folder, "good", case_text("max_speed", 2));
  const CaseSpec one = read_case(folder / "cases" / "good");
  CHECK(one.name == "good");
  CHECK(one.tags == std::vector<std::string>{"one"});
  REQUIRE(one.resolutions.size() == 2);
  CHECK(belongs_to(one.resolutions[0], "quick"));
  CHECK_FALSE(belongs_to(one.resolutions[1], "quick"));
  CHECK(one.resolutions[1].overrides[0].path == "domain.cell_size");
  CHECK(max_error_of(one, one.resolutions[1]) == 2.0);

  put_case(folder, "bad",
           "title = \"t\"\nscene = \"none.toml\"\n[measure]\nkind = \"max_of_colum\"\n"
           "[[resolution]]\nname = \"a/b\"\nmax_eror = 1.0\n");
  CHECK_THROWS_WITH(read_case(folder / "cases" / "bad"),
                    Catch::Contains("case.toml:2") && Catch::Contains("did you mean \"max_of_column\"") &&
                        Catch::Contains("did you mean 'max_error'") && Catch::Contains("letters, digits"));
}

TEST_CASE("a resolution may have its own reference") {
  const ScratchFolder folder;
  put_case(
      folder, "one",
      "title = \"t\"\nscene = \"scene.toml\"\nmax_error = 1\n[measure]\nkind = \"period_of_probe\"\nprobe = \"p\"\n"
      "level = \"0\"\nreference = \"1\"\n[[resolution]]\nname = \"a\"\n[[resolution]]\nname = \"b\"\nreference = "
      "\"2\"\n");
  const CaseSpec one = read_case(folder / "cases" / "one");
  CHECK(reference_of(one, one.resolutions[0]) == "1.0");
  CHECK(reference_of(one, one.resolutions[1]) == "2.0");
}

TEST_CASE("a measure takes only its own parameters, and all of them") {
  const ScratchFolder folder;
  put_case(folder, "one",
           "title = \"t\"\nscene = \"scene.toml\"\nmax_error = 1\n[measure]\nkind = \"period_of_probe\"\n"
           "probe = \"p\"\nlevel = \"x\"\ncolumn = \"c\"\n[[resolution]]\nname = \"a\"\n");
  CHECK_THROWS_WITH(read_case(folder / "cases" / "one"),
                    Catch::Contains("reference") && Catch::Contains("column") && Catch::Contains("level"));
}

namespace {

std::string names_chosen(const std::vector<CaseSpec>& cases, const std::vector<std::string>& words) {
  const Selection selection(cases, words);
  std::string names;
  for (const CaseSpec& one : cases)
    if (selection.takes(one)) names += one.name + " ";
  return names;
}

}  // namespace

TEST_CASE("cases are chosen by name and tag, and a slip gets a suggestion") {
  std::vector<CaseSpec> cases(3);
  cases[0].name = "alpha", cases[0].tags = {"waves"};
  cases[1].name = "beta", cases[1].tags = {"rest"};
  cases[2].name = "gamma", cases[2].tags = {"waves"};
  CHECK(names_chosen(cases, {}) == "alpha beta gamma ");
  CHECK(names_chosen(cases, {"waves", "beta"}) == "alpha beta gamma ");
  CHECK(names_chosen(cases, {"waves"}) == "alpha gamma ");
  cases[0].name = "rest";  // also a tag
  CHECK(names_chosen(cases, {"rest"}) == "rest ");
  CHECK(names_chosen(cases, {"rest", "waves"}) == "rest gamma ");
  CHECK_THROWS_WITH(Selection(cases, {"bta"}), Catch::Contains("did you mean 'beta'"));
  CHECK_THROWS_WITH(Selection(cases, {"zzzzzz"}), Catch::Contains("--list"));
}

TEST_CASE("a single run is chosen by its case and name, whatever its level") {
  std::vector<CaseSpec> cases(2);
  cases[0].name = "alpha", cases[0].resolutions.resize(2);
  cases[0].resolutions[0].name = "32";
  cases[0].resolutions[1].name = "64", cases[0].resolutions[1].levels = {"full"};
  cases[1].name = "beta", cases[1].resolutions.resize(1);
  cases[1].resolutions[0].name = "64";
  const auto takes = [&](const std::vector<std::string>& words, int one, int run) {
    return Selection(cases, words)
        .takes(cases[std::size_t(one)], cases[std::size_t(one)].resolutions[std::size_t(run)], "quick");
  };
  CHECK(names_chosen(cases, {"alpha/64"}) == "alpha ");
  CHECK_FALSE(takes({"alpha/64"}, 0, 0));
  CHECK(takes({"alpha/64"}, 0, 1));
  CHECK_FALSE(takes({"alpha"}, 0, 1));
  CHECK(takes({"alpha"}, 0, 0));
  CHECK(takes({"alpha/64", "beta"}, 1, 0));
  CHECK_FALSE(takes({"alpha/64", "beta"}, 0, 0));
  CHECK_THROWS_WITH(Selection(cases, {"alpha/65"}), Catch::Contains("did you mean 'alpha/64'"));
  CHECK_THROWS_WITH(Selection(cases, {"beta/32"}), Catch::Contains("case/run 'beta/32'"));
}

TEST_CASE("the cases folder is found here, beside an installed program, and around a build") {
  const ScratchFolder folder;
  const fs::path here = folder / "here", prefix = folder / "prefix", tree = folder / "tree";
  const auto add = [](const fs::path& at) {
    fs::create_directories(at / "c");
    put(at / "c" / "case.toml", "");
  };
  CHECK_THROWS_WITH(find_cases_folder(here, prefix / "bin/seiche"), Catch::Contains("--cases"));
  add(prefix / "share/seiche/validation");
  add(tree / "validation");
  CHECK(find_cases_folder(here, prefix / "bin/seiche") == prefix / "share/seiche/validation");
  CHECK(find_cases_folder(here, tree / "build/release/seiche") == tree / "validation");
  fs::create_directories(here / "validation");  // another program's folder, without cases
  CHECK(find_cases_folder(here, tree / "build/release/seiche") == tree / "validation");
  add(here / "validation");
  CHECK(find_cases_folder(here, tree / "build/release/seiche") == here / "validation");
}

TEST_CASE("error, fitted order and the order of two resolutions decide") {
  CaseSpec one;
  one.max_error = 1;
  one.min_order = 1.9;
  CaseResult fine = result_of(0.1, 0.25);
  fine.order = observed_order(result_of(0.2, 1), fine);
  CHECK(*fine.order == Approx(2).epsilon(1e-12));  // round-off of two logarithms
  CHECK(judge(one, {}, fine) == Verdict::passed);
  fine.order = 1.75;
  CHECK(judge(one, {}, fine) == Verdict::passed);  // within order_scatter
  fine.fitted_order = 1.75;
  CHECK(judge(one, {}, fine) == Verdict::missed);
  fine.fitted_order = 1.95;
  fine.order = 1.6;
  CHECK(judge(one, {}, fine) == Verdict::missed);
  one.min_order.reset();
  CHECK(judge(one, {}, fine) == Verdict::passed);
  one.max_error = 0.2;
  CHECK(judge(one, {}, fine) == Verdict::missed);
  CHECK_FALSE(observed_order(result_of(0.1, 1), result_of(0.1, 1)));
  CHECK_FALSE(observed_order(result_of(0.2, 1), result_of(0.1, 0)));
}

TEST_CASE("the fitted order is that of a line through all errors") {
  // Pairs have the orders 1.89 and 2.11. For three equal steps least squares give the slope between the ends, 2.0.
  const double e = 1, f = e / std::pow(2, 1.89), g = f / std::pow(2, 2.11);
  CHECK(*fitted_order({result_of(0.4, e), result_of(0.2, f), result_of(0.1, g)}) == Approx(2).epsilon(1e-12));
  CHECK_FALSE(fitted_order({result_of(0.1, 1)}));
}

TEST_CASE("passing, missing and unmeasurable cases end with codes 0, 1 and 3 and stand in the report") {
  const ScratchFolder folder;
  put_case(folder, "pass", case_text("max_speed", 1.5));
  put_case(folder, "short", case_text("max_speed", 0.5));
  put_case(folder, "unmeasured", unmeasurable_text());
  const Outcome good = validate(folder, {"pass"}, "full");
  CHECK(good.code == ExitCode::done);
  CHECK(json_value(good.json, "passed") == "true");
  CHECK(good.json.find("\"resolution\": \"16\"") != std::string::npos);
  CHECK(fs::exists(folder / "out" / "pass" / "16" / "stats.csv"));

  const Outcome miss = validate(folder, {"pass", "short"}, "quick");
  CHECK(miss.code == ExitCode::bug);
  CHECK(miss.table.find("1 pass, 1 MISS") != std::string::npos);
  CHECK(json_value(miss.json, "passed") == "false");
  CHECK(json_value(miss.json, "complete") == "true");

  const Outcome failed = validate(folder, {"one"}, "quick");  // by tag: all three
  CHECK(failed.code == ExitCode::cannot_continue);
  CHECK(failed.table.find("is zero at the start") != std::string::npos);
}

TEST_CASE("a run that was made is taken, until its scene or the wish changes") {
  const ScratchFolder folder;
  put_case(folder, "first", case_text("max_speed", 1.5));
  put_case(folder, "second", case_text("dt", 1.5));  // the same scene: reuses the first run
  const auto cached = [](const Outcome& o) { return o.json.find("\"cached\": true") != std::string::npos; };
  CHECK_FALSE(cached(validate(folder, {"first"}, "quick")));
  CHECK(fs::exists(folder / "out" / "first" / "8" / "validate.txt"));
  const Outcome again = validate(folder, {"first"}, "quick");
  CHECK(cached(again));
  CHECK(again.code == ExitCode::done);
  CHECK(again.table.find("(") != std::string::npos);  // seconds of an earlier run
  validate(folder, {"second"}, "quick");
  CHECK_FALSE(fs::exists(folder / "out" / "second" / "8" / "stats.csv"));

  ValidateOptions fresh;
  fresh.earlier = Earlier::ignore;
  CHECK_FALSE(cached(validate(folder, {"first"}, "quick", fresh)));
  ValidateOptions broken;
  broken.perturbation = "divergence:0.5";
  CHECK_FALSE(cached(validate(folder, {"first"}, "quick", broken)));
  CHECK_FALSE(cached(validate(folder, {"first"}, "quick")));  // replaced by the broken run
  std::string faster = scene_text;
  faster.replace(faster.find("[1.0, 0.0]", faster.find("velocity")), 10, "[1.1, 0.0]");
  put(folder / "cases" / "first" / "scene.toml", faster);
  CHECK_FALSE(cached(validate(folder, {"first"}, "quick")));
}

TEST_CASE("a report alone runs nothing and says what is missing") {
  const ScratchFolder folder;
  put_case(folder, "one", case_text("max_speed", 1.5));
  validate(folder, {"one"}, "quick");
  ValidateOptions only;
  only.making = Making::report;
  only.docs = folder / "page.md";
  const Outcome outcome = validate(folder, {"one"}, "full", only);
  CHECK(outcome.code == ExitCode::cannot_continue);
  CHECK(outcome.table.find("1 pass, 1 not run") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "out" / "one" / "16"));
  const std::string page = contents(folder / "page" / "one.md");
  CHECK(page.find("seiche validate one --level full") != std::string::npos);
  CHECK(page.find("**not run**") != std::string::npos);
}

TEST_CASE("a record keeps figures of other builds, and the pages have all cases") {
  const ScratchFolder folder;
  put_case(folder, "first", case_text("max_speed", 1.5));
  put_case(folder, "second", case_text("max_speed", 1.5));
  ValidateOptions options;
  options.record = folder / "record.csv", options.docs = folder / "page.md";
  CHECK(validate(folder, {"first"}, "full", options).code == ExitCode::done);
  CHECK(contents(folder / "page.md").find("2 pass, 2 not run") != std::string::npos);

  // As another build would leave it: no runs, but their figures.
  std::string kept = contents(folder / "record.csv");
  for (std::size_t at; (at = kept.find(build_digest())) != std::string::npos;)
    kept.replace(at, build_digest().size(), "abcdef0123456789");
  put(folder / "record.csv", kept);
  fs::remove_all(folder / "out");
  CHECK(validate(folder, {"second"}, "full", options).code == ExitCode::done);
  const std::string page = contents(folder / "page.md");
  CHECK(page.find("4 pass; 2 of them made by other builds") != std::string::npos);
  CHECK(page.find("Of 2 cases 2 meet all their bars, 0 some of them, 0 none.") != std::string::npos);
  CHECK(contents(folder / "page" / "first.md").find("- Made by build abcdef01, 20") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "out" / "first"));

  // Figures of a case that has changed since do not count.
  fs::remove_all(folder / "out");
  put_case(folder, "first", case_text("dt", 1.5));
  options.making = Making::report;
  const Outcome changed = validate(folder, {}, "full", options);
  CHECK(changed.code == ExitCode::cannot_continue);
  CHECK(changed.table.find("2 pass, 2 not run") != std::string::npos);

  put(folder / "record.csv", "case,resolution\nfirst,8,1,2\n");
  CHECK_THROWS_WITH(validate(folder, {}, "full", options), Catch::Contains("record.csv, line 1"));
}

TEST_CASE("the pages show misses with their cause, plots and a picture") {
  const ScratchFolder folder;
  const std::string known = "known = \"the sun <was> in its eyes\"\n";
  put_case(folder, "one", known + case_text("max_speed", 0.5));
  put(folder / "cases" / "one" / "README.md", "# A & B\n");
  ValidateOptions options;
  options.docs = folder / "page.md";
  CHECK(validate(folder, {"one"}, "full", options).code == ExitCode::bug);
  const std::string html = contents(folder / "out" / "report.html"), page = contents(folder / "page" / "one.md");
  CHECK(html.find("# A &amp; B") != std::string::npos);
  CHECK(html.find("the sun &lt;was&gt; in its eyes") != std::string::npos);
  CHECK(html.find("<polyline") != std::string::npos);
  CHECK(html.find("data:image/png;base64,iVBORw0KGgo") != std::string::npos);
  CHECK(html.find("http") == std::string::npos);  // needs no other file
  CHECK(page.find("**MISS**") != std::string::npos);
  CHECK(page.find("Misses its bar: the sun") != std::string::npos);
  options.making = Making::report;
  fs::remove_all(folder / "out");
  validate(folder, {"one"}, "full", options);
  CHECK(contents(folder / "page" / "one.md").find("Not run in full; known: the sun") != std::string::npos);
}

TEST_CASE("the page of a case has what it takes to make its figures again") {
  const ScratchFolder folder;
  put_case(folder, "one", case_text("max_speed", 2));
  put(folder / "cases" / "one" / "README.md", "# Moving\n\nAs [two](../two/README.md).\n");
  ValidateOptions options;
  options.docs = folder / "page.md", options.record = folder / "record.csv";
  CHECK(validate(folder, {}, "full", options).code == ExitCode::done);
  const std::string page = contents(folder / "page" / "one.md"), summary = contents(folder / "page.md");
  for (const char* part : {"# one: t\n", "## Moving\n", "[two](../../cases/two/README.md)",
                           "(`max_of_column`, column `max_speed`), in m/s", "[case.toml](../../cases/one/case.toml)",
                           "[scene.toml](../../cases/one/scene.toml)", "one --level full", "| 16 | 0.0625 | 1 |",
                           "  - 16: `domain.cell_size=0.0625`\n", "- Made by this build, 20", ", 1 thread, machine 1.",
                           "[All cases](../page.md)"}) {
    INFO(part);
    CHECK(page.find(part) != std::string::npos);
  }
  CHECK(summary.find("- machine 1, of 2 runs: ") != std::string::npos);
  CHECK(page.find(folder.path().string()) == std::string::npos);
  // The machine is that of the run, also if the run is found later.
  const std::string record = contents(folder / "record.csv");
  fs::remove(folder / "record.csv");
  CHECK(validate(folder, {}, "full", options).code == ExitCode::done);
  const auto line = [](const std::string& text) { return text.substr(text.find("one,8")); };
  CHECK(line(contents(folder / "record.csv")).find("; g++ ") != std::string::npos);
  CHECK(line(record).find("; g++ ") != std::string::npos);
}

TEST_CASE("the summary opens with a row a case, its finest run and its misses") {
  const ScratchFolder folder;
  put_case(folder, "good", case_text("max_speed", 1.5));
  put_case(folder, "bad", case_text("max_speed", 0.5));
  ValidateOptions options;
  options.docs = folder / "page.md";
  validate(folder, {}, "full", options);
  const std::string page = contents(folder / "page.md");
  const std::size_t table = page.find("| case | compared | error | bar | runs |"),
                    list = page.find("## Runs that miss");
  CHECK(table < list);
  for (const char* part : {"Of 2 cases 1 meet all their bars, 0 some of them, 1 none.",
                           "| [good](page/good.md) | t | 1 | 1.5 | 2 pass |\n",
                           "| [bad](page/bad.md) | t | 1 | 0.5 | **0 pass, 2 MISS** |\n",
                           "- [bad 16](page/bad.md): MISS, error 1 where 0.5 passes\n"}) {
    INFO(part);
    CHECK(page.find(part) != std::string::npos);
  }
}

TEST_CASE("pages of cases that are no more go, other texts stay") {
  const ScratchFolder folder;
  put_case(folder, "one", case_text("max_speed", 1.5));
  put_case(folder, "two", case_text("max_speed", 1.5));
  ValidateOptions options;
  options.docs = folder / "page.md";
  validate(folder, {}, "quick", options);
  put(folder / "page" / "notes.md", "mine\n");
  fs::remove_all(folder / "cases" / "two");
  validate(folder, {}, "quick", options);
  CHECK(fs::exists(folder / "page" / "one.md"));
  CHECK_FALSE(fs::exists(folder / "page" / "two.md"));
  CHECK(contents(folder / "page" / "notes.md") == "mine\n");
  put(folder / "page" / "one.md", "mine\n");
  CHECK_THROWS_WITH(validate(folder, {}, "quick", options), Catch::Contains("no page of seiche validate"));
  options.docs = folder / "page";
  fs::remove_all(folder / "page");
  CHECK_THROWS_WITH(validate(folder, {}, "quick", options), Catch::Contains("no extension"));
}

TEST_CASE("a case's README stands in its page with its headings deeper and its links right") {
  CHECK(embed_readme("# A\ntext # no heading\n```\n# code [a](b)\n```\n    # code\n## B\n", "v/one") ==
        "## A\ntext # no heading\n```\n# code [a](b)\n```\n    # code\n### B\n");
  CHECK(embed_readme("[a](b.csv), [c](../d/e.md#f), [g](#h), [i](https://j.k)\n\n", "v/one") ==
        "[a](../../v/one/b.csv), [c](../../v/d/e.md#f), [g](#h), [i](https://j.k)\n");
  CHECK(embed_readme("~~~\n# code\n```\n", "v/one") == "~~~\n# code\n```\n~~~\n");  // closed for the following text
  CHECK(embed_readme("<!-- a -->\n<!-- b\n", "v/one") == "<!-- a -->\n<!-- b\n-->\n");
  CHECK(link_from_page("v/one", "../../scenes/s.toml") == "../../scenes/s.toml");
}

TEST_CASE("the parts of plots") {
  CHECK(round_steps(0, 10, 5) == std::vector<double>{0, 2, 4, 6, 8, 10});
  Points points;
  for (int n = 0; n < 5000; ++n) points.emplace_back(n, n == 3210 ? 7.0 : n == 4000 ? -3.0 : 0.0);
  const Points few = thinned(points, 800);
  CHECK(few.size() <= 1000);
  const auto holds = [&](double y) {
    return std::any_of(few.begin(), few.end(), [&](const auto& p) { return p.second == y; });
  };
  CHECK(holds(7));
  CHECK(holds(-3));
  CHECK(format_svg({"x", "y", Chart::Axes::logarithmic, {{"none", {{1, 0}, {2, -1}}, Curve::Style::line}}}).empty());
}

TEST_CASE("a wrong scene is refused before any case is run") {
  const ScratchFolder folder;
  put_case(folder, "a", case_text("max_speed", 1.5));
  put_case(folder, "b", case_text("max_speed", 1.5));
  put(folder / "cases" / "b" / "scene.toml", "dimension = 7\n");
  CHECK_THROWS_AS(validate(folder, {}, "quick"), Error);
  CHECK_FALSE(fs::exists(folder / "out"));
}

}  // namespace validate_tests
