#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "commands.hpp"
#include "exit_code.hpp"
#include "support/clouds.hpp"
#include "support/shapes.hpp"
#include "write_doctor.hpp"

namespace graspd::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::json;

Gripper hand() {
    Gripper gripper;
    gripper.name = "hand";
    return gripper;
}

Diagnosis diagnosis_of(const std::variant<TriangleMesh, PointCloud>& object) {
    ObjectFile file;
    file.object = object;
    return diagnose_object(file, hand(), {});
}

// 0.1 m cube as STL stores it, one face missing: 33 corners on 8 places, a hole of three edges.
TEST(Doctor, CountsAndMeasuresBeforeAndAfter) {
    const TriangleMesh soup = test::to_soup(test::without(test::box({0.1, 0.1, 0.1}), {5}));
    const Diagnosis diagnosis = diagnosis_of(soup);
    EXPECT_TRUE(diagnosis.usable());
    EXPECT_EQ(diagnosis.kind, "mesh");
    EXPECT_EQ(diagnosis.before.vertices, 33u);
    EXPECT_EQ(diagnosis.before.faces, 11u);
    EXPECT_EQ(diagnosis.before.components, 1u);
    EXPECT_EQ(diagnosis.before.holes, 1u);
    EXPECT_FALSE(diagnosis.before.volume_m3.has_value());
    EXPECT_NEAR(diagnosis.before.area_m2, 0.055, 1e-12);  // 5.5 sides of 0.01 m2
    ASSERT_TRUE(diagnosis.after.has_value());
    EXPECT_EQ(diagnosis.after->vertices, 8u);
    EXPECT_EQ(diagnosis.after->faces, 12u);
    EXPECT_EQ(diagnosis.after->holes, 0u);
    EXPECT_NEAR(diagnosis.after->volume_m3.value_or(0.0), 1e-3, 1e-12);
    EXPECT_NEAR(diagnosis.after->area_m2, 0.06, 1e-12);
    EXPECT_TRUE(diagnosis.after->size_m.isApprox(Eigen::Vector3d(0.1, 0.1, 0.1)));
    EXPECT_THAT(diagnosis.advice, ElementsAre(HasSubstr("close the holes")));
}

TEST(Doctor, AProperMeshNeedsNothing) {
    const Diagnosis diagnosis = diagnosis_of(test::torus(0.06, 0.02, 2000));
    EXPECT_TRUE(diagnosis.usable());
    EXPECT_THAT(diagnosis.advice, IsEmpty());
    ASSERT_EQ(diagnosis.findings.size(), 1u);
    EXPECT_EQ(diagnosis.findings[0].code, "components");
}

TEST(Doctor, FindsFacesThatCross) {
    TriangleMesh mesh = test::box({0.1, 0.1, 0.1});
    Eigen::Isometry3d pose = test::random_pose(4);
    pose.translation().setZero();
    mesh = test::joined(mesh, test::moved(mesh, pose));
    const Diagnosis diagnosis = diagnosis_of(mesh);
    const auto found = std::ranges::find(diagnosis.findings, "self_intersections", &Finding::code);
    ASSERT_NE(found, diagnosis.findings.end());
    EXPECT_GT(found->value, 0.0);
    EXPECT_TRUE(diagnosis.usable());
}

TEST(Doctor, RefusesWithTheFactorAndSaysWhatHelps) {
    const Diagnosis diagnosis = diagnosis_of(test::box({80, 60, 120}, 100));
    EXPECT_THAT(diagnosis.refusal, HasSubstr("object of 120 x 80 x 60 m"));
    EXPECT_THAT(diagnosis.advice, ElementsAre(HasSubstr("--units mm")));
    EXPECT_TRUE(diagnosis.after.has_value());
    const Diagnosis empty = diagnosis_of(PointCloud{});
    EXPECT_THAT(empty.refusal, HasSubstr("cloud is empty"));
    EXPECT_FALSE(empty.after.has_value());
}

// 2000 points with 15.7 mm2 each: neighbours stand 3.09 to 3.6 / sqrt(2000) radii apart.
TEST(Doctor, MeasuresACloudsSpacing) {
    const Diagnosis diagnosis = diagnosis_of(test::spiral_sphere(0.05, 2000));
    EXPECT_EQ(diagnosis.kind, "cloud");
    EXPECT_EQ(diagnosis.before.vertices, 2000u);
    EXPECT_EQ(diagnosis.before.faces, 0u);
    EXPECT_NEAR(diagnosis.before.spacing_m.value_or(0.0), 0.00375, 0.0005);
    EXPECT_EQ(diagnosis.after->faces, 2u * 2000u - 4u);
}

