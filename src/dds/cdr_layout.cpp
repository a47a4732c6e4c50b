#include "cdr_layout.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstring>

#include "graspd_idl.hpp"

namespace graspd::dds {

/// A recursive-descent reader over the words of an IDL text.
class IdlParser {
public:
    explicit IdlParser(std::string_view text) { split(text); }

    Result<CdrLayouts> parse() {
        while (at_ < words_.size() && !failed_) definition("");
        if (failed_) {
            const std::string word = at_ < words_.size() ? std::string(words_[at_]) : "end of file";
            return PlanError{PlanErrorCode::kInvalidInput, "IDL: cannot read on at: " + word};
        }
        return std::move(layouts_);
    }

private:
    static bool is_word(char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ':';
    }

    void split(std::string_view text) {
        for (std::size_t i = 0; i < text.size();) {
            if (text.substr(i, 2) == "//") {
                i = std::min(text.find('\n', i), text.size());
            } else if (is_word(text[i])) {
                std::size_t end = i;
                while (end < text.size() && is_word(text[end])) ++end;
                words_.push_back(text.substr(i, end - i));
                i = end;
            } else if (std::isspace(static_cast<unsigned char>(text[i])) != 0) {
                ++i;
            } else {
                words_.push_back(text.substr(i++, 1));
            }
        }
    }

    bool accept(std::string_view word) {
        if (failed_ || at_ >= words_.size() || words_[at_] != word) return false;
        ++at_;
        return true;
    }
    void expect(std::string_view word) {
        if (!accept(word)) failed_ = true;
    }
    std::string_view take() {
        if (failed_ || at_ >= words_.size()) {
            failed_ = true;
            return {};
        }
        return words_[at_++];
    }

    void definition(const std::string& scope) {
        if (accept("module")) {
            const std::string inner = scope + std::string(take()) + "::";
            expect("{");
            while (!failed_ && !accept("}")) definition(inner);
            expect(";");
        } else if (accept("const")) {
            while (!failed_ && take() != ";") {
            }
        } else {
            expect("@");
            expect("final");
            expect("struct");
            structure(scope + std::string(take()));
        }
    }

    void structure(const std::string& name) {
        expect("{");
        CdrStruct type;
        while (!failed_ && !accept("}")) type.members.push_back(member());
        expect(";");
        measure(type);
        if (!failed_) layouts_.structs_.emplace(name, std::move(type));
    }

    CdrMember member() {
        CdrMember member;
        if (accept("sequence")) {
            expect("<");
            element(member);
            if (accept(",")) member.most = number();
            expect(">");
            member.sequence = true;
        } else {
            element(member);
        }
        member.name = take();
        if (accept("[")) {
            member.repeat = number();
            expect("]");
        }
        expect(";");
        return member;
    }

    void element(CdrMember& member) {
        using Kind = CdrMember::Kind;
        if (accept("string")) {
            member.kind = Kind::kString;
            if (accept("<")) {
                number();
                expect(">");
            }
        } else if (accept("boolean")) {
            member.kind = Kind::kBoolean;
            member.bytes = 1;
        } else if (accept("octet")) {
            member.bytes = 1;
        } else if (accept("float")) {
            member.bytes = 4;
        } else if (accept("double")) {
            member.bytes = 8;
        } else if (accept("unsigned") || (at_ < words_.size() && words_[at_] == "long")) {
            expect("long");
            member.bytes = accept("long") ? 8 : 4;
        } else {
            member.kind = Kind::kStruct;
            member.nested = layouts_.find(std::string(take()));
            if (member.nested == nullptr && !failed_) {
                failed_ = true;
                --at_;
            }
        }
    }

    std::uint32_t number() {
        const std::string_view word = take();
        std::uint32_t value = 0;
        const char* end = word.data() + word.size();
        if (std::from_chars(word.data(), end, value).ptr != end || value == 0) failed_ = true;
        return value;
    }

    static void measure(CdrStruct& type) {
        using Kind = CdrMember::Kind;
        bool uniform = true;
        for (const CdrMember& m : type.members) {
            const bool nested = m.kind == Kind::kStruct && m.nested != nullptr;
            const std::size_t element = m.kind == Kind::kString ? 4
                                        : nested                ? m.nested->least_bytes
                                                                : m.bytes;
            const std::size_t alike = nested ? m.nested->uniform_bytes : m.bytes;
            type.least_bytes += m.sequence ? 4 : element * m.repeat;
            if (type.uniform_bytes == 0) type.uniform_bytes = alike;
            uniform = uniform && !m.sequence && alike != 0 && alike == type.uniform_bytes;
        }
        if (!uniform) type.uniform_bytes = 0;
    }

