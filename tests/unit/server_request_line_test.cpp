#include "request_line.hpp"

#include <gmock/gmock.h>

#include "server_fakes.hpp"

namespace graspd::server {
namespace {

using test::FakeRequest;
using testing::HasSubstr;

Answer answer_to(const std::string& request_id, const std::string& client_id) {
    auto to = std::make_shared<FakeRequest>(1, request_id);
    to->id.client_id = client_id;
    Answer answer;
    answer.out.to = to;
    answer.out.attempt = 2;
    answer.out.reply.status = PlanStatus::kNoGrasp;
    answer.out.reply.message = "too wide";
    answer.out.reply.report.stages = {{"mesh/condition_mesh", 1.25, 8, 8}};
    answer.work = {8, 0.5, 1.0, 20.125};
    answer.total_ms = 22.0;
    answer.written = true;
    return answer;
}

TEST(RequestLine, SaysWhoWhatAndHowLong) {
    EXPECT_EQ(request_line(answer_to("mug-7", "arm/left")),
              "id=mug-7 client=arm/left status=NO_GRASP attempt=2 written=yes points=8 grasps=0 "
              "total_ms=22.00 queue_ms=0.50 convert_ms=1.00 plan_ms=20.12 "
              "mesh/condition_mesh_ms=1.25 message=\"too wide\"");
}

// A client that puts a line end and a status of its own into its id must not forge the log.
TEST(RequestLine, IsOneLineWhateverTheClientSends) {
    const std::string line = request_line(answer_to("a\nid=b status=OK", "x\" \\\x1b[2J"));
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_THAT(line, HasSubstr(R"(id="a?id=b status=OK" client="x\" \\?[2J" status=NO_GRASP)"));
    EXPECT_THAT(request_line(answer_to("", "")), HasSubstr(R"(id="" client="" )"));
}

}  // namespace
}  // namespace graspd::server
