#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "bounded_queue.hpp"
#include "graspd/base/result.hpp"
#include "object_store.hpp"
#include "planner_service.hpp"

namespace graspd::server {

/// Where and how much a recorder writes.
struct RecorderSettings {
    std::filesystem::path directory;
    std::uint32_t most_requests = 1000;
    std::uint64_t most_bytes = std::uint64_t{1} << 30;  ///< [bytes] of all files together
    std::string version;                                ///< of graspd, for the notes
    std::string config_hash;                            ///< likewise
};

/// What a recorder is made of besides.
struct RecorderParts {
    /// A geometry as the payload of a request; empty where it cannot be one.
    std::function<std::vector<std::uint8_t>(const ObjectGeometry&)> object_payload;
    /// Told of the first failure, the second, the fourth and so on. On the recorder's thread.
    std::function<void(const std::string& what, std::uint64_t failures)> failed;
};

/// Writes requests as they came and their replies to files, for `graspctl replay`:
///
///     request-000001.cdr   the payload as received (of a service call without the caller's header)
///     request-000001.json  who sent it, when, how; version and configuration of this process
///     object-000001.cdr    where the request names an object: that object, as a request
///     reply-000001.cdr     the answer's payload
///
/// Numbers follow the order of receipt and go on behind those that are in the directory already.
/// When there are too many or too large ones the oldest are removed, those of earlier processes
/// first. A thread of its own writes; whoever hands over a request never waits: what it cannot
/// keep up with is not recorded, and counted. Every member may be called from any thread.
class RequestRecorder {
public:
    /// Makes the directory. @return kUnreadableFile naming it when it cannot be used
    static Result<std::unique_ptr<RequestRecorder>> open(RecorderSettings settings,
                                                         RecorderParts parts);
    /// As close().
    ~RequestRecorder();
    RequestRecorder(const RequestRecorder&) = delete;
    RequestRecorder& operator=(const RequestRecorder&) = delete;

    /// To be called before the request is served. One without a payload is not recorded.
    void received(const IncomingRequest& request) noexcept;
    /// The answer to a request that was received; `payload` as it was written.
    void answered(const Answer& answer, std::vector<std::uint8_t> payload) noexcept;

    /// Writes what was handed over, as far as that takes 0.3 s, and ends. What is
    /// handed over later is not recorded. To be called from one thread.
    void close();

    std::uint64_t recorded() const { return recorded_; }  ///< requests that were written
    std::uint64_t failures() const { return failures_; }  ///< requests and replies that were not

private:
    using Bytes = std::vector<std::uint8_t>;
    /// What is to be written under one number.
    struct Job {
        std::uint64_t number = 0;
        std::shared_ptr<const ReceivedPayload> request;  ///< null: a reply
        std::string note;                                ///< beside the request
        Bytes reply;
        std::shared_ptr<const ObjectGeometry> object;  ///< that the request named
        std::uint64_t bytes = 0;
    };
    struct Record {
        std::uint64_t number = 0;
        std::uint64_t bytes = 0;
    };

    RequestRecorder(RecorderSettings settings, RecorderParts parts);
    void scan();
    void run();
    void write(const Job& job);
    bool write_file(const char* kind, std::uint64_t number, const char* ending,
                    std::span<const std::uint8_t> bytes);
    void remove_oldest();
    bool hand_over(Job job);
    void fail(const std::string& what);
    std::string note_of(const IncomingRequest& request, const ReceivedPayload& payload,
                        std::uint64_t number) const;

    const RecorderSettings settings_;
    const RecorderParts parts_;
    std::atomic<std::uint64_t> recorded_{0};
    std::atomic<std::uint64_t> failures_{0};
    std::atomic<std::uint64_t> queued_bytes_{0};
    std::mutex mutex_;  ///< guards the next two
    std::uint64_t next_ = 1;
    std::unordered_map<const IncomingRequest*, std::uint64_t> open_;  ///< recorded, not answered
    std::deque<Record> records_;  ///< oldest first; the thread's alone once it runs
    std::uint64_t bytes_ = 0;     ///< of records_
    BoundedQueue<Job> jobs_;
    std::jthread thread_;
};

}  // namespace graspd::server
