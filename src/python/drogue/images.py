# SPDX-License-Identifier: Apache-2.0
"""Images as grey arrays through Pillow, or OpenCV where that alone is there; videos through OpenCV."""
from __future__ import annotations

import os
import pathlib
import re
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
    if isinstance(path, (str, os.PathLike)):  # bytes in memory, too, are read: PNG of the golden vectors
        with open(path, 'rb') as file:
            if file.read(2) in (b'P5', b'P6'):
                return _read_pnm(path)
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


def _read_pnm(path: Path) -> Grey:
    """Binary PGM and PPM of any greatest value, rounded as the program does it and Pillow does not."""
    data = pathlib.Path(path).read_bytes()
    number = rb'(?:\s|#[^\n]*\n)*([0-9]{1,8})\s'
    head = re.match(rb'P[56]' + 3 * number, data)
    width, height, most = (int(text) for text in head.groups()) if head else (0, 0, 0)
    if head is None or width < 1 or height < 1 or not 1 <= most <= 65535:
        raise ValueError(f'{path}: no sound header of a PGM or PPM file')
    count, channels = width * height, 3 if data[1:2] == b'6' else 1
    kind = np.dtype('>u2' if most > 255 else 'u1')
    if count > 2**26:
        raise ValueError(f'{path}: {width}x{height} pixels are more than the {2**26} that are read')
    if len(data) - head.end() < count * channels * kind.itemsize:
        raise ValueError(f'{path}: the file ends early')
    samples = np.frombuffer(data, kind, count * channels, head.end()).astype(np.uint32)
    if samples.max() > most:
        raise ValueError(f'{path}: a sample is {samples.max()}, more than the {most} that the header allows')
    scaled = ((samples * 510 + most) // (2 * most)).astype(np.uint8)
    return scaled.reshape(height, width) if channels == 1 else to_grey(scaled.reshape(height, width, 3))


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
