#include "object_store.hpp"

#include <cstring>
#include <span>

namespace graspd::server {
namespace {

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    const auto of_a = std::as_bytes(std::span(a));
    const auto of_b = std::as_bytes(std::span(b));
    if (of_a.size() != of_b.size()) return false;
    return of_a.empty() || std::memcmp(of_a.data(), of_b.data(), of_a.size()) == 0;
}

std::uint64_t bytes_of(const StoredObject& object) {
    return (object.geometry ? geometry_bytes(*object.geometry) : 0) +
           (object.prepared ? memory_bytes(*object.prepared) : 0);
}

}  // namespace

std::uint64_t geometry_bytes(const ObjectGeometry& geometry) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&geometry)) {
        return mesh->vertices.size() * sizeof(Eigen::Vector3d) +
               mesh->faces.size() * sizeof(Triangle);
    }
    return std::get<PointCloud>(geometry).points.size() * sizeof(Eigen::Vector3d);
}

bool same_geometry(const ObjectGeometry& a, const ObjectGeometry& b) {
    if (a.index() != b.index()) return false;
    if (const auto* mesh = std::get_if<TriangleMesh>(&a)) {
        const auto& other = std::get<TriangleMesh>(b);
        return same_bytes(mesh->vertices, other.vertices) && same_bytes(mesh->faces, other.faces);
    }
    const auto& cloud = std::get<PointCloud>(a);
    const auto& other = std::get<PointCloud>(b);
    return cloud.sensor_origin == other.sensor_origin && same_bytes(cloud.points, other.points);
}

void ObjectStore::put(const std::string& key, ObjectGeometry geometry, PreparedObjectPtr prepared) {
    StoredObject object{std::make_shared<const ObjectGeometry>(std::move(geometry)),
                        std::move(prepared)};
    if (bytes_of(object) > max_bytes_) object.prepared = nullptr;
    const std::uint64_t bytes = bytes_of(object);
    if (bytes > max_bytes_) return;
    const std::scoped_lock lock(mutex_);
    if (!touch(key)) {
        make_room(bytes);
        newest_first_.push_front({key, {}, 0});
        by_key_.emplace(key, newest_first_.begin());
        set(newest_first_.front(), std::move(object));
        return;
    }
    Entry& known = newest_first_.front();
    if (!known.object.geometry) return;
    if (!same_geometry(*known.object.geometry, *object.geometry)) {
        set(known, {});
    } else if (!known.object.prepared && object.prepared) {
        set(known, {});
        make_room(bytes);
        set(known, std::move(object));
    }
}

StoredObject ObjectStore::find(const std::string& key) {
    const std::scoped_lock lock(mutex_);
    return touch(key) ? newest_first_.front().object : StoredObject{};
}

StoredObject ObjectStore::find(const std::string& key, const ObjectGeometry& geometry) {
    StoredObject object = find(key);
    const bool same = object.geometry && same_geometry(*object.geometry, geometry);
    return same ? object : StoredObject{};
}

std::size_t ObjectStore::size() const {
    const std::scoped_lock lock(mutex_);
    return newest_first_.size();
}

std::uint64_t ObjectStore::bytes() const {
    const std::scoped_lock lock(mutex_);
    return bytes_;
}

/// Makes a known object the newest. @return whether it is known
bool ObjectStore::touch(const std::string& key) {
    const auto found = by_key_.find(key);
    if (found == by_key_.end()) return false;
    newest_first_.splice(newest_first_.begin(), newest_first_, found->second);
    return true;
}

void ObjectStore::set(Entry& entry, StoredObject object) {
    bytes_ -= entry.bytes;
    entry.bytes = bytes_of(object);
    bytes_ += entry.bytes;
    entry.object = std::move(object);
}

/// Drops the oldest until so many bytes more fit in, which the whole store could hold.
void ObjectStore::make_room(std::uint64_t bytes) {
    while (bytes_ + bytes > max_bytes_) {
        const Entry& oldest = newest_first_.back();
        bytes_ -= oldest.bytes;
        by_key_.erase(oldest.key);
        newest_first_.pop_back();
    }
}

}  // namespace graspd::server
