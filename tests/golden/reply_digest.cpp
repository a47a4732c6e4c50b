// Prints a digest of the replies to a set of generated requests: what must be the same for every
// number of workers and threads, for prepared objects and new ones, and for every build.
//
//   reply_digest [--each]     one line for all replies; with --each one a reply before it
//
//   diff <(build/release/tests/golden/reply_digest --each) <(build/asan/tests/golden/reply_digest
//   --each)
#include <cstring>
#include <iostream>

#include "reply_digests.hpp"

int main(int count, char** arguments) {
    const auto digests = graspd::test::cold_digests();
    if (count > 1 && std::strcmp(arguments[1], "--each") == 0) {
        for (const auto& [name, digest] : digests) std::cout << name << ' ' << digest << '\n';
    }
    std::cout << "all " << graspd::test::digest_of(digests) << '\n';
}
