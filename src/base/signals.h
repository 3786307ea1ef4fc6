#pragma once
// Signals: named numbers in formulas that a program around the simulation sets between steps, as a controller does.
// They belong to the process; formulas that were parsed while a signal was declared follow it from then on.
#include <map>
#include <string>

namespace seiche {

// Replaces the names that formulas may use, and sets their values. Formulas that use earlier ones keep them.
void declare_signals(const std::map<std::string, double>& values);

// Sets a declared signal; false if there is no such one. Not while a step runs.
bool set_signal(const std::string& name, double value);

// Declared signals with their values.
std::map<std::string, double> declared_signals();

bool is_signal(const std::string& name);

// The number behind a declared signal; it stays where it is for the life of the process.
double* signal_slot(const std::string& name);

}  // namespace seiche
