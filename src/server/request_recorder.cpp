#include "request_recorder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <chrono>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "graspd/base/fnv1a.hpp"

namespace graspd::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostQueued = 256;
constexpr std::uint64_t kMostQueued_bytes = 128u << 20;
constexpr std::chrono::milliseconds kMostClosing{300};  // of the two seconds to stop in
constexpr std::size_t kDigits = 6;                      // more where they are needed
constexpr std::array kNames = {std::pair("request-", ".cdr"), std::pair("request-", ".json"),
                               std::pair("object-", ".cdr"), std::pair("reply-", ".cdr")};

fs::path file_of(const fs::path& directory, const char* kind, std::uint64_t number,
                 const char* ending) {
    std::string digits = std::to_string(number);
    if (digits.size() < kDigits) digits.insert(0, kDigits - digits.size(), '0');
    return directory / (kind + digits + ending);
}

/// The number in a name such as request-000001.cdr; 0 for every other name.
std::uint64_t number_of(const std::string& name) {
    for (const auto& [kind, ending] : kNames) {
        if (!name.starts_with(kind) || !name.ends_with(ending)) continue;
        const char* first = name.data() + std::char_traits<char>::length(kind);
        const char* last = name.data() + name.size() - std::char_traits<char>::length(ending);
        std::uint64_t number = 0;
        const auto read = std::from_chars(first, last, number);
        if (read.ec == std::errc() && read.ptr == last) return number;
    }
    return 0;
}

std::string hex(std::span<const std::uint8_t> bytes) {
    std::string text;
    for (const std::uint8_t byte : bytes) text += to_hex(byte).substr(14);
    return text;
}

}  // namespace

Result<std::unique_ptr<RequestRecorder>> RequestRecorder::open(RecorderSettings settings,
                                                               RecorderParts parts) {
    std::error_code error;
    fs::create_directories(settings.directory, error);
    if (!fs::is_directory(settings.directory, error)) {
        return PlanError{PlanErrorCode::kUnreadableFile,
                         "server.record_dir = " + settings.directory.string() +
                             " cannot be made: " + error.message()};
    }
    std::unique_ptr<RequestRecorder> recorder(
        new RequestRecorder(std::move(settings), std::move(parts)));
    recorder->scan();
    recorder->thread_ = std::jthread([raw = recorder.get()] { raw->run(); });
    return recorder;
}

RequestRecorder::RequestRecorder(RecorderSettings settings, RecorderParts parts)
    : settings_(std::move(settings)), parts_(std::move(parts)), jobs_(kMostQueued) {}

RequestRecorder::~RequestRecorder() {
    close();
}

void RequestRecorder::close() {
    if (!thread_.joinable()) return;
    jobs_.close();
    const auto deadline = std::chrono::steady_clock::now() + kMostClosing;
    while (jobs_.size() > 0 && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    failures_ += jobs_.close_and_take().size();
    thread_.join();
}

/// Learns what earlier processes left.
void RequestRecorder::scan() {
    std::map<std::uint64_t, std::uint64_t> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(settings_.directory, error)) {
        const std::uint64_t number = number_of(entry.path().filename().string());
        if (number == 0 || !entry.is_regular_file(error)) continue;
        found[number] += entry.file_size(error);
    }
    for (const auto& [number, bytes] : found) {
        records_.push_back({number, bytes});
        bytes_ += bytes;
        next_ = number + 1;
    }
}

void RequestRecorder::received(const IncomingRequest& request) noexcept {
    try {
        const auto payload = request.payload();
        if (payload == nullptr) return;
        Job job;
        {
            const std::scoped_lock lock(mutex_);
            job.number = next_++;
            open_.emplace(&request, job.number);
        }
        job.note = note_of(request, *payload, job.number);
        job.request = payload;
        job.bytes = payload->bytes.size() + job.note.size();
        if (hand_over(std::move(job))) return;
        const std::scoped_lock lock(mutex_);
        open_.erase(&request);
    } catch (...) {  // no memory: the request itself comes first
        ++failures_;
    }
}

