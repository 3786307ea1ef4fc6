#include "validate/case/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "scene/section.h"
#include "validate/measure/kinds.h"
#include "validate/measure/measures.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

using T = OptionType;
const Option error_bar{.key = "max_error", .range = positive(), .unset = "no bar", .doc = "largest error that passes"};

// The name becomes a folder's name.
bool is_plain_name(const std::string& name) {
  const auto plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), plain);
}

// Strings of an array; reports other entries.
std::vector<std::string> texts_of(SceneContext& c, const Place& p) {
  std::vector<std::string> texts;
  const auto good = [](const TomlNode& node) { return is_text(node); };
  if (p.node->kind != TomlNode::Kind::array || !std::all_of(p.node->items.begin(), p.node->items.end(), good)) {
    c.report(p, fmt::format("{} must be an array of texts in quotes, not {}", p.path, describe(*p.node)));
    return texts;
  }
  for (const TomlNode& item : p.node->items) texts.push_back(item.text);
  return texts;
}

Key<CaseSpec> tags_key() {
  Key<CaseSpec> key;
  key.option = {.key = "tags", .type = T::text, .doc = "words to select cases by"};
  key.read = [](SceneContext& c, const Place& p, CaseSpec& s) { s.tags = texts_of(c, p); };
  return key;
}

Key<ResolutionSpec> overrides_key() {
  Key<ResolutionSpec> key;
  key.option = {.key = "set", .type = T::text, .doc = "keys of the scene to set, each as \"key.path=value\""};
  key.read = [](SceneContext& c, const Place& p, ResolutionSpec& s) {
    for (const std::string& text : texts_of(c, p)) {
      try {
        const Override one = parse_override(text);
        if (std::ranges::count(s.overrides, one.path, &Override::path) > 0)
          c.report(p, fmt::format("{} is set twice", one.path));
        s.overrides.push_back(one);
      } catch (const Error& error) {
        c.report(p, error.what());
      }
    }
  };
  return key;
}

Section<ResolutionSpec> resolution_section() {
  using S = ResolutionSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "name", .type = T::text, .presence = Presence::required, .doc = "names its run"}, &S::name),
      value_key<S>({.key = "scene", .type = T::file, .unset = "the case's", .doc = "scene file"}, &S::scene),
      value_key<S>({.key = "levels", .type = T::choice_list, .choices = {"quick", "full"}, .doc = "when it is run"},
                   &S::levels),
      overrides_key(),
      value_key<S>(error_bar, &S::max_error),
      value_key<S>({.key = "reference", .type = T::formula, .unset = "the measure's", .doc = "what is expected here"},
                   &S::reference),
      value_key<S>({.key = "others", .type = T::text, .doc = "what others report here"}, &S::others),
      value_key<S>({.key = "series", .type = T::text, .doc = "runs that orders are taken over"}, &S::series),
  };
  s.finish = [](SceneContext& c, const Place& p, S& spec) {
    if (!is_plain_name(spec.name)) c.report(p, "name must be made of letters, digits, '_' and '-'");
  };
  return s;
}

Section<PlotSpec> plot_section() {
  using S = PlotSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "data", .type = T::file, .presence = Presence::required, .doc = "the reference's"},
                   &S::data),
      value_key<S>(
          {.key = "time_unit", .type = T::formula, .unit = "s", .range = positive(), .doc = "its first column"},
          &S::time_unit),
      value_key<S>({.key = "value_unit", .type = T::formula, .doc = "its second column"}, &S::value_unit),
      value_key<S>({.key = "x", .type = T::text, .doc = "name of the axis"}, &S::x),
      value_key<S>({.key = "y", .type = T::text, .doc = "name of the axis"}, &S::y),
  };
  return s;
}

bool takes_reference(const MeasureSpec& measure) {
  return std::ranges::any_of(
      measure_kinds(), [&](const MeasureKind& kind) { return measure.kind == kind.name && uses(kind, "reference"); });
}

// An order of convergence needs at least two runs of a series.
bool has_series(const CaseSpec& spec) {
  const auto& all = spec.resolutions;
  for (auto run = all.begin(); run != all.end(); ++run)
    if (std::any_of(run + 1, all.end(), [&](const ResolutionSpec& other) { return same_series(spec, *run, other); }))
      return true;
  return false;
}

void check_case(SceneContext& c, const Place& p, const CaseSpec& spec) {
  if (!is_plain_name(spec.name))
    c.report(p, fmt::format("the name of its folder, '{}', must be made of letters, digits, '_' and '-'", spec.name));
  if (spec.min_order && !has_series(spec))
    c.report(p, "min_order needs two resolutions of the same series and the same reference");
  std::vector<std::string> names;
  for (const ResolutionSpec& resolution : spec.resolutions) {
    if (std::count(names.begin(), names.end(), resolution.name) > 0) {
      c.report(p, fmt::format("two resolutions are named '{}'", resolution.name));
    }
    names.push_back(resolution.name);
    if (resolution.reference && !takes_reference(spec.measure))
      c.report(p, fmt::format("resolution '{}' has a reference, and the measure takes none", resolution.name));
    if (!max_error_of(spec, resolution)) c.report(p, fmt::format("resolution '{}' has no max_error", resolution.name));
    if (!resolution.scene && spec.scene.empty())
      c.report(p, fmt::format("resolution '{}' has no scene", resolution.name));
  }
  if (names.empty()) c.report(p, "the case needs at least one [[resolution]]");
}

