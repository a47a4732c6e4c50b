#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "graspd/base/result.hpp"

namespace graspd::dds {

// What a well-formed sample of each type of idl/graspd.idl looks like on the wire. Generated
// readers believe every sequence count up to one element a byte: a 10 MB sample can ask for
// gigabytes. Walking the bytes first, by the IDL itself, refuses such a count before memory is
// spent on it.

struct CdrStruct;

/// One member of a struct.
struct CdrMember {
    std::string name;
    enum class Kind : std::uint8_t { kNumber, kBoolean, kString, kStruct };
    Kind kind = Kind::kNumber;
    std::size_t bytes = 0;              ///< [byte] of a number or boolean: 1, 2, 4 or 8
    const CdrStruct* nested = nullptr;  ///< of kStruct
    std::uint32_t repeat = 1;           ///< length of a fixed array
    bool sequence = false;              ///< a count of 4 bytes stands before the elements
    std::uint32_t most = 0;             ///< bound of the sequence; 0: none
};

struct CdrStruct {
    std::vector<CdrMember> members;
    std::size_t least_bytes = 0;    ///< [byte] no sample is shorter, padding aside
    std::size_t uniform_bytes = 0;  ///< [byte] of each number when all are alike; else 0
};

/// The structs of an IDL file by their full name, such as "std_msgs::msg::dds_::Header_".
class CdrLayouts {
public:
    /// Reads the subset of IDL that idl/graspd.idl uses: modules, constants (skipped), structs of
    /// numbers, booleans, strings, earlier structs (by full name), their sequences and arrays.
    /// @return kInvalidInput naming the word that it cannot read
    static Result<CdrLayouts> parse(std::string_view idl);

    /// Null when there is no such struct. Valid as long as this object.
    const CdrStruct* find(const std::string& full_name) const;

private:
    friend class IdlParser;
    std::map<std::string, CdrStruct> structs_;  // a map: its nodes stay where they are
};

/// The layouts of idl/graspd.idl, parsed once. Thread-safe.
const CdrLayouts& wire_layouts();

/// Told of every sequence of a payload before its elements are walked. @param member  of the struct
/// itself that the sequence lies in, or that it is
using SequenceSeen =
    std::function<void(const CdrMember& member, const CdrMember& sequence, std::uint64_t count)>;

/// Whether a payload is plain CDR (encapsulation 0x0000 or 0x0001), holds the struct and nothing
/// more than 3 bytes of padding after it, and every count in it fits into the bytes that follow.
/// Numbers are not looked at, bounds of the IDL neither: those a client gets an answer about.
/// Cost: linear in the number of strings and of structs with mixed members, not in the bytes.
bool is_well_formed(std::span<const std::uint8_t> payload, const CdrStruct& type,
                    const SequenceSeen& seen = {});

}  // namespace graspd::dds
