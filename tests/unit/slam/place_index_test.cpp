#include "rgbd_graphslam/slam/place_index.h"

#include <gtest/gtest.h>

#include <random>

namespace rgbd_graphslam {
namespace {

constexpr int max_hamming = 40;

class Places {
  public:
    std::vector<Descriptor> place(int descriptors) {
        std::vector<Descriptor> result;
        for (int i = 0; i < descriptors; ++i) {
            result.push_back({random_(), random_(), random_(), random_()});
        }
        return result;
    }

    /** The same place from elsewhere: every descriptor with `flips` bits changed at most. */
    std::vector<Descriptor> again(std::vector<Descriptor> place, int flips) {
        for (Descriptor& descriptor : place) {
            for (int i = 0; i < flips; ++i) {
                descriptor[random_() % 4] ^= std::uint64_t{1} << (random_() % 64);
            }
        }
        return place;
    }

  private:
    std::mt19937_64 random_{7};
};

TEST(PlaceIndex, namesThePlaceAmongHundreds) {
    Places places;
    PlaceIndex index(max_hamming);
    std::vector<std::vector<Descriptor>> known;
    for (int k = 0; k < 300; ++k) {
        known.push_back(places.place(200));
        index.insert(k, known.back());
    }
    for (int k = 0; k < 300; k += 37) {
        const auto votes = index.query(places.again(known[k], 20));
        ASSERT_FALSE(votes.empty());
        EXPECT_EQ(votes[0].keyframe, k);
        EXPECT_GT(votes[0].votes, 60);
        for (std::size_t i = 1; i < votes.size(); ++i) EXPECT_LT(votes[i].votes, 5);
    }
}

TEST(PlaceIndex, growsAllAtOnceAsOneByOne) {
    Places places;
    std::vector<std::vector<Descriptor>> known;
    PlaceIndex one_by_one(max_hamming), at_once(max_hamming);
    for (int k = 0; k < 50; ++k) {
        known.push_back(places.place(100));
        one_by_one.insert(k, known.back());
    }
    at_once.insertAll(known);
    const auto query = places.again(known[20], 10);
    const auto a = one_by_one.query(query), b = at_once.query(query);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].keyframe, b[i].keyframe);
        EXPECT_EQ(a[i].votes, b[i].votes);
    }
}

TEST(PlaceIndex, forgetsAnErasedKeyframeAndGoesOnWithTheOthers) {
    Places places;
    PlaceIndex index(max_hamming);
    const auto place = places.place(200);
    index.insert(0, place);
    index.insert(1, places.again(place, 5));
    index.erase(0);
    for (int k = 2; k < 60; ++k) index.insert(k, places.place(200));
    const auto votes = index.query(place);
    ASSERT_FALSE(votes.empty());
    EXPECT_EQ(votes[0].keyframe, 1);
    for (const PlaceVote& vote : votes) EXPECT_NE(vote.keyframe, 0);
}

/** Descriptors of erased keyframes that an index still holds, by its saved state. */
std::uint64_t left(const PlaceIndex& index) {
    ByteWriter out;
    index.save(out);
    const std::string bytes = out.take();
    ByteReader in(bytes);
    for (std::size_t keyframes = in.getCount(1); keyframes > 0; --keyframes) in.get<std::uint8_t>();
    std::uint64_t count = 0;
    for (int tree = 0; tree < 4; ++tree) {
        in.get<std::uint32_t>();  // swept
        for (std::size_t nodes = in.getCount(1); nodes > 0; --nodes) {
            const bool is_leaf = in.get<std::int16_t>() < 0;
            in.get<std::uint32_t>();
            if (is_leaf) count += in.get<std::uint32_t>();
        }
    }
    return count;
}

TEST(PlaceIndex, freesWhatErasedKeyframesLeft) {
    Places places;
    PlaceIndex index(max_hamming);
    for (int k = 0; k < 40; ++k) index.insert(k, places.place(200));
    for (int k = 0; k < 40; k += 2) index.erase(k);
    EXPECT_EQ(left(index), 4u * 20 * 200);
    for (int k = 40; k < 40 + 70; ++k) index.insert(k, places.place(2));
    EXPECT_EQ(left(index), 0u);
}

TEST(PlaceIndex, knowsNothingAtFirst) {
    EXPECT_TRUE(PlaceIndex(max_hamming).query(Places().place(10)).empty());
}

}  // namespace
}  // namespace rgbd_graphslam
