#include "guarded_type.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <memory>

#include <fastcdr/Cdr.h>
#include <graspd_msgs/graspdPubSubTypes.h>

#include "convert_reply.hpp"
#include "convert_request.hpp"
#include "received_request.hpp"
#include "support/plan_samples.hpp"

namespace graspd::dds {
namespace {

using eprosima::fastcdr::Cdr;
using eprosima::fastrtps::rtps::SerializedPayload_t;
using Bytes = std::vector<std::uint8_t>;

/// A sample of each topic's type with every sequence filled.
void fill(wire::GraspRequest_& sample) {
    sample = write_request(test::full_request(), "client").value();
    FirstError none;
    sample.object_key("key");
    sample.cloud().header().frame_id("table");
    sample.cloud().fields().resize(2);
    sample.cloud().fields()[0].name("intensity");
    sample.cloud().data({1, 2, 3});
    sample.sensor_origin().resize(1);
    sample.gripper("name");
    sample.grippers()[0].palm_meshes().resize(1);
    sample.grippers()[0].palm_meshes()[0].vertices().resize(2);
    sample.obstacle_cloud().data({4});
    sample.options()[0].markers(true);
}
void fill(wire::RankedGrasps_& sample) {
    sample = write_reply(test::full_reply(), {});
}
void fill(wire::CancelRequest_& sample) {
    sample.client_id("client");
    sample.request_id("abc");
}
void fill(wire::PlannerStatus_& sample) {
    sample.planner_id("p");
    sample.state(1);
    sample.grippers({"one", "", "three"});
}
void fill(graspd_msgs::srv::dds_::PlanGrasps_Request_& sample) {
    fill(sample.request());
}
void fill(graspd_msgs::srv::dds_::PlanGrasps_Response_& sample) {
    fill(sample.reply());
}
void fill(visualization_msgs::msg::dds_::MarkerArray_& sample) {
    sample.markers().resize(2);
    auto& marker = sample.markers()[1];
    marker.ns("grasps");
    marker.points().resize(3);
    marker.colors().resize(2);
    marker.texture().data({1, 2, 3, 4, 5});
    marker.uv_coordinates().resize(1);
    marker.text("t");
    marker.mesh_file().filename("f");
    marker.mesh_file().data({1});
    marker.mesh_use_embedded_materials(true);
}
void fill(diagnostic_msgs::msg::dds_::DiagnosticArray_& sample) {
    sample.header().frame_id("f");
    sample.status().resize(2);
    sample.status()[1].name("name");
    sample.status()[1].values().resize(2);
    sample.status()[1].values()[0].key("k");
}
template <class Info>
void fill_entities(Info& sample) {
    sample.node_entities_info_seq().resize(2);
    sample.node_entities_info_seq()[0].node_name("graspd");
    sample.node_entities_info_seq()[0].reader_gid_seq().resize(2);
    sample.node_entities_info_seq()[1].writer_gid_seq().resize(1);
}
void fill(rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_& sample) {
    fill_entities(sample);
}
void fill(rmw_dds_common_gid24::msg::dds_::ParticipantEntitiesInfo_& s) {
    fill_entities(s);
}

template <class Struct>
Bytes serialized(const Struct& sample, Cdr::Endianness order) {
    Bytes bytes(Struct::getCdrSerializedSize(sample) + 4);
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
    Cdr cdr(buffer, order, Cdr::DDS_CDR);
    cdr.serialize_encapsulation();
    sample.serialize(cdr);
    bytes.resize(cdr.getSerializedDataLength());
    return bytes;
}

template <class Struct>
Bytes filled_bytes(Cdr::Endianness order = Cdr::LITTLE_ENDIANNESS) {
    Struct sample;
    fill(sample);
    return serialized(sample, order);
}

template <class Generated>
class Guarded : public testing::Test {
protected:
    using Struct = typename Generated::type;

    bool accepts(const Bytes& bytes) {
        SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size()) + 1);
        std::ranges::copy(bytes, payload.data);
        payload.length = static_cast<std::uint32_t>(bytes.size());
        void* sample = type_.createData();
        const bool accepted = type_.deserialize(&payload, sample);
        if (accepted) again_ = serialized(*static_cast<Struct*>(sample), Cdr::LITTLE_ENDIANNESS);
        type_.deleteData(sample);
        return accepted;
    }

    std::shared_ptr<PayloadGuard> guard_ = std::make_shared<PayloadGuard>();
    GuardedType<Generated> type_{guard_};
    Bytes again_;  ///< what was accepted last, serialized again
};

