#include "support/suggestion.hpp"

#include <algorithm>
#include <regex>

namespace graspd::test {
namespace {

double number(const std::string& text) {
    return std::stod(text);
}

}  // namespace

ReadSuggestion read_suggestion(const std::string& text) {
    ReadSuggestion read;
    static const std::regex change(
        "(max_width|friction|min_clearance|half_angle) ([0-9.e-]+)(?: m| rad)?"
        "(?: instead of ([0-9.e-]+))?");
    for (std::sregex_iterator match(text.begin(), text.end(), change), end; match != end; ++match) {
        read.to[(*match)[1]] = number((*match)[2]);
        if ((*match)[3].matched) read.from[(*match)[1]] = number((*match)[3]);
    }
    if (text.find("no approach_cones") != std::string::npos) read.to["approach_cones"] = 0.0;
    read.all_sources = text.find("all sources") != std::string::npos ||
                       text.find("sources boundary,wall,whole_object") != std::string::npos;
    std::smatch match;
    static const std::regex grasp("there is a grasp of score ([0-9.]+)$");
    static const std::regex better("the best score is ([0-9.]+) instead of ([0-9.]+)$");
    if (std::regex_search(text, match, grasp)) read.score = number(match[1]);
    if (std::regex_search(text, match, better)) {
        read.score = number(match[1]);
        read.instead = number(match[2]);
    }
    return read;
}

PlanRequest applied(PlanRequest request, const std::string& suggestion) {
    const ReadSuggestion read = read_suggestion(suggestion);
    request.options.want_suggestion = false;
    if (read.all_sources) request.options.sources = kAllSources;
    for (const auto& [name, value] : read.to) {
        if (name == "friction") request.options.friction = value;
        if (name == "min_clearance") request.options.min_clearance_m = value;
        if (name == "approach_cones") request.approach_cones.clear();
        for (ApproachCone& cone : request.approach_cones) {
            if (name == "half_angle") cone.half_angle_rad = std::max(cone.half_angle_rad, value);
        }
        for (Gripper& gripper : request.grippers) {
            const bool named = request.grippers.size() == 1 ||
                               suggestion.find("(" + gripper.name + ")") != std::string::npos;
            if (name == "max_width" && named) gripper.max_width_m = value;
        }
    }
    return request;
}

}  // namespace graspd::test
