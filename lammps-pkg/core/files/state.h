// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/state.h
/// State in a restart file. One function lists the members, for both writing and reading:
///
///     template <class Self, class State>
///     static void visit(Self &self, State &state) { state(self.step, self.pe); }
///
/// Self is const when writing. Types with visit() can be members of others and elements of vectors.
/// Integers and booleans are stored as doubles, exact below 2^53.
#ifndef LSM_STATE_H
#define LSM_STATE_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace LSM {

/// Common part of writing and reading. Derived has one(number); expect(numbers), which checks that
/// as many can be read; and raw_words(pointer, words).
template <class Derived>
class StateVisitor {
 public:
  template <class... Values>
  void operator()(Values &...values) {
    (any(values), ...);
  }
  /// Visits a vector whose length is known to the reader.
  template <class Vector>
  void fixed(Vector &values) {
    for (auto &value : values) any(value);
  }
  /// Visits the length of a vector, then its elements.
  template <class Vector>
  void list(Vector &values) {
    list(values, [](auto &) {});
  }
  /// prepare(element) is called before each element is read.
  template <class Vector, class Prepare>
  void list(Vector &values, Prepare &&prepare) {
    auto length = static_cast<std::int64_t>(values.size());
    self().one(length);
    if constexpr (!std::is_const_v<Vector>) {
      self().expect(length);
      values.resize(static_cast<std::size_t>(length));
    }
    for (auto &value : values) prepare(value);
    fixed(values);
  }
  /// Copies the bytes of a struct of eight-byte words unchanged.
  template <class Plain>
  void raw(Plain &plain) {
    static_assert(std::is_trivially_copyable_v<Plain> && sizeof(Plain) % sizeof(double) == 0);
    self().raw_words(&plain, sizeof(Plain) / sizeof(double));
  }

 private:
  Derived &self() { return static_cast<Derived &>(*this); }
  template <class Value>
  void any(Value &value) {
    if constexpr (std::is_arithmetic_v<Value>)
      self().one(value);
    else
      Value::visit(value, self());
  }
};

/// Appends the state to a vector.
class StateWriter : public StateVisitor<StateWriter> {
 public:
  explicit StateWriter(std::vector<double> &to) : to_(to) {}

  template <class Value>
  void one(const Value &value) {
    to_.push_back(static_cast<double>(value));
  }
  void expect(std::int64_t) {}
  void raw_words(const void *from, std::size_t words) {
    to_.resize(to_.size() + words);
    std::memcpy(&to_[to_.size() - words], from, words * sizeof(double));
  }

 private:
  std::vector<double> &to_;
};

/// Reads the state from numbers.
/// \throws std::invalid_argument if numbers are missing
class StateReader : public StateVisitor<StateReader> {
 public:
  explicit StateReader(const std::vector<double> &from, std::size_t at = 0)
      : from_(from.data() + at), left_(from.size() - at) {}
  /// For numbers that are known to be complete.
  explicit StateReader(const double *from) : from_(from), left_(SIZE_MAX) {}

  template <class Value>
  void one(Value &value) {
    expect(1);
    value = static_cast<Value>(*from_++);
    --left_;
  }
  /// Checks that at least this many numbers are left.
  void expect(std::int64_t numbers) const {
    if (numbers < 0 || static_cast<std::uint64_t>(numbers) > left_)
      throw std::invalid_argument("saved state is incomplete");
  }
  void raw_words(void *to, std::size_t words) {
    expect(static_cast<std::int64_t>(words));
    std::memcpy(to, from_, words * sizeof(double));
    from_ += words;
    left_ -= words;
  }
  /// How many numbers have not been read yet.
  std::size_t left() const { return left_; }

 private:
  const double *from_;
  std::size_t left_;
};

}  // namespace LSM

#endif
