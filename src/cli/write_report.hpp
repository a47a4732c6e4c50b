#pragma once

#include <string>
#include <string_view>

namespace graspd::cli {

/// The page without data, as web/report builds it; part of this program.
std::string_view report_template();

/// A page that shows a report by itself: the template with the data in it.
/// @param data  JSON of report_data(); whatever its strings hold, it stays data
std::string report_page(std::string_view page_template, const std::string& data);

}  // namespace graspd::cli
