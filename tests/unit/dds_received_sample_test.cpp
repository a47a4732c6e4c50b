// A request read in blocks, against the same bytes read by the generated code.
#include "received_sample.hpp"

#include <gtest/gtest.h>

#include <fastcdr/Cdr.h>
#include <graspd_msgs/graspdPubSubTypes.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "convert_request.hpp"
#include "graspd/base/content_hash.hpp"
#include "guarded_type.hpp"
#include "support/plan_samples.hpp"

namespace graspd::dds {
namespace {

using eprosima::fastcdr::Cdr;
using Bytes = std::vector<std::uint8_t>;

/// Everything that a request can hold; coordinates whose eight bytes all differ.
wire::GraspRequest_ full_sample() {
    wire::GraspRequest_ sample = write_request(test::full_request(), "client").value();
    sample.cloud().header().frame_id("table");
    sample.cloud().fields().resize(2);
    sample.cloud().fields()[1].name("intensity");
    sample.cloud().data({1, 2, 3});
    sample.sensor_origin().resize(1);
    sample.sensor_origin()[0].y(0.1);
    sample.gripper("name");
    sample.obstacle_cloud().data({4});
    sample.mesh().vertices().resize(5);
    sample.mesh().triangles().resize(3);
    for (std::size_t i = 0; i < 5; ++i) {
        auto& vertex = sample.mesh().vertices()[i];
        vertex.x(0.1 + static_cast<double>(i));
        vertex.y(-1.0 / (3.0 + static_cast<double>(i)));
        vertex.z(i == 4 ? std::numeric_limits<double>::infinity() : 1e-7);
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
        sample.mesh().triangles()[i].vertex_indices({i, 0x01020304u + i, 4294967295u});
    }
    return sample;
}

Bytes serialized(const wire::GraspRequest_& sample, Cdr::Endianness order) {
    Bytes bytes(wire::GraspRequest_::getCdrSerializedSize(sample) + 8);
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
    Cdr cdr(buffer, order, Cdr::DDS_CDR);
    cdr.serialize_encapsulation();
    sample.serialize(cdr);
    bytes.resize(cdr.getSerializedDataLength());
    return bytes;
}

/// The mesh back in its place, so that one comparison sees every field.
wire::GraspRequest_ with_mesh(const ReceivedSample& sample) {
    wire::GraspRequest_ whole = sample;
    EXPECT_TRUE(is_empty(whole.mesh()));
    whole.mesh(write_mesh(sample.mesh_O));
    return whole;
}

void expect_read_back(const wire::GraspRequest_& sample) {
    for (const auto order : {Cdr::LITTLE_ENDIANNESS, Cdr::BIG_ENDIANNESS}) {
        SCOPED_TRACE(order == Cdr::BIG_ENDIANNESS ? "big endian" : "little endian");
        Bytes bytes = serialized(sample, order);
        ASSERT_TRUE(
            is_well_formed(bytes, *wire_layouts().find("graspd_msgs::msg::dds_::GraspRequest_")));
        ReceivedSample read;
        read.read(bytes);
        EXPECT_TRUE(with_mesh(read) == sample);
        EXPECT_EQ(read.payload_hash, content_hash(std::as_bytes(std::span(bytes))));
    }
}

// The id's length moves what follows over every alignment; one face less moves the vertices by 12.
TEST(ReceivedSample, ReadsWhatTheGeneratedCodeReads) {
    wire::GraspRequest_ sample = full_sample();
    for (std::size_t length = 1; length <= 9; ++length) {
        SCOPED_TRACE(length);
        sample.object_key(std::string(length, 'k'));
        sample.mesh().triangles().resize(3);
        expect_read_back(sample);
        sample.mesh().triangles().resize(2);
        expect_read_back(sample);
    }
}

TEST(ReceivedSample, ReadsMeshesWithoutFacesOrVertices) {
    wire::GraspRequest_ sample = full_sample();
    sample.mesh().triangles().clear();
    expect_read_back(sample);
    sample = full_sample();
    sample.mesh().vertices().clear();
    expect_read_back(sample);
    sample.mesh().triangles().clear();
    expect_read_back(sample);
    expect_read_back({});
}

// A sample that the middleware uses again must not keep the last one's mesh.
TEST(ReceivedSample, HoldsTheLastThatWasRead) {
    ReceivedSample read;
    Bytes full = serialized(full_sample(), Cdr::LITTLE_ENDIANNESS);
    read.read(full);
    EXPECT_EQ(read.mesh_O.faces.size(), 3u);
    Bytes empty = serialized({}, Cdr::LITTLE_ENDIANNESS);
    read.read(empty);
    EXPECT_TRUE(read.mesh_O.faces.empty());
    EXPECT_TRUE(read.mesh_O.vertices.empty());
}

TEST(ReceivedSample, IsConvertedWithItsMesh) {
    const PlanRequest request = test::full_request();
    Bytes bytes = serialized(write_request(request, "client").value(), Cdr::LITTLE_ENDIANNESS);
    ReceivedSample read;
    read.read(bytes);
    const auto converted = read_request(read, read.mesh_O, {});
    ASSERT_TRUE(converted.ok()) << converted.error().detail;
    test::expect_same(request, converted.value());
}

// What the guard lets through is read; every shorter payload is refused, whatever is missing.
TEST(ReceivedSample, TheGuardStandsBeforeIt) {
    GuardedType<wire::GraspRequest_PubSubType, ReceivedSample> type(
        std::make_shared<PayloadGuard>());
    const Bytes bytes = serialized(full_sample(), Cdr::LITTLE_ENDIANNESS);
    for (std::size_t size = 0; size <= bytes.size(); ++size) {
        const auto length = static_cast<std::uint32_t>(size);
        eprosima::fastrtps::rtps::SerializedPayload_t payload(length);
        std::copy_n(bytes.begin(), size, payload.data);
        payload.length = length;
        const std::unique_ptr<ReceivedSample> sample(
            static_cast<ReceivedSample*>(type.createData()));
        EXPECT_EQ(type.deserialize(&payload, sample.get()), size == bytes.size()) << size;
    }
}

// Whoever records requests wants those that are refused by a count too, but not those that are too
// large to be read.
TEST(ReceivedSample, KeepsItsBytesWhereThatIsAskedFor) {
    Bytes bytes = serialized(full_sample(), Cdr::LITTLE_ENDIANNESS);
    const auto kept = [&bytes](const PayloadGuard& guard) {
        ReceivedSample sample;
        sample.payload = std::make_shared<ReceivedPayload>();
        EXPECT_TRUE(sample.read(bytes, guard));
        return sample;
    };
    PayloadGuard guard;
    EXPECT_FALSE(kept(guard).refused);
    EXPECT_EQ(kept(guard).payload->bytes, bytes);
    guard.limits.max_faces = 2;
    EXPECT_TRUE(kept(guard).refused);
    EXPECT_EQ(kept(guard).payload->bytes, bytes);
    guard.max_payload_bytes = static_cast<std::uint32_t>(bytes.size() - 1);
    EXPECT_TRUE(kept(guard).refused);
    EXPECT_EQ(kept(guard).payload, nullptr);
    ReceivedSample plain;
    EXPECT_TRUE(plain.read(bytes, PayloadGuard{}));
    EXPECT_EQ(plain.payload, nullptr);
}

}  // namespace
}  // namespace graspd::dds
