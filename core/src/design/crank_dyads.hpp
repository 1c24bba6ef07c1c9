// Many linkages of one structure, a crank and dyads: how their planes move, where each dyad is nearest to its limit, slopes.
//
// A linkage needs no drive cycle here: crank angles are given, and where a dyad cannot be assembled, what hangs on it is NaN.
// Theory: docs/theory/synthesis-any.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/watch.hpp"
#include "design/lanes.hpp"
#include "motion/complex.hpp"

namespace gruebler::design {

// The five dyads by their joints: outer, inner, outer; turning or sliding.
enum class Form : std::int64_t { rrr, rrp, rpr, prp, rpp };

// Links and elements by their numbers; an element is a point and, of a sliding joint, a line, in the plane of its link.
struct CrankDyad {
    Form form;
    std::int64_t links[2], bases[2];  // a base is placed before
    std::int64_t on_base[2], on_link[2], inner[2];  // elements
};

struct Crank {
    std::int64_t frame, link, on_frame, on_link;
};

struct Linkages {
    Crank crank;
    const CrankDyad* dyads;
    std::int64_t dyad_count, link_count, element_count, count;
    const Complex* points;  // [count, elements]
    const Complex* lines;   // [count, elements] of modulus 1; null if no joint slides
    const double* sides;    // [dyads, count]: 1 or -1, the assembly mode
    const double* turned;   // [count, angles] of the crank
    std::int64_t angles;
    Lanes lanes;            // of a level of the processor
};

// A message for linkages that are none, else empty: numbers of links and elements that are none, links placed twice or never.
std::string fault(const Linkages& linkages);

// A point w of a link goes to turn w + shift: [links, count, angles] each. Cost: 30 ns for each dyad and angle.
bool move_planes(const Linkages& linkages, Complex* turns, Complex* shifts, Watch& watch);

// For each watched dyad the angles at which its cosine is largest and least; between the given ones by a parabola, if these
// are a whole turn in equal steps: [count, 2 watched].
//
// The cosine is between -1 and 1 exactly where the dyad can be assembled, smooth beyond: of RRR that of the angle at the inner
// joint; of RRP how far the line lies beside the first outer joint, by the arm; of RPR how far the outer joints lie beside each
// other across the slide, by the root mean square of this and their distance; of PRP and RPP 1 less the sine between both lines.
bool find_tops(const Linkages& linkages, const std::vector<std::int64_t>& watched, bool between, double* tops,
               Watch& watch);

// Each watched dyad's cosine at its two angles of `turned`, which has two for each: [watched, 2, count].
bool find_cosines(const Linkages& linkages, const std::vector<std::int64_t>& watched, double* cosines, Watch& watch);

// How these change with x, y of each point, of turning joints in one plane, by which the motion is told: [watched, 2, 2
// points, count]. A linkage has all its elements in the plane of its drawing; they may be one for several links.
bool cosine_slopes(const Linkages& linkages, const std::vector<std::int64_t>& watched, double* slopes, Watch& watch);

// Where the last point goes, which a link carries, NaN if any dyad cannot be assembled: [count, angles].
bool trace(const Linkages& linkages, std::int64_t link, Complex* z, Watch& watch);

// The same, and how it changes with the crank alone or with x, y of each point before that: [1 or 2 points + 1, count,
// angles]. Turning joints as above.
bool trace_slopes(const Linkages& linkages, std::int64_t link, bool by_places, Complex* z, Complex* slopes, Watch& watch);

}  // namespace gruebler::design
