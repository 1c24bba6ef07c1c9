// What this processor can do.
#pragma once

namespace gruebler {

// The levels of x86-64, as its ABI defines them. Elsewhere everything is compiled for the one level there is.
enum class Level { baseline, v3, v4 };

// Whether the baseline itself will run: x86-64-v2 on x86-64.
bool has_baseline();

// The highest level that this processor and its system have.
Level highest_level();

}  // namespace gruebler
