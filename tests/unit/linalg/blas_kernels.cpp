#include "base/blas_kernels.h"

#include <catch2/catch.hpp>
#include <cstdlib>

namespace blas_kernels_tests {
using namespace seiche;

// The test program has called choose_blas_kernels() at its start.
TEST_CASE("processors with AVX2 get no BLAS kernels of SSE3 unless the environment names them") {
  if (std::string(std::getenv("OPENBLAS_CORETYPE") ? std::getenv("OPENBLAS_CORETYPE") : "") == "Prescott") return;
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) CHECK(blas_kernels() != "Prescott");
#endif
}

}  // namespace blas_kernels_tests
