#include <unistd.h>

#include <fstream>
#include <system_error>

#include "targets.hpp"

namespace graspd::fuzz {
namespace {

std::filesystem::path directory() {
    return std::filesystem::temp_directory_path() / ("graspd_fuzz_" + std::to_string(getpid()));
}

}  // namespace

ScratchFile::ScratchFile(const std::string& name) : path_(directory() / name) {
    std::filesystem::create_directories(path_.parent_path());
}

ScratchFile::~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
    std::filesystem::remove(path_.parent_path(), ignored);  // when it is the last one
}

const std::filesystem::path& ScratchFile::write(Bytes bytes) const {
    std::ofstream file(path_, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) throw std::runtime_error("cannot write " + path_.string());
    return path_;
}

}  // namespace graspd::fuzz
