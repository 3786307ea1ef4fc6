#pragma once
// A kind of solid as scenes, files and pictures see it. Its class in coupling/state/participant.h does the rest.
#include <string_view>

namespace seiche {

enum class Drive : char { none, prescribed, forces };  // the cause of a solid's motion

// One row of the table of kinds (coupling/solids/solid_kinds.h).
struct SolidKind {
  const char* name;  // in scenes
  Drive drive;
  bool has_elements = false;    // its shape is meshed with finite elements and deforms
  bool may_turn = true;         // false: forces only translate it
  bool follows_meshes = false;  // its surface is that of a sequence of meshes

  constexpr bool moves() const { return drive != Drive::none; }
  constexpr bool is_prescribed() const { return drive == Drive::prescribed; }
  constexpr bool deforms() const { return has_elements || follows_meshes; }
  constexpr bool is_free() const { return drive == Drive::forces; }  // it has mass and unknowns
  friend constexpr bool operator==(const SolidKind& a, const SolidKind& b) {
    return std::string_view(a.name) == b.name;
  }

  static const SolidKind fixed, kinematic, rigid, elastic;
};

inline constexpr SolidKind SolidKind::fixed{"static", Drive::none};
inline constexpr SolidKind SolidKind::kinematic{"kinematic", Drive::prescribed};
inline constexpr SolidKind SolidKind::rigid{"rigid", Drive::forces};
inline constexpr SolidKind SolidKind::elastic{"elastic", Drive::forces, true};

}  // namespace seiche
