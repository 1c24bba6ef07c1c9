// Ordered partitions of the vertices of a coloured multigraph, and their refinement.
//
// A partition is kept as a permutation of the vertices in which every cell is a run of places; a cell is named by its
// first place, which never changes while the cell lives. Splitting a cell leaves its first part where it is and names the
// others by new first places, so that a split is undone by giving the names back.
//
// Nothing here may look at the number of a vertex when it decides: colours, places and sizes only. That blindness is what
// makes the labelling canonical (docs/theory/canonical-code.md).
#pragma once

#include <compare>
#include <vector>

#include "labelling/coloured_graph.hpp"
#include "labelling/words.hpp"

namespace gruebler::labelling {

// A cell that was made, and the one that it was cut from.
struct Split {
    int born, parent;
};

// A hash of all that a refinement did, the same for every numbering of the vertices.
struct Trace {
    Word early = 0;  // after the first few splitting cells
    Word whole = 0;  // its last bit tells whether every cell is a single vertex; 0 if the refinement was given up

    auto operator<=>(const Trace&) const = default;
};

// When a refinement is given up early: if its early trace exceeds the one of the best path, unless it is the one of the
// first path and that may be followed.
struct Bound {
    bool bounded = false, follows_first = false;
    Word best_early = 0, first_early = 0;

    bool excludes(Word early) const { return bounded && early > best_early && !(follows_first && early == first_early); }
};

class Partition {
public:
    explicit Partition(int n);

    std::vector<int> vertex_at;  // place -> vertex
    std::vector<int> place_of;   // vertex -> place
    std::vector<int> cell_of;    // vertex -> first place of its cell
    std::vector<int> size_of;    // first place -> number of vertices of the cell
    std::vector<Split> trail;    // the splits since the first partition
    int cells = 0;

    bool is_discrete() const { return cells == n_; }

    // By vertex colour, ascending, then by a hash of the surroundings. All cells but one largest are left waiting: what
    // that one would split is known from the sums over all neighbours that the hash has used.
    void begin(const ColouredGraph& graph);

    // Splits cells by the weights of their edges into waiting cells until none waits. A cell that is split lets all its
    // parts wait if it waited itself, and all but one largest if not (Hopcroft's rule).
    // Cost: O(edges * log n) for a whole path from the root to a leaf.
    Trace refine(const ColouredGraph& graph, const Bound& bound);

    // Cuts a vertex from its cell, as a cell of its own at the last place, and lets it wait.
    void single_out(int v);

    // Takes back all splits after the first `mark` of the trail.
    void undo(std::size_t mark);

private:
    struct Keyed {
        Word key;
        int vertex;

        bool operator<(const Keyed& other) const { return key < other.key; }
    };

    int n_;
    std::vector<Word> weight_;     // end of an edge -> hash of the colour
    std::vector<Word> key_;        // vertex -> hash of its surroundings
    std::vector<Word> sum_;        // vertex -> weight of its edges into the splitting cell
    std::vector<Keyed> keyed_;
    std::vector<int> hits_;        // first place -> vertices of the cell met so far; 0 between steps
    std::vector<char> waits_;      // first place -> whether the cell waits to split the others
    std::vector<int> waiting_;     // the waiting cells, a stack
    std::vector<int> touched_;     // the cells met by the splitting cell
    std::vector<int> splitter_;    // its vertices

    void hash_surroundings(const ColouredGraph& graph);
    void wait(int cell);
    Word meet(const ColouredGraph& graph, int splitter);
    Word split(int cell, Word trace);
    void let_parts_wait(int cell, std::size_t mark);
};

}  // namespace gruebler::labelling
