// Sets as bits of a word.
#pragma once

#include <bit>
#include <cstdint>

#include "base/level.hpp"

namespace gruebler::bits::inline GRUEBLER_LEVEL {

using Word = std::uint64_t;

inline constexpr int word_bits = 64;

constexpr Word bit(int i) { return Word{1} << i; }
constexpr Word ones(int count) { return bit(count) - 1; }  // count < 64
constexpr bool has(Word set, int i) { return (set >> i & 1) != 0; }
constexpr int lowest(Word word) { return std::countr_zero(word); }
constexpr int size(Word set) { return std::popcount(set); }
constexpr Word without_lowest(Word word) { return word & (word - 1); }

}  // namespace gruebler::bits
