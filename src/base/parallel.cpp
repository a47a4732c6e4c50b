#include "graspd/base/parallel.hpp"

#include <algorithm>

#include "graspd/base/stop.hpp"

#if defined(__SANITIZE_THREAD__)
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>
#endif

namespace graspd {
namespace {

#if defined(__SANITIZE_THREAD__)
/// ThreadSanitizer does not see how Debian's TBB, which is built without it, hands work over and
/// waits for it. Threads of the standard library, which it understands, do the same.
void each_alone(std::size_t count, const std::function<void(std::size_t i)>& work) {
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::exception_ptr first;
    const auto run = [&] {
        for (std::size_t i = next++; i < count; i = next++) {
            try {
                work(i);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!first) first = std::current_exception();
            }
        }
    };
    {
        const std::jthread other(run);
        run();
    }
    if (first) std::rethrow_exception(first);
}
#else
/// Calls work(i) for every i below count, each as a task of its own.
void each_alone(std::size_t count, const std::function<void(std::size_t i)>& work) {
    // Isolated: else an exception beside this loop's caller would end the loop, as if it were done.
    tbb::task_group_context context(tbb::task_group_context::isolated);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) work(i);
        },
        tbb::simple_partitioner(), context);
}
#endif

/// each_alone(), stopped as this thread is.
void each_stoppable(std::size_t count, const std::function<void(std::size_t i)>& work) {
    const StopQuery* const query = StopScope::current();
    each_alone(count, [&](std::size_t i) {
        const StopScope scope(query);
        stop_point();
        work(i);
    });
}

}  // namespace

void for_blocks(std::size_t count, std::size_t block,
                const std::function<void(std::size_t first, std::size_t last)>& work) {
    const std::size_t blocks = (count + block - 1) / block;
    if (blocks <= 1) {
        stop_point();
        if (count > 0) work(0, count);
        return;
    }
    each_stoppable(blocks,
                   [&](std::size_t i) { work(i * block, std::min(count, (i + 1) * block)); });
}

void run_together(const std::vector<std::function<void()>>& work) {
    each_stoppable(work.size(), [&](std::size_t i) { work[i](); });
}

}  // namespace graspd
