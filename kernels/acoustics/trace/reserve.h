#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
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

}  // namespace ensonify::trace
