#include "negative/verdict.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>

#include "graspd/mesh/condition_mesh.hpp"
#include "graspd/mesh/face_sensor.hpp"
#include "graspd/mesh/read_object.hpp"
#include "graspd/mesh/triangulate_cloud.hpp"

namespace graspd::test {
namespace {

void append(std::vector<Finding>& findings, const std::vector<Finding>& more) {
    findings.insert(findings.end(), more.begin(), more.end());
}

Outcome close_mesh(const TriangleMesh& mesh) {
    const auto closed = condition_mesh(mesh, {});
    if (!closed.ok()) return {closed.error(), {}};
    return {std::nullopt, closed.value().findings};
}

Outcome close_cloud(const PointCloud& cloud) {
    Outcome outcome;
    const auto surface = triangulate_cloud(cloud, {});
    if (!surface.ok()) return {surface.error(), {}};
    append(outcome.findings, surface.value().findings);
    auto closed = condition_mesh(surface.value().mesh, {});
    if (closed.ok()) closed = face_sensor(std::move(closed).value(), cloud.sensor_origin, {}, {});
    if (!closed.ok()) return {closed.error(), outcome.findings};
    append(outcome.findings, closed.value().findings);
    return outcome;
}

}  // namespace

Verdict refused(PlanErrorCode code, std::vector<std::string> says) {
    return {code, std::move(says), {}};
}

Verdict unreadable(std::vector<std::string> says) {
    return refused(PlanErrorCode::kUnreadableFile, std::move(says));
}

Verdict repaired(std::vector<ExpectedFinding> findings) {
    return {std::nullopt, {}, std::move(findings)};
}

Outcome close(const std::variant<TriangleMesh, PointCloud>& object) {
    const auto* mesh = std::get_if<TriangleMesh>(&object);
    return mesh ? close_mesh(*mesh) : close_cloud(std::get<PointCloud>(object));
}

Outcome read_and_close(const std::filesystem::path& file) {
    const auto object = read_object(file);
    if (!object.ok()) return {object.error(), {}};
    Outcome outcome{std::nullopt, object.value().findings};
    const Outcome closed = close(object.value().object);
    outcome.error = closed.error;
    append(outcome.findings, closed.findings);
    return outcome;
}

void expect_verdict(const Outcome& outcome, const Verdict& verdict) {
    if (verdict.code) {
        ASSERT_TRUE(outcome.error.has_value()) << "it was taken";
        EXPECT_EQ(outcome.error->code, *verdict.code) << outcome.error->detail;
        for (const std::string& part : verdict.says) {
            EXPECT_THAT(outcome.error->detail, testing::HasSubstr(part));
        }
        return;
    }
    ASSERT_FALSE(outcome.error.has_value()) << outcome.error->detail;
    for (const ExpectedFinding& expected : verdict.findings) {
        const auto found = std::ranges::find(outcome.findings, expected.code, &Finding::code);
        ASSERT_NE(found, outcome.findings.end()) << "no finding " << expected.code;
        EXPECT_NEAR(found->value, expected.value, expected.tolerance) << expected.code;
        EXPECT_FALSE(found->detail.empty()) << expected.code;
    }
}

ScratchFolder::ScratchFolder() {
    static std::atomic<int> count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("graspd_negative_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path ScratchFolder::write(const std::string& name,
                                           const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
}

void PrintTo(const BadFile& row, std::ostream* out) {
    *out << row.name;
}

void expect_verdict(const BadFile& object) {
    const ScratchFolder folder;
    expect_verdict(read_and_close(folder.write(object.file, object.bytes)), object.verdict);
}

}  // namespace graspd::test
