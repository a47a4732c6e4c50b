#include <gmock/gmock.h>

#include <CLI/CLI.hpp>

#include "command_line/write_man_page.hpp"

namespace graspd::command_line {
namespace {

std::string page_of(const CLI::App& app) {
    return write_man_page(read_command_tree(app, "tea"),
                          {"1", "tea 2.0", "makes tea", {{"EXIT STATUS", {{"0", "it is hot"}}}}});
}

TEST(ManPage, HasEverySectionInOrder) {
    CLI::App app("tea");
    auto* brew = app.add_subcommand("brew", "make it");
    std::string text;
    brew->add_option("FILE", text, "leaves")->required();
    brew->add_option("--kind", text, "of tea")->check(CLI::IsMember({"green", "black"}));
    EXPECT_EQ(page_of(app),
              ".TH TEA 1 \"\" \"tea 2.0\"\n"
              ".SH NAME\ntea \\- makes tea\n"
              ".SH SYNOPSIS\n\\fBtea\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n"
              ".SH OPTIONS\n"
              ".TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nPrint this help message and exit\n"
              ".SH COMMANDS\n"
              ".SS \\fBtea brew\\fR [\\fIOPTIONS\\fR] \\fIFILE\\fR\nmake it\n"
              ".TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nPrint this help message and exit\n"
              ".TP\n\\fIFILE\\fR\nleaves\n"
              ".TP\n\\fB\\-\\-kind\\fR \\fBgreen\\fR|\\fBblack\\fR\nof tea\n"
              ".SH EXIT STATUS\n.TP\n\\fB0\\fR\nit is hot\n");
}

// A line that begins with a dot or a quote would be a request, a backslash an escape.
TEST(ManPage, TextIsNeverARequest) {
    CLI::App app("tea");
    bool flag = false;
    app.add_flag("--a", flag, ".hidden \\n and\n'quoted'");
    EXPECT_THAT(page_of(app), testing::HasSubstr("\n\\&.hidden \\en and\n\\&'quoted'\n"));
}

}  // namespace
}  // namespace graspd::command_line
