// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

#include "quadrille/core/contract.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// An index that names one kind of thing and converts to nothing else. Ordered; hashable.
template <class Tag>
class StrongId {
 public:
  using Value = std::uint32_t;

  constexpr StrongId() = default;  ///< Id 0.
  /// Requires a value below 2^32.
  constexpr explicit StrongId(std::size_t value) : value_(static_cast<Value>(value)) {
    QUADRILLE_REQUIRE(value_ == value, "ids have 32 bits");
  }

  /// The id as an index into a plain array.
  [[nodiscard]] constexpr std::size_t index() const noexcept { return value_; }
  [[nodiscard]] constexpr Value value() const noexcept { return value_; }

  friend constexpr auto operator<=>(StrongId, StrongId) = default;

 private:
  Value value_ = 0;
};

using AgentId = StrongId<struct AgentTag>;
using VertexId = StrongId<struct VertexTag>;

/// A timestep of the discrete domain. Never negative in an instance or a plan.
using Timestep = std::int32_t;
/// The cost of one agent or of a plan, in timesteps or ticks.
using Cost = std::int64_t;

/// A vector that is indexed by `Id` and by nothing else.
template <class Id, class T>
class IdVector {
 public:
  using iterator = typename std::vector<T>::iterator;
  using const_iterator = typename std::vector<T>::const_iterator;

  IdVector() = default;
  explicit IdVector(std::size_t size, const T& value = T()) : items_(size, value) {}
  IdVector(std::initializer_list<T> items) : items_(items) {}
  explicit IdVector(std::vector<T> items) : items_(std::move(items)) {}

  [[nodiscard]] typename std::vector<T>::reference operator[](Id id) { return items_[id.index()]; }
  [[nodiscard]] typename std::vector<T>::const_reference operator[](Id id) const {
    return items_[id.index()];
  }
  [[nodiscard]] std::size_t size() const noexcept { return items_.size(); }
  [[nodiscard]] bool empty() const noexcept { return items_.empty(); }
  void push_back(T item) { items_.push_back(std::move(item)); }
  void resize(std::size_t size, const T& value = T()) { items_.resize(size, value); }
  void assign(std::size_t size, const T& value) { items_.assign(size, value); }
  void reserve(std::size_t size) { items_.reserve(size); }
  /// The id that the next push_back gives.
  [[nodiscard]] Id next_id() const noexcept { return Id(items_.size()); }

  [[nodiscard]] iterator begin() noexcept { return items_.begin(); }
  [[nodiscard]] iterator end() noexcept { return items_.end(); }
  [[nodiscard]] const_iterator begin() const noexcept { return items_.begin(); }
  [[nodiscard]] const_iterator end() const noexcept { return items_.end(); }
  /// The items in id order.
  [[nodiscard]] const std::vector<T>& items() const noexcept { return items_; }

  friend bool operator==(const IdVector&, const IdVector&) = default;

 private:
  std::vector<T> items_;
};

/// Range over the ids 0 .. size-1, for range-based for loops.
template <class Id>
class IdRange {
 public:
  class Iterator {
   public:
    explicit Iterator(std::size_t at) : at_(at) {}
    Id operator*() const { return Id(at_); }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    friend bool operator==(Iterator, Iterator) = default;

   private:
    std::size_t at_;
  };
  explicit IdRange(std::size_t size) : size_(size) {}
  [[nodiscard]] Iterator begin() const { return Iterator(0); }
  [[nodiscard]] Iterator end() const { return Iterator(size_); }

 private:
  std::size_t size_;
};

}  // namespace quadrille

template <class Tag>
struct std::hash<quadrille::StrongId<Tag>> {
  std::size_t operator()(quadrille::StrongId<Tag> id) const noexcept { return id.index(); }
};

QUADRILLE_API_END
