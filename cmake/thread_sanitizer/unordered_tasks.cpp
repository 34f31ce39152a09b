// Two tasks that write one number: what the thread sanitizer has to find.
#include <tbb/parallel_for.h>

#include <cstdio>

int main() {
  int sum = 0;
  tbb::parallel_for(0, 100, [&](int i) { sum += i; });
  std::printf("%d\n", sum);
}
