// The tests that blocks face, and what these still ask for, eight tests a word.
//
// A test of a block asks that a subset of its bundles lack so much at least, and the more the lanes before it use, the
// more. What is asked for stands in bytes: a block before adds its part to all of them at once, and the high bits tell
// which tests ask for anything, some three of forty, and which for more than there is. docs/theory/enumeration.md,
// "Counting without listing".
#pragma once

#include "counting/block_tables.hpp"
#include "counting/frame.hpp"

namespace gruebler::counting::inline GRUEBLER_LEVEL {

inline constexpr int most_blocks = 6;  // five hold 31 bundles, and the last may be empty

// Whether a test is about what is used (c within the set) or what is left over (2 - c outside it).
enum Side { upper = 0, lower = 1 };

inline constexpr Word first_bits = 0x5555555555555555;  // of every lane

// c(masked lanes) <= limit.
struct SearchTest {
    Word mask;
    int limit;
};

// The subset of the block must lack `need` + c(masked lanes) if the test is an upper one; if it is a lower one,
// `need` - c(masked lanes) + what the whole block lacks. The masked lanes stand before the block.
struct BlockTest {
    Word mask;
    int subset, need;
};

template <class Test>
class Tests {
public:
    void clear() { size_ = 0; }
    void add(const Test& test) { tests_[size_++] = test; }
    int size() const { return size_; }
    const Test* begin() const { return tests_.data(); }
    const Test* end() const { return tests_.data() + size_; }

private:
    int size_ = 0;
    std::array<Test, most_sets> tests_;  // one of a critical set at most
};

using BlockTests = std::array<std::array<Tests<BlockTest>, 2>, most_blocks>;  // by block and side

class Budgets {
    static constexpr int tests_of_word = 8, bits_of_byte = 8;
    static constexpr int most_words = most_blocks * 2 * (most_sets / tests_of_word);

public:
    using Row = std::array<Word, most_words>;  // a byte a test, those of later blocks first

    // Takes the tests of so many blocks.
    void take(int blocks, const BlockTests& tests, int lanes) {
        words_ = 0;
        for (int i = 0; i < blocks; ++i)
            for (const Tests<BlockTest>& side : tests[i]) words_ += words_for(side);
        for (int k = 0; k < lanes * words_; ++k) step_[k] = 0;
        int word = 0;
        for (int i = blocks - 1; i >= 0; --i) {
            range_[i].begin = word;
            word = put(tests[i][upper], 1, word);
            range_[i].middle = word;
            word = put(tests[i][lower], -1, word);
            range_[i].end = word;
        }
    }

    // Adds up once what neighbouring lanes of a block, two and two, change together.
    void tabulate(int block, int begin, int width) {
        const int words = range_[block].begin;
        for (int lane = begin; lane < begin + width; lane += 2) {
            const Word* first = step_.data() + lane * words_;
            for (int c = 0; c <= 2; ++c) {
                Word* row = change_.data() + row_of(lane, ones(c));
                for (int w = 0; w < words; ++w) row[w] = static_cast<Word>(c) * first[w];
            }
            if (lane + 1 == begin + width) break;
            const Word* second = first + words_;
            for (int i = 0; i < 6; ++i) {
                const Word low = ones(i % 3), high = ones(1 + i / 3) << 2;
                const Word* row = change_.data() + row_of(lane, low);
                Word* both = change_.data() + row_of(lane, low | high);
                for (int w = 0; w < words; ++w) both[w] = row[w] + static_cast<Word>(1 + i / 3) * second[w];
            }
        }
    }

    // What is asked for when the search has given these c, in unary, to its lanes.
    void begin(Word used, Row& asked) const {
        for (int w = 0; w < words_; ++w) asked[w] = start_[w];
        for (; used != 0; used = without_lowest(used)) {
            const Word* step = step_.data() + lowest(used) / 2 * words_;
            for (int w = 0; w < words_; ++w) asked[w] += step[w];
        }
    }

