#pragma once

#include <cstdint>

namespace graspd::server {

/// Lets no allocation take the process's address space beyond `bytes` (RLIMIT_AS): it fails with
/// bad_alloc, which costs its request, where the kernel would end the process. 0: no limit. To be
/// called before threads start. @return false: the system refuses
bool fence_memory(std::uint64_t bytes);

}  // namespace graspd::server
