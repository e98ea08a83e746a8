# SPDX-License-Identifier: Apache-2.0
"""What goes in and what comes out, as dataclasses."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Mapping, Optional, Tuple

import numpy as np
import numpy.typing as npt

Vector = npt.NDArray[np.float64]
Region = Tuple[int, int, int, int]
POLARITIES = ('dark', 'bright', 'mixed')


@dataclass(frozen=True)
class Camera:
    """Pinhole camera with Brown-Conrady distortion, in pixels and OpenCV's order and sense."""
    fx: float
    fy: float
    cx: float
    cy: float
    k1: float = 0.0
    k2: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    k3: float = 0.0

    def numbers(self) -> Tuple[float, ...]:
        return (self.fx, self.fy, self.cx, self.cy, self.k1, self.k2, self.p1, self.p2, self.k3)


@dataclass(frozen=True)
class Model:
    """The drogue: radius of the rim, at least 0.01, radius of the inner part and its depth behind the rim; metres, rounded
    to multiples of 2^-16. An inner radius of 0: unknown, and the orientation stays unresolved."""
    radius: float
    inner_radius: float = 0.0
    inner_depth: float = 0.0

    def numbers(self) -> Tuple[float, float, float]:
        return (self.radius, self.inner_radius, self.inner_depth)


@dataclass(frozen=True)
class Ellipse:
    """Centre and semi-axes a >= b in pixels of the whole image; angle of the major axis from +x towards +y, radians."""
    xc: float
    yc: float
    a: float
    b: float
    angle_rad: float


@dataclass(frozen=True)
class InnerPart:
    """Centre and root mean square of the rays' residuals in pixels, area in pixels, grey at the edge and step across it,
    rays of 64 that see it."""
    x: float
    y: float
    area: int
    spread: float
    threshold: int
    contrast: int
    rays: int


@dataclass(frozen=True)
class Quality:
    """Scores of the fit, each in [0, 1]."""
    fit_ratio: float
    length_ratio: float
    axis_ratio: float
    score: float
    reliability: float


@dataclass(frozen=True, eq=False)
class Pose:
    """Centre of the end plane, shape (3,), metres; unit vector into the drogue, shape (3,); its angles, radians."""
    position_m: Vector
    axis: Vector
    yaw_rad: float
    pitch_rad: float

    @property
    def yaw_deg(self) -> float:
        return math.degrees(self.yaw_rad)

    @property
    def pitch_deg(self) -> float:
        return math.degrees(self.pitch_rad)


@dataclass(frozen=True, eq=False)
class Result:
    """One measurement. What could not be measured is None; docs/program.md explains status and scores."""
    status: str
    second_look: str  # what became of a second look at an outline that the region cuts
    region: Region  # used, clipped to the image: x, y, width, height
    edge_count: int
    arc_count: int
    arcs: Tuple[Optional[int], ...]  # of the winning combination, by quadrant
    ellipse: Optional[Ellipse]  # as seen
    ideal: Optional[Ellipse]  # without distortion
    quality: Quality
    polarity: str  # dark, bright or mixed
    cluster_members: int
    refit_points: int
    cover: float
    outside: int  # parts of the ellipse, of eight, outside which another edge shows
    has_inner: bool
    inner: Optional[InnerPart]  # as found; believed when has_inner
    pose: Optional[Pose]
    alternative: Optional[Pose]  # the other pose that the ellipse allows
    orientation_resolved: bool  # the inner part decided between the two
    ambiguity: float
    doubt: float  # share of the distance in doubt by the inner part's size and by edges outside, in the covariance;
    # 1/64 and more where the inner part contradicts the outline
    log_odds: Optional[float]  # natural logarithm of the odds that the pose is right; 'unsure', too, has it. None without
    # a pose or for a model without an inner part; -3 + cover where no inner part is weighed
    covariance: Optional[Vector]  # shape (5, 5): x, y, z in metres, yaw, pitch in radians
    position_std_m: Optional[Vector]  # shape (3,)
    axis_std_rad: Optional[float]

    @property
    def ok(self) -> bool:
        return self.status == 'ok'

    @property
    def reliability(self) -> float:
        return self.quality.reliability


@dataclass(frozen=True, eq=False)
class Estimate:
    """The filter's: metres, metres a second, radians; arrays of shape (3,); standard deviations."""
    position_m: Vector
    velocity_mps: Vector
    axis: Vector
    yaw_rad: float
    pitch_rad: float
    orientation_resolved: bool
    position_std_m: Vector
    yaw_std_rad: float
    pitch_std_rad: float
    axis_std_rad: float


@dataclass(frozen=True, eq=False)
class Frame:
    """One frame of a track: state is tracking, coasting or lost; gated: measured, but refused."""
    state: str
    gated: bool
    region: Region  # asked for; width 0: the whole image
    raw: Result
    filtered: Optional[Estimate]  # None while lost


@dataclass(frozen=True)
class Sighting:
    """Where search() saw something: region for measure(), about the middle and radius in pixels; score compares."""
    region: Region
    x: int
    y: int
    radius: int
    score: int


@dataclass(frozen=True)
class Threshold:
    default: float
    least: float
    most: float
    unit: str


def result_from(raw: Mapping[str, Any]) -> Result:
    values = dict(raw)
    ok = values['status'] == 'ok'
    seen = values['ellipse'][2] > 0
    values['ellipse'] = Ellipse(*values['ellipse']) if seen else None
    values['ideal'] = Ellipse(*values['ideal']) if values['ideal'][2] > 0 else None
    values['quality'] = Quality(*values['quality'])
    values['polarity'] = POLARITIES[values['polarity']]
    values['inner'] = InnerPart(*values['inner']) if any(values['inner']) else None
    for name in ('pose', 'alternative'):
        values[name] = Pose(*values[name]) if ok else None
    for name in ('covariance', 'position_std_m', 'axis_std_rad'):
        values[name] = values[name] if ok else None
    return Result(**values)


def estimate_from(raw: Optional[Tuple[Any, ...]]) -> Optional[Estimate]:
    return None if raw is None else Estimate(*raw)
