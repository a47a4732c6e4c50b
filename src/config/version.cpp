#include "graspd/config/version.hpp"

namespace graspd {

const char* version() {
    return GRASPD_VERSION;
}

}  // namespace graspd
