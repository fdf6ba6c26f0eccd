// SPDX-License-Identifier: GPL-2.0-or-later
#include "two_sample.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "finite_size.h"
#include "lsm_random.h"
#include "lsm_sum.h"

namespace LSM::postproc {

namespace {

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

double mean_of(const std::vector<double> &values, std::size_t from, std::size_t to) {
  return sum_pairwise(values.data() + from, to - from) / static_cast<double>(to - from);
}

std::vector<double> centred(std::vector<double> values) {
  const double mean = mean_of(values, 0, values.size());
  for (double &value : values) value -= mean;
  return values;
}

BlockMean block_mean(const std::vector<double> &values, int block) {
  BlockMean result;
  result.mean = mean_of(values, 0, values.size());
  const std::vector<std::size_t> starts = blocks_of(values.size(), block);
  const auto count = static_cast<double>(starts.size() - 1);
  if (count < 2.0) return result;
  double squares = 0.0;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i)
    squares += std::pow(mean_of(values, starts[i], starts[i + 1]) - result.mean, 2);
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
  if (block == 0) {
    const std::vector<double> ranks = joined.ranks();
    const auto middle = ranks.begin() + static_cast<std::ptrdiff_t>(first.size());
    const double longer =
        std::max(block_length(centred(std::vector<double>(ranks.begin(), middle))),
                 block_length(centred(std::vector<double>(middle, ranks.end()))));
    block = std::max(1, static_cast<int>(std::lround(longer)));
  }
  test.block = block;
  test.means = {block_mean(first, block), block_mean(second, block)};
  test.ratio = test.means[1].mean / test.means[0].mean;
  test.ratio_error = std::fabs(test.ratio) * std::hypot(test.means[0].error / test.means[0].mean,
                                                        test.means[1].error / test.means[1].mean);

  struct Block {
    std::size_t from, to;
  };
  std::vector<Block> blocks;
  const std::vector<std::size_t> starts1 = blocks_of(first.size(), block);
  const std::vector<std::size_t> starts2 = blocks_of(second.size(), block);
  for (std::size_t i = 0; i + 1 < starts1.size(); ++i)
    blocks.push_back({starts1[i], starts1[i + 1]});
  const std::size_t of_first = blocks.size();
  for (std::size_t i = 0; i + 1 < starts2.size(); ++i)
    blocks.push_back({first.size() + starts2[i], first.size() + starts2[i + 1]});

  std::vector<char> side(first.size() + second.size());
  const auto divide = [&] {
    std::fill(side.begin(), side.end(), 1);
    for (std::size_t i = 0; i < of_first; ++i)
      std::fill(side.begin() + static_cast<std::ptrdiff_t>(blocks[i].from),
                side.begin() + static_cast<std::ptrdiff_t>(blocks[i].to), 0);
    return joined.distance(side);
  };
  test.distance = divide();
  Random random(seed);
  int as_large = 1;
  // Sums of counts over counts are exact to rounding only.
  const double least = test.distance * (1.0 - 1e-12);
  for (int r = 0; r < replicas; ++r) {
    for (std::size_t i = blocks.size() - 1; i > 0; --i)
      std::swap(blocks[i],
                blocks[static_cast<std::size_t>(random.uniform() * static_cast<double>(i + 1))]);
    if (divide() >= least) ++as_large;
  }
  test.p = static_cast<double>(as_large) / (replicas + 1.0);
  test.p_error = std::sqrt(test.p * (1.0 - test.p) / (replicas + 1.0));
  return test;
}

}  // namespace LSM::postproc
