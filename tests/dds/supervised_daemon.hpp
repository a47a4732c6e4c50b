#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon_harness.hpp"

namespace graspd::test {

/// graspd under its supervisor, ready for requests.
class SupervisedDaemon : public Daemon {
public:
    explicit SupervisedDaemon(std::uint32_t domain, std::vector<std::string> more = {});

    /// The participant's process now, after as many starts as there were.
    pid_t participant() const;

    /// Lines of the log that hold the text.
    std::size_t count(const std::string& text) const;

    /// Waits until the supervisor has counted so many crashes and the participant is ready again.
    bool wait_restarted(std::size_t crashes) const;
};

/// 84 bytes that make Fast DDS 2.9.1 as Debian builds it (with statistics and asserts) abort: an
/// RTPS header, a submessage of the vendor's statistics kind that is not the last one, and one
/// more.
std::vector<std::uint8_t> aborting_datagram();

/// Sends a datagram to a port of 127.0.0.1.
void send_datagram(std::uint16_t port, const std::vector<std::uint8_t>& bytes);

/// The port on which a participant takes discovery traffic by unicast.
std::uint16_t discovery_port(pid_t participant, std::uint32_t domain);

}  // namespace graspd::test
