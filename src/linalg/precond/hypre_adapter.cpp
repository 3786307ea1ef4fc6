#include "linalg/precond/hypre_adapter.h"

#include <HYPRE.h>
#include <HYPRE_parcsr_ls.h>
#include <HYPRE_struct_ls.h>
#include <_hypre_parcsr_mv.h>

#include <algorithm>
#include <numeric>

namespace seiche {
namespace {

// Starts hypre at its first use; it runs until the program ends.
void start_hypre() {
  static const int started = HYPRE_Init();
  (void)started;
  HYPRE_ClearAllErrors();
}

// Communicator of the ranks that have rows or cells. Null on the others, so that hypre never sees empty parts.
class ActiveRanks {
 public:
  ActiveRanks(const Communicator& ranks, int size) {
    MPI_Comm_split(ranks.handle(), size > 0 ? 0 : MPI_UNDEFINED, ranks.rank(), &handle_);
  }
  ~ActiveRanks() {
    if (handle_ != MPI_COMM_NULL) MPI_Comm_free(&handle_);
  }
  ActiveRanks(const ActiveRanks&) = delete;
  ActiveRanks& operator=(const ActiveRanks&) = delete;
  operator MPI_Comm() const { return handle_; }
  bool include_me() const { return handle_ != MPI_COMM_NULL; }

