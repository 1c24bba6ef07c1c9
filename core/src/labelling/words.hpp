// Words of 64 bits: scrambled, and sorted.
#pragma once

#include <algorithm>
#include <cstdint>

namespace gruebler::labelling {

using Word = std::uint64_t;

// The constants of splitmix64 (G. Steele, D. Lea, C. Flood 2014).
inline constexpr Word golden = 0x9E3779B97F4A7C15, mixer = 0xBF58476D1CE4E5B9, second_mixer = 0x94D049BB133111EB;

inline constexpr int short_length = 24;  // up to it insertion is quicker

// A fixed scramble: the finaliser of splitmix64.
inline Word mix(Word x) {
    x += golden;
    x = (x ^ (x >> 30)) * mixer;
    x = (x ^ (x >> 27)) * second_mixer;
    return x ^ (x >> 31);
}

inline Word fold(Word x) { return x ^ (x >> 31); }

// Ascending; equal items come in any order.
template <class Item>
void sort(Item* begin, Item* end) {
    if (end - begin > short_length) return std::sort(begin, end);
    for (Item* at = begin; at < end; ++at) {
        const Item item = *at;
        Item* to = at;
        for (; to > begin && item < to[-1]; --to) *to = to[-1];
        *to = item;
    }
}

}  // namespace gruebler::labelling
