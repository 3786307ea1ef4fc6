#include "base/signals.h"

#include <set>

namespace seiche {
namespace {

struct Registry {
  std::map<std::string, double> slots;  // never erased: formulas hold their addresses
  std::set<std::string> declared;
};

Registry& registry() {
  static Registry all;
  return all;
}

}  // namespace

void declare_signals(const std::map<std::string, double>& values) {
  registry().declared.clear();
  for (const auto& [name, value] : values) {
    registry().slots[name] = value;
    registry().declared.insert(name);
  }
}

bool set_signal(const std::string& name, double value) {
  if (!is_signal(name)) return false;
  registry().slots[name] = value;
  return true;
}

std::map<std::string, double> declared_signals() {
  std::map<std::string, double> values;
  for (const std::string& name : registry().declared) values[name] = registry().slots[name];
  return values;
}

bool is_signal(const std::string& name) {
  return registry().declared.contains(name);
}

double* signal_slot(const std::string& name) {
  return &registry().slots[name];
}

}  // namespace seiche
