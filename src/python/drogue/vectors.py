# SPDX-License-Identifier: Apache-2.0
"""The golden vectors as numpy arrays, for tests of other implementations and for cocotb (vectors/README.md).

    for case in drogue.vectors.load("vectors", stage="mask"):
        print(case.id, case.inputs["params"], case.exact["ring"].shape)
"""
from __future__ import annotations

import hashlib
import io
import json
import pathlib
from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Mapping, Optional, Union

import numpy as np
import numpy.typing as npt

from . import images

Array = npt.NDArray[Any]


@dataclass(frozen=True, eq=False)
class Case:
    """One case: arrays by name. Words are signed integers of their width; an image is uint8 of shape (rows, columns)."""
    id: str
    stage: str
    tier: str
    inputs: Dict[str, Array]
    exact: Dict[str, Array]  # expected bit for bit
    described: Mapping[str, Any]  # as in manifest.json: Q formats, bounds of the reference tier


def read_array(folder: Union[str, pathlib.Path], described: Mapping[str, Any]) -> Array:
    """The words or pixels of one file, whose SHA-256 must be as described."""
    path = pathlib.Path(folder) / described['file']
    data = path.read_bytes()
    if hashlib.sha256(data).hexdigest() != described['sha256']:
        raise ValueError(f'{path}: not the file that the manifest describes')
    if path.suffix == '.png':
        return images.read(io.BytesIO(data))  # type: ignore[arg-type]
    unsigned = np.array([int(word, 16) for word in data.split()], dtype=f'u{described["bits"] // 8}')
    return unsigned.view(f'i{described["bits"] // 8}')


def load(folder: Union[str, pathlib.Path], stage: Optional[str] = None) -> Iterator[Case]:
    """The cases of a folder with a manifest.json, or those of one stage. ValueError where that has none: a test of no case
    would pass."""
    manifest = json.loads((pathlib.Path(folder) / 'manifest.json').read_text())
    if stage is not None and all(case['stage'] != stage for case in manifest['cases']):
        raise ValueError(f'{folder}: no case of a stage {stage!r}; see stages()')
    for case in manifest['cases']:
        if stage is None or case['stage'] == stage:
            yield Case(case['id'], case['stage'], case['tier'],
                       {a['name']: read_array(folder, a) for a in case['inputs']},
                       {a['name']: read_array(folder, a) for a in case['exact']}, case)


def stages(folder: Union[str, pathlib.Path]) -> List[str]:
    """Names of the stages that have cases."""
    manifest = json.loads((pathlib.Path(folder) / 'manifest.json').read_text())
    return sorted({case['stage'] for case in manifest['cases']})
