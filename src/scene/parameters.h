#pragma once
// Named numbers of a scene, [parameters], and numbers written as texts: "depth/2", "2 cm".
#include <map>
#include <optional>
#include <string>

#include "base/options.h"

namespace seiche {

class SceneContext;
struct TomlNode;

using Parameters = std::map<std::string, double>;

// True for an identifier that expressions do not know.
bool is_free_name(const std::string& name);

// The text with each parameter's value in its place.
std::string with_parameters(const std::string& text, const Parameters& parameters);

// The number that a text stands for at a key: an expression of parameters, with or without a unit. Else sets `fault`.
std::optional<double> number_of(const std::string& text, const Option& option, const Parameters& parameters,
                                std::string& fault);

// The numbers of the table [parameters], which may depend on each other in any order. Reports names that are taken,
// values that are not numbers, and circles.
Parameters read_parameters(SceneContext& context, const TomlNode& root);

// Declares the signals of the table [signals], numbers in formulas that a program around the simulation may change
// (base/signals.h). Returns their values at the start. Reports names that are taken and values that are not numbers.
Parameters read_signals(SceneContext& context, const TomlNode& root);

}  // namespace seiche
