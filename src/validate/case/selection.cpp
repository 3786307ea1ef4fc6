#include "validate/case/selection.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/suggest.h"

namespace seiche {
namespace {

using Cases = std::vector<CaseSpec>;

// A word that is a case's name selects that case only, even if it is also a tag.
bool fits(const Cases& cases, const CaseSpec& one, const std::string& word) {
  if (std::ranges::count(cases, word, &CaseSpec::name) > 0) return one.name == word;
  return std::ranges::count(one.tags, word) > 0;
}

std::string run_word(const CaseSpec& one, const ResolutionSpec& run) {
  return one.name + "/" + run.name;
}

bool names_run(const CaseSpec& one, const std::string& word) {
  return std::ranges::any_of(one.resolutions, [&](const ResolutionSpec& run) { return run_word(one, run) == word; });
}

// Names of runs are included only for words that look like one; otherwise they would crowd out the cases.
std::vector<std::string> known_words(const Cases& cases, bool runs) {
  std::vector<std::string> known;
  for (const CaseSpec& one : cases) {
    known.push_back(one.name);
    known.insert(known.end(), one.tags.begin(), one.tags.end());
    if (!runs) continue;
    for (const ResolutionSpec& run : one.resolutions) known.push_back(run_word(one, run));
  }
  return known;
}

void refuse_unknown(const Cases& cases, const std::string& word) {
  const auto known = [&](const CaseSpec& one) { return fits(cases, one, word) || names_run(one, word); };
  if (std::ranges::any_of(cases, known)) return;
  const bool is_run = word.find('/') != std::string::npos;
  const auto near = suggest(word, known_words(cases, is_run));
  throw Error(ExitCode::bad_input,
              fmt::format("there is no validation case, tag or case/run '{}'; {}", word,
                          near ? fmt::format("did you mean '{}'?", *near) : "`seiche validate --list` shows all"));
}

}  // namespace

Selection::Selection(const Cases& cases, std::vector<std::string> words) : cases_(&cases), words_(std::move(words)) {
  for (const std::string& word : words_) refuse_unknown(cases, word);
}

bool Selection::takes_whole(const CaseSpec& one) const {
  return words_.empty() ||
         std::ranges::any_of(words_, [&](const std::string& word) { return fits(*cases_, one, word); });
}

bool Selection::takes(const CaseSpec& one) const {
  return takes_whole(one) || std::ranges::any_of(words_, [&](const std::string& word) { return names_run(one, word); });
}

bool Selection::takes(const CaseSpec& one, const ResolutionSpec& run, const std::string& level) const {
  return (takes_whole(one) && belongs_to(run, level)) || std::ranges::count(words_, run_word(one, run)) > 0;
}

}  // namespace seiche
