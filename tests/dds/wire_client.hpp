#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

#include <graspd_msgs/graspdPubSubTypes.h>

#include "convert_request.hpp"
#include "participant.hpp"
#include "wire_types.hpp"

namespace graspd::test {

/// A client that keeps everything: sends a request without waiting and collects each reply on the
/// topic, whoever it is for, as it stands on the wire.
class WireClient final : public dds::fast::DataReaderListener,
                         public dds::fast::DataWriterListener {
public:
    using Reply = dds::wire::RankedGrasps_;

    explicit WireClient(const DdsSettings& settings) {
        auto joined = dds::Participant::join(settings);
        EXPECT_TRUE(joined.ok()) << joined.error().detail;
        participant_ = std::move(joined).value();
        participant_->create_reader(
            {"rt/graspd/ranked_grasps",
             dds::fast::TypeSupport(new dds::wire::RankedGrasps_PubSubType), dds::kReplyEnds},
            this);
        writer_ = participant_->create_writer(
            {"rt/graspd/grasp_request",
             dds::fast::TypeSupport(new dds::wire::GraspRequest_PubSubType), dds::kRequestEnds},
            this);
    }
    ~WireClient() override { participant_.reset(); }

    bool wait_matched(int planners = 1) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, kLimit, [this, planners] {
            return readers_ >= planners && writers_ >= planners;
        });
    }

    void send(const PlanRequest& request, const std::string& client_id = "wire") {
        auto sample = dds::write_request(request, client_id);
        ASSERT_TRUE(sample.ok()) << sample.error().detail;
        send(sample.value());
    }
    /// A full history gives way to a volatile writer with a timeout that means "try again".
    void send(dds::wire::GraspRequest_ sample) {
        using eprosima::fastrtps::types::ReturnCode_t;
        const auto deadline = std::chrono::steady_clock::now() + kLimit;
        ReturnCode_t code = ReturnCode_t::RETCODE_TIMEOUT;
        while (code == ReturnCode_t::RETCODE_TIMEOUT &&
               std::chrono::steady_clock::now() < deadline) {
            code = writer_->write(&sample, eprosima::fastrtps::rtps::c_InstanceHandle_Unknown);
        }
        ASSERT_EQ(code, ReturnCode_t::RETCODE_OK);
    }

    /// Waits until so many replies have come, and returns all.
    std::vector<Reply> wait_for(std::size_t count) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, kLimit, [&] { return replies_.size() >= count; });
        return replies_;
    }

    void on_data_available(dds::fast::DataReader* reader) override {
        Reply reply;
        dds::fast::SampleInfo info;
        using eprosima::fastrtps::types::ReturnCode_t;
        while (reader->take_next_sample(&reply, &info) == ReturnCode_t::RETCODE_OK) {
            const std::scoped_lock lock(mutex_);
            if (info.valid_data) replies_.push_back(reply);
            changed_.notify_all();
        }
    }
    void on_subscription_matched(dds::fast::DataReader*,
                                 const dds::fast::SubscriptionMatchedStatus& status) override {
        const std::scoped_lock lock(mutex_);
        writers_ = status.current_count;
        changed_.notify_all();
    }
    void on_publication_matched(dds::fast::DataWriter*,
                                const dds::fast::PublicationMatchedStatus& status) override {
        const std::scoped_lock lock(mutex_);
        readers_ = status.current_count;
        changed_.notify_all();
    }

private:
    static constexpr std::chrono::seconds kLimit{10};
    std::mutex mutex_;
    std::condition_variable changed_;
    int readers_ = 0;
    int writers_ = 0;
    std::vector<Reply> replies_;
    std::unique_ptr<dds::Participant> participant_;
    dds::fast::DataWriter* writer_ = nullptr;
};

}  // namespace graspd::test
