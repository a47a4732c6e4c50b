#include "graspd/config/network_profile.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "refused.hpp"
#include "split_text.hpp"

namespace graspd {
namespace {

using config_detail::split_text;

constexpr const char* kRange = "ROS_AUTOMATIC_DISCOVERY_RANGE";
constexpr const char* kLocalhostOnly = "ROS_LOCALHOST_ONLY";
constexpr const char* kStaticPeers = "ROS_STATIC_PEERS";
constexpr std::size_t kLongestHost = 253;  // RFC 1035, section 2.3.4, without the root's two bytes
constexpr std::size_t kLongestLabel = 63;

/// How far the participant is to reach.
enum class Reach { kProfile, kLoopback, kLoopbackWithoutPeers, kSubnet };

struct Decision {
    Reach reach = Reach::kLoopback;
    std::string why;
};

std::optional<std::string> variable(const char* name) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
    if (value == nullptr || *value == '\0') return std::nullopt;
    return value;
}

bool is_byte(const std::string& text) {
    unsigned value = 0;
    const char* end = text.data() + text.size();
    const auto got = std::from_chars(text.data(), end, value);
    const bool padded = text.size() > 1 && text.front() == '0';  // some resolvers read it as octal
    return got.ec == std::errc{} && got.ptr == end && value <= 255 && !padded;
}

/// A label of a host's name. '_' is not for the Internet, but container networks use it.
bool is_label(const std::string& text) {
    const auto allowed = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '-' || c == '_';
    };
    return !text.empty() && text.size() <= kLongestLabel && text.front() != '-' &&
           text.back() != '-' && std::ranges::all_of(text, allowed);
}

bool is_host(const std::string& text) {
    const auto parts = split_text(text, '.');
    if (text.find_first_not_of("0123456789.") == std::string::npos) {
        return parts.size() == 4 && std::ranges::all_of(parts, is_byte);
    }
    return text.size() <= kLongestHost && std::ranges::all_of(parts, is_label);
}

Result<Decision> decide(const std::string& profile_option, const NetworkEnvironment& environment) {
    if (!profile_option.empty()) return Decision{Reach::kProfile, "--profile"};
    if (environment.localhost_only == "1") {
        return Decision{Reach::kLoopbackWithoutPeers, std::string(kLocalhostOnly) + " = 1"};
    }
    if (const auto& range = environment.discovery_range) {
        std::string why = std::string(kRange) + " = " + *range;
        if (environment.localhost_only) {
            why += ", before " + std::string(kLocalhostOnly) + " = " + *environment.localhost_only;
        }
        if (*range == "SUBNET") return Decision{Reach::kSubnet, why};
        if (*range == "LOCALHOST") return Decision{Reach::kLoopback, why};
        if (*range == "SYSTEM_DEFAULT") return Decision{Reach::kLoopbackWithoutPeers, why};
        if (*range == "OFF") {
            return refused(kRange, *range,
                           "lets nobody find graspd; set LOCALHOST or SUBNET, or give --profile");
        }
        return refused(kRange, *range, "must be SUBNET, LOCALHOST, SYSTEM_DEFAULT or OFF");
    }
    if (const auto& only = environment.localhost_only) {
        const std::string why = std::string(kLocalhostOnly) + " = " + *only;
        if (*only == "0") return Decision{Reach::kSubnet, why};
        return refused(kLocalhostOnly, *only, "must be 0 or 1");
    }
    return Decision{Reach::kLoopback, "built-in: nothing is set"};
}

Result<std::vector<std::string>> read_peers(const std::string& text, Reach reach) {
    std::vector<std::string> peers;
    for (const std::string& peer : split_text(text, ';')) {
        if (peer.empty()) continue;  // as rcl: "a;;b;" names two
        if (!is_host(peer)) {
            return refused(kStaticPeers, text,
                           "must hold IPv4 addresses or host names with ';' between them, '" +
                               peer + "' is neither");
        }
        if (reach == Reach::kLoopback && peer != "127.0.0.1" && peer != "localhost") {
            return refused(kStaticPeers, text,
                           "has the peer " + peer + ", which dds/loopback.xml cannot reach; set " +
                               kRange + " = SUBNET, or give --profile");
        }
        peers.push_back(peer);
    }
    return peers;
}

}  // namespace

NetworkEnvironment network_environment() {
    return {variable(kRange), variable(kLocalhostOnly), variable(kStaticPeers)};
}

Result<NetworkChoice> choose_network(const std::string& profile_option,
                                     const std::filesystem::path& profiles,
                                     const NetworkEnvironment& environment) {
    auto decided = decide(profile_option, environment);
    if (!decided.ok()) return decided.error();
    const Reach reach = decided.value().reach;
    const bool without_peers = reach == Reach::kLoopbackWithoutPeers;
    auto peers = read_peers(without_peers ? "" : environment.static_peers.value_or(""), reach);
    if (!peers.ok()) return peers.error();
    const char* name = reach == Reach::kSubnet ? "lan.xml" : "loopback.xml";
    const std::string file =
        reach == Reach::kProfile ? profile_option : (profiles / "dds" / name).string();
    std::string why = decided.value().why;
    if (without_peers && environment.static_peers) why += std::string(", without ") + kStaticPeers;
    return NetworkChoice{file, std::move(peers).value(), why};
}

}  // namespace graspd
