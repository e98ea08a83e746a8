# SPDX-License-Identifier: Apache-2.0
"""python -m drogue report FRAMES... -o report.html: one page about a track."""
from __future__ import annotations

import argparse
import os
import pathlib
import re
import sys
from typing import Callable, List, Optional, Tuple

from . import Camera, Model, Tracker, __version__, images, report, thresholds


def number(text: str) -> float:
    """As the program takes it: no spaces, no hexadecimal digits, no nan, no inf."""
    if not re.fullmatch(r'[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?', text):
        raise argparse.ArgumentTypeError(f"'{text}' is not a decimal number")
    return float(text)


def numbers(*counts: int) -> Callable[[str], List[float]]:
    def parse_list(text: str) -> List[float]:
        items = text.split(',')
        if len(items) not in counts:
            raise argparse.ArgumentTypeError(f'{" or ".join(map(str, counts))} numbers separated by commas are wanted, '
                                             f'not {len(items)}')
        return [number(item) for item in items]
    return parse_list


def region(text: str) -> List[int]:
    values = numbers(4)(text)
    if not all(value.is_integer() for value in values):
        raise argparse.ArgumentTypeError(f"'{text}' are not whole numbers")
    return [int(value) for value in values]


def whole(text: str) -> int:
    if not number(text).is_integer():
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number")
    return int(float(text))


def missed(text: str) -> int:
    if not 0 <= whole(text) <= 1000000:
        raise argparse.ArgumentTypeError(f"'{text}' is outside [0, 1000000]")
    return whole(text)


def setting(text: str) -> Tuple[str, float]:
    """Of a threshold; what rounds into its range is in it."""
    name, sign, value = text.partition('=')
    if not sign:
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=VALUE")
    if name not in thresholds():
        raise argparse.ArgumentTypeError(f"no threshold is named '{name}'; see drogue.thresholds()")
    known = thresholds()[name]
    try:
        if not known.least - 0.5 / 65536 <= number(value) < known.most + 0.5 / 65536:
            raise argparse.ArgumentTypeError(f"'{value}' is outside [{known.least:.10g}, {known.most:.10g}]")
    except argparse.ArgumentTypeError as error:
        raise argparse.ArgumentTypeError(f'{name}: {error}') from None
    return name, number(value)


def joined(arguments: List[str]) -> List[str]:
    """A value that begins with a minus sign goes to its option, as --name=value: argparse takes it for an option."""
    out: List[str] = []
    for k, argument in enumerate(arguments):
        if argument == '--':
            return out + arguments[k:]
        if out and re.match(r'--[^=]+$', out[-1]) and re.match(r'-\.?[0-9]', argument):
            out[-1] += f'={argument}'
        else:
            out.append(argument)
    return out


def parse(arguments: Optional[List[str]]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog='python -m drogue', description='Pose of a refuelling drogue from images.')
    parser.add_argument('--version', action='version', version=f'drogue {__version__}')
    commands = parser.add_subparsers(dest='command', required=True)
    page = commands.add_parser('report', help='one self-contained page about a track')
    page.add_argument('frames', nargs='+', help='images, folders of images, videos')
    page.add_argument('-o', '--output', required=True, help='the page, .html')
    page.add_argument('--camera', required=True, type=numbers(4), metavar='FX,FY,CX,CY')
    page.add_argument('--distortion', type=numbers(5), default=[], metavar='K1,K2,P1,P2,K3')
    page.add_argument('--drogue', type=numbers(1, 3), metavar='RADIUS[,INNER,DEPTH]')
    page.add_argument('--roi', type=region, metavar='X,Y,W,H')
    page.add_argument('--fps', type=float, default=30.0)
    page.add_argument('--set', type=setting, action='append', default=[], metavar='NAME=VALUE',
                      help='a threshold, as often as wanted: drogue.thresholds() lists them')
    page.add_argument('--max-missed', type=missed, default=10, metavar='N',
                      help='frames in a row without the drogue that a track survives')
    page.add_argument('--min-reliability', type=number, default=0.0, metavar='R',
                      help='a measurement of less counts as missed')
    return parser.parse_args(joined(sys.argv[1:] if arguments is None else arguments))


def model(lengths: List[float]) -> Model:
    """As the program: who gives three lengths knows the inner part, which a Model's inner radius of 0 says nobody does."""
    if len(lengths) == 3 and lengths[1] < 0.5 / 65536:
        raise ValueError('--drogue: INNER must be above 0 (at least 1/65536)')
    return Model(*lengths)


def check_output(names: List[str], output: pathlib.Path) -> None:
    """Before anything is computed: what cannot be written, or must not be."""
    if output.is_dir():
        raise ValueError(f'{output}: is a folder')
    if not output.parent.is_dir():
        raise ValueError(f'{output}: there is no folder {output.parent}')
    if not os.access(output if output.exists() else output.parent, os.W_OK):
        raise ValueError(f'{output}: cannot be written')
    for path in images.files(names) if output.exists() else ():
        if path.exists() and path.samefile(output):
            raise ValueError(f'{output}: is read as input and would be overwritten')


def main(arguments: Optional[List[str]] = None) -> int:
    a = parse(arguments)
    output = pathlib.Path(a.output)
    try:
        check_output(a.frames, output)
        camera = Camera(*a.camera, *a.distortion)
        tracker = Tracker(camera, model(a.drogue or [1.0]), a.roi, dict(a.set), a.max_missed, a.min_reliability)
        page = report.build(images.frames(a.frames), tracker, camera, a.fps, 'rim radii' if a.drogue is None else 'm')
        try:
            output.write_text(page, encoding='utf-8')
        except OSError as error: # one of a write names no file
            raise OSError(error.errno, error.strerror, str(output)) from None
    except (OSError, ValueError, ImportError) as error:
        if isinstance(error, OSError) and error.filename is not None:
            print(f'drogue: {error.filename}: {error.strerror}', file=sys.stderr)
        else:
            print(f'drogue: {error}', file=sys.stderr)
        return 2
    return 0


if __name__ == '__main__':
    sys.exit(main())
