// The page of --report: its data, held against the reply and against shapes worked by hand, and
// that it is one page by itself whatever the names in it. All lengths in the comments in mm.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "base64.hpp"
#include "commands.hpp"
#include "graspd/planner/planner.hpp"
#include "report_data.hpp"
#include "support/shapes.hpp"
#include "write_json.hpp"
#include "write_report.hpp"

namespace graspd::cli {
namespace {

using nlohmann::json;

/// The bytes of base64 text, by the alphabet's own order.
std::vector<std::uint8_t> bytes_of(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::uint8_t> bytes;
    std::uint32_t bits = 0;
    int held = 0;
    for (const char character : text) {
        if (character == '=') break;
        bits = (bits << 6) | static_cast<std::uint32_t>(digits.find(character));
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes.push_back(static_cast<std::uint8_t>((bits >> held) & 255U));
    }
    return bytes;
}

template <class Number>
std::vector<Number> numbers_of(const json& text) {
    const auto bytes = bytes_of(text.get<std::string>());
    std::vector<Number> numbers(bytes.size() / sizeof(Number));
    EXPECT_EQ(numbers.size() * sizeof(Number), bytes.size());
    if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

struct TracedPlan {
    ProcessPlan plan;
    PlanTrace trace;
};

/// Plates of 60 x 48 x 10 on a neck of 20 x 20 x 30, in F at (1, 2, 3) m, on a plane.
TracedPlan planned() {
    TracedPlan traced;
    PlanRequest& request = traced.plan.request;
    request.request_id = "hourglass";
    request.frame_id = "table";
    request.object_O = test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 1000);
    request.X_FO.translation() = Eigen::Vector3d(1.0, 2.0, 3.0);
    request.support_plane = SupportPlane{Eigen::Vector3d::UnitZ(), 2.975};
    request.obstacles = {
        {test::box({0.02, 0.04, 0.06}), request.X_FO * Eigen::Translation3d(1, 0, 0)}};
    request.grippers = {Gripper{}};
    request.grippers.front().name = "plain";
    traced.plan.reply = plan(request, {}, {}, &traced.trace);
    traced.plan.origin = {"0.1.0", "abcd", 12.5};
    return traced;
}

json data_of(const TracedPlan& traced, const std::string& file = "hourglass.stl") {
    return json::parse(report_data(traced.plan, traced.trace, file));
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// What a browser takes for the page's data: from the element's begin to the first end tag.
json data_in(const std::string& page) {
    const std::string begin = "<script id=\"graspd-data\" type=\"application/json\">";
    const std::size_t from = page.find(begin);
    EXPECT_NE(from, std::string::npos);
    const std::size_t to = page.find("</script", from);
    return json::parse(page.substr(from + begin.size(), to - from - begin.size()));
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
    return count;
}

// RFC 4648, section 10.
TEST(Base64, IsThatOfTheRfc) {
    const std::map<std::string, std::string> known = {{"", ""},
                                                      {"f", "Zg=="},
                                                      {"fo", "Zm8="},
                                                      {"foo", "Zm9v"},
                                                      {"foob", "Zm9vYg=="},
                                                      {"fooba", "Zm9vYmE="},
                                                      {"foobar", "Zm9vYmFy"}};
    for (const auto& [plain, text] : known) {
        EXPECT_EQ(base64_of(std::vector<std::uint8_t>(plain.begin(), plain.end())), text);
    }
    EXPECT_EQ(base64_of(std::vector<std::uint8_t>{0xff, 0xff, 0xfe}), "///+");
    EXPECT_EQ(base64_of(std::vector<std::uint32_t>{1}), "AQAAAA==");
}

TEST(ReportData, HoldsTheReplyAsItIs) {
    const TracedPlan traced = planned();
    ASSERT_EQ(traced.plan.reply.status, PlanStatus::kOk);
    const json data = data_of(traced);
    EXPECT_EQ(data["schema"], "graspd-report/1");
    EXPECT_EQ(data["file"], "hourglass.stl");
    EXPECT_EQ(data["reply"], json::parse(write_json(traced.plan.reply, traced.plan.request.grippers,
                                                    traced.plan.origin)));
}

// The object's middle is the origin: what is drawn is a box of 60 x 48 x 50 about it.
TEST(ReportData, TheObjectLiesAboutTheOrigin) {
    const TracedPlan traced = planned();
    const json data = data_of(traced);
    EXPECT_NEAR(data["origin"][0], 1.0, 1e-6);
    EXPECT_NEAR(data["origin"][1], 2.0, 1e-6);
    EXPECT_NEAR(data["origin"][2], 3.0, 1e-6);
    const json& object = data["object"];
    const auto vertices = numbers_of<float>(object["vertices"]);
    const auto& mesh = traced.trace.object.mesh_P;
    ASSERT_EQ(vertices.size(), 3 * mesh.vertices.size());
    const float half[] = {0.03F, 0.024F, 0.025F};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float most = 0.0F;
        for (std::size_t i = axis; i < vertices.size(); i += 3) {
            most = std::max(most, std::abs(vertices[i]));
        }
        EXPECT_NEAR(most, half[axis], 1e-6);
    }
    EXPECT_EQ(numbers_of<std::uint32_t>(object["faces"]).size(), 3 * mesh.faces.size());
    EXPECT_EQ(numbers_of<float>(object["concavity"]).size(), mesh.vertices.size());
    EXPECT_EQ(bytes_of(object["flags"]).size(), mesh.vertices.size());
    EXPECT_EQ(numbers_of<std::uint32_t>(object["hull"]), traced.trace.object.hull);
    const auto concavity = numbers_of<float>(object["concavity"]);
    EXPECT_NEAR(*std::ranges::max_element(concavity), 0.02, 1e-6);
}

TEST(ReportData, HasEveryCandidateWithItsVerdict) {
    const TracedPlan traced = planned();
    const json data = data_of(traced);
    const json& candidates = data["candidates"];
    const auto reason = bytes_of(candidates["reason"]);
    ASSERT_EQ(reason.size(), candidates["count"]);
    std::map<std::string, std::size_t> counts;
    for (const std::uint8_t number : reason) ++counts[candidates["reasons"][number]];
    EXPECT_EQ(counts[""], traced.plan.reply.grasps.size());
    counts.erase("");
    EXPECT_EQ(
        json(counts),
        json(data["reply"]["report"]["rejections"].get<std::map<std::string, std::size_t>>()));
    EXPECT_EQ(candidates["units"].size(), candidates["reasons"].size());
    for (const char* column : {"width", "margin", "beta", "min_friction", "score"}) {
        EXPECT_EQ(numbers_of<float>(candidates[column]).size(), reason.size()) << column;
    }
    EXPECT_EQ(numbers_of<float>(candidates["position"]).size(), 3 * reason.size());
    EXPECT_EQ(numbers_of<float>(candidates["quaternion"]).size(), 4 * reason.size());
    EXPECT_EQ(numbers_of<std::int32_t>(candidates["concavity"]).size(), reason.size());
}

// The last candidate that is in the reply stands where the reply's last grasp does.
TEST(ReportData, CandidatesOfTheReplyStandWhereItSays) {
    const TracedPlan traced = planned();
    const json data = data_of(traced);
    const auto position = numbers_of<float>(data["candidates"]["position"]);
    const auto quaternion = numbers_of<float>(data["candidates"]["quaternion"]);
    const auto beta = numbers_of<float>(data["candidates"]["beta"]);
    const json& grasp = data["reply"]["grasps"].back();
    const std::size_t last = beta.size() - 1;
    double along = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(position[3 * last + k],
                    grasp["position"][k].get<double>() - data["origin"][k].get<double>(), 1e-6);
    }
    for (std::size_t k = 0; k < 4; ++k) {
        along += double{quaternion[4 * last + k]} * grasp["quaternion"][k].get<double>();
    }
    EXPECT_NEAR(std::abs(along), 1.0, 1e-6);
    EXPECT_NEAR(beta[last], grasp["beta_rad"].get<double>(), 1e-6);
}

// Pads are as far apart as the reply says, open and closed; the fingers are 10 thick.
TEST(ReportData, HandsAreOpenAndClosedAsTheReplySays) {
    const json data = data_of(planned());
    ASSERT_EQ(data["hands"].size(), data["reply"]["grasps"].size());
    for (std::size_t i = 0; i < data["hands"].size(); ++i) {
        const json& grasp = data["reply"]["grasps"][i];
        for (const auto& [when, width] :
             {std::pair("open", "open_width"), std::pair("contact", "width")}) {
            const json& parts = data["hands"][i][when];
            ASSERT_EQ(parts.size(), 3U);
            EXPECT_EQ(parts[0]["member"], "palm");
            const double left = parts[1]["box"]["max"][0], right = parts[2]["box"]["min"][0];
            EXPECT_NEAR(right - left, grasp[width], 1e-9);
            EXPECT_NEAR(parts[2]["box"]["max"][0].get<double>() - right, 0.01, 1e-9);
        }
    }
}

// Convex parts take the place of the boxes: a finger tip of 4 points that goes where its pad goes.
TEST(ReportData, ConvexPartsAreDrawnInPlaceOfBoxes) {
    TracedPlan traced = planned();
    Gripper& gripper = traced.plan.request.grippers.front();
    const double z = pad_z_m(gripper, gripper.max_width_m), x = 0.5 * gripper.max_width_m;
    gripper.convex_parts = {{"tip",
                             GripperMember::kFingerRight,
                             {{x, 0, z}, {x + 0.01, 0, z}, {x, 0.01, z}, {x, 0, z + 0.01}},
                             -1}};
    const json data = data_of(traced);
    const Grasp& grasp = traced.plan.reply.grasps.front();
    const json& hand = data["hands"][0];
    ASSERT_EQ(hand["contact"].size(), 1U);
    EXPECT_EQ(hand["contact"][0]["member"], "finger_right");
    EXPECT_NEAR(numbers_of<float>(hand["contact"][0]["points"])[0], 0.5 * grasp.width_m, 1e-7);
    EXPECT_NEAR(numbers_of<float>(hand["open"][0]["points"])[0], 0.5 * grasp.open_width_m, 1e-7);
}

TEST(ReportData, SurroundingsAreThoseOfTheRequest) {
    const json data = data_of(planned());
    EXPECT_EQ(data["request"]["support_plane"]["offset"], 2.975);
    EXPECT_EQ(data["request"]["grippers"], json::array({"plain"}));
    ASSERT_EQ(data["request"]["obstacles"].size(), 1U);
    const auto corner = numbers_of<float>(data["request"]["obstacles"][0]["vertices"]);
    ASSERT_GE(corner.size(), 3U);
    EXPECT_NEAR(std::abs(corner[0] - 1.0F), 0.01, 1e-6);
    EXPECT_NEAR(std::abs(corner[1]), 0.02, 1e-6);
    EXPECT_NEAR(std::abs(corner[2]), 0.03, 1e-6);
}

TEST(ReportData, OfARefusedRequestIsThereAllTheSame) {
    TracedPlan traced = planned();
    traced.plan.request.options.friction = -1.0;
    traced.plan.reply = plan(traced.plan.request, {}, {}, &traced.trace);
    const json data = data_of(traced);
    EXPECT_EQ(data["reply"]["status"], "INVALID_REQUEST");
    EXPECT_EQ(data["object"]["vertices"], "");
    EXPECT_EQ(data["candidates"]["count"], 0);
    EXPECT_TRUE(data["hands"].empty());
}

TEST(ReportPage, NamesCannotLeaveTheData) {
    TracedPlan traced = planned();
    const std::string odd = "a</script><script>alert(1)</script><!--.stl";
    traced.plan.reply.request_id = odd + "\"\\\n";
    traced.plan.reply.report.findings = {{"odd", 1.0, "\xff\xfe bytes of no text"}};
    const std::string page =
        report_page(report_template(), report_data(traced.plan, traced.trace, "/tmp/" + odd));
    const std::string bare(report_template());
    EXPECT_EQ(count_of(page, "</script"), count_of(bare, "</script"));
    EXPECT_EQ(count_of(page, "<script"), count_of(bare, "<script"));
    EXPECT_EQ(count_of(page, "<!--"), count_of(bare, "<!--"));
    const json data = data_in(page);
    EXPECT_EQ(data["reply"]["request_id"], odd + "\"\\\n");
    // A file name cannot hold a slash, so only what follows the last one is left.
    EXPECT_EQ(data["file"], "script><!--.stl");
    EXPECT_THAT(data["reply"]["report"]["findings"][0]["detail"].get<std::string>(),
                testing::HasSubstr("bytes of no text"));
}

TEST(ReportPage, LoadsNothingFromAnywhere) {
    const std::string page(report_template());
    EXPECT_EQ(count_of(page, "GRASPD_REPORT_DATA"), 1U);
    EXPECT_THAT(page, testing::HasSubstr("default-src 'none'"));
    for (const char* loading : {"<link", "<img", "<iframe", "<script src", "@import", "url(http",
                                "src=\"http", "href=\"http", "src=\"//", "import(", "importScripts",
                                "new Worker", "XMLHttpRequest", "WebSocket", "sendBeacon"}) {
        EXPECT_EQ(count_of(page, loading), 0U) << loading;
    }
    EXPECT_LT(page.size(), 1200000U);
}

// The whole way: the program's files lie side by side and say the same.
TEST(RunPlan, WritesThePageBesideTheReply) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "cli_report_test";
    PlanArguments plan;
    plan.object.file = GRASPD_SOURCE_DIR "/examples/objects/koala_bear.obj";
    OutputArguments output;
    output.report = folder.string();
    output.out = (folder / "out.txt").string();
    EXPECT_EQ(run_plan(plan, "", output), 0);
    const json reply = json::parse(text_of(folder / "reply.json"));
    const json data = data_in(text_of(folder / "report.html"));
    EXPECT_EQ(data["reply"], reply);
    EXPECT_EQ(data["file"], "koala_bear.obj");
    EXPECT_EQ(text_of(folder / "reply.txt"), text_of(folder / "out.txt"));
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace graspd::cli
