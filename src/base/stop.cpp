#include "graspd/base/stop.hpp"

namespace graspd {
namespace {

thread_local const StopQuery* query_of_thread = nullptr;

}  // namespace

StopScope::StopScope(const StopQuery* query) : outer_(query_of_thread) {
    query_of_thread = query;
}

StopScope::~StopScope() {
    query_of_thread = outer_;
}

const StopQuery* StopScope::current() {
    return query_of_thread;
}

void stop_point() {
    if (query_of_thread != nullptr && (*query_of_thread)()) throw Stopped{};
}

}  // namespace graspd
