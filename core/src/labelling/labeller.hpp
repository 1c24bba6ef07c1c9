// Canonical labelling of coloured multigraphs, with their automorphism groups.
//
// Individualisation and refinement after McKay: the leaves of a search tree are the numberings that refinement yields when
// it is told one vertex after another; the canonical one is the leaf with the least (traces, form). A node of the tree is a
// refined partition after some vertices have been singled out, one a level. The first path is the one searched first; every
// other node is reached from one of its nodes. Definitions and proofs: docs/theory/canonical-code.md.
//
// Sources: B. D. McKay, Practical graph isomorphism, Congr. Numer. 30 (1981) 45-87; B. D. McKay and A. Piperno, Practical
// graph isomorphism II, J. Symb. Comput. 60 (2014) 94-112; for automorphisms guessed before a leaf is reached P. T. Darga,
// K. A. Sakallah and I. L. Markov, Faster symmetry discovery using sparsity of symmetries, Proc. DAC (2008) 149-154.
#pragma once

#include <cstdint>
#include <vector>

#include "base/watch.hpp"
#include "labelling/automorphisms.hpp"
#include "labelling/partition.hpp"

namespace gruebler::labelling {

// All memory of a labelling, made once, used for any number of graphs of n vertices.
class Labeller {
public:
    explicit Labeller(int n);

    // The answer, good until the next graph is labelled.
    std::vector<int> place_of;               // vertex -> canonical place; places ascend with the vertex colours
    std::vector<int> orbit_of;               // vertex -> least vertex of its orbit
    std::vector<std::int64_t> factors;       // the order of the group is their product
    const std::vector<std::vector<Move>>& generators() const { return automorphisms_.generators; }

    // Labels a graph; false if the watch ends the work. Cost: one refinement, O(m log n), for a graph that it takes apart;
    // exponential in n in the worst case.
    bool label(const ColouredGraph& graph, Watch& watch);

private:
    // A node of the present path.
    struct Level {
        int vertex = 0;              // singled out here
        int target = 0;              // the cell to take apart, by its first place
        int eldest = 0;              // the child that was searched first
        std::size_t mark = 0;        // length of the trail of splits before
        bool follows_first = false;  // whether the traces before equal those of the first path
        std::strong_ordering standing = std::strong_ordering::equal;  // the traces before, compared with the best path's
    };

    enum class End { done, too_long, interrupted };

    int n_;
    Partition partition_;
    Automorphisms automorphisms_;
    std::vector<Level> levels_;
    std::vector<Trace> first_traces_, best_traces_;  // by level
    std::vector<int> first_leaf_, best_leaf_;        // place -> vertex
    Form best_form_;
    bool best_is_first_ = false;
    bool thorough_ = false;  // whether children are compared before one is searched first
    std::int64_t nodes_ = 0;
    std::vector<int> level_of_;  // vertex -> level at which it is singled out, n if it is not
    Orbits local_;               // orbits within a target cell
    std::vector<int> candidates_, met_, hits_;

    End search(const ColouredGraph& graph, Watch& watch);
    End explore(const ColouredGraph& graph, int base, int child, Watch& watch);
    std::strong_ordering stand(int level, const Trace& trace);
    int jump_back(const ColouredGraph& graph, int base, int parting, bool follows, std::strong_ordering standing);
    void open(const ColouredGraph& graph, int level, bool follows, std::strong_ordering standing);
    int take_back(int level, int back);
    std::int64_t orbit_length(int level);

    void list_candidates(int level);
    int count_joins(const ColouredGraph& graph, int cell);
    int target_cell(const ColouredGraph& graph, int level);
    int next_root(int level, int last, int eldest, Orbits& orbits) const;
    int next_child(int level, int last, int eldest);
    int eldest_child(const ColouredGraph& graph, int level, bool compare, Watch& watch);
};

}  // namespace gruebler::labelling
