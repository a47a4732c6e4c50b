#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <utility>

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>

namespace graspd::dds {

/// Takes each sample from the middleware as soon as it is there. The middleware may hold its own
/// lock while it calls, so none of ours is held while the middleware is called.
class TakingListener final : public eprosima::fastdds::dds::DataReaderListener {
public:
    /// Takes one sample and hands it on. @return false when there is none
    using TakeOne = std::function<bool(eprosima::fastdds::dds::DataReader&)>;

    explicit TakingListener(TakeOne take_one) : take_one_(std::move(take_one)) {}

    void on_data_available(eprosima::fastdds::dds::DataReader* reader) override {
        if (!enter()) return;
        try {
            while (!stopped_ && take_one_(*reader)) {
            }
        } catch (...) {  // out of memory: what was not taken stays with the middleware
        }
        leave();
    }

    /// Returns once no call is under way.
    void stop() {
        std::unique_lock lock(mutex_);
        stopped_ = true;
        left_.wait(lock, [this] { return calls_ == 0; });
    }

private:
    bool enter() {
        const std::lock_guard lock(mutex_);
        if (stopped_) return false;
        ++calls_;
        return true;
    }
    void leave() {
        const std::lock_guard lock(mutex_);
        --calls_;
        left_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable left_;
    std::atomic<bool> stopped_{false};
    int calls_ = 0;
    TakeOne take_one_;
};

}  // namespace graspd::dds