 private:
  MPI_Comm handle_ = MPI_COMM_NULL;
};

// Owns a hypre handle.
template <class T, HYPRE_Int (*Destroy)(T)>
class Handle {
 public:
  Handle() = default;
  ~Handle() {
    if (value_) Destroy(value_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  T* address() { return &value_; }
  operator T() const { return value_; }

 private:
  T value_ = nullptr;
};

using IjMatrix = Handle<HYPRE_IJMatrix, HYPRE_IJMatrixDestroy>;
using IjVector = Handle<HYPRE_IJVector, HYPRE_IJVectorDestroy>;
using AmgSolver = Handle<HYPRE_Solver, HYPRE_BoomerAMGDestroy>;
using StructGrid = Handle<HYPRE_StructGrid, HYPRE_StructGridDestroy>;
using StructStencil = Handle<HYPRE_StructStencil, HYPRE_StructStencilDestroy>;
using StructMatrix = Handle<HYPRE_StructMatrix, HYPRE_StructMatrixDestroy>;
using StructVector = Handle<HYPRE_StructVector, HYPRE_StructVectorDestroy>;
using PfmgSolver = Handle<HYPRE_StructSolver, HYPRE_StructPFMGDestroy>;

// A hypre vector whose entries can be written in place.
class RowVector {
 public:
  void create(MPI_Comm comm, HYPRE_BigInt first, HYPRE_BigInt last) {
    HYPRE_IJVectorCreate(comm, first, last, ij_.address());
    HYPRE_IJVectorSetObjectType(ij_, HYPRE_PARCSR);
    HYPRE_IJVectorInitialize(ij_);
    HYPRE_IJVectorAssemble(ij_);
    HYPRE_IJVectorGetObject(ij_, reinterpret_cast<void**>(&object_));
  }
  HYPRE_ParVector object() const { return object_; }
  double* entries() const { return hypre_VectorData(hypre_ParVectorLocalVector(object_)); }

 private:
  IjVector ij_;
  HYPRE_ParVector object_ = nullptr;
};

class BoomerAmg : public Preconditioner {
 public:
  BoomerAmg(const LinearSystem& system, const AmgSettings& settings) : comm_(system.ranks(), system.rows()) {
    start_hypre();
    if (!comm_.include_me()) return;
    assemble(system);
    configure(settings);
    HYPRE_BoomerAMGSetup(solver_, matrix_object_, b_.object(), x_.object());
    HYPRE_ClearAllErrors();
  }

  void apply(const Vector& r, Vector& z) override {
    if (!comm_.include_me()) return;
    HYPRE_ClearAllErrors();
    std::copy(r.begin(), r.end(), b_.entries());
    HYPRE_ParVectorSetConstantValues(x_.object(), 0.0);
    HYPRE_BoomerAMGSolve(solver_, matrix_object_, b_.object(), x_.object());
    std::copy_n(x_.entries(), z.size(), z.begin());
    HYPRE_ClearAllErrors();
  }

 private:
  void assemble(const LinearSystem& system) {
    const DistributedMatrix& A = system.pattern();
    const auto first = HYPRE_BigInt(A.first_row), last = first + A.rows() - 1;
    HYPRE_IJMatrixCreate(comm_, first, last, first, last, matrix_.address());
    HYPRE_IJMatrixSetObjectType(matrix_, HYPRE_PARCSR);
    std::vector<HYPRE_Int> own(A.rows(), 0), foreign(A.rows(), 0), entries(A.rows());
    for (int i = 0; i < A.rows(); ++i) {
      entries[i] = A.row_start[i + 1] - A.row_start[i];
      for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k) {
        ++(A.column[k] >= first && A.column[k] <= last ? own : foreign)[i];
      }
    }
    HYPRE_IJMatrixSetDiagOffdSizes(matrix_, own.data(), foreign.data());
    HYPRE_IJMatrixInitialize(matrix_);
    std::vector<HYPRE_BigInt> rows(A.rows()), columns(A.column.begin(), A.column.end());
    std::iota(rows.begin(), rows.end(), first);
    HYPRE_IJMatrixAddToValues(matrix_, A.rows(), entries.data(), rows.data(), columns.data(), system.values().data());
    HYPRE_IJMatrixAssemble(matrix_);
    HYPRE_IJMatrixGetObject(matrix_, reinterpret_cast<void**>(&matrix_object_));
    b_.create(comm_, first, last);
    x_.create(comm_, first, last);
  }

  void configure(const AmgSettings& s) {
    HYPRE_BoomerAMGCreate(solver_.address());
    HYPRE_BoomerAMGSetCoarsenType(solver_, s.coarsening);
    HYPRE_BoomerAMGSetInterpType(solver_, s.interpolation);
    HYPRE_BoomerAMGSetPMaxElmts(solver_, s.elements_per_row);
    HYPRE_BoomerAMGSetStrongThreshold(solver_, s.strength);
    HYPRE_BoomerAMGSetAggNumLevels(solver_, s.aggressive_levels);
    HYPRE_BoomerAMGSetNumSweeps(solver_, s.sweeps);
    if (s.components > 1) set_components(s);
    HYPRE_BoomerAMGSetCycleRelaxType(solver_, s.relax_down, 1);
    HYPRE_BoomerAMGSetCycleRelaxType(solver_, s.relax_up, 2);
    HYPRE_BoomerAMGSetCycleRelaxType(solver_, s.relax_coarsest, 3);
    HYPRE_BoomerAMGSetMaxIter(solver_, 1);
    HYPRE_BoomerAMGSetTol(solver_, 0.0);
    HYPRE_BoomerAMGSetPrintLevel(solver_, 0);
  }

  // hypre takes ownership of the list.
  void set_components(const AmgSettings& s) {
    auto* list = hypre_TAlloc(HYPRE_Int, s.component.size(), HYPRE_MEMORY_HOST);
    std::copy(s.component.begin(), s.component.end(), list);
    HYPRE_BoomerAMGSetNumFunctions(solver_, s.components);
    HYPRE_BoomerAMGSetDofFunc(solver_, list);
  }

  ActiveRanks comm_;
  IjMatrix matrix_;
  HYPRE_ParCSRMatrix matrix_object_ = nullptr;
  RowVector b_, x_;
  AmgSolver solver_;
};

class Pfmg : public Preconditioner {
 public:
  Pfmg(const LinearSystem& system, GridStencil stencil, const PfmgSettings& settings)
      : row_of_cell_(std::move(stencil.row_of_cell)),
        comm_(system.ranks(), int(row_of_cell_.size())),
        cells_(row_of_cell_.size()) {
    start_hypre();
    if (!comm_.include_me()) return;
    lower_ = stencil.box.lower;
    for (int a = 0; a < 3; ++a) upper_[a] = stencil.box.upper[a] - 1;  // hypre includes the last cell
    make_grid(stencil);
    make_matrix(stencil);
    configure(settings);
    HYPRE_StructPFMGSetup(solver_, matrix_, b_, x_);
    HYPRE_ClearAllErrors();
  }

