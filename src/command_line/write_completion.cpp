#include "write_completion.hpp"

#include <algorithm>

namespace graspd::command_line {
namespace {

using Words = std::vector<std::string>;

std::string joined(const Words& words, const std::string& between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

const ListedValues* listed_for(const OptionEntry& option, std::span<const ListedValues> listed) {
    const auto found = std::ranges::find_if(listed, [&](const ListedValues& values) {
        return std::ranges::count(option.names, values.option) > 0;
    });
    return found == listed.end() ? nullptr : &*found;
}

/// Everything that begins with a dash.
Words option_names(const CommandEntry& command) {
    Words names;
    for (const OptionEntry& option : command.options) {
        if (!option.positional) names.insert(names.end(), option.names.begin(), option.names.end());
    }
    return names;
}

/// What may stand where no option does: subcommands, or the choices of positional arguments. What
/// takes none of these and no file either is given its options, so that TAB never answers with
/// files.
Words other_words(const CommandEntry& command) {
    Words words;
    for (const CommandEntry& each : command.subcommands) words.push_back(each.name);
    bool takes_any = false;
    for (const OptionEntry& option : command.options) {
        if (!option.positional) continue;
        words.insert(words.end(), option.choices.begin(), option.choices.end());
        takes_any = takes_any || option.choices.empty();
    }
    return words.empty() && !takes_any ? option_names(command) : words;
}

/// The branches of bash's `case "$command $before"`.
struct ValueBranches {
    std::string known;  ///< a branch for each option whose values are known
    Words any;          ///< patterns of those that take any value
};

void add_values(ValueBranches& branches, const std::string& command, const CommandEntry& entry,
                std::span<const ListedValues> listed) {
    for (const OptionEntry& option : entry.options) {
        if (option.positional || option.value.empty()) continue;
        const std::string before = command + " ";
        Words patterns;
        for (const std::string& name : option.names) patterns.push_back(quoted(before + name));
        const ListedValues* values = listed_for(option, listed);
        if (values == nullptr && option.choices.empty()) {
            branches.any.insert(branches.any.end(), patterns.begin(), patterns.end());
            continue;
        }
        branches.known +=
            "        " + joined(patterns, " | ") + ") words=" +
            (values ? "$(" + values->command + ")" : quoted(joined(option.choices, " "))) + " ;;\n";
    }
}

/// The branches of bash's `case "$command $word"` of one command.
std::string word_branches(const std::string& command, const CommandEntry& entry) {
    const std::string indent = "                ";
    return indent + quoted(command + " -") +
           "*) words=" + quoted(joined(option_names(entry), " ")) + " ;;\n" + indent +
           quoted(command + " ") + "*) words=" + quoted(joined(other_words(entry), " ")) + " ;;\n";
}

/// Text within [...] of an _arguments specification.
std::string zsh_text(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
        result += c;
    }
    return result;
}

std::string zsh_values(const OptionEntry& option, std::span<const ListedValues> listed) {
    if (const ListedValues* values = listed_for(option, listed)) {
        return "($(" + values->command + "))";
    }
    return option.choices.empty() ? "_files" : "(" + joined(option.choices, " ") + ")";
}

/// The specifications of one command's options and arguments, a line each.
std::string zsh_arguments(const CommandEntry& command, std::span<const ListedValues> listed,
                          const std::string& indent) {
    std::string text;
    for (const OptionEntry& option : command.options) {
        const std::string values = zsh_values(option, listed);
        if (option.positional) {
            text += " \\\n" + indent + quoted(":" + option.names[0] + ":" + values);
            continue;
        }
        const std::string value = option.value.empty() ? "" : ":" + option.value + ":" + values;
        const std::string after = "[" + zsh_text(option.description) + "]" + value;
        for (const std::string& name : option.names) {
            text += " \\\n" + indent + quoted(name + after);
        }
    }
    return text + "\n";
}

}  // namespace

std::string write_bash_completion(const CommandEntry& program,
                                  std::span<const ListedValues> listed) {
    Words commands;
    ValueBranches values;
    add_values(values, "", program, listed);
    std::string words = word_branches("", program);
    for (const CommandEntry& command : program.subcommands) {
        commands.push_back(command.name);
        add_values(values, command.name, command, listed);
        words += word_branches(command.name, command);
    }
    if (!values.any.empty()) {
        values.known += "        " + joined(values.any, " | \\\n            ") + ") return ;;\n";
    }
    const std::string name = program.name, function = "_" + name;
    std::string text = "# Completion of " + name + " for bash, written by `" + name +
                       " completion bash`.\n" + function + "() {\n" +
                       "    local word=${COMP_WORDS[COMP_CWORD]} words= command= i\n"
                       "    local before=${COMP_WORDS[COMP_CWORD - 1]}\n";
    if (!commands.empty()) {
        text +=
            "    for ((i = 1; i < COMP_CWORD; ++i)); do\n"
            "        case ${COMP_WORDS[i]} in\n            " +
            joined(commands, " | ") +
            ")\n                command=${COMP_WORDS[i]}\n                break\n"
            "                ;;\n        esac\n    done\n";
    }
    text += "    COMPREPLY=()\n    case \"$command $before\" in\n" + values.known +
            "        *)\n            case \"$command $word\" in\n" + words +
            "            esac\n            ;;\n    esac\n"
            "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n}\n"
            "complete -o default -F " +
            function + " " + name + "\n";
    return text;
}

std::string write_zsh_completion(const CommandEntry& program,
                                 std::span<const ListedValues> listed) {
    const std::string name = program.name, function = "_" + name;
    std::string text =
        "#compdef " + name + "\n# Completion of " + name + " for zsh, written by `" + name +
        " completion zsh`.\n" + function + "() {\n" +
        "    local state line\n    local -a commands\n    _arguments -C" +
        std::string(program.subcommands.empty() ? ""
                                                : " \\\n        '1:command:->command' \\\n"
                                                  "        '*::argument:->argument'") +
        zsh_arguments(program, listed, "        ");
    std::string described, branches;
    for (const CommandEntry& command : program.subcommands) {
        described +=
            "                " + quoted(command.name + ":" + zsh_text(command.description)) + "\n";
        branches += "                " + command.name + ")\n                    _arguments" +
                    zsh_arguments(command, listed, "                        ") +
                    "                    ;;\n";
    }
    if (!described.empty()) {
        text += "    case $state in\n        command)\n            commands=(\n" + described +
                "            )\n            _describe command commands\n            ;;\n"
                "        argument)\n            case $words[1] in\n" +
                branches + "            esac\n            ;;\n    esac\n";
    }
    return text + "}\nif [[ $funcstack[1] == " + function + " ]]; then\n    " + function +
           " \"$@\"\nelse\n    compdef " + function + " " + name + "\nfi\n";
}

}  // namespace graspd::command_line
