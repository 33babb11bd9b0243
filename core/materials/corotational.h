// Corotational elasticity: the strain is measured in the element's own turned frame. F = Q S (polar.h), e = S - I,
// Psi = mu e:e + lambda/2 tr(e)^2, P = Q (2 mu e + lambda tr(e) I). With the exact Q this P is the exact gradient of
// Psi. Source: M. Mueller, M. Gross, Interactive virtual materials, Graphics Interface 2004; the tangent follows from
// dQ = Q [w], w = (tr(S) I - S)^-1 axl(Q^T dF - dF^T Q).
#pragma once

#include "core/materials/law.h"

namespace flexcast {
extern const Law corotational_law;

// c_k of the tangent's twist mode about the k-th axis, from the signed stretches, Pa; clamped: c_k >= -mu.
double calc_twist(Lame lame, bool clamped, const Vec3& s, int k);
}  // namespace flexcast
