#include "supervised_daemon.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

#include "support/process_table.hpp"

namespace graspd::test {

SupervisedDaemon::SupervisedDaemon(std::uint32_t domain, std::vector<std::string> more)
    : Daemon(domain, [&] {
          more.emplace_back("--supervise");
          return more;
      }()) {}

pid_t SupervisedDaemon::participant() const {
    const std::string log = errors();
    const std::string mark = "event=child_started pid=";
    const auto at = log.rfind(mark);
    return at == std::string::npos ? 0 : std::stoi(log.substr(at + mark.size()));
}

std::size_t SupervisedDaemon::count(const std::string& text) const {
    const std::string log = errors();
    std::size_t found = 0;
    for (auto at = log.find(text); at != std::string::npos; at = log.find(text, at + 1)) ++found;
    return found;
}

bool SupervisedDaemon::wait_restarted(std::size_t crashes) const {
    for (int i = 0; i < 400; ++i) {
        if (count("event=child_died") >= crashes && count("event=ready") > crashes) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
}

std::vector<std::uint8_t> aborting_datagram() {
    constexpr std::size_t kHeader = 20;  // with a GUID prefix of zeros
    constexpr std::size_t kBody = 56;
    std::vector<std::uint8_t> bytes(kHeader + 4 + kBody + 4);
    const auto put = [&](std::size_t at, std::initializer_list<std::uint8_t> what) {
        std::ranges::copy(what, bytes.begin() + static_cast<std::ptrdiff_t>(at));
    };
    put(0, {'R', 'T', 'P', 'S', 2, 3, 1, 15});     // version 2.3, eProsima
    put(kHeader, {0x80, 0x01, kBody, 0});          // statistics, little endian, length
    put(kHeader + 4 + kBody, {0x01, 0x01, 0, 0});  // PAD
    return bytes;
}

void send_datagram(std::uint16_t port, const std::vector<std::uint8_t>& bytes) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int from = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    ASSERT_GE(from, 0);
    const auto sent = ::sendto(from, bytes.data(), bytes.size(), 0,
                               reinterpret_cast<const sockaddr*>(&to), sizeof to);
    ::close(from);
    ASSERT_EQ(sent, static_cast<ssize_t>(bytes.size()));
}

/// 7400 + 250 domain + 10 + 2 n (RTPS 2.3, 9.6.1), n the first that was free.
std::uint16_t discovery_port(pid_t participant, std::uint32_t domain) {
    const std::uint32_t base = 7400 + 250 * domain;
    const auto ports = udp_ports(participant);
    const auto port = std::ranges::find_if(
        ports, [&](std::uint16_t p) { return p >= base + 10 && p < base + 250 && p % 2 == 0; });
    return port == ports.end() ? std::uint16_t{0} : *port;
}

}  // namespace graspd::test
