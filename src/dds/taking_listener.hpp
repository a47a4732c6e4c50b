#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <set>
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

    /// Told of the GUID of a writer that is matched no longer.
    using WriterGone = std::function<void(const eprosima::fastrtps::rtps::GUID_t&)>;

    /// Told of the GUID of a writer that has missed its lease, or asserts itself again.
    using WriterLives = std::function<void(const eprosima::fastrtps::rtps::GUID_t&, bool lives)>;

    explicit TakingListener(TakeOne take_one, WriterGone writer_gone = {},
                            WriterLives writer_lives = {})
        : take_one_(std::move(take_one)),
          writer_gone_(std::move(writer_gone)),
          writer_lives_(std::move(writer_lives)) {}

    void on_subscription_matched(
        eprosima::fastdds::dds::DataReader*,
        const eprosima::fastdds::dds::SubscriptionMatchedStatus& status) override {
        if (!enter()) return;
        try {
            eprosima::fastrtps::rtps::GUID_t guid;
            eprosima::fastrtps::rtps::iHandle2GUID(guid, status.last_publication_handle);
            const bool is_gone = status.current_count_change < 0;
            {
                const std::lock_guard lock(mutex_);
                if (is_gone) writers_.erase(guid);
                if (!is_gone) writers_.insert(guid);
            }
            if (is_gone && writer_gone_) writer_gone_(guid);
        } catch (...) {  // out of memory: its calls are answered to nobody
        }
        leave();
    }

    void on_liveliness_changed(
        eprosima::fastdds::dds::DataReader*,
        const eprosima::fastdds::dds::LivelinessChangedStatus& status) override {
        if (!writer_lives_ || status.alive_count_change == 0 || !enter()) return;
        try {
            eprosima::fastrtps::rtps::GUID_t guid;
            eprosima::fastrtps::rtps::iHandle2GUID(guid, status.last_publication_handle);
            writer_lives_(guid, status.alive_count_change > 0);
        } catch (...) {  // out of memory
        }
        leave();
    }

    void on_data_available(eprosima::fastdds::dds::DataReader* reader) override {
        if (!enter()) return;
        try {
            while (!stopped_ && take_one_(*reader)) {
            }
        } catch (...) {  // out of memory: what was not taken stays with the middleware
        }
        leave();
    }

    /// Whether the writer is matched still.
    bool knows(const eprosima::fastrtps::rtps::GUID_t& writer) {
        const std::lock_guard lock(mutex_);
        return writers_.contains(writer);
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
    std::set<eprosima::fastrtps::rtps::GUID_t> writers_;  ///< matched
    TakeOne take_one_;
    WriterGone writer_gone_;
    WriterLives writer_lives_;
};

}  // namespace graspd::dds
