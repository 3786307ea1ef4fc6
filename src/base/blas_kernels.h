#pragma once
// Kernels of OpenBLAS, the dense algebra within sparse factors.
#include <string>

namespace seiche {

// Chooses OpenBLAS's kernels for Haswell (AVX2, FMA) where it fell back to those for Prescott (SSE3, 2004) although the
// processor can do more. Before version 0.3.25 it does so on Intel models that it does not know, such as Raptor Lake
// (OpenBLAS issue 4267). Does nothing if the environment sets OPENBLAS_CORETYPE. Call it before any BLAS.
void choose_blas_kernels();

// Name of the kernels in use; empty with another BLAS.
std::string blas_kernels();

}  // namespace seiche