Section<CaseSpec> case_section() {
  using S = CaseSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "title", .type = T::text, .presence = Presence::required, .doc = "for people"}, &S::title),
      tags_key(),
      value_key<S>({.key = "scene", .type = T::file, .unset = "each resolution's", .doc = "scene file"}, &S::scene),
      value_key<S>({.key = "others", .type = T::text, .doc = "what others report"}, &S::others),
      value_key<S>({.key = "known", .type = T::text, .doc = "why bars are missed"}, &S::known),
      value_key<S>(error_bar, &S::max_error),
      value_key<S>({.key = "min_order", .range = positive(), .unset = "no bar", .doc = "least order of convergence"},
                   &S::min_order),
      block_key<S>({.key = "measure", .presence = Presence::required, .doc = "what is measured"}, &S::measure,
                   measure_section()),
      block_key<S>({.key = "plot", .unset = "none", .doc = "a reference's series to show beside the measured one"},
                   &S::plot, plot_section()),
      list_key<S>({.key = "resolution", .presence = Presence::required, .doc = "runs, coarse to fine", .most = 100},
                  &S::resolutions, resolution_section()),
  };
  s.finish = [](SceneContext& c, const Place& p, S& spec) { check_case(c, p, spec); };
  return s;
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw Error(ExitCode::bad_input, fmt::format("cannot read the case '{}'", file.string()));
  return text;
}

bool is_case(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / "case.toml", ignored);
}

// True for a folder or link, not hidden, without a case.toml.
bool lacks_case(const fs::path& place) {
  std::error_code ignored;
  const bool may_be = fs::is_directory(place, ignored) || fs::is_symlink(place, ignored);
  return may_be && !place.filename().string().starts_with('.') && !is_case(place);
}

// Wanted entries directly below the folder, by name.
template <class Wanted>
std::vector<fs::path> places_below(const fs::path& folder, const Wanted& wanted) {
  std::vector<fs::path> found;
  std::error_code failed;
  for (fs::directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed))
    if (wanted(it->path())) found.push_back(it->path());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<fs::path> case_folders(const fs::path& folder) {
  return places_below(folder, is_case);
}

}  // namespace

CaseSpec read_case(const fs::path& folder) {
  const fs::path file = folder / "case.toml";
  const TomlNode root = parse_toml(read_text(file), file.string());
  SceneContext context(file.string(), folder);
  context.access = FileAccess::anywhere;
  CaseSpec spec;
  spec.folder = folder;
  spec.name = fs::absolute(folder).lexically_normal().filename().string();
  const Section<CaseSpec> section = case_section();
  read_section(context, {&root, ""}, section, own_options(section), spec);
  context.throw_problems();
  return spec;
}

std::vector<CaseSpec> read_cases(const fs::path& folder) {
  std::vector<CaseSpec> cases;
  for (const fs::path& one : case_folders(folder)) cases.push_back(read_case(one));
  if (cases.empty()) {
    throw Error(ExitCode::bad_input,
                fmt::format("{}: holds no validation case (a folder with a case.toml)", folder.string()));
  }
  return cases;
}

std::vector<fs::path> folders_without_case(const fs::path& folder) {
  return places_below(folder, lacks_case);
}

bool belongs_to(const ResolutionSpec& resolution, const std::string& level) {
  return std::count(resolution.levels.begin(), resolution.levels.end(), level) > 0;
}

const fs::path& scene_of(const CaseSpec& one, const ResolutionSpec& resolution) {
  return resolution.scene ? *resolution.scene : one.scene;
}

std::optional<double> max_error_of(const CaseSpec& one, const ResolutionSpec& resolution) {
  return resolution.max_error ? resolution.max_error : one.max_error;
}

const Formula& reference_of(const CaseSpec& one, const ResolutionSpec& resolution) {
  return resolution.reference ? *resolution.reference : one.measure.reference;
}

bool same_series(const CaseSpec& one, const ResolutionSpec& a, const ResolutionSpec& b) {
  return a.series == b.series && reference_of(one, a) == reference_of(one, b);
}

MeasureSpec measure_of(const CaseSpec& one, const ResolutionSpec& resolution) {
  MeasureSpec spec = one.measure;
  spec.reference = reference_of(one, resolution);
  return spec;
}

fs::path find_cases_folder(const fs::path& here, const fs::path& program) {
  const fs::path beside = program.parent_path();
  const fs::path places[] = {here / "validation", (beside / "../share/seiche/validation").lexically_normal(),
                             (beside / "../../validation").lexically_normal()};
  for (const fs::path& place : places) {
    if (!case_folders(place).empty()) return place;
  }
  throw Error(ExitCode::bad_input, fmt::format("no validation cases in {}, {} or {}; give their folder with --cases",
                                               places[0].string(), places[1].string(), places[2].string()));
}

}  // namespace seiche
