#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "graspd/base/geometry.hpp"

namespace graspd::cli {

/// Findings as the array that every JSON of graspctl has: {"code", "value", "detail"}.
inline nlohmann::ordered_json findings_json(const std::vector<Finding>& findings) {
    auto rows = nlohmann::ordered_json::array();
    for (const Finding& finding : findings) {
        rows.push_back(
            {{"code", finding.code}, {"value", finding.value}, {"detail", finding.detail}});
    }
    return rows;
}

/// Findings for people: an empty line, then a line each; nothing without findings.
inline std::string finding_rows(const std::vector<Finding>& findings) {
    std::string text;
    for (const Finding& finding : findings) {
        text += "finding: " + finding.code + ": " + finding.detail + "\n";
    }
    return text.empty() ? "" : "\n" + text;
}

}  // namespace graspd::cli
