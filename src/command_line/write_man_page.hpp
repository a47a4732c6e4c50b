#pragma once

#include <span>
#include <string>

#include "command_tree.hpp"

namespace graspd::command_line {

/// A section of a manual page that the option tree knows nothing of.
struct ManSection {
    std::string title;  ///< such as "EXIT STATUS"
    /// Each a paragraph; with a head, the head stands out and the text is indented below it.
    struct Paragraph {
        std::string head;
        std::string text;
    };
    std::vector<Paragraph> paragraphs;
};

/// What a manual page says beside the options.
struct ManPage {
    std::string section;  ///< "1" for commands, "8" for daemons
    std::string version;  ///< such as "graspd 0.1.0"
    std::string summary;  ///< one line, behind the name
    std::vector<ManSection> sections;
};

/// The manual page of a program, as man(7) reads it. It bears no date: the same program, the same
/// page.
std::string write_man_page(const CommandEntry& program, const ManPage& page);

}  // namespace graspd::command_line
