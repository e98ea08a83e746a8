# SPDX-License-Identifier: Apache-2.0
"""Images as grey arrays through Pillow, or OpenCV where that alone is there; videos through OpenCV."""
from __future__ import annotations

import pathlib
from typing import Any, Iterable, Iterator, Tuple, Union

import numpy as np
import numpy.typing as npt

Grey = npt.NDArray[np.uint8]
Path = Union[str, pathlib.Path]
VIDEOS = {'.avi', '.mkv', '.mov', '.mp4', '.m4v', '.webm'}
IMAGES = {'.png', '.pgm', '.ppm', '.jpg', '.jpeg', '.bmp', '.tif', '.tiff'}


def to_grey(rgb: npt.NDArray[np.uint8]) -> Grey:
    """(77 R + 150 G + 29 B + 128) >> 8 of shape (rows, columns, 3), as the program does it."""
    weighted = rgb.astype(np.uint32) @ np.array([77, 150, 29], np.uint32)
    return ((weighted + 128) >> 8).astype(np.uint8)


def read(path: Path) -> Grey:
    """An image file as uint8 of shape (rows, columns): 16 bits are rounded to 8, alpha is ignored. Pillow cuts
    16 bits of colour or with alpha down: those need OpenCV. OSError and ValueError name the file."""
    try:
        from PIL import Image, UnidentifiedImageError
    except ImportError:
        return _read_by_opencv(path, 'images need Pillow or OpenCV: pip install pillow')
    try:
        return _read_by_pillow(path, Image)
    except UnidentifiedImageError:
        raise OSError(f'{path}: cannot be read as an image') from None
    except (ImportError, MemoryError):
        raise
    except OSError as error:
        if error.filename is not None or str(error).startswith(f'{path}: '):
            raise
        raise OSError(f'{path}: {error}') from None
    except Exception as error:  # Pillow raises whatever a broken file leads it to, of no class that a caller expects
        raise ValueError(f'{path}: {str(error) or type(error).__name__}') from None


def _read_by_pillow(path: Path, pillow: Any) -> Grey:
    with pillow.open(path) as image:
        if image.mode in ('I', 'I;16', 'I;16B', 'I;16L'):
            wide = np.asarray(image, np.uint32)
            return ((wide * 255 + 32767) // 65535).astype(np.uint8)
        if ';16' in str(image.tile):
            return _read_by_opencv(path, f'{path}: 16 bits of colour or with alpha need OpenCV: pip install '
                                         'opencv-python-headless')
        if image.mode in ('L', 'LA', '1'):
            return np.asarray(image.convert('RGBA'), np.uint8)[..., 0].copy()
        return to_grey(np.asarray(image.convert('RGBA'), np.uint8)[..., :3])


def _read_by_opencv(path: Path, needed: str) -> Grey:
    try:
        import cv2
    except ImportError:
        raise ImportError(needed) from None
    image = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    if image is None:
        raise OSError(f'{path}: cannot be read as an image')
    if image.dtype == np.uint16:
        image = ((image.astype(np.uint32) * 255 + 32767) // 65535).astype(np.uint8)
    samples: Grey = np.asarray(image, np.uint8)
    if samples.ndim == 2:
        return samples
    return samples[..., 0].copy() if samples.shape[2] < 3 else to_grey(samples[..., 2::-1])


def _video(path: Path) -> Iterator[Tuple[str, Grey]]:
    try:
        import cv2
    except ImportError:
        raise ImportError('videos need OpenCV: pip install opencv-python-headless') from None
    capture = cv2.VideoCapture(str(path))
    if not capture.isOpened():
        raise OSError(f'{path}: cannot be read as a video')
    number = 0
    while True:
        good, image = capture.read()
        if not good:
            return
        number += 1
        yield f'{path}#{number}', to_grey(np.asarray(image, np.uint8)[..., ::-1])


def files(paths: Union[Path, Iterable[Path]]) -> Iterator[pathlib.Path]:
    """The paths, but for a folder the images in it, by name."""
    for path in [paths] if isinstance(paths, (str, pathlib.Path)) else paths:
        path = pathlib.Path(path)
        if path.is_dir():
            yield from sorted(p for p in path.iterdir() if p.suffix.lower() in IMAGES)
        else:
            yield path


def frames(paths: Union[Path, Iterable[Path]]) -> Iterator[Tuple[str, Grey]]:
    """Name and picture of each frame of image files, folders of images by name, and videos."""
    for path in files(paths):
        if path.suffix.lower() in VIDEOS:
            yield from _video(path)
        else:
            yield str(path), read(path)
