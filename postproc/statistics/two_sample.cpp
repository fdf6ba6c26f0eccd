// SPDX-License-Identifier: GPL-2.0-or-later
#include "two_sample.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <string>

#include "finite_size.h"
#include "replicas.h"
#include "samples.h"

namespace LSM::postproc {

namespace {

// Of both series, where divisions are taken by classes.
constexpr std::size_t most_blocks = 2048;

// Both samples in one list; a division says which side each value is on.
class Joined {
 public:
  Joined(const std::vector<double> &first, const std::vector<double> &second) : values_(first) {
    values_.insert(values_.end(), second.begin(), second.end());
    order_.resize(values_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(),
              [this](std::size_t i, std::size_t j) { return values_[i] < values_[j]; });
  }

  // \param second whether a value belongs to the second sample
  double distance(const std::vector<char> &second) const {
    const auto n2 = static_cast<double>(std::count(second.begin(), second.end(), 1));
    const double n1 = static_cast<double>(second.size()) - n2;
    double below1 = 0.0, below2 = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      (second[order_[k]] ? below2 : below1) += 1.0;
      // Equal values count together.
      if (k + 1 < order_.size() && values_[order_[k + 1]] == values_[order_[k]]) continue;
      largest = std::max(largest, std::fabs(below1 / n1 - below2 / n2));
    }
    return largest;
  }

  // The class of each value, where all values together are divided into classes of consecutive
  // ranks, as equal as can be; equal values are in one class.
  std::vector<std::size_t> classes(std::size_t count) const {
    std::vector<std::size_t> classes(values_.size());
    for (std::size_t k = 0; k < order_.size(); ++k)
      classes[order_[k]] = k > 0 && values_[order_[k]] == values_[order_[k - 1]]
                               ? classes[order_[k - 1]]
                               : k * count / order_.size();
    return classes;
  }

  // Ranks in (-1, 1) in the order of the list; equal values have their mean rank.
  std::vector<double> ranks() const {
    std::vector<double> ranks(values_.size());
    for (std::size_t k = 0; k < order_.size();) {
      std::size_t end = k + 1;
      while (end < order_.size() && values_[order_[end]] == values_[order_[k]]) ++end;
      for (std::size_t i = k; i < end; ++i)
        ranks[order_[i]] = static_cast<double>(k + end) / static_cast<double>(values_.size()) - 1.0;
      k = end;
    }
    return ranks;
  }

 private:
  std::vector<double> values_;
  std::vector<std::size_t> order_;
};

// First values of blocks as equal as can be, and the end.
std::vector<std::size_t> blocks_of(std::size_t n, int block) {
  const std::size_t count = std::max<std::size_t>(1, n / static_cast<std::size_t>(block));
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i <= count; ++i) starts.push_back(i * n / count);
  return starts;
}

struct Block {
  std::size_t from, to;
};

// Blocks of the first series, then of the second one, behind it in the list.
std::vector<Block> blocks_of_both(std::size_t n1, std::size_t n2, int block) {
  std::vector<Block> blocks;
  const std::vector<std::size_t> starts1 = blocks_of(n1, block), starts2 = blocks_of(n2, block);
  for (std::size_t i = 0; i + 1 < starts1.size(); ++i)
    blocks.push_back({starts1[i], starts1[i + 1]});
  for (std::size_t i = 0; i + 1 < starts2.size(); ++i)
    blocks.push_back({n1 + starts2[i], n1 + starts2[i + 1]});
  return blocks;
}

// How many values of each class are in each block, so that the distance of a division costs no
// more for more values.
class ClassCounts {
 public:
  ClassCounts(const Joined &joined, const std::vector<Block> &blocks)
      : counts_(blocks.size() * classes), all_(classes) {
    const std::vector<std::size_t> class_of = joined.classes(classes);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (std::size_t i = blocks[b].from; i < blocks[b].to; ++i) {
        ++counts_[b * classes + class_of[i]];
        ++all_[class_of[i]];
      }
  }

  // \param first blocks on the side of the first sample
  double distance(const std::size_t *first, std::size_t count) const {
    std::vector<std::uint32_t> sums(classes);
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t *const block = counts_.data() + first[k] * classes;
      for (std::size_t c = 0; c < classes; ++c) sums[c] += block[c];
    }
    double n1 = 0.0, n2 = 0.0, below1 = 0.0, below2 = 0.0, largest = 0.0;
    for (std::size_t c = 0; c < classes; ++c) {
      n1 += sums[c];
      n2 += all_[c] - sums[c];
    }
    for (std::size_t c = 0; c < classes; ++c) {
      below1 += sums[c];
      below2 += all_[c] - sums[c];
      largest = std::max(largest, std::fabs(below1 / n1 - below2 / n2));
    }
    return largest;
  }

 private:
  static constexpr std::size_t classes = 512;
  std::vector<std::uint32_t> counts_, all_;
};

