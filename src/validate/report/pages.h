#pragma once
// Files of --write-docs: a summary and a folder of the same name with one page a case.
#include <filesystem>
#include <string>
#include <vector>

#include "validate/report/report.h"

namespace seiche {

// Folder of the pages: "docs/validation" for the summary "docs/validation.md".
std::filesystem::path folder_of_pages(const std::filesystem::path& summary);

// Checks before hours of runs that the pages can be written: makes the folder, replaces nothing. Throws
// Error(bad_input) if the summary has no extension or a file of the same name was not written by a validation,
// Error(output_failed) if the folder cannot be made.
void check_pages(const std::filesystem::path& summary, const std::vector<std::string>& cases);

// Writes all pages and removes those of deleted cases. Throws Error(output_failed).
void write_pages(const std::filesystem::path& summary, const Report& report);

}  // namespace seiche
