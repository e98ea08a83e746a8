# SPDX-License-Identifier: Apache-2.0
"""One self-contained page about a track: frames with what was found, plots by plotly, a slider through the frames."""
from __future__ import annotations

import base64
import html
import io
import json
import math
import pathlib
import string
from decimal import Decimal
from typing import Any, Dict, Iterable, List, Tuple

import numpy as np
import numpy.typing as npt

from . import Camera, Ellipse, Frame, Tracker

WIDEST = 960  # px of a picture on the page
RED, GREEN, YELLOW, BLUE = (255, 70, 70), (120, 255, 60), (255, 225, 0), (140, 150, 255)
Vector = npt.NDArray[np.float64]


def outline(e: Ellipse, steps: int = 120) -> List[Tuple[float, float]]:
    c, s = math.cos(e.angle_rad), math.sin(e.angle_rad)
    turns = [2 * math.pi * i / steps for i in range(steps + 1)]
    return [(e.xc + e.a * math.cos(t) * c - e.b * math.sin(t) * s, e.yc + e.a * math.cos(t) * s + e.b * math.sin(t) * c)
            for t in turns]


def project(point: Vector, camera: Camera) -> Tuple[float, float]:
    x, y = point[0] / point[2], point[1] / point[2]
    r2 = x * x + y * y
    radial = 1 + r2 * (camera.k1 + r2 * (camera.k2 + r2 * camera.k3))
    u = x * radial + 2 * camera.p1 * x * y + camera.p2 * (r2 + 2 * x * x)
    v = y * radial + camera.p1 * (r2 + 2 * y * y) + 2 * camera.p2 * x * y
    return camera.fx * u + camera.cx, camera.fy * v + camera.cy


def draw(image: npt.NDArray[np.uint8], frame: Frame, camera: Camera) -> str:
    """The picture as a data URL: region, outline, axis out of the mouth, inner centre."""
    try:
        from PIL import Image, ImageDraw
    except ImportError:
        raise ImportError('the report needs Pillow: pip install "drogue[report]"') from None
    raw = frame.raw
    scale = min(1.0, WIDEST / image.shape[1])
    size = (max(1, round(image.shape[1] * scale)), max(1, round(image.shape[0] * scale)))
    picture = Image.fromarray(image).convert('RGB').resize(size)
    pen = ImageDraw.Draw(picture)

    def at(x: float, y: float) -> Tuple[float, float]:
        return (x + 0.5) * scale - 0.5, (y + 0.5) * scale - 0.5

    x, y, width, height = raw.region
    if width > 0 and height > 0:
        pen.rectangle([at(x, y), at(x + width - 1, y + height - 1)], outline=BLUE)
    if raw.ellipse is not None:
        pen.line([at(*p) for p in outline(raw.ellipse)], fill=RED, width=2)
    if raw.pose is not None and raw.ellipse is not None:
        radius = raw.pose.position_m[2] * raw.ellipse.a / camera.fx
        ends = [raw.pose.position_m, raw.pose.position_m - raw.pose.axis * radius]
        if min(end[2] for end in ends) > 0:
            pen.line([at(*project(end, camera)) for end in ends], fill=YELLOW, width=2)
    if raw.has_inner and raw.inner is not None:
        u, v = at(raw.inner.x, raw.inner.y)
        pen.line([(u - 5, v), (u + 5, v)], fill=GREEN)
        pen.line([(u, v - 5), (u, v + 5)], fill=GREEN)
    data = io.BytesIO()
    picture.save(data, 'JPEG', quality=85)
    return 'data:image/jpeg;base64,' + base64.b64encode(data.getvalue()).decode('ascii')


def row(name: str, number: int, time: float, frame: Frame) -> Dict[str, Any]:
    """What plots and table need of a frame; None where it is not known."""
    raw, filtered = frame.raw, frame.filtered
    seen = raw.ellipse is not None
    out: Dict[str, Any] = {'name': name, 'frame': number, 'time': time, 'state': frame.state, 'status': raw.status,
                           'gated': frame.gated, 'resolved': raw.orientation_resolved,
                           'reliability': raw.reliability if seen else None, 'cover': raw.cover if seen else None}
    for k, axis in enumerate('xyz'):
        out[f'raw_{axis}'] = None if raw.pose is None else float(raw.pose.position_m[k])
        out[axis] = None if filtered is None else float(filtered.position_m[k])
        out[f'{axis}_std'] = None if filtered is None else float(filtered.position_std_m[k])
    for angle in ('yaw', 'pitch'):
        out[f'raw_{angle}'] = None if raw.pose is None else math.degrees(getattr(raw.pose, f'{angle}_rad'))
        out[angle] = None if filtered is None else math.degrees(getattr(filtered, f'{angle}_rad'))
        out[f'{angle}_std'] = None if filtered is None else math.degrees(getattr(filtered, f'{angle}_std_rad'))
    return out


