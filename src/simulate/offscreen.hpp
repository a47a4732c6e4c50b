#pragma once

#include <memory>

namespace graspd::simulate_detail {

/// A current OpenGL context without a surface or display (EGL), as long as it lives.
class OffscreenContext {
public:
    /// Throws std::runtime_error, saying what is missing.
    OffscreenContext();
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

private:
    struct Handles;
    std::unique_ptr<Handles> handles_;
};

}  // namespace graspd::simulate_detail
