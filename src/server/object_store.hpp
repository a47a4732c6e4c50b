#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <variant>

#include "graspd/base/geometry.hpp"

namespace graspd::server {

/// An object's geometry as it came with a request, frame O.
using ObjectGeometry = std::variant<TriangleMesh, PointCloud>;

/// Memory that an object's numbers take [bytes].
std::uint64_t geometry_bytes(const ObjectGeometry& geometry);

/// The geometry of earlier requests under the object_key of their replies, so that a client can
/// name an object instead of sending it again. Holds at most `max_bytes`; the object that was not
/// asked for longest goes first. Every member may be called from any thread.
class ObjectStore {
public:
    explicit ObjectStore(std::uint64_t max_bytes) : max_bytes_(max_bytes) {}

    /// Keeps an object. One that is known already only becomes the newest; one that is larger than
    /// the whole store is not kept.
    void put(const std::string& key, ObjectGeometry geometry);

    /// The object of that key, which becomes the newest; null when it is unknown or was dropped.
    std::shared_ptr<const ObjectGeometry> find(const std::string& key);

    /// How many objects are kept.
    std::size_t size() const;

    /// What the objects take together [bytes].
    std::uint64_t bytes() const;

private:
    struct Entry {
        std::string key;
        std::shared_ptr<const ObjectGeometry> geometry;
        std::uint64_t bytes = 0;
    };
    bool touch(const std::string& key);

    const std::uint64_t max_bytes_;
    mutable std::mutex mutex_;
    std::list<Entry> newest_first_;
    std::unordered_map<std::string, std::list<Entry>::iterator> by_key_;
    std::uint64_t bytes_ = 0;
};

}  // namespace graspd::server
