#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "commands.hpp"
#include "object_concavity.hpp"
#include "support/shapes.hpp"

namespace graspd::cli {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

ObjectConcavity concavity_of(const ObjectFile& object) {
    auto result = object_concavity(object, {});
    EXPECT_TRUE(result.ok()) << result.error().detail;
    return result.ok() ? std::move(result).value() : ObjectConcavity{};
}

ObjectFile file_of(TriangleMesh mesh) {
    ObjectFile file;
    file.object = std::move(mesh);
    return file;
}

// A blind hole 0.03 wide and 0.06 deep: -z inside, 0 outside. A soup repeats the value at every
// corner that stands on the vertex: 3f + k is corner k of face f.
TEST(ObjectConcavity, HasOneValueForEachStoredVertex) {
    const TriangleMesh mesh = test::blind_hole_block({0.06, 0.06, 0.08}, 0.03, 0.06, 1500);
    const TriangleMesh soup = test::to_soup(mesh);
    for (const TriangleMesh& stored : {mesh, soup}) {
        const ObjectConcavity concavity = concavity_of(file_of(stored));
        ASSERT_EQ(concavity.value_m.size(), stored.vertices.size());
        for (std::size_t i = 0; i < stored.vertices.size(); ++i) {
            const Vector3d& p = stored.vertices[i];
            const bool inside = p.head<2>().cwiseAbs().maxCoeff() < 0.015 + 1e-9;
            const double expected = inside && p.z() > -0.06 - 1e-9 ? -p.z() : 0.0;
            EXPECT_NEAR(concavity.value_m[i], expected, 1e-9);
            EXPECT_LE(concavity.flag[i], ConcavityFlag::kPath);
        }
    }
}

// Vertices that only a degenerate face uses, or none: no value. What is closed in: infinity.
TEST(ObjectConcavity, FlagsWhatHasNoValue) {
    TriangleMesh mesh =
        test::joined(test::box({0.1, 0.1, 0.1}, 12), test::box({0.05, 0.05, 0.05}, 12));
    mesh.vertices.emplace_back(0.3, 0.0, 0.0);
    mesh.vertices.emplace_back(0.4, 0.0, 0.0);
    mesh.faces.push_back({16, 16, 0});
    const ObjectConcavity concavity = concavity_of(file_of(mesh));
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(concavity.flag[i], ConcavityFlag::kExact);
        EXPECT_NEAR(concavity.value_m[i], 0.0, 1e-12);
    }
    for (std::size_t i = 8; i < 16; ++i) {
        EXPECT_EQ(concavity.flag[i], ConcavityFlag::kEnclosed);
        EXPECT_EQ(concavity.value_m[i], std::numeric_limits<double>::infinity());
    }
    for (std::size_t i = 16; i < 18; ++i) {
        EXPECT_EQ(concavity.flag[i], ConcavityFlag::kUnreferenced);
        EXPECT_TRUE(std::isnan(concavity.value_m[i]));
    }
}

// The points of a ring of tube, one of them not there and one there twice: each gets the value of
// its place, tube - |z| on the hole's side, within a share of the spacing (1.5 mm).
TEST(ObjectConcavity, WorksOnTheCloudsPoints) {
    PointCloud cloud{test::torus(0.06, 0.02, 12000).vertices, {}};
    cloud.points.insert(cloud.points.begin() + 5, Vector3d::Constant(std::nan("")));
    cloud.points.push_back(cloud.points[77]);
    ObjectFile file;
    file.object = cloud;
    const ObjectConcavity concavity = concavity_of(file);
    ASSERT_EQ(concavity.value_m.size(), cloud.points.size());
    EXPECT_EQ(concavity.flag[5], ConcavityFlag::kUnreferenced);
    EXPECT_EQ(concavity.value_m.back(), concavity.value_m[77]);
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        const Vector3d& p = cloud.points[i];
        if (i == 5) continue;
        const double expected = std::hypot(p.x(), p.y()) < 0.06 ? 0.02 - std::abs(p.z()) : 0.0;
        EXPECT_NEAR(concavity.value_m[i], expected, 3e-4);
    }
    EXPECT_EQ(concavity.findings.at(0).code, "points_not_finite");
}

