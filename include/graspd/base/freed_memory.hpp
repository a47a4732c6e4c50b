#pragma once

#include <cstddef>

namespace graspd {

/// For programs that plan again and again: up to `bytes` of memory that a plan gives back stay with
/// the process instead of going to the system and being mapped anew, page by page, for the next
/// plan (docs/operations.md, Memory).
/// Does nothing where the C library is not glibc. Call it before threads start.
void keep_freed_memory(std::size_t bytes);

/// Gives what is kept to the system. Takes some milliseconds; any thread.
void give_back_freed_memory();

/// 64 MiB.
constexpr std::size_t kFreedMemory_bytes = std::size_t{64} << 20;

}  // namespace graspd
