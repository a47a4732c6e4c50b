#include "write_man_page.hpp"

#include <algorithm>
#include <cctype>

namespace graspd::command_line {
namespace {

/// Text that troff prints as it stands: no escapes, no requests, and real dashes, which can be
/// searched for and copied.
std::string plain(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const bool starts_line = result.empty() || result.back() == '\n';
        if (starts_line && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
    }
    return result;
}

std::string bold(const std::string& text) {
    return "\\fB" + plain(text) + "\\fR";
}

std::string italic(const std::string& text) {
    return "\\fI" + plain(text) + "\\fR";
}

std::string upper(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

/// The choices of a value, else its kind.
std::string value_text(const OptionEntry& option) {
    if (option.choices.empty()) return italic(option.value);
    std::string text;
    for (const std::string& choice : option.choices)
        text += (text.empty() ? "" : "|") + bold(choice);
    return text;
}

std::string option_text(const OptionEntry& option) {
    std::string head;
    for (const std::string& name : option.names) {
        head += (head.empty() ? "" : ", ") + (option.positional ? italic(name) : bold(name));
    }
    const bool tells_value =
        !option.value.empty() && (!option.positional || !option.choices.empty());
    if (tells_value) head += " " + value_text(option);
    return ".TP\n" + head + "\n" + plain(option.description) + "\n";
}

std::string options_text(const CommandEntry& command) {
    std::string text;
    for (const OptionEntry& option : command.options) text += option_text(option);
    return text;
}

/// The name, its subcommand where it has some, the positional arguments.
std::string synopsis(const CommandEntry& command, const std::string& name) {
    std::string text = bold(name);
    if (!command.subcommands.empty()) text += " " + italic("COMMAND");
    text += " [" + italic("OPTIONS") + "]";
    for (const OptionEntry& option : command.options) {
        if (!option.positional) continue;
        const std::string argument =
            option.choices.empty() ? italic(option.names[0]) : value_text(option);
        text += option.required ? " " + argument : " [" + argument + "]";
    }
    return text + "\n";
}

std::string section_text(const ManSection& section) {
    std::string text = ".SH " + section.title + "\n";
    bool first = true;
    for (const auto& [head, words] : section.paragraphs) {
        if (!head.empty())
            text += ".TP\n" + bold(head) + "\n";
        else if (!first)
            text += ".PP\n";
        text += plain(words) + "\n";
        first = false;
    }
    return text;
}

}  // namespace

std::string write_man_page(const CommandEntry& program, const ManPage& page) {
    const std::string& name = program.name;
    std::string text = ".TH " + upper(name) + " " + page.section + " \"\" \"" +
                       plain(page.version) + "\"\n.SH NAME\n" + plain(name) + " \\- " +
                       plain(page.summary) + "\n.SH SYNOPSIS\n" + synopsis(program, name);
    text += ".SH OPTIONS\n" + options_text(program);
    if (!program.footer.empty()) text += ".PP\n" + plain(program.footer) + "\n";
    if (!program.subcommands.empty()) text += ".SH COMMANDS\n";
    for (const CommandEntry& command : program.subcommands) {
        text += ".SS " + synopsis(command, name + " " + command.name) + plain(command.description) +
                "\n" + options_text(command);
    }
    for (const ManSection& section : page.sections) text += section_text(section);
    return text;
}

}  // namespace graspd::command_line
