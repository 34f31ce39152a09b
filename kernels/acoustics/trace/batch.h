#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <cstddef>
#include <tuple>
#include <vector>

namespace ensonify::trace {

/// Room for `count` elements; nothing is done where there is enough. Else what the vector holds is lost, and an eighth
/// more is taken, as the next ping may have some more rays.
///
/// The system hands out memory page by page as it is first touched, which takes longer than to fill it: for the 200 MB
/// of a first ping with 600,000 rays a tenth of a second, if resize() does it on one thread. So all threads touch it.
template <class T>
void make_room(std::vector<T>& vector, std::size_t count) {
  constexpr std::size_t kPage = 4096, kPagesPerTask = 64;
  if (count <= vector.capacity()) return;
  vector = {};
  vector.reserve(count + count / 8);
  volatile char* const room = reinterpret_cast<char*>(vector.data());  // no element is there yet
  const std::size_t pages = count * sizeof(T) / kPage;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pages, kPagesPerTask), [&](const auto& range) {
    for (std::size_t page = range.begin(); page < range.end(); ++page) room[page * kPage] = 0;
  });
}

/// `count` elements of any value, for who writes each of them.
template <class T>
void make_elements(std::vector<T>& vector, std::size_t count) {
  make_room(vector, count);
  vector.resize(count);
}

/// Vectors of a batch: a column for each component.
template <class T>
struct VectorColumns {
  using Vector = Eigen::Matrix<T, 3, 1>;
  std::vector<T> x, y, z;

  Vector operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const Vector& vector) { x[i] = vector.x(), y[i] = vector.y(), z[i] = vector.z(); }
};

/// Batch of rows as structure of arrays: a column of numbers for each scalar, in memory of its owner. A batch of rows
/// derives from Batch<itself, row> and has its columns, and
///   static auto columns(self)    std::tie of all columns
///   Row operator[](i) const      a row by value
///   void set(i, row)             from several threads for different i
template <class Rows, class Row>
class Batch {
 public:
  std::size_t size() const { return std::get<0>(Rows::columns(static_cast<const Rows&>(*this))).size(); }
  bool empty() const { return size() == 0; }
  void clear() { resize(0); }
  /// Keeps the rows that fit; numbers of new ones are 0.
  void resize(std::size_t count) {
    for_columns([count](auto& column) { column.resize(count); });
  }
  /// As of vectors: rows may be lost.
  void make_room(std::size_t count) {
    for_columns([count](auto& column) { trace::make_room(column, count); });
  }
  void make_elements(std::size_t count) {
    for_columns([count](auto& column) { trace::make_elements(column, count); });
  }
  void push_back(const Row& row) {
    resize(size() + 1);
    static_cast<Rows*>(this)->set(size() - 1, row);
  }

  friend bool operator==(const Rows& a, const Rows& b) { return Rows::columns(a) == Rows::columns(b); }

  struct Iterator {
    const Rows* rows;
    std::size_t at;
    Row operator*() const { return (*rows)[at]; }
    Iterator& operator++() { return ++at, *this; }
    bool operator==(const Iterator&) const = default;
  };
  Iterator begin() const { return {static_cast<const Rows*>(this), 0}; }
  Iterator end() const { return {static_cast<const Rows*>(this), size()}; }

 private:
  template <class Work>
  void for_columns(const Work& work) {
    std::apply([&](auto&... column) { (work(column), ...); }, Rows::columns(static_cast<Rows&>(*this)));
  }
};

}  // namespace ensonify::trace
