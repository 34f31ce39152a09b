#include "components/terrain_pager/resident.h"

#include <mutex>
#include <utility>

namespace ensonify::pager {
namespace {

std::mutex mutex;

/// Never destroyed: rasters must not be closed when GDAL is gone already.
Resident& left() {
  static auto* const resident = new Resident;
  return *resident;
}

}  // namespace

Resident take_resident(const std::string& seabed) {
  const std::scoped_lock lock(mutex);
  Resident resident = std::exchange(left(), {});
  if (seabed.empty() || resident.seabed != seabed) return {seabed, {}, {}, {}, {}};
  return resident;
}

void leave_resident(Resident resident) {
  if (resident.seabed.empty()) return;
  const std::scoped_lock lock(mutex);
  left() = std::move(resident);
}

}  // namespace ensonify::pager
