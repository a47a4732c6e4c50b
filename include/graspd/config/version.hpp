#pragma once

namespace graspd {

/// The version of this build, such as "0.1.0"; that of CMake's project().
const char* version();

}  // namespace graspd
