#include "grid/field_values.h"

#include "base/parallel_range.h"

namespace seiche {

void in_pieces(std::size_t count, std::size_t piece, const std::function<void(std::size_t, std::size_t)>& body) {
  parallel_pieces(count, piece, body);
}

}  // namespace seiche