using TopicTypes =
    testing::Types<wire::GraspRequest_PubSubType, wire::RankedGrasps_PubSubType,
                   wire::CancelRequest_PubSubType, wire::PlannerStatus_PubSubType,
                   graspd_msgs::srv::dds_::PlanGrasps_Request_PubSubType,
                   graspd_msgs::srv::dds_::PlanGrasps_Response_PubSubType,
                   visualization_msgs::msg::dds_::MarkerArray_PubSubType,
                   diagnostic_msgs::msg::dds_::DiagnosticArray_PubSubType,
                   rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_PubSubType,
                   rmw_dds_common_gid24::msg::dds_::ParticipantEntitiesInfo_PubSubType>;
TYPED_TEST_SUITE(Guarded, TopicTypes);

// The walk and the generated reader agree on every type, in both byte orders, filled or empty.
TYPED_TEST(Guarded, AcceptsWhatIsWellFormed) {
    using Sample = typename TypeParam::type;
    for (const auto order : {Cdr::LITTLE_ENDIANNESS, Cdr::BIG_ENDIANNESS}) {
        ASSERT_TRUE(this->accepts(filled_bytes<Sample>(order)));
        EXPECT_EQ(this->again_, filled_bytes<Sample>());
        ASSERT_TRUE(this->accepts(serialized(Sample{}, order)));
        EXPECT_EQ(this->again_, serialized(Sample{}, Cdr::LITTLE_ENDIANNESS));
    }
    EXPECT_EQ(this->guard_->rejected, 0u);
}

TYPED_TEST(Guarded, RefusesEveryTruncationAndCountsIt) {
    const Bytes bytes = filled_bytes<typename TypeParam::type>();
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_FALSE(this->accepts(Bytes(bytes.begin(), bytes.begin() + length))) << length;
    }
    EXPECT_EQ(this->guard_->rejected, bytes.size());
}

// CDR big and little endian are 0x0000 and 0x0001; parameter lists are 2 and 3, XCDR2 6 to 0xb.
TYPED_TEST(Guarded, RefusesOtherEncapsulations) {
    Bytes bytes = filled_bytes<typename TypeParam::type>();
    for (const unsigned id : {2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u, 10u, 11u, 0x63u, 0xffu}) {
        bytes[1] = static_cast<std::uint8_t>(id);
        EXPECT_FALSE(this->accepts(bytes)) << id;
    }
    bytes[0] = 0xc0;
    bytes[1] = 1;
    EXPECT_FALSE(this->accepts(bytes));
}

// Wherever a count may lie, a huge one in its place must end in a verdict: no exception, no memory.
TYPED_TEST(Guarded, SurvivesHugeNumbersAnywhere) {
    const Bytes good = filled_bytes<typename TypeParam::type>();
    for (std::size_t at = 4; at + 4 <= good.size(); at += 4) {
        for (const unsigned top : {0x00u, 0x10u, 0x7fu, 0xffu}) {
            Bytes bytes = good;
            bytes[at] = bytes[at + 1] = bytes[at + 2] = 0xff;
            bytes[at + 3] = static_cast<std::uint8_t>(top);
            this->accepts(bytes);
        }
    }
}

TYPED_TEST(Guarded, SurvivesEveryFlippedByte) {
    const Bytes good = filled_bytes<typename TypeParam::type>();
    for (std::size_t at = 0; at < good.size(); ++at) {
        for (const unsigned mask : {0x01u, 0x02u, 0x80u, 0xffu}) {
            Bytes bytes = good;
            bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ mask);
            this->accepts(bytes);
        }
    }
}

using GuardedRequest = Guarded<wire::GraspRequest_PubSubType>;

TEST_F(GuardedRequest, RefusesAPayloadAboveItsCap) {
    const Bytes bytes = filled_bytes<wire::GraspRequest_>();
    guard_->max_payload_bytes = static_cast<std::uint32_t>(bytes.size());
    EXPECT_TRUE(accepts(bytes));
    guard_->max_payload_bytes -= 1;
    EXPECT_FALSE(accepts(bytes));
    EXPECT_EQ(guard_->rejected, 1u);
}

TEST_F(GuardedRequest, RefusesNothingAtAll) {
    wire::GraspRequest_ sample;
    SerializedPayload_t empty;
    EXPECT_FALSE(type_.deserialize(&empty, &sample));
    EXPECT_FALSE(type_.deserialize(nullptr, &sample));
}

