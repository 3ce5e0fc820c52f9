#include "geometry/float32.h"

namespace prohull {

double nearest_float32(double x) { return static_cast<float>(x); }

}  // namespace prohull