  void apply(const Vector& r, Vector& z) override {
    if (!comm_.include_me()) return;
    HYPRE_ClearAllErrors();
    for (std::size_t c = 0; c < cells_.size(); ++c) cells_[c] = row_of_cell_[c] < 0 ? 0 : r[row_of_cell_[c]];
    HYPRE_StructVectorSetBoxValues(b_, lower_.data(), upper_.data(), cells_.data());
    HYPRE_StructVectorSetConstantValues(x_, 0.0);
    HYPRE_StructPFMGSolve(solver_, matrix_, b_, x_);
    HYPRE_StructVectorGetBoxValues(x_, lower_.data(), upper_.data(), cells_.data());
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (row_of_cell_[c] >= 0) z[row_of_cell_[c]] = cells_[c];
    }
    HYPRE_ClearAllErrors();
  }

 private:
  void make_grid(GridStencil& s) {
    HYPRE_StructGridCreate(comm_, s.dimension, grid_.address());
    HYPRE_StructGridSetExtents(grid_, lower_.data(), upper_.data());
    HYPRE_StructGridSetPeriodic(grid_, s.periodic.data());
    HYPRE_StructGridAssemble(grid_);
    HYPRE_StructStencilCreate(s.dimension, s.entries(), stencil_.address());
    for (int entry = 0; entry < s.entries(); ++entry) {
      std::array<HYPRE_Int, 3> offset{0, 0, 0};
      if (entry > 0) offset[entry - 1] = 1;
      HYPRE_StructStencilSetElement(stencil_, entry, offset.data());
    }
  }

  void make_matrix(GridStencil& s) {
    HYPRE_StructMatrixCreate(comm_, grid_, stencil_, matrix_.address());
    HYPRE_StructMatrixSetSymmetric(matrix_, 1);
    HYPRE_StructMatrixInitialize(matrix_);
    std::vector<HYPRE_Int> entries(s.entries());
    std::iota(entries.begin(), entries.end(), 0);
    HYPRE_StructMatrixSetBoxValues(matrix_, lower_.data(), upper_.data(), s.entries(), entries.data(),
                                   s.coefficients.data());
    HYPRE_StructMatrixAssemble(matrix_);
    for (StructVector* vector : {&b_, &x_}) {
      HYPRE_StructVectorCreate(comm_, grid_, vector->address());
      HYPRE_StructVectorInitialize(*vector);
      HYPRE_StructVectorAssemble(*vector);
    }
  }

  void configure(const PfmgSettings& s) {
    HYPRE_StructPFMGCreate(comm_, solver_.address());
    HYPRE_StructPFMGSetMaxIter(solver_, 1);
    HYPRE_StructPFMGSetTol(solver_, 0.0);
    HYPRE_StructPFMGSetZeroGuess(solver_);
    HYPRE_StructPFMGSetRelaxType(solver_, s.relax);
    HYPRE_StructPFMGSetRAPType(solver_, s.coarse_operator);
    HYPRE_StructPFMGSetSkipRelax(solver_, s.skip_relax);
    HYPRE_StructPFMGSetNumPreRelax(solver_, s.sweeps);
    HYPRE_StructPFMGSetNumPostRelax(solver_, s.sweeps);
  }

  std::vector<int> row_of_cell_;
  ActiveRanks comm_;
  std::vector<double> cells_;
  std::array<HYPRE_Int, 3> lower_{}, upper_{};
  StructGrid grid_;
  StructStencil stencil_;
  StructMatrix matrix_;
  StructVector b_, x_;
  PfmgSolver solver_;
};

}  // namespace

PreconditionerOrFailure make_boomeramg(const LinearSystem& system, const AmgSettings& settings) {
  return {std::make_unique<BoomerAmg>(system, settings), {}};
}

PreconditionerOrFailure make_pfmg(const LinearSystem& system, const PfmgSettings& settings) {
  StencilOrFailure made = make_grid_stencil(system, settings.diagonal_shift);
  if (!made.failure.empty()) return {nullptr, made.failure};
  return {std::make_unique<Pfmg>(system, std::move(made.stencil), settings), {}};
}

}  // namespace seiche
