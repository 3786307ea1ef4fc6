#include "coupling/state/contact_pairs.h"

#include <algorithm>

#include "base/name_pattern.h"
#include "base/scene.h"

namespace seiche {
namespace {

// The last entry that fits a pair; null: none. An empty second name stands for the domain's sides.
const ContactSpec* contact_between(const Scene& scene, const std::string& a, const std::string& b) {
  const auto fits_name = [](const std::string& name, const std::string& pattern) {
    return name.empty() ? pattern == "domain" : fits(name, pattern);
  };
  const auto fits_pair = [&](const ContactSpec& contact) {
    const std::string &one = contact.between.front(), &other = contact.between.back();
    return (fits_name(a, one) && fits_name(b, other)) || (fits_name(b, one) && fits_name(a, other));
  };
  const auto found = std::find_if(scene.contacts.rbegin(), scene.contacts.rend(), fits_pair);
  return found == scene.contacts.rend() ? nullptr : &*found;
}

// visit(pair, contact) for pairs with an entry; the second index is -1 for the domain's sides.
template <class Visit>
void for_each_contact(const Scene& scene, const Visit& visit) {
  if (scene.contacts.empty()) return;
  const auto& solids = scene.solids;
  for (int a = 0; a < int(solids.size()); ++a) {
    const std::string& name = solids[std::size_t(a)].name;
    if (const ContactSpec* c = contact_between(scene, name, "")) visit(std::array{a, -1}, *c);
    for (int b = a + 1; b < int(solids.size()); ++b)
      if (const ContactSpec* c = contact_between(scene, name, solids[std::size_t(b)].name)) visit(std::array{a, b}, *c);
  }
}

}  // namespace

// Deforming solids pass through all that forces do not move, as kinematic ones do.
SharedPairs pairs_apart(const Scene& scene, SharedPairs jointed) {
  const auto& solids = scene.solids;
  for (int a = 0; a < int(solids.size()); ++a)
    for (int b = a + 1; b < int(solids.size()); ++b) {
      const SolidKind &one = solids[std::size_t(a)].kind, &other = solids[std::size_t(b)].kind;
      if ((one.follows_meshes || other.follows_meshes) && !one.is_free() && !other.is_free()) jointed.push_back({a, b});
    }
  for_each_contact(scene, [&](const std::array<int, 2>& pair, const ContactSpec& contact) {
    if (!contact.collide) jointed.push_back(pair);
  });
  std::sort(jointed.begin(), jointed.end());
  jointed.erase(std::unique(jointed.begin(), jointed.end()), jointed.end());
  return jointed;
}

PairCoefficients pair_coefficients(const Scene& scene, std::optional<double> ContactSpec::*member) {
  PairCoefficients coefficients;
  for_each_contact(scene, [&](const std::array<int, 2>& pair, const ContactSpec& contact) {
    if (contact.*member) coefficients[pair] = *(contact.*member);
  });
  return coefficients;
}

}  // namespace seiche
