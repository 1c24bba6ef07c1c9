// One source, compiled for several levels of the processor.
//
// A function that two levels share by name, inline or a template, would be kept once by the linker, from whichever
// level it meets first, and the program would end on an older processor. So all that is compiled for a level stands in
// the inline namespace of its level, and a kernel with levels uses of the standard library only what is compiled away;
// tests/core asks the object files.
#pragma once

#ifndef GRUEBLER_LEVEL
#define GRUEBLER_LEVEL baseline
#endif

// A loop is vectorised only if all that it calls is written into it.
#ifdef _MSC_VER
#define GRUEBLER_INLINE __forceinline
#else
#define GRUEBLER_INLINE [[gnu::always_inline]] inline
#endif

namespace gruebler::bits {
inline namespace GRUEBLER_LEVEL {}
}  // namespace gruebler::bits
namespace gruebler::counting {
inline namespace GRUEBLER_LEVEL {}
}  // namespace gruebler::counting
namespace gruebler::algebra {
inline namespace GRUEBLER_LEVEL {}
}  // namespace gruebler::algebra

namespace gruebler::motion {
inline namespace GRUEBLER_LEVEL {}
}  // namespace gruebler::motion
