// Checks forces and contacts against the solids that they name.
#include <fmt/format.h>

#include <algorithm>

#include "base/name_pattern.h"
#include "base/restitution.h"
#include "base/scene.h"
#include "base/suggest.h"
#include "scene/checks.h"

namespace seiche {
namespace {

// Reports at a key of an entry of [[force]] or [[contact]].
struct EntryChecker {
  SceneContext& context;
  const TomlNode& root;
  std::string list;
  std::size_t index;

  void report(const std::string& key, const std::string& text) const {
    const std::string path = fmt::format("{}.{}.{}", list, index, key);
    context.report(path, line_of(root, path), fmt::format("{}: {}", path, text));
  }
};

std::vector<std::string> names_of(const std::vector<SolidSpec>& solids, bool only_free) {
  std::vector<std::string> names;
  for (const SolidSpec& solid : solids)
    if (!only_free || solid.kind.is_free()) names.push_back(solid.name);
  return names;
}

bool fits_one(const std::string& pattern, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return fits(name, pattern); });
}

// "did you mean", or the names that there are.
std::string remedy(const std::string& pattern, const std::vector<std::string>& names) {
  const auto near = suggest(pattern, names);
  if (near) return "did you mean \"" + *near + "\"?";
  return names.empty() ? "there is none" : "there is " + quoted_list(names);
}

void check_force(const EntryChecker& c, const Scene& scene, const ForceSpec& force) {
  const std::vector<std::string> movable = names_of(scene.solids, true);
  for (const std::string& pattern : force.solids)
    if (!fits_one(pattern, movable))
      c.report("solids", fmt::format("forces move no solid named \"{}\"; {}", pattern, remedy(pattern, movable)));
  const bool on_solids = force.kind == ForceKind::load || force.acts_on == ForceTarget::solids;
  if (on_solids && movable.empty()) c.report("kind", "the scene has no solid that forces move");
  if (!force.solids.empty() && force.acts_on == ForceTarget::liquid)
    c.report("solids", "a force on the liquid alone acts on no solid; remove solids, or acts_on");
  const bool flat = scene.dimension == 2 && (force.kind == ForceKind::vortex || force.kind == ForceKind::load);
  if (flat && (force.axis[0] != 0 || force.axis[1] != 0 || force.axis[2] == 0))
    c.report("axis", "in 2D the axis is [0, 0, 1] or [0, 0, -1]");
  if (force.axis.norm() == 0) c.report("axis", "the axis has no length");
  if (force.kind == ForceKind::wind && scene.gas.flows())
    c.report("kind",
             "wind is for free surfaces; here [gas] flows, so give the gas its velocity by gas.velocity and sides");
  if (force.kind != ForceKind::load) return;
  for (const SolidSpec& solid : scene.solids)
    if (solid.kind.has_elements && (force.solids.empty() || fits_any(solid.name, force.solids)))
      c.report("solids", fmt::format("\"{}\" is elastic: a load would act on one point of it; use traction or "
                                     "body_force of the solid, or name other solids here",
                                     solid.name));
}

void check_rebound(const EntryChecker& c, const Scene& scene, const ContactSpec& contact) {
  for (const SolidSpec& solid : scene.solids) {
    const SolidKind& kind = solid.kind;
    if (!may_rebound(kind) && fits_any(solid.name, contact.between))
      return c.report("restitution", fmt::format("\"{}\" is {}; restitution is for rigid, kinematic and static solids, "
                                                 "so name these in between",
                                                 solid.name, kind.name));
  }
}

void check_contact(const EntryChecker& c, const Scene& scene, const ContactSpec& contact) {
  if (contact.between.size() > 2) c.report("between", "names one or two groups of solids");
  std::vector<std::string> names = names_of(scene.solids, false);
  names.push_back("domain");
  for (const std::string& pattern : contact.between)
    if (!fits_one(pattern, names))
      c.report("between", fmt::format("no solid is named \"{}\"; {}", pattern, remedy(pattern, names)));
  const auto domain = std::find(contact.between.begin(), contact.between.end(), "domain");
  if (domain != contact.between.end() && (contact.between.size() == 1 || !contact.collide))
    c.report("between", contact.collide ? "name the solids that touch the domain's sides"
                                        : "solids cannot pass through the domain's sides; give a side outflow");
  if (contact.collide && !contact.friction && !contact.restitution)
    c.report("between", "give friction, restitution, or collide = false");
  if (!contact.collide && contact.restitution)
    c.report("restitution", "solids that do not collide have no restitution");
  if (contact.restitution.value_or(0) > 0) check_rebound(c, scene, contact);
  if (!contact.collide && contact.friction) c.report("friction", "solids that do not collide have no friction");
}

}  // namespace

void check_forces(SceneContext& context, const TomlNode& root, const Scene& scene) {
  for (std::size_t i = 0; i < scene.forces.size(); ++i)
    check_force({context, root, "force", i}, scene, scene.forces[i]);
}

void check_contacts(SceneContext& context, const TomlNode& root, const Scene& scene) {
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    check_contact({context, root, "contact", i}, scene, scene.contacts[i]);
}

}  // namespace seiche
