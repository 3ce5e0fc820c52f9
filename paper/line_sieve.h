#pragma once

#include <cmath>

#include "query/line.h"

namespace prohull {

/// A line as the faces of one mesh see it, for a quick and certain answer to most of them.
///
/// Along the coordinate k in which its direction D, as rounded, is greatest, the line is projected to a point: p
/// becomes (u, v) = ((p - o)_i D_k - (p - o)_k D_i, (p - o)_j D_k - (p - o)_k D_j). Of two corners p, q of a face u_p
/// v_q - v_p u_q is then D_k dot(D, (p - o) cross (q - o)): a face whose edges have two certain values of different
/// sign is passed by. v is turned where D_k is negative, so that signs are those of dot(D, (p - o) cross (q - o)).
///
/// With M = |D_k|, R no less than any coordinate of p - o, and eps = 2^-53: p - o has a relative error of eps, a
/// product with D another eps, and the difference, at most 2 R M, another: u and v are within 6 eps R M (and O(eps^2)).
/// Then each product of them is within 28 eps R^2 M^2, their difference within 64; D itself, for a segment, may be off
/// by eps M, which is another 6. Products that underflow are negligible while R^2 M^2 is above 2^-900.
class LineSieve {
 public:
  /// Requires all corners of faces to lie in `frame`.
  LineSieve(const DirectedLine& line, const Box& frame) : origin_(line.origin) {
    const Vec3& d = line.direction;
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    const int k = z >= x && z >= y ? 2 : y >= x ? 1 : 0, i = (k + 1) % 3, j = (k + 2) % 3;
    const double turned = d[k] < 0 ? -1 : 1;
    u_[i] = d[k], u_[k] = -d[i];
    v_[j] = turned * d[k], v_[k] = -turned * d[j];
    const double reach =
        std::max(line_filter::largest_entry(frame.max - origin_), line_filter::largest_entry(frame.min - origin_)) *
        std::abs(d[k]);
    reach_ = reach, longest_ = std::abs(d[k]);
    error_ = error_bound(reach * reach);
  }

  struct Projected {
    double u, v;
  };
  Projected projected(const Vec3& p) const { return {dot(u_, p - origin_), dot(v_, p - origin_)}; }

  /// The sign of dot(D, (p - o) cross (q - o)) where it is certain, else 0.
  int edge_sign(const Projected& p, const Projected& q) const {
    const double value = p.u * q.v - p.v * q.u;
    return value > error_ ? 1 : value < -error_ ? -1 : 0;
  }

  /// The same for the corners themselves: also certain where they are very near to each other. The difference e = q - p
  /// stands for q, so that the largest entry of e takes the place of one R in the bound above.
  int edge_sign(const Vec3& p, const Vec3& q) const {
    const Vec3 e = q - p;
    const Projected at = projected(p);
    const double eu = dot(u_, e), ev = dot(v_, e), value = at.u * ev - at.v * eu;
    const double error = error_bound(reach_ * line_filter::largest_entry(e) * longest_);
    return value > error ? 1 : value < -error ? -1 : 0;
  }

  /// Whether the line certainly passes the face by.
  bool passes(const Triangle& face) const {
    const Projected p = projected(face.a), q = projected(face.b), r = projected(face.c);
    const double pq = p.u * q.v - p.v * q.u, qr = q.u * r.v - q.v * r.u, rp = r.u * p.v - r.v * p.u;
    return std::min(std::min(pq, qr), rp) < -error_ && std::max(std::max(pq, qr), rp) > error_;
  }

 private:
  /// `size`: R^2 M^2, or what stands for it. Infinite where products may underflow or overflow.
  static double error_bound(double size) {
    return size > 0x1p-900 && size < 0x1p900 ? 80 * line_filter::kEpsilon * size
                                             : std::numeric_limits<double>::infinity();
  }

  Vec3 origin_;
  Vec3 u_, v_;  // each with a 0, which adds no error
  double error_;
  double reach_, longest_;  // R M, M
};

}  // namespace prohull
