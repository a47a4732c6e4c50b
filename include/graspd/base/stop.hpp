#pragma once

#include <cstddef>
#include <functional>
#include <utility>

namespace graspd {

/// Asked within long work: true when the caller no longer wants the rest (time budget spent,
/// cancelled). Once true it stays true. Several threads may ask at a time.
using StopQuery = std::function<bool()>;

/// What stop_point() throws. No std::exception, so that who turns a library's exceptions into
/// errors lets it pass.
struct Stopped {
    const char* where = nullptr;  ///< the stage that was under way; null where none is named
};

/// Lets stop_point() on this thread ask `query` as long as this object lives; for_blocks() and
/// run_together() take it along to the threads that they use. An empty query never stops.
class StopScope {
public:
    explicit StopScope(const StopQuery& query) : StopScope(query ? &query : nullptr) {}
    /// @param query  must outlive this; null: never stop
    explicit StopScope(const StopQuery* query);
    ~StopScope();
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;

    /// What this thread asks; null where nothing stops it.
    static const StopQuery* current();

private:
    const StopQuery* outer_;
};

/// A place where work may end: throws Stopped when the rest is not wanted. Costs one look at the
/// clock. Nothing else does it: a stage that is not stopped gives what it gave without.
void stop_point();

/// The same for a loop of cheap steps, of which every 1024th asks.
inline void stop_point(std::size_t step) {
    constexpr std::size_t kStepsAtATime = 1024;
    if (step % kStepsAtATime == 0) stop_point();
}

/// Does the work of a stage; where that is stopped, its name is left in the Stopped, unless a stage
/// within it left its own.
template <class Work>
auto as_stage(const char* name, Work&& work) {
    try {
        return std::forward<Work>(work)();
    } catch (Stopped& stopped) {
        if (stopped.where == nullptr) stopped.where = name;
        throw;
    }
}

}  // namespace graspd
