#pragma once
// Features that other settings switch off. One table serves the solver's decisions, the log and docs/features.md.
#include <cstdint>
#include <string>
#include <vector>

namespace seiche {

template <int Dim>
struct Setup;

enum class Feature {
  leapfrog,
  shared_viscosity,
  shear_jump,
  one_sided_at_medial_axis,
  sealed_cavities,
  contact_line_pull,
  contact_angles
};

// The features that nothing in the scene switches off.
class Features {
 public:
  Features() = default;
  template <int Dim>
  explicit Features(const Setup<Dim>& setup);
  bool has(Feature feature) const { return !(off_ >> int(feature) & 1); }

 private:
  std::uint32_t off_ = 0;  // a bit a feature
};

// A property of a scene that switches a feature off.
template <int Dim>
struct Exclusion {
  Feature feature;
  const char* cause;
  bool (*present)(const Setup<Dim>&);
};

template <int Dim>
const std::vector<Exclusion<Dim>>& exclusions();

// Causes in this scene that switch the feature off, in the order of the table.
template <int Dim>
std::vector<std::string> causes_against(const Setup<Dim>& setup, Feature feature);

// One line for each feature that matters in this scene and is off: its name, the causes and the consequence.
template <int Dim>
std::vector<std::string> describe_features(const Setup<Dim>& setup);

// docs/features.md as text.
std::string feature_reference();

}  // namespace seiche
