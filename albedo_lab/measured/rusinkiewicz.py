"""The change of variables of Rusinkiewicz (1998): a pair of directions as its half-vector and the light seen from there.

theta_h is the angle between normal and half-vector; theta_d and phi_d are the light's polar angle and azimuth about the
half-vector, phi_d counted from the tangent that points away from the normal. A surface that looks the same turned about its
normal has no use for phi_h; and where light and viewer can change places, phi_d and phi_d + pi are the same.
"""

from __future__ import annotations

from math import atan2, cos, pi, sin, sqrt
from typing import NamedTuple

from albedo_lab.optics.frame import Direction


class HalfDifference(NamedTuple):
    """theta_h and theta_d in [0, pi/2], phi_d in [0, pi)."""

    theta_h: float
    theta_d: float
    phi_d: float


def half_difference(wi: Direction, wo: Direction) -> HalfDifference:
    """The angles of a pair of directions, light and viewer in either order.

    v = wi + wo points to the half-vector, u = wi - wo is normal to it: tan(theta_d) = |u| / |v|, and phi_d is the azimuth of u
    from the tangent (v_x v_z, v_y v_z, -v_xy^2). No angle is taken from a cosine. phi_d is 0 or pi/2 where it has no meaning.
    """
    vx, vy, vz = wi.x + wo.x, wi.y + wo.y, wi.z + wo.z
    ux, uy, uz = wi.x - wo.x, wi.y - wo.y, wi.z - wo.z
    horizontal = vx * vx + vy * vy
    whole = sqrt(horizontal + vz * vz)
    phi_d = atan2((vx * uy - vy * ux) * whole, (vx * ux + vy * uy) * vz - uz * horizontal)
    phi_d = phi_d + pi if phi_d < 0.0 else phi_d
    return HalfDifference(
        atan2(sqrt(horizontal), vz),
        atan2(sqrt(ux * ux + uy * uy + uz * uz), whole),
        phi_d if phi_d < pi else 0.0,
    )


def light_and_viewer(at: HalfDifference, phi_h: float) -> tuple[Direction, Direction]:
    """The pair of directions whose half-vector has the azimuth phi_h; one may lie below the horizon."""
    sh, ch = sin(at.theta_h), cos(at.theta_h)
    sd, cd = sin(at.theta_d), cos(at.theta_d)
    sp, cp = sin(phi_h), cos(phi_h)
    along, across = sd * cos(at.phi_d), sd * sin(at.phi_d)
    outward, level = cd * sh, along * ch
    rise, tilt = cd * ch, along * sh
    return (
        Direction((outward + level) * cp - across * sp, (outward + level) * sp + across * cp, rise - tilt),
        Direction((outward - level) * cp + across * sp, (outward - level) * sp - across * cp, rise + tilt),
    )


def lower_cosine(at: HalfDifference) -> float:
    """The smaller of both directions' cosines with the normal."""
    return cos(at.theta_h) * cos(at.theta_d) - sin(at.theta_h) * sin(at.theta_d) * abs(cos(at.phi_d))
