#include "shm_segments.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <string>
#include <string_view>

namespace graspd::server {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "fastrtps_";
constexpr std::string_view kLockSuffix = "_el";
constexpr std::size_t kIdDigits = 16;

/// A segment's name holds a number; a port's does not.
bool names_a_segment(const std::string& name) {
    if (name.size() != kPrefix.size() + kIdDigits + kLockSuffix.size()) return false;
    if (!name.starts_with(kPrefix) || !name.ends_with(kLockSuffix)) return false;
    return std::ranges::all_of(name.substr(kPrefix.size(), kIdDigits),
                               [](unsigned char c) { return std::isxdigit(c) != 0; });
}

/// Whether /proc/PID/fdinfo/N tells of an exclusive flock. Fast DDS opens the lock files of others
/// as well, to see whether they live.
bool holds_lock(const fs::path& fdinfo) {
    std::ifstream lines(fdinfo);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("lock:") && line.find("FLOCK") != std::string::npos &&
            line.find("WRITE") != std::string::npos) {
            return true;
        }
    }
    return false;
}

}  // namespace

std::vector<fs::path> owned_segments(pid_t pid, const fs::path& proc) {
    std::vector<fs::path> found;
    const fs::path process = proc / std::to_string(pid);
    std::error_code failed;
    fs::directory_iterator entry(process / "fd", failed);
    while (!failed && entry != fs::directory_iterator()) {
        std::error_code closed;  // meanwhile
        const fs::path file = fs::read_symlink(entry->path(), closed);
        if (!closed && names_a_segment(file.filename().string()) &&
            holds_lock(process / "fdinfo" / entry->path().filename())) {
            found.push_back(file);
        }
        entry.increment(failed);
    }
    return found;
}

bool remove_segment(const fs::path& lock_file) {
    const std::string name = lock_file.string();
    if (!names_a_segment(lock_file.filename().string())) return false;
    const int descriptor = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return false;
    bool removed = false;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
        const std::string segment = name.substr(0, name.size() - kLockSuffix.size());
        const bool segment_gone = ::unlink(segment.c_str()) == 0 || errno == ENOENT;
        removed = ::unlink(name.c_str()) == 0 && segment_gone;
    }
    ::close(descriptor);
    return removed;
}

}  // namespace graspd::server
