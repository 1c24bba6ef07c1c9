// The certificate of a chain without overconstrained part: three classes of joints, any two of which make a forest.
#pragma once

#include <array>
#include <vector>

#include "atlas/chain.hpp"

namespace gruebler::atlas {

// The links of a joint, by their canonical numbers.
struct Ends {
    int u, v;
};

class Certificates {
public:
    // Writes the class of each joint as a digit; false if there are none.
    //
    // Two copies of each joint are put into three forests, one after another, with exchanges (J. Edmonds, Minimum partition
    // of a matroid into independent subsets, 1965). A joint belongs to the class of the forest that it misses.
    bool certify(int links, const std::vector<Ends>& joints, std::uint8_t* digits);

private:
    static constexpr int forests = 3;
    static constexpr int nowhere = -1, unseen = -2;

    struct Forest {
        std::array<Word, most_links> near;
        std::array<std::array<int, most_links>, most_links> copy;  // (link, link): the copy of a joint that joins them
    };

    int links_ = 0;
    const std::vector<Ends>* joints_ = nullptr;
    std::array<Forest, forests> forest_{};
    std::vector<int> forest_of_, before_, queue_, path_;  // by copy; the copies of joint j are 2 j and 2 j + 1

    Ends ends(int copy) const { return (*joints_)[copy / 2]; }
    bool place(int fresh);
    bool find_path(const Forest& forest, Ends ends);
    void move(int copy, int into);
};

}  // namespace gruebler::atlas
