#include "base/processor.hpp"

#ifdef GRUEBLER_X86_LEVELS
#include <cpuid.h>
#endif

namespace gruebler {

#ifdef GRUEBLER_X86_LEVELS
namespace {

bool all(unsigned bits, unsigned wanted) { return (bits & wanted) == wanted; }

// `__builtin_cpu_supports` would say the same, but some compilers' runtime does not fill the table that it reads.
struct Processor {
    unsigned leaf_1_ecx = 0, leaf_7_ebx = 0, extended_ecx = 0;
    unsigned saved = 0;  // the registers that the system saves

    Processor() {
        unsigned a, b, c, d;
        if (__get_cpuid(1, &a, &b, &c, &d)) leaf_1_ecx = c;
        if (__get_cpuid_count(7, 0, &a, &b, &c, &d)) leaf_7_ebx = b;
        if (__get_cpuid(0x80000001, &a, &b, &c, &d)) extended_ecx = c;
        if (leaf_1_ecx & bit_OSXSAVE) {
            unsigned high;
            __asm__("xgetbv" : "=a"(saved), "=d"(high) : "c"(0));
        }
    }

    bool v2() const {
        return all(leaf_1_ecx, bit_CMPXCHG16B | bit_POPCNT | bit_SSE3 | bit_SSSE3 | bit_SSE4_1 | bit_SSE4_2) &&
               all(extended_ecx, bit_LAHF_LM);
    }

    bool v3() const {
        return v2() && all(leaf_1_ecx, bit_AVX | bit_FMA | bit_F16C | bit_MOVBE) &&
               all(leaf_7_ebx, bit_AVX2 | bit_BMI | bit_BMI2) && all(extended_ecx, bit_LZCNT) && all(saved, 0x6);
    }

    bool v4() const {
        constexpr unsigned avx512 = bit_AVX512F | bit_AVX512DQ | bit_AVX512BW | bit_AVX512VL | bit_AVX512CD;
        return v3() && all(leaf_7_ebx, avx512) && all(saved, 0xe6);
    }
};

}  // namespace

bool has_baseline() { return Processor().v2(); }

Level highest_level() {
    // Asked once: a virtual machine takes 40 us to answer.
    static const Level level = [] {
        const Processor processor;
        return processor.v4() ? Level::v4 : processor.v3() ? Level::v3 : Level::baseline;
    }();
    return level;
}

#else

bool has_baseline() { return true; }

Level highest_level() { return Level::baseline; }

#endif

}  // namespace gruebler
