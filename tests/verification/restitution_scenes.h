#pragma once
// Restitution for the verification tests.
#include "rigid_scenes.h"

namespace seiche::test {

inline void set_restitution(Scene& s, double e, const std::vector<std::string>& between = {"*", "domain"}) {
  ContactSpec contact;
  contact.between = between;
  contact.restitution = e;
  s.contacts.push_back(contact);
}

}  // namespace seiche::test
