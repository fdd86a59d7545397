/** Which keyframes show the same place, learnt on the way. */
#pragma once
#include <memory>
#include <vector>

#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/features/descriptor.h"

namespace rgbd_graphslam {

/** A keyframe that looks alike. */
struct PlaceVote {
    int keyframe = 0;
    /** Descriptors of the query that match one of the keyframe. */
    int votes = 0;
};

/** Binary search tree over descriptor bits (Schlegel and Grisetti, "HBST: a Hamming distance
 *  embedding binary search tree", RA-L 2018): a node splits its descriptors by the bit that halves
 *  them best, a leaf compares exhaustively. Nothing is loaded; cost grows with the depth. Several
 *  trees over disjoint halves of the bits make up for bits that flip. */
class PlaceIndex {
  public:
    explicit PlaceIndex(int max_hamming);
    ~PlaceIndex();

    /** \param keyframe rising from call to call */
    void insert(int keyframe, const std::vector<Descriptor>& descriptors);

    /** The same for many, one list a keyframe from 0; the trees grow side by side. */
    void insertAll(const std::vector<std::vector<Descriptor>>& descriptors);

    void save(ByteWriter& out) const;
    /** The trees divide the descriptors as those that were saved.
     *  \param keyframes there are
     *  \throws DamagedBytes */
    void load(ByteReader& in, std::size_t keyframes);

    /** Forgets a keyframe; the memory of its descriptors is free some insertions later. */
    void erase(int keyframe);

    /** Keyframes with their number of matches, best first, then by id. */
    std::vector<PlaceVote> query(const std::vector<Descriptor>& descriptors) const;

  private:
    struct Tree;
    int max_hamming_;
    /** One per keyframe. */
    std::vector<char> erased_;
    std::vector<std::unique_ptr<Tree>> trees_;
};

}  // namespace rgbd_graphslam
