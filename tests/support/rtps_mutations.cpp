#include "support/rtps_mutations.hpp"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

namespace graspd::test {
namespace {

constexpr std::size_t kHeader = 20;
constexpr std::size_t kSubmessageHeader = 4;
constexpr std::uint8_t kStatistics = 0x80;
constexpr std::size_t kIpHeader = 20;  // without options, which the loopback interface never has
constexpr std::size_t kUdpHeader = 8;
constexpr std::size_t kLargest = 65507;
constexpr int kPatience_ms = 50;

// PAD, ACKNACK, HEARTBEAT, GAP, INFO_TS, INFO_SRC, INFO_REPLY_IP4, INFO_DST, INFO_REPLY, NACK_FRAG,
// HEARTBEAT_FRAG, DATA, DATA_FRAG, security's, and what is none.
constexpr std::array<std::uint8_t, 19> kIds = {0x01, 0x06, 0x07, 0x08, 0x09, 0x0c, 0x0d,
                                               0x0e, 0x0f, 0x12, 0x13, 0x15, 0x16, 0x30,
                                               0x31, 0x33, 0x34, 0x7f, 0xff};
constexpr std::array<std::uint16_t, 8> kLengths = {0, 1, 3, 4, 0x7fff, 0x8000, 0xfffc, 0xffff};
constexpr std::array<std::uint32_t, 8> kWords = {0,          1,          0x7fffffff, 0x80000000,
                                                 0xffffffff, 0xfffffffe, 0x00010000, 0x01000000};

std::uint16_t read_big(std::span<const std::uint8_t> two) {
    return static_cast<std::uint16_t>(two[0] << 8 | two[1]);
}

}  // namespace

std::vector<std::size_t> submessage_offsets(std::span<const std::uint8_t> message) {
    std::vector<std::size_t> offsets;
    std::size_t at = kHeader;
    while (at + kSubmessageHeader <= message.size()) {
        const bool little = (message[at + 1] & 1) != 0;
        const std::size_t low = message[at + (little ? 2 : 3)];
        const std::size_t high = message[at + (little ? 3 : 2)];
        const std::size_t length = high << 8 | low;
        if (at + kSubmessageHeader + length > message.size()) break;
        offsets.push_back(at);
        if (length == 0) break;
        at += kSubmessageHeader + length;
    }
    return offsets;
}

Datagram without_statistics(std::span<const std::uint8_t> message) {
    auto offsets = submessage_offsets(message);
    if (offsets.empty()) return {message.begin(), message.end()};
    offsets.push_back(message.size());
    Datagram kept(message.begin(), message.begin() + kHeader);
    for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
        if (message[offsets[i]] == kStatistics) continue;
        const auto part = message.subspan(offsets[i], offsets[i + 1] - offsets[i]);
        kept.insert(kept.end(), part.begin(), part.end());
    }
    return kept;
}

RtpsMutator::RtpsMutator(std::vector<Datagram> seeds, std::uint64_t seed)
    : seeds_(std::move(seeds)), random_(seed) {}

/// Not std::uniform_int_distribution, which may differ between libraries.
std::size_t RtpsMutator::below(std::size_t count) {
    return count == 0 ? 0 : static_cast<std::size_t>(random_() % count);
}

const Datagram& RtpsMutator::any_seed() {
    return seeds_[below(seeds_.size())];
}

Datagram RtpsMutator::next() {
    Datagram message = any_seed();
    const std::size_t changes = 1 + below(3);
    for (std::size_t i = 0; i < changes; ++i) {
        switch (below(6)) {
            case 0: flip_bits(message); break;
            case 1: put_extreme_word(message); break;
            case 2: append_another(message); break;
            case 3: message.resize(kHeader + below(message.size() - kHeader + 1)); break;
            default: change_submessage(message); break;
        }
    }
    return message;
}

/// Anywhere but in the first four bytes, without which a message is none.
void RtpsMutator::flip_bits(Datagram& message) {
    const std::size_t flips = 1 + below(8);
    for (std::size_t i = 0; i < flips; ++i) {
        const auto bit = static_cast<std::uint8_t>(1u << below(8));
        message[4 + below(message.size() - 4)] ^= bit;
    }
}

/// Counts, sequence numbers and lengths stand at multiples of four.
void RtpsMutator::put_extreme_word(Datagram& message) {
    if (message.size() < kHeader + 4) return;
    const std::size_t at = kHeader + 4 * below((message.size() - kHeader) / 4);
    const std::uint32_t word = kWords[below(kWords.size())];
    for (std::size_t i = 0; i < 4; ++i) {
        message[at + i] = static_cast<std::uint8_t>(word >> (8 * i));
    }
}

void RtpsMutator::change_submessage(Datagram& message) {
    const auto offsets = submessage_offsets(message);
    if (offsets.empty()) return;
    const std::size_t at = offsets[below(offsets.size())];
    switch (below(3)) {
        case 0: message[at] = kIds[below(kIds.size())]; break;
        case 1: message[at + 1] = static_cast<std::uint8_t>(below(256)); break;
        default: {
            const std::uint16_t length = kLengths[below(kLengths.size())];
            message[at + 2] = static_cast<std::uint8_t>(length);
            message[at + 3] = static_cast<std::uint8_t>(length >> 8);
        }
    }
}

void RtpsMutator::append_another(Datagram& message) {
    const Datagram& other = any_seed();
    if (message.size() + other.size() > kLargest) return;
    message.insert(message.end(), other.begin() + kHeader, other.end());
}

std::unique_ptr<UdpRecorder> UdpRecorder::open(std::uint16_t first_port, std::uint16_t last_port) {
    const int raw = ::socket(AF_INET, SOCK_RAW | SOCK_CLOEXEC, IPPROTO_UDP);
    if (raw < 0) return nullptr;
    const int bytes = 4 << 20;
    ::setsockopt(raw, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
    return std::unique_ptr<UdpRecorder>(new UdpRecorder(raw, first_port, last_port));
}

UdpRecorder::UdpRecorder(int socket, std::uint16_t first_port, std::uint16_t last_port)
    : socket_(socket),
      thread_([=, this](const std::stop_token& stop) { record(stop, first_port, last_port); }) {}

UdpRecorder::~UdpRecorder() {
    thread_ = {};  // joins
    ::close(socket_);
}

void UdpRecorder::record(const std::stop_token& stop, std::uint16_t first_port,
                         std::uint16_t last_port) {
    Datagram packet(kIpHeader + kUdpHeader + kLargest);
    while (!stop.stop_requested()) {
        pollfd ready{socket_, POLLIN, 0};
        if (::poll(&ready, 1, kPatience_ms) <= 0) continue;
        const ssize_t size = ::recv(socket_, packet.data(), packet.size(), 0);
        if (size < static_cast<ssize_t>(kIpHeader + kUdpHeader + kHeader)) continue;
        const std::uint16_t port = read_big(std::span(packet).subspan(kIpHeader + 2, 2));
        if (port < first_port || port > last_port) continue;
        const std::scoped_lock lock(mutex_);
        datagrams_.emplace_back(packet.begin() + kIpHeader + kUdpHeader, packet.begin() + size);
    }
}

std::vector<Datagram> UdpRecorder::datagrams() const {
    const std::scoped_lock lock(mutex_);
    return datagrams_;
}

}  // namespace graspd::test
