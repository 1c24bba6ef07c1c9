#include <algorithm>

#include "structure/assembly_modes.hpp"

namespace gruebler::structure {
namespace {

using bits::Word;

// Marks on a line, up to its projective maps, and sets of them whose places among one another are given.
struct Marked {
    Word marks;
    std::vector<Word> bodies;
};

class Degenerations {
public:
    explicit Degenerations(Watch& watch) : watch_(watch) {}

    std::int64_t count(Marked marked) {
        if (!settle(marked)) return 0;
        if (marked.bodies.size() <= 1) return 1;  // at most three marks, or one body that has them all
        const auto least = std::min_element(marked.bodies.begin(), marked.bodies.end(), [](Word a, Word b) {
            return bits::size(a) < bits::size(b);
        });
        const Word body = *least;
        marked.bodies.erase(least);
        return Split(*this, marked, body).sum();
    }

    bool stopped() const { return stopped_; }

private:
    Watch& watch_;
    bool stopped_ = false;

    // Bodies with three marks say nothing; a mark of one body goes with it; bodies with three common marks are one. False
    // if there are no places, or infinitely many.
    static bool settle(Marked& marked) {
        auto& bodies = marked.bodies;
        for (;;) {
            std::erase_if(bodies, [](Word body) { return bits::size(body) <= 3; });
            const int merged = merge(bodies);
            if (merged < 0) return false;
            if (merged > 0) continue;
            Word once = 0, twice = 0;
            for (const Word body : bodies) twice |= once & body, once |= body;
            if (bits::size(marked.marks) > 3 && (marked.marks & ~once) != 0) return false;
            if (bodies.size() <= 1) return true;
            once &= ~twice;
            bool changed = false;
            for (Word& body : bodies)
                for (Word own = body & once; own != 0 && bits::size(body) > 3; own = bits::without_lowest(own)) {
                    const Word mark = own & (~own + 1);
                    body &= ~mark, marked.marks &= ~mark;
                    changed = true;
                }
            if (!changed) return true;
        }
    }

    // 1 if two bodies became one, -1 if two have too many marks in common, else 0.
    static int merge(std::vector<Word>& bodies) {
        for (std::size_t i = 0; i < bodies.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const int common = bits::size(bodies[i] & bodies[j]);
                if (common > 3) return -1;
                if (common < 3) continue;
                bodies[j] |= bodies[i];
                bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(i));
                return 1;
            }
        return 0;
    }

    // All ways in which marks part when two marks of a body approach each other: every other body keeps all its marks but
    // one together.
    class Split {
    public:
        Split(Degenerations& all, const Marked& rest, Word body) : all_(all), marked_(rest) {
            const Word second = bits::without_lowest(body);
            near_ = body & ~bits::without_lowest(second);
            far_ = body & ~near_;
        }

        std::int64_t sum() {
            assign(near_, far_, marked_.marks & ~(near_ | far_));
            return sum_;
        }

    private:
        Degenerations& all_;
        const Marked& marked_;
        Word near_, far_;
        std::int64_t sum_ = 0;

        void assign(Word near, Word far, Word left) {
            all_.stopped_ = all_.stopped_ || !spend(all_.watch_, 1 << 5);
            if (all_.stopped_ || !force(near, far, left)) return;
            if (left == 0) {
                sum_ += product(near, far);
                return;
            }
            const Word mark = next_mark(near | far, left);
            assign(near | mark, far, left & ~mark);
            assign(near, far | mark, left & ~mark);
        }

        // Marks whose part follows. False if a body falls apart.
        bool force(Word& near, Word& far, Word& left) const {
            for (bool changed = true; changed;) {
                changed = false;
                for (const Word body : marked_.bodies) {
                    const int here = bits::size(body & near), there = bits::size(body & far);
                    if (here >= 2 && there >= 2) return false;
                    const Word own = body & left;
                    if (own == 0 || here + there < 3) continue;
                    if (here >= 2 && there == 1) near |= own, left &= ~own, changed = true;
                    if (there >= 2 && here == 1) far |= own, left &= ~own, changed = true;
                }
            }
            return true;
        }

        // A mark of the body of which most is known.
        Word next_mark(Word known, Word left) const {
            Word best = left;
            int most = -1;
            for (const Word body : marked_.bodies)
                if ((body & left) != 0 && bits::size(body & known) > most) {
                    most = bits::size(body & known);
                    best = body & left;
                }
            return best & (~best + 1);
        }

        std::int64_t product(Word near, Word far) const {
            const Word used = marked_.marks, point = ~used & (used + 1);  // where the parts touch: a bit that is free
            Marked first{near | point, {}}, second{far | point, {far_ | point}};
            int freedoms = bits::size(near) - 2;
            for (const Word body : marked_.bodies) {
                const bool here = bits::size(body & far) <= 1;
                const Word own = body & (here ? near : far);
                (here ? first : second).bodies.push_back(own == body ? own : own | point);
                if (here) freedoms -= bits::size(body) - 3;
            }
            if (freedoms != 0) return 0;
            const std::int64_t ways = all_.count(std::move(first));
            return ways == 0 ? 0 : ways * all_.count(std::move(second));
        }
    };
};

}  // namespace

std::optional<std::int64_t> count_spherical_modes(int links, const JointSets& joints, Watch& watch) {
    Marked marked{bits::ones(2 * static_cast<int>(joints.size())), std::vector<Word>(static_cast<std::size_t>(links))};
    for (std::size_t j = 0; j < joints.size(); ++j)
        for (Word left = joints[j]; left != 0; left = bits::without_lowest(left))
            marked.bodies[static_cast<std::size_t>(bits::lowest(left))] |= Word{3} << 2 * j;
    Degenerations degenerations(watch);
    const std::int64_t modes = degenerations.count(std::move(marked));
    if (degenerations.stopped()) return std::nullopt;
    return modes;
}

}  // namespace gruebler::structure
