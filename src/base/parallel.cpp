#include "graspd/base/parallel.hpp"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace graspd {
namespace {

/// ThreadSanitizer does not see how Debian's TBB, which is built without it, hands work over and
/// waits for it: this tells. What the pieces of work do to each other it still watches.
class Handover {
public:
    void give() { release(&given_); }
    void take() { acquire(&given_); }
    void finish() { release(&finished_); }
    void wait() { acquire(&finished_); }

private:
#if defined(__SANITIZE_THREAD__)
    static void release(char* at) {
        __tsan_release(at);
    }
    static void acquire(char* at) {
        __tsan_acquire(at);
    }
#else
    static void release(char*) {}
    static void acquire(char*) {}
#endif
    char given_ = 0, finished_ = 0;
};

/// Calls work(i) for every i below count, each as a task of its own.
void each_alone(std::size_t count, const std::function<void(std::size_t i)>& work) {
    Handover handover;
    handover.give();
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
            handover.take();
            for (std::size_t i = range.begin(); i != range.end(); ++i) work(i);
            handover.finish();
        },
        tbb::simple_partitioner());
    handover.wait();
}

}  // namespace

void for_blocks(std::size_t count, std::size_t block,
                const std::function<void(std::size_t first, std::size_t last)>& work) {
    const std::size_t blocks = (count + block - 1) / block;
    if (blocks <= 1) {
        if (count > 0) work(0, count);
        return;
    }
    each_alone(blocks, [&](std::size_t i) { work(i * block, std::min(count, (i + 1) * block)); });
}

void run_together(const std::vector<std::function<void()>>& work) {
    each_alone(work.size(), [&](std::size_t i) { work[i](); });
}

}  // namespace graspd
