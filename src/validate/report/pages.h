#pragma once
// The files of --write-docs: a summary, and a page for each case in a folder of the summary's name.
#include <filesystem>
#include <string>
#include <vector>

#include "validate/report/report.h"

namespace seiche {

// "docs/validation" for the summary "docs/validation.md".
std::filesystem::path folder_of_pages(const std::filesystem::path& summary);

// What would be found only after hours of runs: makes the folder, replaces nothing. Throws Error(bad_input) where the
// summary has no extension or a text stands in the way that no validation wrote, Error(output_failed) where the folder
// cannot be made.
void check_pages(const std::filesystem::path& summary, const std::vector<std::string>& cases);

// Writes all pages and removes those of cases that are no more. Throws Error(output_failed).
void write_pages(const std::filesystem::path& summary, const Report& report);

}  // namespace seiche
