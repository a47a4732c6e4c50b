#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <variant>

#include "graspd/base/geometry.hpp"
#include "graspd/planner/prepared_object.hpp"

namespace graspd::server {

/// An object's geometry as it came with a request, frame O.
using ObjectGeometry = std::variant<TriangleMesh, PointCloud>;

/// Memory that an object's numbers take [bytes].
std::uint64_t geometry_bytes(const ObjectGeometry& geometry);

/// Whether two objects are the same bytes: what a hash cannot promise.
bool same_geometry(const ObjectGeometry& a, const ObjectGeometry& b);

/// An object of an earlier request.
struct StoredObject {
    std::shared_ptr<const ObjectGeometry> geometry;  ///< null: there is none
    PreparedObjectPtr prepared;                      ///< null: it could not be, or left no room
};

/// The objects of earlier requests under the object_key of their replies, so that a client can name
/// an object instead of sending it again, and so that the same object is prepared once. Holds at
/// most `max_bytes` of geometry and prepared objects; the one that was not asked for longest goes
/// first. Two objects under one key (somebody made them so) make the key useless: it then names
/// neither, until it is dropped. Every member may be called from any thread.
class ObjectStore {
public:
    explicit ObjectStore(std::uint64_t max_bytes) : max_bytes_(max_bytes) {}

    /// Keeps an object. One that is known already only becomes the newest, and gets the prepared
    /// object that it lacked: of two that were prepared at once the first stays. What is larger
    /// than the whole store is not kept; a prepared object that does not fit beside its geometry is
    /// left out.
    void put(const std::string& key, ObjectGeometry geometry, PreparedObjectPtr prepared);

    /// The object of that key, which becomes the newest; none when it is unknown or was dropped.
    StoredObject find(const std::string& key);

    /// The same; none when the store knows another geometry under that key.
    StoredObject find(const std::string& key, const ObjectGeometry& geometry);

    /// How many objects are kept.
    std::size_t size() const;

    /// What the objects take together [bytes].
    std::uint64_t bytes() const;

private:
    struct Entry {
        std::string key;
        StoredObject object;
        std::uint64_t bytes = 0;
    };
    bool touch(const std::string& key);
    void set(Entry& entry, StoredObject object);
    void make_room(std::uint64_t bytes);

    const std::uint64_t max_bytes_;
    mutable std::mutex mutex_;
    std::list<Entry> newest_first_;
    std::unordered_map<std::string, std::list<Entry>::iterator> by_key_;
    std::uint64_t bytes_ = 0;
};

}  // namespace graspd::server
