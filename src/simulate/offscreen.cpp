#include "offscreen.hpp"

#include <array>
#include <stdexcept>

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace graspd::simulate_detail {
namespace {

constexpr std::array<EGLint, 13> kWanted = {EGL_SURFACE_TYPE,
                                            EGL_PBUFFER_BIT,
                                            EGL_RENDERABLE_TYPE,
                                            EGL_OPENGL_BIT,
                                            EGL_RED_SIZE,
                                            8,
                                            EGL_GREEN_SIZE,
                                            8,
                                            EGL_BLUE_SIZE,
                                            8,
                                            EGL_DEPTH_SIZE,
                                            24,
                                            EGL_NONE};

[[noreturn]] void refuse(const char* what) {
    throw std::runtime_error(std::string("no drawing without a display: ") + what +
                             " (Debian: libegl1 and libgl1-mesa-dri)");
}

}  // namespace

struct OffscreenContext::Handles {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    ~Handles() {
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        eglTerminate(display);
    }
};

OffscreenContext::OffscreenContext() : handles_(std::make_unique<Handles>()) {
    const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (get_display == nullptr) refuse("EGL has no platforms");
    const EGLDisplay display =
        get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
        refuse("EGL offers none");
    }
    handles_->display = display;
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
        eglChooseConfig(display, kWanted.data(), &config, 1, &count) == EGL_FALSE || count == 0) {
        refuse("EGL has no OpenGL");
    }
    handles_->context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
    if (handles_->context == EGL_NO_CONTEXT ||
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles_->context) == EGL_FALSE) {
        refuse("no OpenGL context can be made");
    }
}

OffscreenContext::~OffscreenContext() = default;

}  // namespace graspd::simulate_detail
