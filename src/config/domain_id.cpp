#include "graspd/config/domain_id.hpp"

#include <charconv>
#include <cstdlib>

namespace graspd {
namespace {

constexpr std::uint32_t kHighestDomain = 232;  // above it RTPS runs out of UDP ports

Result<std::uint32_t> parse_domain(const std::string& name, const std::string& text) {
    std::uint32_t domain = 0;
    const char* end = text.data() + text.size();
    const auto got = std::from_chars(text.data(), end, domain);
    if (got.ec == std::errc{} && got.ptr == end && domain <= kHighestDomain) return domain;
    return PlanError{PlanErrorCode::kInvalidInput,
                     name + " = " + text + " must be a whole number in [0, 232]"};
}

}  // namespace

Result<std::uint32_t> choose_domain(const std::optional<std::string>& option) {
    if (option) return parse_domain("--domain", *option);
    const char* variable = std::getenv("ROS_DOMAIN_ID");  // NOLINT(concurrency-mt-unsafe)
    if (variable == nullptr || *variable == '\0') return 0u;
    return parse_domain("ROS_DOMAIN_ID", variable);
}

}  // namespace graspd
