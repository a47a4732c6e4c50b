#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace graspd::test {

// What /proc tells of processes.

/// The state letter of /proc/PID/stat, 'Z' for one that ended and waits to be reaped; nothing when
/// there is no such process.
std::optional<char> process_state(pid_t pid);

/// Processes whose parent is this one, the ended ones too.
std::vector<pid_t> children_of(pid_t pid);

/// Whether the process ends within ten seconds.
bool wait_gone(pid_t pid);

/// Local ports of the UDP sockets that a process has open, in order.
std::vector<std::uint16_t> udp_ports(pid_t pid);

/// [byte] a field of /proc/PID/status such as "RssAnon"; 0 when it is not there.
std::uint64_t status_bytes(pid_t pid, const std::string& field);

/// How many file descriptors a process has open.
std::size_t open_descriptors(pid_t pid);

}  // namespace graspd::test
