// One program a target: GRASPD_FUZZ_TARGET is its function's name.
#include "targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    graspd::fuzz::GRASPD_FUZZ_TARGET({data, size});
    return 0;
}
