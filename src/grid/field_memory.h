#pragma once
// Memory of large arrays of numbers: pages of zeros that nobody has written to take no room.
#include <cstddef>

namespace seiche {

// Smaller arrays are better off with the memory of operator new.
bool is_large_field(std::size_t bytes);

// True of all large arrays that were taken here.
bool starts_page(const void* memory);

// Memory of a large array, all zero. Throws std::bad_alloc.
void* take_zeros(std::size_t bytes);

// Memory of a large array for a copy of `source`, or null for other values. Its contents are anything.
void* take_for_copy(const void* source, std::size_t bytes);

// Keeps the memory for arrays of the same size: fresh pages cost more than those that are used again
// (docs/decisions/0051-empty-space.md).
void give_back(void* memory, std::size_t bytes);

// Times that memory had to be asked of the system for a large array, since no array of its size was at hand.
std::size_t large_fields_mapped();

// Copies a large array, both at the start of a page. Empty pages stay empty.
void copy_large(const void* from, void* to, std::size_t bytes);

}  // namespace seiche
