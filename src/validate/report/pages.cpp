#include "validate/report/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/error.h"
#include "files/checked_file.h"
#include "validate/record/files.h"
#include "validate/report/markdown.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

bool is_other_text(const fs::path& file, std::string_view first_line) {
  if (!fs::is_regular_file(file)) return false;
  const std::string there = read_whole_file(file);
  return !there.empty() && !there.starts_with(first_line);
}

// Keeps files that no validation wrote. Throws Error(bad_input).
void refuse_other_text(const fs::path& file, std::string_view first_line) {
  if (is_other_text(file, first_line))
    throw Error(ExitCode::bad_input, fmt::format("{} is there and is no page of seiche validate: name another file for "
                                                 "--write-docs, or remove it",
                                                 file.string()));
}

void remove_pages_but(const std::vector<std::string>& files, const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".md" || std::ranges::count(files, file.filename().string()) > 0) continue;
    std::error_code ignored;  // a page that cannot be removed has no links to it
    if (entry.is_regular_file() && !is_other_text(file, case_page_title)) fs::remove(file, ignored);
  }
}

}  // namespace

fs::path folder_of_pages(const fs::path& summary) {
  return summary.parent_path() / summary.stem();
}

void check_pages(const fs::path& summary, const std::vector<std::string>& cases) {
  refuse_other_text(summary, page_title);
  if (!summary.has_extension())
    throw Error(ExitCode::bad_input,
                fmt::format("{} has no extension: name a file such as {}.md for --write-docs; pages "
                            "of cases go to a folder of its name without the extension",
                            summary.string(), summary.string()));
  const fs::path folder = folder_of_pages(summary);
  for (const std::string& name : cases) refuse_other_text(folder / (name + ".md"), case_page_title);
  make_folder(folder);
}

void write_pages(const fs::path& summary, const Report& report) {
  const fs::path folder = folder_of_pages(summary);
  make_folder(folder);
  std::vector<std::string> files;
  for (const CasePage& page : case_pages(report, summary.filename().string())) {
    replace_file(folder / page.file, page.text);
    files.push_back(page.file);
  }
  remove_pages_but(files, folder);
  replace_file(summary, format_markdown(report, folder.filename().string()));
}

}  // namespace seiche
