#include <gmock/gmock.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "command_line/write_completion.hpp"

namespace graspd::command_line {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A program with two subcommands: `brew FILE` and `clean`, and a hidden one.
class CompletionTest : public testing::Test {
protected:
    void SetUp() override {
        app_.set_version_flag("--version", "1");
        auto* brew = app_.add_subcommand("brew", "make tea: it's [hot]");
        brew->add_option("FILE", text_, "leaves")->required();
        brew->add_option("--kind", text_, "of tea")->check(CLI::IsMember({"green", "black"}));
        brew->add_option("--cup", text_, "a cup that is there");
        brew->add_option("-m,--minutes", number_, "to wait");
        brew->add_flag("--sugar", flag_, "sweet");
        brew->add_option("--secret", text_, "not told")->group("");
        app_.add_subcommand("clean", "wash up");
        app_.add_subcommand("chip", "not told")->group("");
        auto* show = app_.add_subcommand("show", "print");
        show->add_option("WHAT", text_, "")->check(CLI::IsMember({"kettle", "pot"}));
    }
    CommandEntry tree() const { return read_command_tree(app_, "tea"); }

    /// What bash offers for the last of these words.
    std::vector<std::string> offered(const std::vector<std::string>& words) const {
        const std::vector<ListedValues> listed = {{"--cup", "printf 'blue\\nred\\n'"}};
        const std::string file = testing::TempDir() + "tea_" + std::to_string(getpid()) + ".bash";
        std::ofstream script(file);
        script << write_bash_completion(tree(), listed) << "COMP_WORDS=(";
        for (const std::string& word : words) script << " '" << word << "'";
        script << ")\nCOMP_CWORD=" << words.size() - 1
               << "\n_tea\nfor word in \"${COMPREPLY[@]}\"; do echo \"$word\"; done\n";
        script.close();
        std::vector<std::string> lines;
        std::FILE* pipe = popen(("bash -u " + file + " 2>&1").c_str(), "r");
        char line[256];
        while (std::fgets(line, sizeof line, pipe) != nullptr) {
            lines.emplace_back(line);
            lines.back().pop_back();
        }
        EXPECT_EQ(pclose(pipe), 0);
        std::remove(file.c_str());
        return lines;
    }

private:
    CLI::App app_{"tea"};
    std::string text_;
    int number_ = 0;
    bool flag_ = false;
};

TEST_F(CompletionTest, TreeSaysWhatTheProgramTakes) {
    const CommandEntry program = tree();
    ASSERT_EQ(program.subcommands.size(), 3u);  // without the hidden one
    const CommandEntry& brew = program.subcommands[0];
    EXPECT_EQ(brew.name, "brew");
    ASSERT_EQ(brew.options.size(), 6u);  // --help first, without the hidden one
    EXPECT_THAT(brew.options[0].names, ElementsAre("-h", "--help"));
    EXPECT_EQ(brew.options[0].value, "");
    EXPECT_TRUE(brew.options[1].positional);
    EXPECT_TRUE(brew.options[1].required);
    EXPECT_THAT(brew.options[2].choices, ElementsAre("green", "black"));
    EXPECT_EQ(brew.options[2].value, "TEXT");
    EXPECT_EQ(brew.options[5].value, "");  // a flag
}

TEST_F(CompletionTest, SubcommandsByTheirBeginning) {
    EXPECT_THAT(offered({"tea", ""}), ElementsAre("brew", "clean", "show"));
    EXPECT_THAT(offered({"tea", "b"}), ElementsAre("brew"));
    EXPECT_THAT(offered({"tea", "x"}), IsEmpty());
    EXPECT_THAT(offered({"tea", "--v"}), ElementsAre("--version"));
}

TEST_F(CompletionTest, OptionsOfASubcommand) {
    EXPECT_THAT(offered({"tea", "brew", "--"}),
                ElementsAre("--help", "--kind", "--cup", "--minutes", "--sugar"));
    EXPECT_THAT(offered({"tea", "brew", "leaves.txt", "--k"}), ElementsAre("--kind"));
    EXPECT_THAT(offered({"tea", "clean", "-"}), ElementsAre("-h", "--help"));
    EXPECT_THAT(offered({"tea", "--version", "brew", "--su"}), ElementsAre("--sugar"));
}

// No answer leaves the word to the shell, which knows the files.
TEST_F(CompletionTest, ValuesWhereTheyAreKnown) {
    EXPECT_THAT(offered({"tea", "brew", "--kind", ""}), ElementsAre("green", "black"));
    EXPECT_THAT(offered({"tea", "brew", "--kind", "b"}), ElementsAre("black"));
    EXPECT_THAT(offered({"tea", "brew", "--cup", ""}), ElementsAre("blue", "red"));
    EXPECT_THAT(offered({"tea", "brew", "-m", ""}), IsEmpty());
    EXPECT_THAT(offered({"tea", "brew", "--minutes", "-"}), IsEmpty());
    EXPECT_THAT(offered({"tea", "brew", "--sugar", ""}), IsEmpty());  // FILE
    EXPECT_THAT(offered({"tea", "show", "p"}), ElementsAre("pot"));
}

// What takes no argument is given its options, else bash would offer files.
TEST_F(CompletionTest, NoFilesForACommandThatTakesNone) {
    EXPECT_THAT(offered({"tea", "clean", ""}), ElementsAre("-h", "--help"));
}

TEST_F(CompletionTest, ZshSpecificationsQuoteTheirText) {
    const std::string script = write_zsh_completion(tree(), {});
    EXPECT_THAT(script, HasSubstr("#compdef tea\n"));
    EXPECT_THAT(script, HasSubstr(R"('brew:make tea\: it'\''s \[hot\]')"));
    EXPECT_THAT(script, HasSubstr("'--kind[of tea]:TEXT:(green black)'"));
    EXPECT_THAT(script, HasSubstr("'--sugar[sweet]'"));
    EXPECT_THAT(script, HasSubstr("':FILE:_files'"));
    EXPECT_THAT(script, testing::Not(HasSubstr("not told")));
}

}  // namespace
}  // namespace graspd::command_line
