// What the tests without Python share.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace {

[[maybe_unused]] bool always(void*) { return true; }
[[maybe_unused]] bool never(void*) { return false; }

void expect(bool truth, const char* otherwise) {
    if (truth) return;
    std::fprintf(stderr, "%s\n", otherwise);
    std::exit(1);
}

}  // namespace
