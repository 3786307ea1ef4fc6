#include "base/version.h"

namespace seiche {

std::string version() {
  return SEICHE_VERSION;
}

}  // namespace seiche
