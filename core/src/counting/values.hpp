// The values a bundle of parallel strings can take.
//
// A bundle is the set of parallel strings between two nodes; its value is the sorted tuple of their weights (numbers of
// binary links). What counts for mobility is the cost c, the sum of 2 - min(weight, 2) over its strings, and the excess,
// the sum of max(weight - 2, 0). Theorems and proofs: docs/theory/enumeration.md, "Strings".
#pragma once

#include <algorithm>

#include "counting/packed_graph.hpp"

namespace gruebler::counting::inline GRUEBLER_LEVEL {

// Numbers of chains and the like. They wrap beyond 64 bits; Totals::bulk notices.
using Count = std::uint64_t;

inline constexpr int most_lanes = 31;     // bundles that fit a word of 64 bits, two bits each; ten loops need 27
inline constexpr int most_freedoms = 24;  // products of binomial coefficients stay within 64 bits
inline constexpr int most_cost = 3;       // of a bundle between two nodes alone, if F = 0; else 2
inline constexpr int most_classes = (most_cost + 1) * most_freedoms;

// The excess that all strings of a chain have together.
inline int spare_excess(int mobility) { return mobility > 1 ? mobility - 1 : 0; }

// One value: its weights, ascending.
struct BundleValue {
    std::array<std::uint8_t, most_parallel> weights{};
    std::uint8_t strings = 0;
    int cost = 0, excess = 0;
};

// Calls `visit` with all values of so many strings, the weights of `head` first, in lexicographic order.
template <class Visit>
void each_value(const BundleValue& head, int strings, int mobility, int highest_cost, const Visit& visit) {
    if (head.cost > highest_cost || head.excess > spare_excess(mobility)) return;
    if (head.strings == strings) return visit(head);
    const int longest = mobility + 1;
    for (int w = head.strings > 0 ? head.weights[head.strings - 1] : 0; w <= longest; ++w) {
        BundleValue longer = head;
        longer.weights[longer.strings++] = static_cast<std::uint8_t>(w);
        longer.cost += 2 - std::min(w, 2);
        longer.excess += std::max(w - 2, 0);
        each_value(longer, strings, mobility, highest_cost, visit);
    }
}

// The values of one cost and excess, added up.
struct ValueClass {
    int cost = 0, excess = 0;
    Count many = 0;           // how many values
    Count links = 0;          // binary links that the symmetry of equal parallel strings tells apart
    Count turned_links = 0;   // of them those that stay when every string is reversed
    Count joints = 0;         // joints, in the same way
    Count turned_joints = 0;
};

struct ValueList {
    int size = 0;
    std::array<ValueClass, most_classes> classes;

    const ValueClass* begin() const { return classes.data(); }
    const ValueClass* end() const { return classes.data() + size; }
};

class Values {
public:
    std::array<ValueList, most_parallel + 1> of_strings;                 // by the number of strings
    std::array<std::array<Count, most_freedoms>, most_lanes + 1> ways;   // (z, x): excess x falls on z single strings

    void fill(int most_strings, int mobility, int highest_cost) {
        for (int k = 0; k <= most_parallel; ++k) of_strings[k].size = 0;
        for (int k = 1; k <= most_strings; ++k) {
            ValueList& list = of_strings[k];
            each_value({}, k, mobility, highest_cost, [&list](const BundleValue& value) { add(value, list); });
        }
        for (int z = 0; z <= most_lanes; ++z) {
            Count c = 1;  // C(z + x - 1, x)
            for (int x = 0; x < std::max(mobility, 1); ++x) {
                ways[z][x] = z > 0 ? c : static_cast<Count>(x == 0);
                c = c * static_cast<Count>(z + x) / static_cast<Count>(x + 1);
            }
        }
    }

private:
    // Classes come in the order in which their first values come.
    static void add(const BundleValue& value, ValueList& list) {
        int i = 0;
        while (i < list.size && (list.classes[i].cost != value.cost || list.classes[i].excess != value.excess)) ++i;
        ValueClass& sums = list.classes[i];
        if (i == list.size) {
            sums = ValueClass{value.cost, value.excess};
            ++list.size;
        }
        ++sums.many;
        for (int k = 0; k < value.strings; ++k) {
            const int w = value.weights[k];
            if (k > 0 && w == value.weights[k - 1]) continue;  // equal parallel strings are one class
            sums.links += static_cast<Count>(w);
            sums.turned_links += static_cast<Count>(w % 2);
            sums.joints += static_cast<Count>(w + 1);
            sums.turned_joints += static_cast<Count>(1 - w % 2);
        }
    }
};

}  // namespace gruebler::counting