    // What is asked for of later blocks when a block has these c.
    void go_on(int block, int begin, int width, Word used, const Row& before, Row& asked) const {
        std::array<const Word*, block_width / 2> change;
        for (int i = 0; i < block_width / 2; ++i)  // the first row changes nothing
            change[i] = change_.data() + row_of(2 * i < width ? begin + 2 * i : begin, used >> (4 * i) & 15);
        for (int w = 0; w < range_[block].begin; ++w) {
            Word sum = before[w];
            for (const Word* each : change) sum += each[w];
            asked[w] = sum;
        }
    }

    // Calls `ask` with the subset and what it must lack, for each test of a block that asks for anything of assignments
    // of this lack; false at once if one asks for more than there is.
    template <class Ask>
    GRUEBLER_INLINE bool each(const Row& asked, int block, int lack, const Ask& ask) const {
        const auto [begin, middle, end] = range_[block];
        const Word added = static_cast<Word>(lack) * each_byte;  // to lower tests
        Word too_much = 0;
        for (int w = begin; w < middle; ++w) too_much |= asked[w] - added;
        for (int w = middle; w < end; ++w) too_much |= asked[w];
        if ((too_much & high_bits) != 0) return false;
        if (lack == 0) return true;
        for (int first = begin; first < end; first += bits_of_byte) {
            Word tests = 0;  // bit w of byte k: test k of word w
            for (int w = first; w < std::min(first + bits_of_byte, end); ++w) {
                const Word all = asked[w] + (w < middle ? 0 : added);
                tests |= (all & high_bits) >> (bits_of_byte - 1 - (w - first));
            }
            for (; tests != 0; tests = without_lowest(tests)) {
                const int at = lowest(tests), w = first + at % bits_of_byte, k = at / bits_of_byte;
                const Word all = asked[w] + (w < middle ? 0 : added);
                ask(subset_[w * tests_of_word + k], static_cast<int>((all >> (bits_of_byte * k) & 255) - nothing));
            }
        }
        return true;
    }

private:
    static constexpr Word each_byte = 0x0101010101010101, high_bits = 0x80 * each_byte;
    static constexpr Word nothing = 0x7f;  // a byte that asks for 0: the high bit tells of more
    static constexpr Word idle = 0x40;     // a byte without a test
    static constexpr int pairs = 16;       // patterns of c of two lanes

    // Lanes use 62 at most, needs lie between -50 and 64, lacks between 0 and 16: so no byte leaves 0 .. 255.
    static_assert(2 * most_lanes <= 62 && block_lacks <= 17);

    // The words of one block: its upper tests, then its lower ones.
    struct Range {
        int begin = 0, middle = 0, end = 0;
    };

    int words_ = 0;
    std::array<Range, most_blocks> range_;
    Row start_;                                                // before any lane has a value
    std::array<Word, most_lanes * most_words> step_;           // (lane, word): what one more of c changes
    std::array<Word, most_lanes * pairs * most_words> change_;  // (lane, c of it and the next, word)
    std::array<std::uint8_t, most_words * tests_of_word> subset_;

    static int words_for(const Tests<BlockTest>& tests) { return (tests.size() + tests_of_word - 1) / tests_of_word; }

    int row_of(int lane, Word pattern) const { return (lane * pairs + static_cast<int>(pattern)) * words_; }

    // Lays tests down from a word on, which a masked lane changes by `change`; returns the word after them.
    int put(const Tests<BlockTest>& tests, int change, int word) {
        int k = 0;
        for (const BlockTest& test : tests) {
            const int w = word + k / tests_of_word, shift = k % tests_of_word * bits_of_byte;
            if (shift == 0) start_[w] = idle * each_byte;
            start_[w] += (static_cast<Word>(test.need) + nothing - idle) << shift;
            for (Word bits = test.mask & first_bits; bits != 0; bits = without_lowest(bits))
                step_[lowest(bits) / 2 * words_ + w] += static_cast<Word>(change) << shift;
            subset_[word * tests_of_word + k++] = static_cast<std::uint8_t>(test.subset);
        }
        return word + words_for(tests);
    }
};

}  // namespace gruebler::counting