void RequestRecorder::answered(const Answer& answer, std::vector<std::uint8_t> payload) noexcept {
    try {
        Job job;
        {
            const std::scoped_lock lock(mutex_);
            const auto at = open_.find(answer.out.to.get());
            if (at == open_.end()) return;
            job.number = at->second;
            open_.erase(at);
        }
        job.reply = std::move(payload);
        job.object = answer.work.named_object;
        job.bytes = job.reply.size() + (job.object ? geometry_bytes(*job.object) : 0);
        hand_over(std::move(job));
    } catch (...) {
        ++failures_;
    }
}

bool RequestRecorder::hand_over(Job job) {
    const std::uint64_t bytes = job.bytes;
    const std::uint64_t queued = queued_bytes_.fetch_add(bytes) + bytes;
    if (queued <= kMostQueued_bytes && jobs_.try_push(job)) return true;
    queued_bytes_ -= bytes;
    ++failures_;  // said by the thread with the next one that fails there, and at the end
    return false;
}

void RequestRecorder::run() {
    while (const auto job = jobs_.pop()) {
        try {
            write(*job);
        } catch (const std::exception& error) {
            fail(error.what());
        }
        queued_bytes_ -= job->bytes;
    }
}

void RequestRecorder::write(const Job& job) {
    const bool is_request = job.request != nullptr;
    if (is_request) records_.push_back({job.number, 0});
    // A record whose request is gone already has no use for a reply.
    if (records_.empty() || !std::ranges::count(records_, job.number, &Record::number)) return;
    bool good = true;
    if (is_request) {
        const auto note = std::as_bytes(std::span(job.note));
        good = write_file("request-", job.number, ".cdr", job.request->bytes) &&
               write_file("request-", job.number, ".json",
                          {reinterpret_cast<const std::uint8_t*>(note.data()), note.size()});
        if (good) ++recorded_;
    } else {
        if (job.object) {
            good = write_file("object-", job.number, ".cdr", parts_.object_payload(*job.object));
        }
        good = write_file("reply-", job.number, ".cdr", job.reply) && good;
    }
    if (!good)
        fail("number " + std::to_string(job.number) + " could not be written to " +
             settings_.directory.string());
    remove_oldest();
}

/// Under a name of its own first, so that nobody reads half a file.
bool RequestRecorder::write_file(const char* kind, std::uint64_t number, const char* ending,
                                 std::span<const std::uint8_t> bytes) {
    const fs::path file = file_of(settings_.directory, kind, number, ending);
    const fs::path part = settings_.directory / ".part";
    {
        std::ofstream stream(part, std::ios::binary);
        stream.write(reinterpret_cast<const char*>(bytes.data()),
                     static_cast<std::streamsize>(bytes.size()));
        if (!stream.flush()) return false;
    }
    std::error_code error;
    fs::rename(part, file, error);
    if (error) return false;
    const auto record = std::ranges::find(records_, number, &Record::number);
    record->bytes += bytes.size();
    bytes_ += bytes.size();
    return true;
}

void RequestRecorder::remove_oldest() {
    while (!records_.empty() &&
           (records_.size() > settings_.most_requests || bytes_ > settings_.most_bytes)) {
        const Record oldest = records_.front();
        records_.pop_front();
        bytes_ -= oldest.bytes;
        std::error_code error;
        for (const auto& [kind, ending] : kNames) {
            fs::remove(file_of(settings_.directory, kind, oldest.number, ending), error);
        }
    }
}

void RequestRecorder::fail(const std::string& what) {
    const std::uint64_t failures = ++failures_;
    if (parts_.failed && std::has_single_bit(failures)) parts_.failed(what, failures);
}

std::string RequestRecorder::note_of(const IncomingRequest& request, const ReceivedPayload& payload,
                                     std::uint64_t number) const {
    const RequestIdentity& identity = request.identity();
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    const nlohmann::json note = {
        {"schema", "graspd-record/1"},
        {"number", number},
        {"received_unix_ms", std::chrono::duration_cast<std::chrono::milliseconds>(since).count()},
        {"came_by", payload.by_service ? "service" : "topic"},
        {"writer", hex(identity.writer)},
        {"client_id", identity.client_id},
        {"request_id", identity.request_id},
        {"object_key", request.object_key()},
        {"bytes", payload.bytes.size()},
        {"version", settings_.version},
        {"config_hash", settings_.config_hash},
    };
    return note.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace graspd::server