def runs(rows: List[Dict[str, Any]], name: str) -> Iterable[List[Dict[str, Any]]]:
    """Frames in a row in which a quantity is known: a band does not reach across what was lost."""
    run: List[Dict[str, Any]] = []
    for r in rows:
        if r[name] is not None:
            run.append(r)
        elif run:
            yield run
            run = []
    if run:
        yield run


def plots(rows: List[Dict[str, Any]], unit: str) -> str:
    """The plots, with plotly's script in them."""
    try:
        import plotly.graph_objects as go
        from plotly.subplots import make_subplots
    except ImportError:
        raise ImportError('the report needs plotly: pip install "drogue[report]"') from None
    quantities = [('x', unit), ('y', unit), ('z', unit), ('yaw', 'degrees'), ('pitch', 'degrees')]
    last = len(quantities) + 1
    figure = make_subplots(rows=last, cols=1, shared_xaxes=True, vertical_spacing=0.025)
    times = [r['time'] for r in rows]
    for k, (name, of) in enumerate(quantities, 1):
        for i, run in enumerate(runs(rows, name)):
            there = [r['time'] for r in run]
            upper = [r[name] + 2 * r[f'{name}_std'] for r in run]
            lower = [r[name] - 2 * r[f'{name}_std'] for r in run]
            figure.add_trace(go.Scatter(x=there + there[::-1], y=upper + lower[::-1], fill='toself', mode='lines',
                                        line={'width': 0}, fillcolor='rgba(30,90,200,0.18)', hoverinfo='skip',
                                        name='filtered, two standard deviations', legendgroup='band',
                                        showlegend=k == 1 and i == 0), k, 1)
        figure.add_trace(go.Scatter(x=times, y=[r[f'raw_{name}'] for r in rows], mode='markers', name='raw',
                                    marker={'size': 5, 'color': '#d2691e'}, legendgroup='raw', showlegend=k == 1), k, 1)
        figure.add_trace(go.Scatter(x=times, y=[r[name] for r in rows], mode='lines', name='filtered',
                                    line={'color': '#1e5ac8'}, legendgroup='filtered', showlegend=k == 1), k, 1)
        figure.update_yaxes(title_text=f'{name}, {of}', row=k, col=1)
    for name, colour in (('reliability', '#2e8b57'), ('cover', '#808080')):
        figure.add_trace(go.Scatter(x=times, y=[r[name] for r in rows], mode='lines+markers', name=name,
                                    line={'color': colour}), last, 1)
    figure.update_yaxes(title_text='0 to 1', range=[0, 1.05], row=last, col=1)
    figure.update_xaxes(title_text='time, s', row=last, col=1)
    figure.update_layout(height=230 * last, margin={'l': 80, 'r': 20, 't': 80, 'b': 50}, template='plotly_white',
                         legend={'orientation': 'h', 'y': 1.03})
    return str(figure.to_html(full_html=False, include_plotlyjs=True, div_id='plots', config={'displaylogo': False}))


def script(value: Any) -> str:
    """JSON that may stand in a script element."""
    return json.dumps(value).replace('<', '\\u003c')


def time_us(frame: int, fps: float) -> int:
    """Time of a frame, counted from 0, to the microsecond, as the program has it: the rate in billionths."""
    rate = int(Decimal(str(fps)) * 10**9)
    return (2 * frame * 10**15 + rate) // (2 * rate)


def build(frames: Iterable[Tuple[str, npt.NDArray[np.uint8]]], tracker: Tracker, camera: Camera, fps: float,
          unit: str) -> str:
    """The page of a track over frames, pairs of name and picture; fps frames a second; unit of lengths."""
    if not 0.0005 <= fps <= 1000000:
        raise ValueError(f"--fps: '{fps:g}' is not a rate from 0.0005 to 1000000 frames a second")
    rows: List[Dict[str, Any]] = []
    pictures: List[str] = []
    for number, (name, image) in enumerate(frames, 1):
        now_us = time_us(number - 1, fps)
        try:
            frame = tracker.frame(image, (now_us - time_us(number - 2, fps)) / 1e6)
        except ValueError as error:
            raise ValueError(f'{name}: {error}') from None
        rows.append(row(name, number, now_us / 1e6, frame))
        pictures.append(draw(image, frame, camera))
    if not rows:
        raise ValueError('no frame was found')
    measured = sum(r['status'] == 'ok' for r in rows)
    tracking = sum(r['state'] == 'tracking' for r in rows)
    resolved = sum(r['resolved'] for r in rows)
    summary = (f'{len(rows)} frames at {fps:g} a second: {measured} measured, {resolved} with the orientation resolved, '
               f'{tracking} tracked; lengths in {unit}.')
    title = rows[0]['name'] if len(rows) == 1 else f'{rows[0]["name"]} and {len(rows) - 1} more'
    page = string.Template((pathlib.Path(__file__).parent / 'report.html').read_text(encoding='utf-8'))
    return page.substitute(title=html.escape(title), summary=html.escape(summary), last=len(rows) - 1,
                           plots=plots(rows, unit), rows=script(rows), pictures=script(pictures), unit=script(unit))
