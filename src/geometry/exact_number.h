#pragma once

#include <CGAL/Gmpq.h>
#include <CGAL/Mpzf.h>

namespace prohull {

/// Exact sums and products of doubles: without allocation where exponents are not far apart, and some ten times as
/// fast as rational numbers.
#ifdef CGAL_HAS_MPZF
using ExactNumber = CGAL::Mpzf;
#else
using ExactNumber = CGAL::Gmpq;
#endif

}  // namespace prohull