    std::vector<std::string_view> words_;
    std::size_t at_ = 0;
    bool failed_ = false;
    CdrLayouts layouts_;
};

namespace {

/// Walks over a payload; every step says whether the bytes were there.
class Walker {
public:
    Walker(std::span<const std::uint8_t> body, bool little_endian, const SequenceSeen& seen)
        : body_(body), little_endian_(little_endian), seen_(seen) {}

    bool walk_sample(const CdrStruct& type) {
        return std::ranges::all_of(type.members, [this](const CdrMember& member) {
            outer_ = &member;
            return walk(member);
        });
    }
    std::size_t remaining() const { return body_.size() - at_; }

private:
    bool walk(const CdrStruct& type) {
        return std::ranges::all_of(type.members, [this](const CdrMember& m) { return walk(m); });
    }

    bool walk(const CdrMember& member) {
        using Kind = CdrMember::Kind;
        std::uint64_t count = member.repeat;
        if (member.sequence) {
            std::uint32_t length = 0;
            if (!read_count(length)) return false;
            count = length;
            if (seen_) seen_(*outer_, member, count);
        }
        if (count == 0) return true;  // no padding before elements that are not there
        if (member.kind == Kind::kNumber) return skip(count, member.bytes);
        if (member.kind == Kind::kBoolean) return walk_booleans(count);
        if (member.kind == Kind::kString) {
            if (count > remaining() / 4) return false;
            for (; count > 0; --count) {
                if (!walk_string()) return false;
            }
            return true;
        }
        const CdrStruct& nested = *member.nested;
        if (nested.uniform_bytes != 0) {
            if (count > remaining() / nested.least_bytes) return false;
            return skip(count * (nested.least_bytes / nested.uniform_bytes), nested.uniform_bytes);
        }
        if (count > remaining() / nested.least_bytes) return false;
        for (; count > 0; --count) {
            if (!walk(nested)) return false;
        }
        return true;
    }

    bool walk_booleans(std::uint64_t count) {
        for (; count > 0; --count) {
            if (remaining() < 1 || body_[at_] > 1) return false;
            ++at_;
        }
        return true;
    }

    bool walk_string() {
        std::uint32_t length = 0;
        return read_count(length) && skip(length, 1);
    }

    /// Aligns to `bytes` and passes over `count` numbers of that size.
    bool skip(std::uint64_t count, std::size_t bytes) {
        const std::size_t padding = (bytes - at_ % bytes) % bytes;
        if (padding > remaining() || count > (remaining() - padding) / bytes) return false;
        at_ += padding + static_cast<std::size_t>(count) * bytes;
        return true;
    }

    bool read_count(std::uint32_t& count) {
        if (!skip(1, 4)) return false;
        const std::uint8_t* b = body_.data() + at_ - 4;
        for (std::size_t i = 0; i < 4; ++i) {
            count = (count << 8) | b[little_endian_ ? 3 - i : i];
        }
        return true;
    }

    std::span<const std::uint8_t> body_;
    std::size_t at_ = 0;
    bool little_endian_;
    const SequenceSeen& seen_;
    const CdrMember* outer_ = nullptr;  ///< member of the sample that the walk is in
};

}  // namespace

Result<CdrLayouts> CdrLayouts::parse(std::string_view idl) {
    return IdlParser(idl).parse();
}

const CdrStruct* CdrLayouts::find(const std::string& full_name) const {
    const auto found = structs_.find(full_name);
    return found == structs_.end() ? nullptr : &found->second;
}

const CdrLayouts& wire_layouts() {
    static const CdrLayouts layouts = [] {
        auto parsed = CdrLayouts::parse(kGraspdIdl);
        assert(parsed.ok());  // a file of our own; every type is tested
        return parsed.ok() ? std::move(parsed).value() : CdrLayouts{};
    }();
    return layouts;
}

bool is_well_formed(std::span<const std::uint8_t> payload, const CdrStruct& type,
                    const SequenceSeen& seen) {
    constexpr std::size_t kHeader = 4;       // representation id, then options
    constexpr std::size_t kMostPadding = 3;  // RTPS pads a payload to 4 bytes
    if (payload.size() < kHeader || payload[0] != 0 || payload[1] > 1) return false;
    Walker walker(payload.subspan(kHeader), payload[1] == 1, seen);
    return walker.walk_sample(type) && walker.remaining() <= kMostPadding;
}

}  // namespace graspd::dds
