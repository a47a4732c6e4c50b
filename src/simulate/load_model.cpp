#include "load_model.hpp"

#include <cstring>
#include <memory>
#include <stdexcept>

#include <mujoco/mujoco.h>

namespace graspd::simulate_detail {
namespace {

[[noreturn]] void throw_error(const char* text) {
    throw std::runtime_error(std::string("MuJoCo: ") + text);
}

void ignore_warning(const char* /*text*/) {}

}  // namespace

mjModel_* load_model(const std::string& text) {
    mju_user_error = throw_error;
    mju_user_warning = ignore_warning;
    constexpr const char* kName = "scene.xml";
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    char problem[500] = "";
    mjModel* model = mj_loadXML(kName, files.get(), problem, sizeof problem);
    mj_deleteVFS(files.get());
    if (model == nullptr) throw_error(problem);
    return model;
}

}  // namespace graspd::simulate_detail