BlockMean block_mean(const std::vector<double> &values, int block) {
  BlockMean result;
  result.mean = mean_of(values);
  const std::vector<std::size_t> starts = blocks_of(values.size(), block);
  const auto count = static_cast<double>(starts.size() - 1);
  if (count < 2.0) return result;
  double squares = 0.0;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i)
    squares +=
        std::pow(mean_of(values.data() + starts[i], starts[i + 1] - starts[i]) - result.mean, 2);
  result.error = std::sqrt(squares / (count - 1.0) / count);
  return result;
}

}  // namespace

double two_sample_distance(std::vector<double> first, std::vector<double> second) {
  if (first.empty() || second.empty())
    throw std::invalid_argument("distance of two samples: one is empty");
  std::vector<char> side(first.size(), 0);
  side.resize(first.size() + second.size(), 1);
  return Joined(first, second).distance(side);
}

TwoSampleTest two_sample_test(const std::vector<double> &first, const std::vector<double> &second,
                              int replicas, std::uint64_t seed, int block) {
  for (const std::vector<double> *sample : {&first, &second})
    if (sample->size() < 10)
      throw std::invalid_argument("two-sample test of " + std::to_string(sample->size()) +
                                  " values, expected at least 10 in each series");
  if (replicas < 1 || block < 0)
    throw std::invalid_argument(
        "two-sample test: expected at least 1 replica and blocks of 0 or more");
  TwoSampleTest test;
  test.n = {static_cast<std::int64_t>(first.size()), static_cast<std::int64_t>(second.size())};
  const Joined joined(first, second);
  const std::size_t n = first.size() + second.size();
  const bool by_classes = block == 0 && n > 2 * static_cast<std::size_t>(largest_exact_sample);
  if (block == 0) {
    const std::vector<double> ranks = joined.ranks();
    const auto middle = ranks.begin() + static_cast<std::ptrdiff_t>(first.size());
    const double longer =
        std::max(block_length(centred(std::vector<double>(ranks.begin(), middle))),
                 block_length(centred(std::vector<double>(middle, ranks.end()))));
    block = std::max(1, static_cast<int>(std::lround(longer)));
    // Longer blocks are as sound.
    if (by_classes) block = std::max(block, static_cast<int>(n / most_blocks));
  }
  test.block = block;
  test.means = {block_mean(first, block), block_mean(second, block)};
  test.ratio = test.means[1].mean / test.means[0].mean;
  test.ratio_error = std::fabs(test.ratio) * std::hypot(test.means[0].error / test.means[0].mean,
                                                        test.means[1].error / test.means[1].mean);

  const std::vector<Block> blocks = blocks_of_both(first.size(), second.size(), block);
  const auto of_first = static_cast<std::size_t>(std::count_if(
      blocks.begin(), blocks.end(), [&first](const Block &b) { return b.to <= first.size(); }));
  std::vector<std::size_t> order(blocks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto exact = [&](const std::vector<std::size_t> &divided) {
    std::vector<char> side(n, 1);
    for (std::size_t i = 0; i < of_first; ++i)
      std::fill(side.begin() + static_cast<std::ptrdiff_t>(blocks[divided[i]].from),
                side.begin() + static_cast<std::ptrdiff_t>(blocks[divided[i]].to), 0);
    return joined.distance(side);
  };
  test.distance = exact(order);
  const ClassCounts counts(joined, by_classes ? blocks : std::vector<Block>{});
  const auto distance = [&](const std::vector<std::size_t> &divided) {
    return by_classes ? counts.distance(divided.data(), of_first) : exact(divided);
  };
  // Sums of counts over counts are exact to rounding only.
  const double least = distance(order) * (1.0 - 1e-12);
  // One division after the other from one stream, whoever takes them.
  Random random(seed);
  std::mutex drawing;
  test.p = share_of_replicas(replicas, [&](int) {
    std::vector<std::size_t> divided;
    {
      const std::lock_guard<std::mutex> lock(drawing);
      shuffle(order, random);
      divided = order;
    }
    return distance(divided) >= least;
  });
  test.p_error = std::sqrt(test.p * (1.0 - test.p) / (replicas + 1.0));
  return test;
}

}  // namespace LSM::postproc
