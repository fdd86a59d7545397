#include "rgbd_graphslam/semantics/label_vote.h"

#include <algorithm>
#include <cmath>

namespace rgbd_graphslam {

void LabelVote::add(int label, float share) {
    const auto same = std::find(labels_.begin(), labels_.end(), label);
    const auto weakest = std::min_element(votes_.begin(), votes_.end()) - votes_.begin();
    const auto place = same != labels_.end() ? same - labels_.begin() : weakest;
    labels_[place] = static_cast<std::uint16_t>(label);
    votes_[place] += share;
}

std::size_t LabelVote::strongest() const {
    return static_cast<std::size_t>(std::max_element(votes_.begin(), votes_.end()) -
                                    votes_.begin());
}

double LabelVote::confidence(double frame_accuracy, int classes) const {
    const double log_odds = std::log(frame_accuracy * (classes - 1) / (1 - frame_accuracy));
    const float most = votes_[strongest()];
    const auto others = static_cast<int>(
        std::count_if(votes_.begin(), votes_.end(), [](float v) { return v > 0; }));
    double sum = std::max(0, classes - others) * std::exp(-log_odds * most);
    for (const float votes : votes_) {
        if (votes > 0) sum += std::exp(log_odds * (votes - most));
    }
    return votes() > 0 ? 1 / sum : 0;
}

}  // namespace rgbd_graphslam
