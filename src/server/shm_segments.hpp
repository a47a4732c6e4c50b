#pragma once

#include <sys/types.h>

#include <filesystem>
#include <vector>

namespace graspd::server {

// Fast DDS's shared-memory transport gives each participant a segment /dev/shm/fastrtps_<16 digits>
// of the profile's size and a file of that name with "_el" behind it, which the participant keeps
// locked (flock) while it lives. A participant that is killed leaves both, and nobody takes them
// away: measured, 64 MB a crash. Its ports (fastrtps_portN) are used again by the next one.

/// The lock files of the segments that a living process owns: those that it holds locked.
/// @param proc  where procfs is mounted
/// @return nothing when the process has ended or may not be looked at
std::vector<std::filesystem::path> owned_segments(pid_t pid,
                                                  const std::filesystem::path& proc = "/proc");

/// Removes a segment and its lock file, unless a process holds the lock.
/// @return whether both are gone now
bool remove_segment(const std::filesystem::path& lock_file);

}  // namespace graspd::server
