/** A sequence that grows without moving what it holds. */
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace rgbd_graphslam {

/** As std::vector, in chunks of 256 kB: growing copies nothing and leaves at most one chunk empty,
 * and references stay valid until clear(). */
template <class T>
class ChunkedVector {
  public:
    class Iterator {
      public:
        Iterator(const ChunkedVector& vector, std::size_t index) : vector_(vector), index_(index) {}
        const T& operator*() const { return vector_[index_]; }
        Iterator& operator++() {
            ++index_;
            return *this;
        }
        bool operator!=(const Iterator& other) const { return index_ != other.index_; }

      private:
        const ChunkedVector& vector_;
        std::size_t index_;
    };

    void push_back(T value) {
        const std::size_t chunk = size_ / chunk_size;
        if (chunk == chunks_.size()) {
            chunks_.emplace_back();
            chunks_.back().reserve(chunk_size);
        }
        chunks_[chunk].push_back(std::move(value));
        ++size_;
    }

    T& operator[](std::size_t i) { return chunks_[i / chunk_size][i % chunk_size]; }
    const T& operator[](std::size_t i) const { return chunks_[i / chunk_size][i % chunk_size]; }

    std::size_t size() const { return size_; }
    Iterator begin() const { return {*this, 0}; }
    Iterator end() const { return {*this, size_}; }

    /** Keeps the memory for the next use. */
    void clear() {
        for (auto& chunk : chunks_) chunk.clear();
        size_ = 0;
    }

    std::size_t bytes() const { return chunks_.size() * chunk_size * sizeof(T); }

  private:
    static constexpr std::size_t largestPowerOfTwo(std::size_t limit) {
        return limit < 2 ? 1 : 2 * largestPowerOfTwo(limit / 2);
    }
    static constexpr std::size_t chunk_size = largestPowerOfTwo((1 << 18) / sizeof(T));

    std::vector<std::vector<T>> chunks_;
    std::size_t size_ = 0;
};

}  // namespace rgbd_graphslam
