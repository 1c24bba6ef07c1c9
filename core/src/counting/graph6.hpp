// Lines of graph6: the number of vertices, then for every pair of them whether it is joined, six pairs a letter.
//
// Format: B. D. McKay, Description of graph6, sparse6 and digraph6 encodings.
#pragma once

#include <algorithm>
#include <cstdint>

namespace gruebler::counting {

inline constexpr int most_vertices = 255;     // of a line: numbers of one byte
inline constexpr int blank = 63;              // the letter of no edge, and what is added to every number
inline constexpr int most_short = 62;         // vertices whose number is one letter
inline constexpr int long_mark = 126;         // before a longer number, of three letters
inline constexpr int pairs_of_letter = 6;

inline int graph6_head(int vertices) { return vertices <= most_short ? 1 : 4; }

// The number of bytes of a line, its end included.
inline int graph6_length(int vertices) {
    return graph6_head(vertices) + (vertices * (vertices - 1) / 2 + pairs_of_letter - 1) / pairs_of_letter + 1;
}

// Writes the number of vertices, no edge, and the end of the line.
inline void begin_graph6(int vertices, std::uint8_t* line) {
    const int length = graph6_length(vertices);
    std::fill(line, line + length - 1, static_cast<std::uint8_t>(blank));
    line[length - 1] = '\n';
    if (vertices <= most_short) {
        line[0] = static_cast<std::uint8_t>(blank + vertices);
    } else {
        line[0] = long_mark;
        line[2] = static_cast<std::uint8_t>(blank + (vertices >> pairs_of_letter));
        line[3] = static_cast<std::uint8_t>(blank + (vertices & 63));
    }
}

// Adds the edge between two vertices to a line whose edges begin at `head`; once is enough.
inline void add_graph6_edge(int u, int v, int head, std::uint8_t* line) {
    const int low = std::min(u, v), high = std::max(u, v), place = high * (high - 1) / 2 + low;
    std::uint8_t& letter = line[head + place / pairs_of_letter];
    letter = static_cast<std::uint8_t>(((letter - blank) | (32 >> place % pairs_of_letter)) + blank);
}

}  // namespace gruebler::counting
