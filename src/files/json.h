#pragma once
// JSON as far as summaries and reports of runs need it.
#include <string>

namespace seiche {

// The text in double quotes with JSON's escapes.
std::string json_string(const std::string& text);

// The value of a key at the top level of a JSON object as it stands there, strings without their quotes and escapes;
// empty if there is no such key.
std::string json_value(const std::string& json, const std::string& key);

}  // namespace seiche
