#pragma once

#include <bit>
#include <cstdint>

#include "targets.hpp"

namespace graspd::fuzz {

/// Draws values from bytes; when they are used up, zeros. Two draws never stand among the arguments
/// of one call: their order would be the compiler's.
class ByteReader {
public:
    explicit ByteReader(Bytes bytes) : bytes_(bytes) {}

    bool empty() const { return at_ >= bytes_.size(); }
    std::uint8_t byte() { return empty() ? 0 : bytes_[at_++]; }
    bool flag() { return (byte() & 1) != 0; }
    /// A whole number from `least` to `greatest`; one byte, so of at most 256 values.
    unsigned number(unsigned least, unsigned greatest) {
        return least + byte() % (greatest - least + 1);
    }
    unsigned word() {  // in two steps: compilers differ in which side of a sum they read first
        const unsigned high = byte();
        return high * 256 + byte();
    }
    /// From `least` to `greatest` in 65536 steps; with zeros the least.
    double between(double least, double greatest) {
        return least + (greatest - least) * word() / 65535.0;
    }
    /// Any double at all.
    double any() {
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
        return std::bit_cast<double>(bits);
    }

private:
    Bytes bytes_;
    std::size_t at_ = 0;
};

}  // namespace graspd::fuzz
