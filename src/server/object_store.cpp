#include "object_store.hpp"

namespace graspd::server {

std::uint64_t geometry_bytes(const ObjectGeometry& geometry) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&geometry)) {
        return mesh->vertices.size() * sizeof(Eigen::Vector3d) +
               mesh->faces.size() * sizeof(Triangle);
    }
    return std::get<PointCloud>(geometry).points.size() * sizeof(Eigen::Vector3d);
}

void ObjectStore::put(const std::string& key, ObjectGeometry geometry) {
    const std::uint64_t bytes = geometry_bytes(geometry);
    const std::scoped_lock lock(mutex_);
    if (bytes > max_bytes_ || touch(key)) return;
    while (bytes_ + bytes > max_bytes_) {
        const Entry& oldest = newest_first_.back();
        bytes_ -= oldest.bytes;
        by_key_.erase(oldest.key);
        newest_first_.pop_back();
    }
    auto kept = std::make_shared<const ObjectGeometry>(std::move(geometry));
    newest_first_.push_front({key, std::move(kept), bytes});
    by_key_.emplace(key, newest_first_.begin());
    bytes_ += bytes;
}

std::shared_ptr<const ObjectGeometry> ObjectStore::find(const std::string& key) {
    const std::scoped_lock lock(mutex_);
    return touch(key) ? newest_first_.front().geometry : nullptr;
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

}  // namespace graspd::server
