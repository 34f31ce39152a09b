#pragma once

#include <memory>
#include <string>
#include <vector>

namespace ensonify::dataset {

/// Python processes that make the pictures of scenes whose runs have ended, while others run.
class PictureMakers {
 public:
  /// So many, for this folder of a plan. keep: records are left when their pictures are made.
  PictureMakers(const std::string& folder, std::size_t count, bool keep);
  ~PictureMakers();

  /// Hands a scene to one of them, a line of the plan. Waits where they have more to do than they can keep up with.
  /// Throws ExitError with what went wrong with an earlier one.
  void make(const std::string& scene);

  /// Waits until all are made. Throws ExitError.
  void finish();

 private:
  class Maker;
  std::vector<std::unique_ptr<Maker>> makers_;
  std::size_t next_ = 0;
};

}  // namespace ensonify::dataset
