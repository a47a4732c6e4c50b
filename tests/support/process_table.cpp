#include "support/process_table.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

namespace graspd::test {
namespace {

namespace fs = std::filesystem;

struct Stat {
    char state = 0;
    pid_t parent = 0;
};

/// What a folder of /proc holds; processes may end while it is read.
std::vector<fs::path> entries_of(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code failed;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end;
         at.increment(failed)) {
        entries.push_back(at->path());
    }
    return entries;
}

fs::path folder_of(pid_t pid) {
    return "/proc/" + std::to_string(pid);
}

/// The name in /proc/PID/stat may hold blanks and brackets: the last bracket ends it.
std::optional<Stat> read_stat(pid_t pid) {
    std::ifstream file(folder_of(pid) / "stat");
    std::string text;  // stays empty when the process ends meanwhile
    std::getline(file, text, '\0');
    const auto name_end = text.rfind(')');
    if (name_end == std::string::npos) return std::nullopt;
    Stat stat;
    std::istringstream(text.substr(name_end + 1)) >> stat.state >> stat.parent;
    return stat;
}

/// "socket:[INODE]" of every open descriptor.
std::set<std::string> socket_inodes(pid_t pid) {
    std::set<std::string> inodes;
    std::error_code failed;
    for (const fs::path& entry : entries_of(folder_of(pid) / "fd")) {
        const std::string target = fs::read_symlink(entry, failed).string();
        if (target.starts_with("socket:[")) inodes.insert(target.substr(8, target.size() - 9));
    }
    return inodes;
}

}  // namespace

std::optional<char> process_state(pid_t pid) {
    const auto stat = read_stat(pid);
    return stat ? std::optional<char>(stat->state) : std::nullopt;
}

std::vector<pid_t> children_of(pid_t pid) {
    std::vector<pid_t> children;
    for (const fs::path& entry : entries_of("/proc")) {
        const std::string name = entry.filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        const auto stat = read_stat(std::stoi(name));
        if (stat && stat->parent == pid) children.push_back(std::stoi(name));
    }
    return children;
}

bool wait_gone(pid_t pid) {
    for (int i = 0; i < 200; ++i) {
        if (process_state(pid).value_or('Z') == 'Z') return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
}

std::vector<std::uint16_t> udp_ports(pid_t pid) {
    const auto inodes = socket_inodes(pid);
    std::vector<std::uint16_t> ports;
    std::ifstream table(folder_of(pid) / "net/udp");
    std::string line;
    std::getline(table, line);  // headings
    while (std::getline(table, line)) {
        // sl local remote state queues timer retransmits uid timeout inode ...
        std::istringstream words(line);
        std::vector<std::string> word(10);
        for (std::string& text : word) words >> text;
        if (!inodes.contains(word[9])) continue;
        const auto port = std::stoul(word[1].substr(word[1].find(':') + 1), nullptr, 16);
        ports.push_back(static_cast<std::uint16_t>(port));
    }
    std::ranges::sort(ports);
    return ports;
}

std::uint64_t status_bytes(pid_t pid, const std::string& field) {
    std::ifstream file(folder_of(pid) / "status");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with(field + ":")) return std::stoull(line.substr(field.size() + 1)) * 1024;
    }
    return 0;
}

std::size_t open_descriptors(pid_t pid) {
    return entries_of(folder_of(pid) / "fd").size();
}

}  // namespace graspd::test
