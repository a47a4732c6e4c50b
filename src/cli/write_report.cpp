#include "write_report.hpp"

#include <cassert>

// The template lies in the program itself, so that a report can be written wherever it runs.
extern "C" {
extern const char graspd_report_template_begin[];  // NOLINT(readability-identifier-naming)
extern const char graspd_report_template_end[];    // NOLINT(readability-identifier-naming)
}
asm(".pushsection .rodata\n"
    ".global graspd_report_template_begin\n"
    "graspd_report_template_begin:\n"
    ".incbin \"" GRASPD_REPORT_TEMPLATE
    "\"\n"
    ".global graspd_report_template_end\n"
    "graspd_report_template_end:\n"
    ".popsection\n");

namespace graspd::cli {
namespace {

constexpr std::string_view kPlace = "GRASPD_REPORT_DATA";

/// JSON that no HTML parser takes for markup: a "<" can stand in strings alone.
std::string inert(const std::string& json) {
    std::string text;
    text.reserve(json.size());
    for (const char character : json) {
        if (character == '<') {
            text += "\\u003c";
        } else {
            text += character;
        }
    }
    return text;
}

}  // namespace

std::string_view report_template() {
    return {graspd_report_template_begin,
            // cppcheck-suppress comparePointers ; the assembler's two ends of one file
            static_cast<std::size_t>(graspd_report_template_end - graspd_report_template_begin)};
}

std::string report_page(std::string_view page_template, const std::string& data) {
    const std::size_t place = page_template.find(kPlace);
    assert(place != std::string_view::npos);
    std::string page(page_template.substr(0, place));
    page += inert(data);
    page += page_template.substr(place + kPlace.size());
    return page;
}

}  // namespace graspd::cli