// The last 16 bytes are sources, three booleans, 4 bytes of padding and the seed.
TEST_F(GuardedRequest, RefusesABooleanOfTwo) {
    Bytes bytes = filled_bytes<wire::GraspRequest_>();
    const std::size_t at = bytes.size() - 15;
    ASSERT_EQ(bytes[at - 1], kBoundary | kWholeObject);
    ASSERT_EQ(bytes[at], 1);  // markers
    bytes[at] = 2;
    EXPECT_FALSE(accepts(bytes));
}

// A million grippers in as many bytes: fastcdr alone would first make room for them, 300 MB. The
// walk alone must refuse it, whatever stands in the bytes.
TEST_F(GuardedRequest, RefusesMoreElementsThanTheBytesCanHold) {
    wire::GraspRequest_ sample;
    const std::size_t with_none = serialized(sample, Cdr::LITTLE_ENDIANNESS).size();
    Bytes bytes = serialized(sample, Cdr::LITTLE_ENDIANNESS);
    bytes.resize(with_none + 1'000'100, 0);  // not what a string or octets of that length need
    const CdrStruct* layout = wire_layouts().find("graspd_msgs::msg::dds_::GraspRequest_");
    ASSERT_NE(layout, nullptr);
    for (std::size_t at = 4; at + 4 <= with_none; at += 4) {
        Bytes many = bytes;
        many[at] = 0x40;
        many[at + 1] = 0x42;
        many[at + 2] = 0x0f;  // 1'000'000
        EXPECT_FALSE(is_well_formed(many, *layout)) << at;
        EXPECT_FALSE(accepts(many)) << at;
    }
}

/// What the guard makes of a payload.
std::unique_ptr<ReceivedSample> received(Bytes bytes, std::uint32_t max_payload_bytes = 256u << 20,
                                         const RequestLimits& limits = {}) {
    auto guard = std::make_shared<PayloadGuard>();
    guard->max_payload_bytes = max_payload_bytes;
    guard->limits = limits;
    GuardedType<wire::GraspRequest_PubSubType, ReceivedSample> type(guard);
    SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size()));
    std::ranges::copy(bytes, payload.data);
    payload.length = static_cast<std::uint32_t>(bytes.size());
    std::unique_ptr<ReceivedSample> sample(static_cast<ReceivedSample*>(type.createData()));
    if (!type.deserialize(&payload, sample.get())) sample.reset();
    EXPECT_EQ(guard->rejected.load(), sample ? 0u : 1u);
    return sample;
}

Bytes bytes_of_request(const std::function<void(wire::GraspRequest_&)>& change = {}) {
    wire::GraspRequest_ sample;
    fill(sample);
    if (change) change(sample);
    return cdr_bytes(sample);
}

TEST(ReceivedPayload, HashTellsEveryByteOfThePayload) {
    const Bytes bytes = bytes_of_request();
    const auto same = received(bytes);
    ASSERT_TRUE(same);
    EXPECT_EQ(same->request_id(), "a request");
    EXPECT_EQ(received(bytes)->payload_hash, same->payload_hash);
    std::size_t read = 0;
    for (std::size_t at = 4; at < bytes.size(); ++at) {
        Bytes other = bytes;
        other[at] ^= 1;
        const auto sample = received(other);
        if (!sample) continue;
        ++read;
        EXPECT_NE(sample->payload_hash, same->payload_hash) << at;
    }
    EXPECT_GT(read, bytes.size() / 2);
}

TEST(ReceivedPayload, CountsItsGeometry) {
    const auto sample = received(bytes_of_request([](wire::GraspRequest_& r) {
        r.mesh().vertices().resize(11);
        r.mesh().triangles().resize(7);
        r.obstacles().resize(2);
        r.obstacles()[0].mesh().vertices().resize(5);
        r.obstacles()[1].mesh().vertices().resize(6);
        r.obstacles()[0].mesh().triangles().resize(3);
        r.obstacles()[1].mesh().triangles().resize(4);
        r.cloud().width(5);
        r.cloud().height(3);
        r.cloud().data(std::vector<std::uint8_t>(15 * 12));
    }));
    ASSERT_TRUE(sample);
    EXPECT_FALSE(sample->refused) << sample->refused->detail;
    EXPECT_EQ(sample->size.vertices, 11u);
    EXPECT_EQ(sample->size.faces, 7u);
    EXPECT_EQ(sample->size.obstacle_vertices, 11u);
    EXPECT_EQ(sample->size.obstacle_faces, 7u);
    EXPECT_EQ(sample->size.points, 15u);
}

