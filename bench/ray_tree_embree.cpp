#include <algorithm>
#include <memory>
#include <type_traits>
#include <vector>

#include <embree3/rtcore.h>

#include "ray_trees.hpp"

namespace graspd::bench {
namespace {

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

template <class Value>
Value* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    return static_cast<Value*>(
        rtcSetNewGeometryBuffer(geometry, type, 0, format, 3 * sizeof(Value), count));
}

class EmbreeTree final : public RayTree {
public:
    EmbreeTree(const TriangleMesh& mesh, RTCDevice device, RTCSceneFlags flags)
        : scene_(rtcNewScene(device)) {
        const Owned<RTCGeometry> geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
        std::vector<Triangle> faces;
        faces.reserve(mesh.faces.size());
        for (const Triangle& face : mesh.faces) {
            if (has_area(mesh, face)) faces.push_back(face);
        }
        auto* places = new_buffer<float>(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                         mesh.vertices.size());
        for (const Eigen::Vector3d& vertex : mesh.vertices) {
            for (const double value : vertex) *places++ = static_cast<float>(value);
        }
        auto* corners = new_buffer<std::uint32_t>(geometry.get(), RTC_BUFFER_TYPE_INDEX,
                                                  RTC_FORMAT_UINT3, faces.size());
        for (const Triangle& face : faces) corners = std::copy(face.begin(), face.end(), corners);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometry(scene_.get(), geometry.get());
        rtcSetSceneFlags(scene_.get(), flags);
        rtcCommitScene(scene_.get());
    }
    bool blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const override {
        const Eigen::Vector3f from = a.cast<float>(), along = (b - a).cast<float>();
        RTCRay ray{};
        ray.org_x = from.x();
        ray.org_y = from.y();
        ray.org_z = from.z();
        ray.dir_x = along.x();
        ray.dir_y = along.y();
        ray.dir_z = along.z();
        ray.tfar = 1.0F;  // the direction is as long as the segment
        ray.mask = ~0U;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(scene_.get(), &context, &ray);
        return ray.tfar < 0.0F;
    }

private:
    Owned<RTCScene> scene_;
};

/// One for all trees, as Embree means it to be.
RTCDevice widest_device() {
    static const Owned<RTCDevice> device(rtcNewDevice("threads=1"));
    return device.get();
}

RTCDevice sse42_device() {
    static const Owned<RTCDevice> device(rtcNewDevice("threads=1,isa=sse4.2"));
    return device.get();
}

}  // namespace

RayTreePtr embree_fast_tree(const TriangleMesh& mesh) {
    return std::make_unique<EmbreeTree>(mesh, widest_device(), RTC_SCENE_FLAG_NONE);
}

RayTreePtr embree_robust_tree(const TriangleMesh& mesh) {
    return std::make_unique<EmbreeTree>(mesh, widest_device(), RTC_SCENE_FLAG_ROBUST);
}

RayTreePtr embree_sse42_tree(const TriangleMesh& mesh) {
    return std::make_unique<EmbreeTree>(mesh, sse42_device(), RTC_SCENE_FLAG_ROBUST);
}

}  // namespace graspd::bench
