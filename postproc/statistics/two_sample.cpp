// SPDX-License-Identifier: GPL-2.0-or-later
#include "two_sample.h"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <string>

#include "block_length.h"
#include "monte_carlo.h"

namespace LSM::postproc {

namespace {

// For both series together, when distances are computed by classes.
constexpr std::size_t most_blocks = 2048, coarse_classes = 512;

struct Block {
  std::size_t from, to;
};

// Divides n values into blocks, as equal as possible, of which the first begins at `from`.
std::vector<Block> blocks_of(std::size_t n, int block, std::size_t from = 0) {
  const std::size_t count = std::max<std::size_t>(1, n / static_cast<std::size_t>(block));
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < count; ++i)
    blocks.push_back({from + i * n / count, from + (i + 1) * n / count});
  return blocks;
}

using Counts = std::vector<std::uint32_t>;

// Both samples in one list, with all values divided into classes of consecutive ranks, as equal as
// possible; equal values are in the same class. With as many classes as values, each distinct value
// has a class of its own.
class Classes {
 public:
  Classes(const std::vector<double> &first, const std::vector<double> &second, std::size_t count)
      : class_of_(first.size() + second.size()), all_(count) {
    std::vector<double> values = first;
    values.insert(values.end(), second.begin(), second.end());
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&values](std::size_t i, std::size_t j) { return values[i] < values[j]; });
    for (std::size_t k = 0; k < order.size(); ++k) {
      const bool same = k > 0 && values[order[k]] == values[order[k - 1]];
      class_of_[order[k]] = same ? class_of_[order[k - 1]] : k * count / order.size();
      ++all_[class_of_[order[k]]];
    }
  }

  std::size_t count() const { return all_.size(); }

  void add(const Block &block, Counts &counts) const {
    for (std::size_t i = block.from; i < block.to; ++i) ++counts[class_of_[i]];
  }

  // Largest difference between the cumulative distributions of the counted values and of the rest.
  double distance(const Counts &counts) const {
    const auto n1 = static_cast<double>(std::accumulate(counts.begin(), counts.end(), 0u)),
               n2 = static_cast<double>(class_of_.size()) - n1;
    double below1 = 0.0, below2 = 0.0, largest = 0.0;
    for (std::size_t c = 0; c < count(); ++c) {
      below1 += counts[c];
      below2 += all_[c] - counts[c];
      largest = std::max(largest, std::fabs(below1 / n1 - below2 / n2));
    }
    return largest;
  }

  // Ranks of some values scaled to (-1, 1); equal values have their mean rank. Only valid with as
  // many classes as values.
  std::vector<double> ranks(std::size_t from, std::size_t to) const {
    std::vector<double> ranks;
    for (std::size_t i = from; i < to; ++i)
      ranks.push_back(static_cast<double>(2 * class_of_[i] + all_[class_of_[i]]) /
                          static_cast<double>(count()) -
                      1.0);
    return ranks;
  }

 private:
  std::vector<std::size_t> class_of_;
  Counts all_;
};

Measured block_mean(const std::vector<double> &values, int block) {
  Measured result{mean_of(values)};
  std::vector<double> means;
  for (const Block &one : blocks_of(values.size(), block))
    means.push_back(mean_of(values.data() + one.from, one.to - one.from));
  const auto count = static_cast<double>(means.size());
  if (count < 2.0) return result;
  result.error = gsl_stats_sd_m(means.data(), 1, means.size(), result.value) / std::sqrt(count);
  return result;
}

// Block length that is long against the correlation of either sample.
int usual_block(const Classes &classes, std::size_t n1, std::size_t n) {
  const double longer = std::max(block_length(centred(classes.ranks(0, n1))),
                                 block_length(centred(classes.ranks(n1, n))));
  return std::max(1, static_cast<int>(std::lround(longer)));
}

}  // namespace

TwoSampleTest two_sample_test(const std::vector<double> &first, const std::vector<double> &second,
                              int replicas, std::uint64_t seed) {
  for (const std::vector<double> *sample : {&first, &second})
    if (sample->size() < 10)
      throw std::invalid_argument("two-sample test of " + std::to_string(sample->size()) +
                                  " values, expected at least 10 in each series");
  TwoSampleTest test;
  test.n = {static_cast<std::int64_t>(first.size()), static_cast<std::int64_t>(second.size())};
  const std::size_t n = first.size() + second.size();
  Classes classes(first, second, n);
  const bool by_classes = n > 2 * largest_exact_sample;
  int block = usual_block(classes, first.size(), n);
  // Longer blocks are just as valid.
  if (by_classes) block = std::max(block, static_cast<int>(n / most_blocks));
  test.block = block;
  test.means = {block_mean(first, block), block_mean(second, block)};
  const auto [a, b] = test.means;
  const double ratio = b.value / a.value;
  test.ratio = {ratio, std::fabs(ratio) * std::hypot(a.error / a.value, b.error / b.value)};

  std::vector<Block> blocks = blocks_of(first.size(), block);
  const std::size_t of_first = blocks.size();
  for (const Block &one : blocks_of(second.size(), block, first.size())) blocks.push_back(one);
  std::vector<std::size_t> order(blocks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Counts of_series(n);
  classes.add({0, first.size()}, of_series);
  test.distance = classes.distance(of_series);
  // Counts by class for each block, so that the cost of a division does not grow with the number of
  // values.
  std::vector<Counts> in_block;
  if (by_classes) {
    classes = Classes(first, second, coarse_classes);
    in_block.assign(blocks.size(), Counts(coarse_classes));
    for (std::size_t i = 0; i < blocks.size(); ++i) classes.add(blocks[i], in_block[i]);
  }
  const auto distance = [&](const std::vector<std::size_t> &divided) {
    Counts counts(classes.count());
    for (std::size_t i = 0; i < of_first; ++i)
      if (by_classes)
        std::transform(counts.begin(), counts.end(), in_block[divided[i]].begin(), counts.begin(),
                       std::plus<>());
      else
        classes.add(blocks[divided[i]], counts);
    return classes.distance(counts);
  };
  // Sums of counts over counts are only exact up to rounding.
  const double least = distance(order) * (1.0 - 1e-12);
  Random random(seed);
  std::mutex drawing;
  const double p = share_of_replicas(replicas, [&](int) {
    std::unique_lock<std::mutex> lock(drawing);
    shuffle(order, random);
    const std::vector<std::size_t> divided = order;
    lock.unlock();
    return distance(divided) >= least;
  });
  test.p = share_of(p, replicas);
  return test;
}

}  // namespace LSM::postproc
