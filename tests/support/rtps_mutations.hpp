#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <random>
#include <span>
#include <thread>
#include <vector>

namespace graspd::test {

using Datagram = std::vector<std::uint8_t>;

/// Where the submessages of an RTPS message begin: after its header of 20 bytes, each with an id,
/// flags (bit 0: little endian), and the length of what follows in two bytes; a length of 0 is
/// "up to the end" (RTPS 2.3, 8.3.3). Stops at what does not fit.
std::vector<std::size_t> submessage_offsets(std::span<const std::uint8_t> message);

/// The message without the vendor's statistics submessages (id 0x80). Debian's Fast DDS puts one at
/// the end of each message, and aborts wherever one of them is not the last.
Datagram without_statistics(std::span<const std::uint8_t> message);

/// Makes wrong RTPS messages out of right ones. The same seeds and the same number give the same
/// messages.
class RtpsMutator {
public:
    /// @param seeds  at least one, each with an RTPS header
    RtpsMutator(std::vector<Datagram> seeds, std::uint64_t seed);

    /// The next wrong one: one to three changes of a message, each a flip of bits, a word of an
    /// extreme value, a cut, another submessage id, another length, other flags, or the
    /// submessages of a second message behind its own.
    Datagram next();

private:
    std::size_t below(std::size_t count);
    const Datagram& any_seed();
    void flip_bits(Datagram& message);
    void put_extreme_word(Datagram& message);
    void change_submessage(Datagram& message);
    void append_another(Datagram& message);

    std::vector<Datagram> seeds_;
    std::mt19937_64 random_;
};

/// Listens to every UDP datagram of this network namespace that is addressed to a range of ports.
/// Needs the right to open raw sockets, as root or in a namespace of one's own.
class UdpRecorder {
public:
    /// @return null without that right
    static std::unique_ptr<UdpRecorder> open(std::uint16_t first_port, std::uint16_t last_port);
    ~UdpRecorder();
    UdpRecorder(const UdpRecorder&) = delete;
    UdpRecorder& operator=(const UdpRecorder&) = delete;

    /// What has come so far, without what came before.
    std::vector<Datagram> datagrams() const;

private:
    UdpRecorder(int socket, std::uint16_t first_port, std::uint16_t last_port);
    void record(const std::stop_token& stop, std::uint16_t first_port, std::uint16_t last_port);

    int socket_;
    mutable std::mutex mutex_;
    std::vector<Datagram> datagrams_;
    std::jthread thread_;
};

}  // namespace graspd::test
