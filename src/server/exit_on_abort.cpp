#include "exit_on_abort.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace graspd::server {
namespace {

volatile std::sig_atomic_t exit_code = 0;

void leave(int /*signal*/) {
    constexpr std::string_view kLine =
        "event=aborted what=\"the middleware, while it left the domain; all was answered\"\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, kLine.data(), kLine.size());
    _exit(exit_code);
}

}  // namespace

void exit_on_abort(int code) {
    exit_code = code;
    std::signal(SIGABRT, leave);
}

}  // namespace graspd::server
