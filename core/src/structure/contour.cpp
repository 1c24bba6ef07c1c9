#include "structure/contour.hpp"

#include <algorithm>

namespace gruebler::structure {

using namespace bits;

int Contours::class_of(int links, const std::vector<InnerJoint>& joints) {
    degree_.assign(static_cast<std::size_t>(links), 0);
    for (const auto [u, v] : joints) {
        ++degree_[u];
        ++degree_[v];
    }
    int number = std::max(2, longest(links, joints));
    for (const int degree : degree_) number = std::max(number, degree);
    return number;
}

int Contours::longest(int links, const std::vector<InnerJoint>& joints) {
    const int parts = list_loops(links, joints), dimension = static_cast<int>(joints.size()) - links + parts;
    basis_.assign(joints.size(), 0);
    int rank = 0, most = 0;
    for (int length = 2; length <= links && rank < dimension; ++length) {
        for (const Word loop : loops_) {
            if (size(loop) != length || !add_to_basis(loop)) continue;
            ++rank;
            most = length;
        }
    }
    return most;
}

// The candidates of Horton: each joint with the shortest paths from its ends to each link. Returns the number of connected
// parts.
int Contours::list_loops(int links, const std::vector<InnerJoint>& joints) {
    loops_.clear();
    path_.resize(static_cast<std::size_t>(links));
    Word visited = 0;
    int parts = 0;
    for (int start = 0; start < links; ++start) {
        Word reached = bit(start);
        path_[start] = 0;
        queue_.assign(1, start);
        for (std::size_t k = 0; k < queue_.size(); ++k) {
            const int v = queue_[k];
            for (std::size_t j = 0; j < joints.size(); ++j) {
                const int other = joints[j].u == v ? joints[j].v : joints[j].v == v ? joints[j].u : -1;
                if (other < 0 || has(reached, other)) continue;
                reached |= bit(other);
                path_[other] = path_[v] ^ bit(static_cast<int>(j));
                queue_.push_back(other);
            }
        }
        if (!has(visited, start)) {
            ++parts;
            visited |= reached;
        }
        for (std::size_t j = 0; j < joints.size(); ++j) {
            if (!has(reached, joints[j].u)) continue;
            const Word loop = path_[joints[j].u] ^ path_[joints[j].v] ^ bit(static_cast<int>(j));
            if (loop != 0) loops_.push_back(loop);
        }
    }
    return parts;
}

// Whether it is independent of the loops before; they stand by their highest joints.
bool Contours::add_to_basis(Word loop) {
    while (loop != 0) {
        Word& other = basis_[word_bits - 1 - std::countl_zero(loop)];
        if (other == 0) {
            other = loop;
            return true;
        }
        loop ^= other;
    }
    return false;
}

}  // namespace gruebler::structure
