// Every file of tests/fuzz/corpus/TARGET through its target, as any compiler builds it. What
// libFuzzer once found lies there too, so that it stays mended (scripts/fuzz).
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "targets.hpp"

namespace graspd::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const std::string& target) {
    std::vector<fs::path> files;
    for (const auto& entry :
         fs::directory_iterator(fs::path(GRASPD_SOURCE_DIR) / "tests/fuzz/corpus" / target)) {
        files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
}

std::vector<std::uint8_t> bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void run_corpus(const std::string& target, bool (*run)(Bytes), std::size_t least) {
    const auto files = files_of(target);
    EXPECT_GE(files.size(), least);
    for (const fs::path& file : files) {
        std::cout << file.filename().string() << std::endl;  // the last one, should a run end here
        const auto bytes = bytes_of(file);
        bool accepted = false;
        EXPECT_NO_THROW(accepted = run(bytes)) << file;
        const bool seed = file.filename().string().starts_with("seed_");
        EXPECT_TRUE(accepted || !seed) << file << " is refused: run tests/fuzz/make_seeds.py anew";
        // Cut short, as a sample or a file may arrive.
        EXPECT_NO_THROW(run(Bytes(bytes).first(bytes.size() / 2))) << "half of " << file;
    }
}

TEST(FuzzCorpora, Guard) {
    run_corpus("guard", fuzz_guard, 8);
}
TEST(FuzzCorpora, ObjectFile) {
    run_corpus("object_file", fuzz_object_file, 8);
}
TEST(FuzzCorpora, Yaml) {
    run_corpus("yaml", fuzz_yaml, 8);
}
TEST(FuzzCorpora, Plan) {
    run_corpus("plan", fuzz_plan, 8);
}

}  // namespace
}  // namespace graspd::fuzz
