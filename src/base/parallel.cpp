#include "graspd/base/parallel.hpp"

#include <algorithm>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

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

}  // namespace

void for_blocks(std::size_t count, std::size_t block,
                const std::function<void(std::size_t first, std::size_t last)>& work) {
    const std::size_t blocks = (count + block - 1) / block;
    if (blocks <= 1) {
        if (count > 0) work(0, count);
        return;
    }
    Handover handover;
    handover.give();
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t i) {
        handover.take();
        work(i * block, std::min(count, (i + 1) * block));
        handover.finish();
    });
    handover.wait();
}

void run_both(const std::function<void()>& one, const std::function<void()>& other) {
    Handover handover;
    handover.give();
    const auto shared = [&](const std::function<void()>& work) {
        handover.take();
        work();
        handover.finish();
    };
    tbb::parallel_invoke([&] { shared(one); }, [&] { shared(other); });
    handover.wait();
}

}  // namespace graspd
