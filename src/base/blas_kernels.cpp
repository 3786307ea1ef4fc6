#include "base/blas_kernels.h"

#include <dlfcn.h>

#include <cstdlib>

namespace seiche {
namespace {

template <class Function>
Function find_function(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

bool has_avx2() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

}  // namespace

std::string blas_kernels() {
  static const auto core_name = find_function<const char* (*)()>("openblas_get_corename");
  return core_name ? core_name() : "";
}

// OpenBLAS reads the variable in the initialiser that chooses its kernels. Both functions are exported but
// undocumented, so they are looked up.
void choose_blas_kernels() {
  if (!has_avx2() || std::getenv("OPENBLAS_CORETYPE") != nullptr || blas_kernels() != "Prescott") return;
  const auto forget = find_function<void (*)()>("gotoblas_dynamic_quit");
  const auto choose = find_function<void (*)()>("gotoblas_dynamic_init");
  if (!forget || !choose) return;
  setenv("OPENBLAS_CORETYPE", "Haswell", 1);
  forget();
  choose();
}

}  // namespace seiche
