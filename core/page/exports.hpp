// What a door to the page shares with the others: names that the page sees, and nothing of the system behind them.
#pragma once

#define EXPORT extern "C" __attribute__((visibility("default"), used))

// What the standard library says before it gives up would bring half of it along.
namespace std {
inline namespace __1 {
[[noreturn]] void __libcpp_verbose_abort(const char*, ...) noexcept { __builtin_trap(); }
}  // namespace __1
}  // namespace std