TEST(Doctor, WritesATableAndJson) {
    Diagnosis diagnosis = diagnosis_of(test::without(test::box({0.1, 0.1, 0.1}), {5}));
    diagnosis.file = "cube.stl";
    const std::string table = write_doctor_table(diagnosis);
    for (const char* part :
         {"cube.stl: mesh, usable", "as planned on", "100.0 x 100.0 x 100.0", "1000.000",
          "finding: holes_filled: 1 boundary loops closed", "would help: close the holes"}) {
        EXPECT_THAT(table, HasSubstr(part));
    }
    const Json json = Json::parse(write_doctor_json(diagnosis));
    EXPECT_EQ(json["schema"], "graspd/1");
    EXPECT_EQ(json["verdict"], "usable");
    EXPECT_EQ(json["before"]["faces"], 11);
    EXPECT_TRUE(json["before"]["volume"].is_null());
    EXPECT_NEAR(json["after"]["volume"].get<double>(), 1e-3, 1e-12);
    EXPECT_EQ(json["findings"][0]["code"], "holes_filled");
    EXPECT_EQ(json["advice"].size(), 1u);
}

/// A file and where the result goes.
class DoctorCommand : public testing::Test {
protected:
    DoctorCommand() {
        std::filesystem::create_directories(folder_);
        output_.format = "json";
        output_.out = (folder_ / "out.json").string();
    }
    ~DoctorCommand() override { std::filesystem::remove_all(folder_); }

    int run(const std::string& name, const std::string& bytes, double scale = 1.0) {
        ObjectArguments object;
        object.file = (folder_ / name).string();
        object.scale = scale;
        std::ofstream(object.file) << bytes;
        const int code = run_doctor(object, "parallel_85", "", output_);
        std::ifstream file(output_.out);
        result_ = Json::parse(file);
        return code;
    }

    Json result_;
    OutputArguments output_;

private:
    const std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) / ("doctor_" + std::to_string(getpid()));
};

const std::string kTetrahedron =
    "OFF\n4 4 0\n0 0 0\n80 0 0\n0 80 0\n0 0 80\n"
    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

TEST_F(DoctorCommand, ExitCodeIsTheVerdict) {
    EXPECT_EQ(run("t.off", kTetrahedron, 0.001), kExitOk);
    EXPECT_EQ(result_["verdict"], "usable");
    EXPECT_NEAR(result_["after"]["volume"].get<double>(), 0.08 * 0.08 * 0.08 / 6, 1e-12);
    EXPECT_EQ(run("t.off", kTetrahedron), kExitUsage);
    EXPECT_EQ(result_["verdict"], "refused");
    EXPECT_THAT(result_["message"].get<std::string>(), HasSubstr("--units mm"));
}

TEST_F(DoctorCommand, SaysWhyAFileCannotBeRead) {
    EXPECT_EQ(run("t.off", "OFF\n3 1 0\n0 0 0\n"), kExitUsage);
    EXPECT_EQ(result_["kind"], "unreadable");
    EXPECT_TRUE(result_["before"].is_null());
    EXPECT_THAT(result_["message"].get<std::string>(), HasSubstr("promises 3 vertices"));
}

// The reader's findings come first.
TEST_F(DoctorCommand, TellsWhatTheReaderDropped) {
    EXPECT_EQ(run("t.obj",
                  "v 0 0 0\nv .08 0 0\nv 0 .08 0\nv 0 0 .08\n"
                  "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 1 2 9\n"),
              kExitOk);
    EXPECT_EQ(result_["findings"][0]["code"], "faces_dropped");
}

// --sensor is for clouds, three numbers.
TEST_F(DoctorCommand, RefusesAWrongSensor) {
    ObjectArguments object;
    run("t.off", kTetrahedron, 0.001);
    object.file = (std::filesystem::path(output_.out).parent_path() / "t.off").string();
    for (const char* sensor : {"0,0", "0,0,up", "0,0,nan", "1,2,3,4"}) {
        object.sensor = sensor;
        const auto file = read_object_file(object);
        ASSERT_FALSE(file.ok()) << sensor;
        EXPECT_THAT(file.error().detail, HasSubstr(std::string("--sensor = ") + sensor));
    }
    object.sensor = "0,0,0.5";
    EXPECT_TRUE(read_object_file(object).ok());
}

}  // namespace
}  // namespace graspd::cli
