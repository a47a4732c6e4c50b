#include "profile_interfaces.hpp"

#include <fstream>
#include <iterator>
#include <optional>

namespace graspd::server {
namespace {

std::string without_comments(std::string xml) {
    for (auto begin = xml.find("<!--"); begin != std::string::npos; begin = xml.find("<!--")) {
        const auto end = xml.find("-->", begin);
        xml.erase(begin, end == std::string::npos ? end : end + 3 - begin);
    }
    return xml;
}

/// What stands between the next <tag> and </tag>; `at` moves behind it.
std::optional<std::string> next_element(const std::string& xml, const std::string& tag,
                                        std::size_t& at) {
    const std::string open = "<" + tag + ">";
    const auto begin = xml.find(open, at);
    const auto end = xml.find("</" + tag + ">", at);
    if (begin == std::string::npos || end == std::string::npos) return std::nullopt;
    at = end + open.size() + 1;
    return xml.substr(begin + open.size(), end - begin - open.size());
}

}  // namespace

std::string profile_interfaces(const std::string& xml) {
    const std::string text = without_comments(xml);
    std::string interfaces;
    std::size_t at = 0;
    while (const auto list = next_element(text, "interfaceWhiteList", at)) {
        for (const char* tag : {"address", "interface"}) {
            std::size_t inside = 0;
            while (const auto entry = next_element(*list, tag, inside)) {
                interfaces += (interfaces.empty() ? "" : ",") + *entry;
            }
        }
    }
    return interfaces.empty() ? "all" : interfaces;
}

std::string profile_file_interfaces(const std::string& file) {
    std::ifstream stream(file);
    if (!stream) return "unknown";
    return profile_interfaces(std::string(std::istreambuf_iterator<char>(stream), {}));
}

}  // namespace graspd::server
