# SPDX-License-Identifier: Apache-2.0
"""Pose of a refuelling drogue from one image: the fixed-point library's results as floats and numpy arrays.

    import drogue
    image = drogue.images.read("demo.png")
    print(drogue.measure(image, drogue.Camera(1465.5, 1465.5, 403.5, 143.5), drogue.Model(0.35, 0.12, 0.25)).pose)

Pixel (0, 0) is the centre of the top-left pixel, x right, y down. Camera frame: x right, y down, z forward, metres. The
axis is a unit vector into the drogue; yaw = atan2(x, z), pitch = asin(y) of it. Every float is a fixed-point number of
the library's, exactly. What takes long releases the interpreter's lock.
"""
from __future__ import annotations

from typing import List, Mapping, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from . import _native, images, vectors
from ._types import (Camera, Ellipse, Estimate, Frame, InnerPart, Model, Pose, Quality, Region, Result, Sighting,
                     Threshold, estimate_from, result_from)

__all__ = ['Camera', 'Ellipse', 'Estimate', 'Frame', 'InnerPart', 'Model', 'Pose', 'Quality', 'Region', 'Result',
           'Sighting', 'Threshold', 'Tracker', 'canny', 'images', 'measure', 'search', 'thresholds', 'vectors']
__version__: str = _native.version()


def measure(image: npt.NDArray[np.uint8], camera: Camera, model: Optional[Model] = None,
            region: Optional[Sequence[int]] = None, config: Optional[Mapping[str, float]] = None) -> Result:
    """Measure one image.

    image   uint8, shape (rows, columns), up to 32767 each; parts of up to 2048 x 2048 are measured
    camera  focal lengths and principal point in pixels, distortion
    model   radii and depth in metres; None: a rim of radius 1, so that positions come out in rim radii
    region  x, y, width, height in pixels, the drogue about its middle, longest side 2 to 3 major semi-axes; None: the
            whole image is searched
    config  thresholds by name, see thresholds()
    return  the result; its status says why when there is no pose. Raises TypeError for what is not a picture or a number
            (whole ones in a region), ValueError for a number out of range, KeyError for a threshold that does not exist
    """
    return result_from(_native.measure(image, camera.numbers(), (model or Model(1.0)).numbers(), region,
                                       dict(config or {})))


def search(image: npt.NDArray[np.uint8]) -> List[Sighting]:
    """Places where a dark disc inside a ring may be, by falling score; at most 12.

    image  uint8, shape (rows, columns)
    """
    return [Sighting(*item) for item in _native.search(image)]


def canny(image: npt.NDArray[np.uint8], low: int, high: int, smooth: bool = False) -> npt.NDArray[np.uint8]:
    """Canny's edge map, 0 and 255, equal to cv2.Canny(image, low, high, apertureSize=3, L2gradient=False).

    image      uint8, shape (rows, columns), at most 2048 each
    low, high  thresholds on the L1 Sobel magnitude, 0 <= low <= high
    smooth     5 x 5 binomial smoothing first
    """
    return _native.canny(image, low, high, smooth)


def thresholds() -> Mapping[str, Threshold]:
    """Every threshold with default, range, and unit or effect."""
    return {name: Threshold(*values) for name, values in _native.thresholds().items()}


class Tracker:
    """The drogue over the frames of one camera, all of one size: prediction, gate, coasting, re-acquisition.

    region      of the first frame, as of measure(); None: the whole image is searched
    max_missed  frames in a row without the drogue that a track survives
    min_reliability  a measurement of less counts as missed
    """

    def __init__(self, camera: Camera, model: Optional[Model] = None, region: Optional[Sequence[int]] = None,
                 config: Optional[Mapping[str, float]] = None, max_missed: int = 10,
                 min_reliability: float = 0.0) -> None:
        self._native = _native.Tracker(camera.numbers(), (model or Model(1.0)).numbers(), region, dict(config or {}),
                                       max_missed, min_reliability)

    def frame(self, image: npt.NDArray[np.uint8], dt_s: float = 1 / 30) -> Frame:
        """Track one frame, dt_s seconds after the one before (rounded to microseconds)."""
        state, gated, region, raw, estimate = self._native.frame(image, dt_s)
        return Frame(state, gated, region, result_from(raw), estimate_from(estimate))