struct OverLimit {
    const char* name;
    std::function<void(wire::GraspRequest_&)> change;
    std::vector<std::string> says;
};
void PrintTo(const OverLimit& over, std::ostream* out) {
    *out << over.name;
}

class GuardedLimit : public testing::TestWithParam<OverLimit> {};

// Nothing but the names is read of what is over a limit, so that it can be answered.
TEST_P(GuardedLimit, IsToldByFieldCountAndLimit) {
    const RequestLimits limits{100, 90, 80, 70};
    const auto fits = received(bytes_of_request(), 1u << 20, limits);
    ASSERT_TRUE(fits);
    ASSERT_FALSE(fits->refused) << fits->refused->detail;
    const auto sample = received(bytes_of_request(GetParam().change), 8u << 20, limits);
    ASSERT_TRUE(sample);
    ASSERT_TRUE(sample->refused);
    EXPECT_EQ(sample->refused->code, PlanErrorCode::kTooLarge);
    for (const std::string& part : GetParam().says) {
        EXPECT_THAT(sample->refused->detail, testing::HasSubstr(part));
    }
    EXPECT_EQ(sample->request_id(), "a request");
    EXPECT_EQ(sample->client_id(), "client");
    EXPECT_EQ(sample->header().frame_id(), fits->header().frame_id());
}

using Wire = wire::GraspRequest_;
const OverLimit kOverLimits[] = {
    {"Vertices",
     [](Wire& r) { r.mesh().vertices().resize(101); },
     {"mesh.vertices = 101", "condition_mesh.max_vertices = 100"}},
    {"Faces",
     [](Wire& r) { r.mesh().triangles().resize(91); },
     {"mesh.triangles = 91", "condition_mesh.max_faces = 90"}},
    {"ObstacleFacesTogether",
     [](Wire& r) {
         r.obstacles().resize(2);
         r.obstacles()[0].mesh().triangles().resize(40);
         r.obstacles()[1].mesh().triangles().resize(31);
     },
     {"obstacles.triangles = 71", "server.max_obstacle_faces = 70"}},
    {"ObstacleVertices",
     [](Wire& r) {
         r.obstacles().resize(1);
         r.obstacles()[0].mesh().vertices().resize(211);
     },
     {"obstacles.vertices = 211", "3 x server.max_obstacle_faces = 210"}},
    {"Points",
     [](Wire& r) {
         r.cloud().width(81);
         r.cloud().height(1);
         r.cloud().data(std::vector<std::uint8_t>(81 * 12));
     },
     {"cloud.width x cloud.height = 81", "triangulate_cloud.limit_points = 80"}},
    {"Grippers", [](Wire& r) { r.grippers().resize(9); }, {"grippers has 9", "at most 8"}},
    {"Obstacles", [](Wire& r) { r.obstacles().resize(65); }, {"obstacles has 65", "at most 64"}},
    {"Cones",
     [](Wire& r) { r.approach_cones().resize(65); },
     {"approach_cones has 65", "at most 64"}},
    {"CloudFields",
     [](Wire& r) { r.cloud().fields().resize(257); },
     {"cloud.fields = 257", "limit 256"}},
    {"GripperParts",
     [](Wire& r) { r.grippers()[0].palm_meshes()[0].vertices().resize(100001); },
     {"grippers.vertices = 100001", "limit 100000"}},
};
INSTANTIATE_TEST_SUITE_P(Guard, GuardedLimit, testing::ValuesIn(kOverLimits),
                         [](const auto& over) { return over.param.name; });

TEST(ReceivedPayload, ATooLargePayloadIsToldWithItsNames) {
    const Bytes bytes = bytes_of_request();
    const auto limit = static_cast<std::uint32_t>(bytes.size() - 1);
    const auto sample = received(bytes, limit);
    ASSERT_TRUE(sample);
    ASSERT_TRUE(sample->refused);
    EXPECT_THAT(sample->refused->detail,
                testing::AllOf(testing::HasSubstr("payload = " + std::to_string(bytes.size())),
                               testing::HasSubstr("max_payload_bytes = " + std::to_string(limit))));
    EXPECT_EQ(sample->request_id(), "a request");
    Bytes broken = bytes;
    std::fill_n(broken.begin() + 4, 16, std::uint8_t{0xff});  // no names to be read
    EXPECT_FALSE(received(broken, limit));
}

}  // namespace
}  // namespace graspd::dds