TEST(ObjectConcavity, PassesErrorsOn) {
    ObjectFile file;
    file.object = PointCloud{};
    EXPECT_EQ(object_concavity(file, {}).error().code, PlanErrorCode::kInvalidInput);
    TriangleMesh line;
    line.vertices = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
    line.faces = {{0, 1, 2}};
    const auto flat = object_concavity(file_of(line), {});
    ASSERT_FALSE(flat.ok());
    EXPECT_EQ(flat.error().code, PlanErrorCode::kDegenerate);
}

// A sheet is wrapped: each vertex has the value of the wrap beside it, which nobody has proven for
// the vertex itself. A flat sheet lies on its hull: the wrap's value is 0.
TEST(ObjectConcavity, AWrapsValueIsNotProven) {
    TriangleMesh sheet;
    sheet.vertices = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0.05, 0.05, 0.2}};
    sheet.faces = {{0, 1, 2}};
    const ObjectConcavity concavity = concavity_of(file_of(sheet));
    ASSERT_EQ(concavity.value_m.size(), 4u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(concavity.flag[i], ConcavityFlag::kPath);
        EXPECT_NEAR(concavity.value_m[i], 0.0, 2e-4);  // the wrap is 1e-3 of 0.141 m off
    }
    EXPECT_EQ(concavity.flag[3], ConcavityFlag::kUnreferenced);
    EXPECT_TRUE(std::ranges::any_of(
        concavity.findings, [](const Finding& each) { return each.code == "alpha_wrapped"; }));
}

// Numbers read back bit for bit; a line is "index value flag".
TEST(WriteConcavity, PrintsOneLineARecord) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const ObjectConcavity concavity{
        {0.0, 0.1 + 0.2, 1e-300, kInfinity, std::nan("")},
        {ConcavityFlag::kExact, ConcavityFlag::kPath, ConcavityFlag::kPath,
         ConcavityFlag::kEnclosed, ConcavityFlag::kUnreferenced},
        {}};
    EXPECT_EQ(write_concavity(concavity),
              "0 0 exact\n1 0.30000000000000004 path\n2 1e-300 path\n3 inf enclosed\n"
              "4 nan unreferenced\n");
    EXPECT_EQ(write_concavity({}), "");
}

/// A channel 5 deep, 4 wide and 20 long between walls of 1, in centimetres, as OFF.
class ConcavityCommand : public testing::Test {
protected:
    void SetUp() override {
        const TriangleMesh mesh = test::u_channel(5, 4, 1, 20, 600);
        std::ofstream file(object_.file);
        file << "OFF\n" << mesh.vertices.size() << ' ' << mesh.faces.size() << " 0\n";
        for (const Vector3d& p : mesh.vertices) file << p.transpose() << '\n';
        for (const Triangle& f : mesh.faces) {
            file << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
        }
        vertices_ = mesh.vertices;
    }
    void TearDown() override {
        std::filesystem::remove(object_.file);
        std::filesystem::remove(output_.out);
    }
    static std::string temporary(const std::string& end) {
        return testing::TempDir() + "concavity_" + std::to_string(getpid()) + end;
    }

    ObjectArguments object_{temporary(".off"), 0.01, ""};
    OutputArguments output_{"table", temporary(".txt"), ""};
    std::vector<Vector3d> vertices_;
};

// In metres through --scale: in the gap, |x| <= 2 and z >= 0 of the file, min(5 - z, 10 - |y|) cm.
TEST_F(ConcavityCommand, WritesAFileInTheFilesOrder) {
    ASSERT_EQ(run_concavity(object_, "any_angle", "", output_), 0);
    std::ifstream file(output_.out);
    std::size_t index = 0, lines = 0;
    double value_m = -1.0;
    std::string flag;
    while (file >> index >> value_m >> flag) {
        ASSERT_EQ(index, lines++);
        const Vector3d& p = vertices_.at(index);
        const bool in_gap = std::abs(p.x()) < 2.01 && p.z() > -0.01;
        const double expected = in_gap ? std::min(5.0 - p.z(), 10.0 - std::abs(p.y())) : 0.0;
        EXPECT_NEAR(value_m, 0.01 * expected, 1e-6);  // the file has six digits
        EXPECT_TRUE(flag == "exact" || flag == "path") << flag;
    }
    EXPECT_EQ(lines, vertices_.size());
}

