#pragma once
// The parts of JSON that summaries and reports of runs need.
#include <string>

namespace seiche {

// The text in double quotes with JSON escapes.
std::string json_string(const std::string& text);

// Raw value of a top-level key of a JSON object; strings without quotes and escapes. Empty if there is no such key.
std::string json_value(const std::string& json, const std::string& key);

}  // namespace seiche
