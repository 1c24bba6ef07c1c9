#include "atlas/certificate.hpp"

namespace gruebler::atlas {

using namespace bits;

namespace {

constexpr int all_forests = 0 + 1 + 2;  // the sum of their numbers

}  // namespace

bool Certificates::certify(int links, const std::vector<Ends>& joints, std::uint8_t* digits) {
    links_ = links;
    joints_ = &joints;
    const auto count = static_cast<int>(joints.size());
    forest_of_.assign(2 * joints.size(), nowhere);
    for (Forest& forest : forest_) forest.near.fill(0);
    for (int fresh = 0; fresh < 2 * count; ++fresh)
        if (!place(fresh)) return false;
    for (int j = 0; j < count; ++j)
        digits[j] = static_cast<std::uint8_t>('0' + all_forests - forest_of_[2 * j] - forest_of_[2 * j + 1]);
    return true;
}

// Puts a copy into a forest that has room for it after a chain of exchanges, the shortest there is.
bool Certificates::place(int fresh) {
    before_.assign(forest_of_.size(), unseen);
    before_[fresh] = nowhere;
    queue_.assign(1, fresh);
    for (std::size_t k = 0; k < queue_.size(); ++k) {
        const int copy = queue_[k];
        for (int which = 0; which < forests; ++which) {
            if (forest_of_[copy] == which) continue;
            if (!find_path(forest_[which], ends(copy))) {
                for (int here = copy, into = which; here >= 0; here = before_[here]) {
                    const int old = forest_of_[here];
                    move(here, into);
                    into = old;
                }
                return true;
            }
            for (const int other : path_) {
                if (before_[other] != unseen) continue;
                before_[other] = copy;
                queue_.push_back(other);
            }
        }
    }
    return false;
}

// The copies on the path between two links in a forest; false if there is none.
bool Certificates::find_path(const Forest& forest, Ends ends) {
    std::array<int, most_links> from;
    Word reached = bit(ends.u), front = reached;
    while (front != 0 && !has(reached, ends.v)) {
        Word fresh = 0;
        for (Word set = front; set != 0; set = without_lowest(set)) {
            const Word here = forest.near[lowest(set)] & ~reached;
            reached |= here;
            fresh |= here;
            for (Word next = here; next != 0; next = without_lowest(next)) from[lowest(next)] = lowest(set);
        }
        front = fresh;
    }
    if (!has(reached, ends.v)) return false;
    path_.clear();
    for (int v = ends.v; v != ends.u; v = from[v]) path_.push_back(forest.copy[v][from[v]]);
    return true;
}

void Certificates::move(int copy, int into) {
    const auto [u, v] = ends(copy);
    if (forest_of_[copy] >= 0) {
        Forest& old = forest_[forest_of_[copy]];
        if (old.copy[u][v] == copy) {  // else its place is taken by another already
            old.near[u] &= ~bit(v);
            old.near[v] &= ~bit(u);
        }
    }
    forest_of_[copy] = into;
    Forest& forest = forest_[into];
    forest.near[u] |= bit(v);
    forest.near[v] |= bit(u);
    forest.copy[u][v] = forest.copy[v][u] = copy;
}

}  // namespace gruebler::atlas