// On the floor, away from the ends, the way is straight up: 5 cm, here with cells of a tenth of the
// diagonal. The method of the file is as good as the one of the command line, which goes before it.
TEST_F(ConcavityCommand, MethodComesFromTheCommandLineElseFromTheFile) {
    const std::string config = temporary(".yaml");
    const auto flags_with = [&](const std::string& method, const std::string& in_file) {
        std::ofstream(config) << "vertex_concavity: {method: " << in_file << "}\n"
                              << "tetrahedral_concavity: {cell_size: 0.1}\n";
        EXPECT_EQ(run_concavity(object_, method, config, output_), 0);
        std::ifstream file(output_.out);
        std::size_t index = 0;
        double value_m = -1.0;
        std::string flag;
        std::set<std::string> flags;
        while (file >> index >> value_m >> flag) {
            flags.insert(flag);
            const Vector3d& p = vertices_.at(index);
            const bool on_floor = std::abs(p.x()) < 1.99 && std::abs(p.z()) < 0.01;
            if (on_floor && std::abs(p.y()) < 2.0) {
                EXPECT_NEAR(value_m, 0.05, 0.0025);
            }
        }
        return flags;
    };
    const std::set<std::string> front = {"path"}, rays = {"exact", "path"};
    EXPECT_EQ(flags_with("tetrahedral", "any_angle"), front);
    EXPECT_EQ(flags_with("", "tetrahedral"), front);
    EXPECT_EQ(flags_with("any_angle", "tetrahedral"), rays);
    EXPECT_EQ(flags_with("", "any_angle"), rays);
    std::filesystem::remove(config);
}

// A method that fails is an error, not a reason for another one.
TEST_F(ConcavityCommand, NeverFallsBack) {
    const std::string config = temporary(".yaml");
    std::ofstream(config) << "tetrahedral_concavity: {max_cells: 10}\n";
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_concavity(object_, "tetrahedral", config, output_), 2);
    EXPECT_THAT(testing::internal::GetCapturedStderr(),
                HasSubstr("tetrahedral_concavity.max_cells = 10 is passed"));
    EXPECT_FALSE(std::filesystem::exists(output_.out));
    std::filesystem::remove(config);
}

TEST_F(ConcavityCommand, NamesTheFileThatFailed) {
    const auto message_of = [&] {
        testing::internal::CaptureStderr();
        EXPECT_EQ(run_concavity(object_, "any_angle", "", output_), 2);
        return testing::internal::GetCapturedStderr();
    };
    std::ofstream(object_.file) << "OFF\n3 1 0\n0 0 0\n1 0 0\n3 0 0\n3 0 1 2\n";
    EXPECT_THAT(message_of(), testing::AllOf(HasSubstr(object_.file), HasSubstr("flat sheet")));
    object_.file = "/nowhere/mug.stl";
    EXPECT_THAT(message_of(), HasSubstr("/nowhere/mug.stl"));
    EXPECT_EQ(run_concavity(object_, "any_angle", "/nowhere/planner.yaml", output_), 2);
}

// What was repaired is for people: standard error, not the result.
TEST_F(ConcavityCommand, FindingsGoToStandardError) {
    output_.out.clear();
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_concavity(object_, "any_angle", "", output_), 0);
    const std::string result = testing::internal::GetCapturedStdout();
    EXPECT_EQ(std::ranges::count(result, '\n'), static_cast<std::ptrdiff_t>(vertices_.size()));
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("finding: components: 1 piece"));
}

}  // namespace
}  // namespace graspd::cli
